import { readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { clickChart, exported, launch, openPage, PAGE, PLACEHOLDER, seek, settled } from './browser';
import { loadRun, logText, type LogName } from './support';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser?.close());

const logs = (...names: LogName[]): string =>
  exported(names.map((name) => ({ name: `${name}.jsonl`, text: logText(name) })));

describe('the built page', () => {
  const html = readFileSync(PAGE, 'utf8');

  it('is one file of at most 250 kB gzip that refers to nothing outside', () => {
    expect(gzipSync(html, { level: 9 }).length).toBeLessThan(250_000);
    expect(html).not.toMatch(/<(script|img|iframe)[^>]+src=|<link[^>]+href=/);
    expect(html).not.toMatch(/url\((?!["']?data:)/);
    expect(html).toContain("default-src 'none'");
  });

  it('has exactly one place for logs', () => {
    expect(html.split(PLACEHOLDER)).toHaveLength(2);
    expect(html.split('id="linewright-logs"')).toHaveLength(2);
  });
});

describe('one run', () => {
  let page: Page;
  let faults: string[];
  beforeAll(async () => {
    ({ page, faults } = await openPage(browser, logs('routed')));
  });
  afterAll(() => page.context().close());

  it('is on the page without a fault', async () => {
    const state = await settled(page);
    expect(state).toMatchObject({ ready: true, time: 0, last: 772, playing: false, camera: 'overview' });
    expect(state.logs[0]!.problems).toEqual([]);
    expect(await page.title()).toBe('duct line routed – Linewright');
    expect(faults).toEqual([]);
  });

  it('has agents, carriers and items where the log says, at any tick', async () => {
    const run = loadRun('routed');
    for (const time of [0, 8.25, 47, 300, 433.5, 772]) {
      const { runs } = await seek(page, time);
      for (const [id, agent] of Object.entries(runs[0]!.agents)) {
        const { pose, moving } = run.motions.get(id)!.at(time);
        expect({ x: agent.x, y: agent.y, yaw: agent.yaw, moving: agent.moving }).toEqual({ ...pose, moving });
      }
      for (const [place, count] of Object.entries(runs[0]!.places)) expect(count).toBe(run.material.count(place, time));
    }
  });

  it('agrees with the log itself about who stands where when a way ends', async () => {
    const lines = logText('routed').trim().split('\n');
    const { stations } = JSON.parse(lines[0]!) as { stations: Record<string, Record<string, number[]>> };
    const go = JSON.parse(lines.find((line) => line.includes('"event":"go"'))!) as {
      worker: string;
      to: string;
      arrives: number;
    };
    const agent = (await seek(page, go.arrives)).runs[0]!.agents[go.worker]!;
    const [x, y] = stations[go.to]![go.worker.split('.')[0]!]!;
    expect(agent).toMatchObject({ x, y, moving: false, station: go.to });
  });

  it('plays and pauses, and draws only while it plays', async () => {
    await seek(page, 10);
    await page.click('.play');
    await page.waitForFunction(() => window.linewright.state().time > 12);
    await page.click('.play');
    const { time, playing } = await settled(page);
    expect(playing).toBe(false);
    await page.waitForTimeout(300);
    expect((await settled(page)).time).toBe(time);
  });

  it('scrubs with the slider and on the ticks of the chart', async () => {
    await page.locator('.slider').fill('386');
    expect((await settled(page)).time).toBe(386);
    const chart = (await page.locator('.gantt canvas').boundingBox())!;
    await page.mouse.move(chart.x + 200, chart.y + 8);
    await page.mouse.down();
    await page.mouse.move(chart.x + chart.width / 2, chart.y + 8, { steps: 4 });
    await page.mouse.up();
    const { time } = await settled(page);
    expect(time).toBeGreaterThan(200);
    expect(time).toBeLessThan(500);
  });

  it('zooms the chart, and turns its page when time leaves it', async () => {
    await seek(page, 0);
    for (let i = 0; i < 6; ++i) await page.keyboard.press('+');
    const at = (t: number): Promise<number> =>
      page.evaluate((tick) => window.linewright.pointOf(0, 'human.0', tick)!.x, t);
    expect((await at(10)) - (await at(0))).toBeGreaterThan(50);
    await seek(page, 700);
    const chart = (await page.locator('.gantt canvas').boundingBox())!;
    expect(await at(700)).toBeGreaterThan(chart.x);
    expect(await at(700)).toBeLessThan(chart.x + chart.width);
    expect(await page.locator('.playhead').isVisible()).toBe(true);
    for (let i = 0; i < 6; ++i) await page.keyboard.press('-');
    await settled(page);
  });

  it('says of a bar who did what, with whom, from where and how far', async () => {
    await clickChart(page, 0, 'human.0', 60);
    const { selection, time } = await settled(page);
    expect(selection).toMatchObject({ kind: 'task', worker: 'human.0' });
    expect(Math.abs(time - 60)).toBeLessThan(2);
    const text = await page.locator('.details[data-kind=task]').innerText();
    expect(text).toContain('bring bends');
    expect(text).toMatch(/walks from storage to bend rack, 4\d\.\d m/);
    await clickChart(page, 0, 'robot.0', 60);
    expect(await page.locator('.details[data-kind=task]').innerText()).toMatch(/waits for human\.0/);
  });

  it('says of a decision what else could have been chosen, and why not', async () => {
    await page.keyboard.press('Home');
    await page.keyboard.press('Shift+ArrowRight');
    const { selection, time } = await settled(page);
    expect(selection).toMatchObject({ kind: 'decision', n: 1 });
    expect(time).toBe(1);
    const text = await page.locator('.details[data-kind=decision]').innerText();
    expect(text).toContain('would end at 772');
    expect(text).toContain('flange table.available is 0, needs 1'.replace('table.', 'table · '));
    expect(text).toMatch(/human\.1\s+\d+ ticks, \d+\.\d m/);
    await clickChart(page, 0, 'decisions', 338);
    expect((await settled(page)).selection).toMatchObject({ kind: 'decision' });
    expect((await settled(page)).time).toBe(338);
  });

  it('says of a machine what it works on', async () => {
    await clickChart(page, 0, 'welder.inner', 0);
    const run = loadRun('routed');
    const { begin, operation } = run.machines.intervals.get('welder.inner')![0]!;
    await clickChart(page, 0, 'welder.inner', begin + 8);
    expect((await settled(page)).runs[0]!.machines['welder.inner']).toMatchObject({ state: 'working', operation });
    expect(await page.locator('.details[data-kind=machine]').innerText()).toContain('works on weld flange · inner');
  });

  it('obeys the keyboard and lists its keys', async () => {
    await page.keyboard.press('Escape');
    await seek(page, 100);
    await page.keyboard.press('ArrowRight');
    expect((await settled(page)).time).toBeGreaterThan(100);
    await page.keyboard.press('ArrowUp');
    expect((await settled(page)).speed).toBe(16);
    for (const [key, want] of [
      ['t', { camera: 'top' }],
      ['f', { camera: 'follow' }],
      ['o', { camera: 'overview' }],
      ['l', { labels: 'agents' }],
      ['r', { routes: true }],
      ['d', { theme: 'dark' }],
    ] as const) {
      await page.keyboard.press(key);
      expect(await settled(page)).toMatchObject(want);
    }
    await page.keyboard.press('?');
    expect(await page.locator('dialog.help').innerText()).toContain('play or pause');
    await page.keyboard.press('Escape');
    expect(await page.locator('dialog.help').isVisible()).toBe(false);
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.linewright.state().playing);
    await page.keyboard.press('Space');
    expect((await settled(page)).playing).toBe(false);
  });

  it('follows an agent that was clicked in the hall', async () => {
    await page.keyboard.press('Escape');
    await page.locator('[data-agent="robot.1"]').click();
    await page.keyboard.press('f');
    await seek(page, 440);
    expect((await settled(page)).camera).toBe('follow');
    const hall = (await page.locator('.hall-stage').boundingBox())!;
    await page.mouse.click(hall.x + hall.width / 2, hall.y + hall.height / 2);
    expect((await settled(page)).selection).toMatchObject({ worker: 'robot.1' });
    expect(faults).toEqual([]);
  });
});

describe('two runs', () => {
  it('are shown on one clock, with what makes the difference and where they part', async () => {
    const { page, faults } = await openPage(browser, logs('routed', 'routed_fifo'));
    const state = await seek(page, 500);
    expect(state.runs.map((run) => run.name)).toEqual(['routed.jsonl', 'routed_fifo.jsonl']);
    expect(await page.locator('.hall canvas.stage').count()).toBe(2);
    const panel = page.locator('.details[data-kind=comparison]');
    expect(await panel.innerText()).toContain('B takes 12 ticks longer than A (784 against 772; 1.6 %).');
    const first = page.locator('[data-first]');
    const t = Number(await first.getAttribute('data-first'));
    await first.getByText('Go there').click();
    expect((await settled(page)).time).toBe(t);
    await first.getByText('Why?').first().click();
    expect((await settled(page)).selection).toMatchObject({ kind: 'decision', side: 0 });
    await page.locator('.choices select').nth(1).selectOption('-1');
    expect((await settled(page)).runs).toHaveLength(1);
    expect(faults).toEqual([]);
    await page.context().close();
  });
});

describe('a phone', () => {
  it('shows everything in one column, nothing wider than the screen', async () => {
    const { page, faults } = await openPage(browser, logs('routed'), {
      viewport: { width: 390, height: 844 },
      deviceScaleFactor: 2,
      hasTouch: true,
      isMobile: true,
    });
    const widths = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
    expect(widths[0]).toBeLessThanOrEqual(widths[1]!);
    const order = ['.bar', '.halls', '.transport', '.charts', '.panel'];
    const boxes = await Promise.all(order.map((name) => page.locator(name).boundingBox()));
    boxes.reduce((bottom, box) => (expect(box!.y).toBeGreaterThanOrEqual(bottom - 1), box!.y + box!.height), 0);
    await page.locator('.play').tap();
    await page.waitForFunction(() => window.linewright.state().time > 1);
    expect(faults).toEqual([]);
    await page.context().close();
  });
});
