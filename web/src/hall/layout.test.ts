import { describe, expect, it } from 'vitest';
import { loadRun, logText, LOGS, runOf, type LogName } from '../../tests/support';
import { boxOf, contains, distance, nearestOnEdge } from './geometry';
import { layOut, type Layout } from './layout';
import { arrange } from './crowd';
import { Heads } from './heads';
import { Piles, type Pile } from './piles';
import { spread } from './spread';

function layoutOf(name: LogName): Layout {
  const run = loadRun(name);
  return layOut(run.header, run.seenAt);
}

/** As earlier versions wrote it: without a word about where machines and material are. */
function silent(name: LogName): Layout {
  const [first, ...rest] = logText(name).split('\n');
  const header = JSON.parse(first!) as Record<string, unknown> & { places: { at?: string }[] };
  for (const key of ['kinds', 'machine_stations', 'machine_areas', 'machine_positions']) delete header[key];
  for (const place of header.places) delete place.at;
  const run = runOf([JSON.stringify(header), ...rest].join('\n'));
  return layOut(run.header, run.seenAt);
}

const HALLS: [string, Layout][] = LOGS.flatMap((name) => [
  [name, layoutOf(name)],
  [`${name}, of which the log says little`, silent(name)],
]);

describe.each(HALLS)('the hall of %s', (_name, layout) => {
  const { bounds } = layout;

  it('has every machine and all material on the floor', () => {
    for (const { centre } of layout.machines) expectInside(centre);
    for (const { centre } of layout.material.values()) expectInside(centre);
  });

  it('has no two machines in one another', () => {
    for (const one of layout.machines) {
      for (const other of layout.machines) {
        if (one !== other && !one.overhead && !other.overhead) {
          expect(contains(other.area, one.centre), `${one.name} in ${other.name}`).toBe(false);
          expect(distance(one.centre, other.centre)).toBeGreaterThan(0.7);
        }
      }
    }
  });

  it('keeps machines that it places itself away from where people and robots stand', () => {
    for (const { centre, known } of layout.machines) {
      if (known) continue;
      for (const station of layout.stations.values()) {
        for (const pose of station.poses) expect(distance(pose, centre)).toBeGreaterThan(0.9);
      }
    }
  });

  function expectInside([x, y]: [number, number]): void {
    expect(x).toBeGreaterThanOrEqual(bounds.x0);
    expect(x).toBeLessThanOrEqual(bounds.x1);
    expect(y).toBeGreaterThanOrEqual(bounds.y0);
    expect(y).toBeLessThanOrEqual(bounds.y1);
  }
});

