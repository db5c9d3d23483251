// What tests (and the curious) may ask of the page: `window.linewright`. Numbers as the log gives them, independent
// of pixels. docs/view.md describes it.

import type { App } from './app';

export interface AgentState {
  x: number; // metres, as the log has it: not moved aside as in the picture
  y: number;
  yaw: number;
  moving: boolean;
  station: string | null; // where it stands
  task: string | null;
  n: number; // decision of the task, 0: none
}

export interface AppState {
  ready: boolean; // everything that ends by itself was read, and all of it was drawn (or it plays)
  time: number;
  last: number;
  playing: boolean;
  speed: number;
  following: boolean;
  theme: string;
  camera: string;
  labels: string;
  routes: boolean;
  selection: object;
  logs: {
    name: string;
    live: boolean;
    reading: boolean;
    shown: boolean;
    problems: { severity: string; text: string }[];
  }[];
  runs: {
    name: string;
    end: object | null;
    agents: Record<string, AgentState>;
    carriers: Record<string, { x: number; y: number; worker: string | null; items: number }>;
    places: Record<string, number>;
    machines: Record<string, { x: number; y: number; state: string; operation: string | null }>;
  }[];
}

export function appState(app: App): AppState {
  const { clock, panes } = app;
  const { logs } = app.shelf;
  return {
    ready: logs.every((log) => !log.reading || log.live) && (clock.playing || !app.wished),
    time: clock.time,
    last: clock.last,
    playing: clock.playing,
    speed: clock.speed,
    following: clock.following,
    theme: app.themeName,
    camera: app.shownRuns.camera,
    labels: app.shownRuns.labels,
    routes: app.shownRuns.routes,
    selection: { ...app.selection },
    logs: logs.map(({ name, live, reading, problems, run }) => ({
      name,
      live,
      reading,
      shown: panes.some((pane) => pane.run === run),
      problems,
    })),
    runs: panes.map((pane) => runState(pane, clock.time)),
  };
}

function runState({ run, hall }: App['panes'][number], clockTime: number): AppState['runs'][number] {
  const time = Math.min(clockTime, run.last);
  const state: AppState['runs'][number] = {
    name: run.name,
    end: run.end ?? null,
    agents: {},
    carriers: {},
    places: {},
    machines: {},
  };
  for (const [id, motion] of run.motions) {
    const { pose, moving, station } = motion.at(time);
    const binding = run.diaries.get(id)!.bindings.find(({ since, until }) => since <= time && time < until);
    const task = binding ? (run.tasks.get(binding.n)?.decision.task ?? null) : null;
    state.agents[id] = { ...pose, moving, station: station ?? null, task, n: binding?.n ?? 0 };
  }
  for (const id of run.carriers.keys()) {
    const { pose, worker } = run.carrierPose(id, time);
    state.carriers[id] = { x: pose.x, y: pose.y, worker: worker ?? null, items: run.material.count(id, time) };
  }
  for (const { name } of run.header.places) state.places[name] = run.material.count(name, time);
  for (const { name, centre } of hall?.layout.machines ?? []) {
    const interval = run.machines.at(name, time);
    state.machines[name] = {
      x: centre[0],
      y: centre[1],
      state: interval?.state ?? 'free',
      operation: interval?.operation ?? null,
    };
  }
  return state;
}
