import type { ServerResponse } from 'node:http';
import { pathToFileURL } from 'node:url';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { clickChart, exported, launch, openPage, PAGE, seek, serve, settled } from './browser';
import { dataFile, logText } from './support';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser?.close());

const text = logText('routed');

describe('a broken log', () => {
  it.each([
    ['cut off', text.slice(0, 60_000), 'The log is cut off in the middle of a line', 1],
    [
      'of another version',
      text.replace('event_log/1', 'event_log/2'),
      'This log has version 2 of the format; this page reads version 1',
      0,
    ],
    ['empty', '', 'The file is empty', 0],
    ['no log', '{"schema": "line/1"}', 'This is not an event log', 0],
    [
      'with a broken line',
      text.replace('"event":"pick_up"', '"event":"vanish"'),
      'is left out: "vanish" is no event of this version',
      1,
    ],
  ])('that is %s is named on the page, and what can be shown is shown', async (_what, log, message, runs) => {
    const { page, faults } = await openPage(browser, exported([{ name: 'bad.jsonl', text: log }]));
    expect(await page.locator('.messages').innerText()).toContain(`bad.jsonl: `);
    expect(await page.locator('.messages').innerText()).toContain(message);
    expect((await settled(page)).runs).toHaveLength(runs);
    expect(await page.locator('.invite').count()).toBe(runs === 0 ? 1 : 0);
    expect(faults).toEqual([]);
    await page.context().close();
  });

  it('does not keep another one from being shown', async () => {
    const { page } = await openPage(
      browser,
      exported([
        { name: 'bad.jsonl', text: 'x' },
        { name: 'good.jsonl', text },
      ]),
    );
    const state = await settled(page);
    expect(state.runs.map((run) => run.name)).toEqual(['good.jsonl']);
    expect(state.logs[0]!.problems).toHaveLength(1);
    await page.context().close();
  });

  it('of 100 MB is shown as far as a page can carry it', async () => {
    const lines = text.split('\n');
    const line = '{"t":700,"event":"milestone","name":"again"}\n';
    const big = `${lines.slice(0, -2).join('\n')}\n`;
    const { url, server } = await serve((request, response) => {
      if (request.url === '/logs.json')
        return response.end(JSON.stringify({ logs: [{ name: 'big.jsonl', href: 'logs/0', live: false }] }));
      response.write(big.slice(0, big.indexOf('{"t":701')));
      const block = line.repeat(20_000);
      let left = Math.ceil(100e6 / block.length);
      const more = (): void => {
        while (left-- > 0) if (!response.write(block)) return void response.once('drain', more);
        response.end();
      };
      more();
    });
    const { page } = await openPage(browser, url);
    await page.waitForFunction(() => !window.linewright.state().logs[0]?.reading, undefined, { timeout: 35_000 });
    expect(await page.locator('.messages').innerText()).toContain('too large for a page');
    expect((await seek(page, 300)).runs[0]!.agents['human.0']).toBeDefined();
    await page.context().close();
    server.closeAllConnections();
    server.close();
  });
});

describe('the page from disk', () => {
  it('without a log asks for files', async () => {
    const { page, faults } = await openPage(browser, pathToFileURL(PAGE).href);
    expect(await page.locator('.invite').innerText()).toContain('Open an event log');
    await page
      .locator('.invite input[type=file]')
      .setInputFiles([dataFile('routed.jsonl'), dataFile('routed_fifo.jsonl')]);
    await page.waitForFunction(() => window.linewright.state().runs.length === 2);
    expect(faults).toEqual([]);
    await page.context().close();
  });

  it('without WebGL has no hall, but everything else', async () => {
    const plain = await launch(['--disable-3d-apis']);
    const { page } = await openPage(plain, exported([{ name: 'run.jsonl', text }]));
    expect(await page.locator('.hall').innerText()).toContain('This browser cannot draw in 3D');
    await clickChart(page, 0, 'human.0', 60);
    expect(await page.locator('.details[data-kind=task]').innerText()).toContain('bring bends');
    expect((await seek(page, 100)).runs[0]!.agents['human.0']).toBeDefined();
    await plain.close();
  });
});