describe('the layout', () => {
  it.each([layoutOf, silent])('puts material on the rack or table at its station', (make) => {
    const layout = make('routed');
    const on = (place: string): string | undefined =>
      layout.blocks.find((block) => contains(block.polygon, layout.material.get(place)!.centre))?.name;
    expect(on('flange_stock')).toBe('raw_storage');
    expect(on('flange_table')).toBe('flange_table');
    expect(on('bend_table')).toBe('bend_table');
    expect(on('flange_side.inner')).toBe('welding_stations');
  });

  it('takes walls for walls, and an obstacle with a machine’s name for the machine', () => {
    const layout = layoutOf('routed');
    expect(layout.blocks.filter(({ look }) => look === 'wall').map(({ name }) => name)).toEqual([
      'wall_south',
      'wall_north',
      'wall_west',
      'wall_east',
    ]);
    expect(layout.machines.find(({ name }) => name === 'cutter')).toMatchObject({ block: true, height: 1.6 });
  });

  it('puts machines of which the log says nothing between what they work on', () => {
    const layout = silent('routed');
    const welder = layout.machines.find(({ name }) => name === 'welder.inner')!;
    const stations = layout.blocks.find(({ name }) => name === 'welding_stations')!;
    expect(
      contains(stations.polygon, welder.centre) ||
        distance(nearestOnEdge(stations.polygon, welder.centre), welder.centre) < 4,
    ).toBe(true);
  });

  it('uses the areas, stations and positions of machines where the log has them', () => {
    const [first, ...rest] = logText('routed').split('\n');
    const header = JSON.parse(first!) as Record<string, unknown>;
    header.places = (header.places as object[]).map((place) => ({ ...place, at: undefined }));
    header.machine_areas = {
      belt: [
        [-20, 0],
        [-5, 0],
        [-5, 1],
        [-20, 1],
      ],
      inner_gantry: [
        [-25, 2],
        [-24, 2],
        [-24, 8],
        [-25, 8],
      ],
    };
    header.machine_stations = { 'welder.outer': 'storage' };
    header.machine_positions = { inner_gantry: ['home', 'there'] };
    header.kinds = {
      robot: { footprint_m: [1.4, 0.9] },
      human: {
        outline_m: [
          [0, 0],
          [0.6, 0],
          [0.6, 0.4],
          [0, 0.4],
        ],
      },
    };
    const { header: read, seenAt } = runOf([JSON.stringify(header), ...rest].join('\n'));
    const layout = layOut(read, seenAt);
    const machine = (name: string): Layout['machines'][number] =>
      layout.machines.find((candidate) => candidate.name === name)!;
    expect(boxOf(machine('belt').area)).toEqual({ x0: -20, x1: -5, y0: 0, y1: 1 });
    expect(machine('inner_gantry')).toMatchObject({ overhead: true, known: true });
    expect(distance(machine('welder.outer').centre, layout.stations.get('storage')!.centre)).toBeLessThan(4);
    expect(read.kinds.get('robot')).toEqual({ length: 1.4, width: 0.9 });
    expect(read.kinds.get('human')).toEqual({ length: 0.6, width: 0.4 });
    expect(layout.material.get('part_in_gripper.inner')!.atMachine).toBe('inner_gantry');
  });

  it('draws a floor even where a log says nothing at all about places', () => {
    const run = runOf(
      '{"format":"linewright/event_log/1","machines":["a","b"],"workers":[{"id":"human.0","kind":"human","start":"x"}]}\n{"t":2,"event":"end","status":"horizon","makespan":null,"progress":0}\n',
    );
    const layout = layOut(run.header);
    expect(layout.bounds.x1).toBeGreaterThan(layout.bounds.x0);
    expect(layout.machines).toHaveLength(2);
  });
});

describe('the items that are drawn', () => {
  const run = loadRun('routed');
  const layout = layOut(run.header, run.seenAt);
  const piles = new Piles(run, layout, new Heads(run, layout));
  const at = (time: number): Pile[] => piles.at(time, arrange(run, time, layout.agentScale));

  it('are all that the log counts, and those that operations have taken', () => {
    for (const time of [0, 30.5, 200, 433, 772]) {
      const drawn = at(time).reduce((sum, pile) => sum + pile.count, 0);
      const of = new Map(run.header.places.map((place) => [place.name, place.of]));
      let expected = 0;
      for (const { name, of: material, berth } of run.header.places) {
        if (!berth && run.materials.has(material)) expected += run.material.count(name, time);
      }
      for (const { id } of run.header.carriers) expected += run.material.count(id, time);
      for (const { operation } of run.operationsAt(time)) {
        for (const [place, count] of run.header.operations.get(operation)!.consumes) {
          if (run.materials.has(of.get(place)!)) expected += count;
        }
      }
      expect(drawn, `at ${time}`).toBe(expected);
    }
  });

  it('run along the belt while it feeds', () => {
    const straight = (time: number): Pile => at(time).find(({ of, count }) => of === 'straight' && count === 1)!;
    expect(run.operationsAt(30).map(({ operation }) => operation)).toContain('feed');
    const [early, late] = [straight(10).at, straight(50).at];
    expect(early.x - late.x).toBeGreaterThan(10); // from the storage in the east to the cutter in the west
    expect(early.y).toBeCloseTo(late.y);
  });
});

describe('agents at one place', () => {
  const at = (id: string, since: number, moving = false): Parameters<typeof spread>[0][number] => ({
    id,
    since,
    moving,
    width: 1,
    length: 1,
    pose: { x: 5, y: 5, yaw: 0 },
  });

  it('are drawn beside each other, the first where it stands', () => {
    const drawn = spread([at('a', 3), at('b', 1), at('c', 2)], 10);
    expect(drawn.get('b')).toMatchObject({ x: 5, y: 5 });
    const all = [...drawn.values()];
    for (const one of all)
      for (const other of all)
        if (one !== other) expect(distance([one.x, one.y], [other.x, other.y])).toBeGreaterThan(0.9);
  });

  it('are where the log says while they move', () => {
    expect(spread([at('a', 3, true), at('b', 1, true)], 10).get('a')).toEqual({ x: 5, y: 5, yaw: 0 });
  });
});
