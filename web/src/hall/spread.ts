// Several agents may stand at one pose of a station. So that each is seen, they are drawn beside each other, in the
// order in which they came; the state that tests compare with the log keeps the pose of the log.

import type { Pose } from '../log/header';

const ABREAST = 5;

export interface Standing {
  id: string;
  pose: Pose;
  moving: boolean;
  since: number;
  width: number; // metres, with some room
  length: number;
}

/** Poses as drawn, by id. Who came second steps aside within a tick. */
export function spread(agents: readonly Standing[], time: number): Map<string, Pose> {
  const drawn = new Map<string, Pose>();
  const groups = new Map<string, Standing[]>();
  for (const agent of agents) {
    drawn.set(agent.id, agent.pose);
    if (agent.moving) continue;
    const key = `${agent.pose.x.toFixed(1)} ${agent.pose.y.toFixed(1)}`;
    const group = groups.get(key);
    if (group) group.push(agent);
    else groups.set(key, [agent]);
  }
  for (const group of groups.values()) {
    if (group.length < 2) continue;
    group.sort((a, b) => a.since - b.since);
    group.forEach((agent, index) => drawn.set(agent.id, aside(agent, index, time)));
  }
  return drawn;
}

function aside({ pose, width, length, since }: Standing, index: number, time: number): Pose {
  const row = Math.floor(index / ABREAST); // the others stand behind
  const place = index % ABREAST;
  const side = place % 2 === 1 ? 1 : -1;
  const eased = Math.min(1, Math.max(0, time - since));
  const across = side * Math.ceil(place / 2) * width * eased;
  const back = row * length * eased;
  return {
    x: pose.x - Math.sin(pose.yaw) * across - Math.cos(pose.yaw) * back,
    y: pose.y + Math.cos(pose.yaw) * across - Math.sin(pose.yaw) * back,
    yaw: pose.yaw,
  };
}