describe('text from files', () => {
  it('never becomes markup or script', async () => {
    const evil = '<img src=x onerror=window.hacked=1></script><script>window.hacked=1</script>';
    const [header, ...rest] = logText('kitting_cell').split('\n');
    const head = JSON.parse(header!) as { line: string; tasks: { name: string }[]; machines: string[] };
    head.line = evil;
    const log = [JSON.stringify(head), ...rest]
      .join('\n')
      .replaceAll('"task":"build"', `"task":${JSON.stringify(evil)}`)
      .replaceAll('"name":"kit_built"', `"name":${JSON.stringify(evil)}`);
    const { page, faults } = await openPage(browser, exported([{ name: evil, text: log }]));
    await page.keyboard.press('Shift+ArrowRight');
    for (let i = 0; i < 6; ++i) await page.keyboard.press('n');
    await settled(page);
    expect(await page.evaluate(() => 'hacked' in window)).toBe(false);
    expect(await page.locator('img').count()).toBe(0);
    expect(await page.locator('h1').textContent()).toContain('<img');
    expect(faults).toEqual([]);
    await page.context().close();
  });
});

describe('a server', () => {
  const open = (live: boolean, answer: (response: ServerResponse) => void): ReturnType<typeof serve> =>
    serve((request, response) => {
      if (request.url === '/logs.json')
        response.end(JSON.stringify({ logs: [{ name: 'run.jsonl', href: 'logs/0', live }] }));
      else if (request.url === '/logs/0') answer(response);
      else response.writeHead(404).end();
    });

  it('sends a log whose simulation still runs, and the page follows it', async () => {
    const lines = logText('kitting_cell').split('\n');
    let stream: ServerResponse | undefined;
    const { url, server } = await open(true, (response) => {
      stream = response;
      response.write(`${lines.slice(0, 40).join('\n')}\n`);
    });
    const { page, faults } = await openPage(browser, url);
    await page.waitForFunction(() => window.linewright.state().runs.length === 1);
    const before = await settled(page);
    expect(before).toMatchObject({ following: true, time: before.last });
    expect(before.last).toBeGreaterThan(5);
    stream!.write(`${lines.slice(40, 90).join('\n')}\n`);
    await page.waitForFunction((last) => window.linewright.state().time > last, before.last);
    expect(await page.locator('.live').isVisible()).toBe(true);
    stream!.end(lines.slice(90).join('\n'));
    await page.waitForFunction(() => window.linewright.state().runs[0]?.end);
    const after = await settled(page);
    expect(after.logs[0]).toMatchObject({ live: false, problems: [] });
    expect(after.time).toBe(after.last);
    expect(faults).toEqual([]);
    await page.context().close();
    server.close();
  });

  it('that goes away leaves what was read, and a message', async () => {
    const { url, server } = await open(true, (response) => {
      response.write(logText('kitting_cell').slice(0, 15_000));
      setTimeout(() => response.destroy(), 300);
    });
    const { page } = await openPage(browser, url);
    await page.waitForFunction(() => document.querySelector('.messages .warning'));
    expect(await page.locator('.messages').innerText()).toContain('could not be read to its end');
    expect((await settled(page)).runs).toHaveLength(1);
    await page.context().close();
    server.close();
  });

  it('without logs gets a message, and files can be chosen instead', async () => {
    const { url, server } = await serve((_request, response) => response.writeHead(500).end());
    const { page } = await openPage(browser, url);
    expect(await page.locator('.messages').innerText()).toContain(
      'The logs could not be loaded: the server answered 500',
    );
    await page.locator('.invite input[type=file]').setInputFiles(dataFile('kitting_cell.jsonl'));
    await page.waitForFunction(() => window.linewright.state().runs.length === 1);
    expect((await settled(page)).runs[0]!.name).toBe('kitting_cell.jsonl');
    expect(await page.locator('.invite').count()).toBe(0);
    await page.context().close();
    server.close();
  });
});
