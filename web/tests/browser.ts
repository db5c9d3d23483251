// Opens the built page in Chromium, from disk or from a small server.

import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer, type IncomingMessage, type Server, type ServerResponse } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';
import type { FrameRate } from '../src/ui/meter';
import type { AppState } from '../src/ui/state';

export const PAGE = fileURLToPath(new URL('../../build/web/linewright-view.html', import.meta.url));
export const PLACEHOLDER = '<script type="application/json" id="linewright-logs">null</script>';

interface PageApi {
  state: () => AppState;
  seek: (time: number) => void;
  meter: () => FrameRate;
  shownAfterMs: () => number;
  pointOf: (run: number, name: string, t: number) => { x: number; y: number } | undefined;
}
declare global {
  interface Window {
    linewright: PageApi;
  }
}

export function launch(
  args = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', ...args],
  });
}

/** What `linewright view LOG... --export` writes: the page with the logs in it. */
export function exported(logs: { name: string; text: string }[]): string {
  const escape = (c: string): string => `\\u${c.charCodeAt(0).toString(16).padStart(4, '0')}`;
  const json = JSON.stringify({ logs }).replace(/[<>&\u2028\u2029]/g, escape);
  const html = readFileSync(PAGE, 'utf8').replace(PLACEHOLDER, () => PLACEHOLDER.replace('null', () => json));
  const file = join(mkdtempSync(join(tmpdir(), 'linewright_')), 'page.html');
  writeFileSync(file, html);
  return pathToFileURL(file).href;
}

/** A page on which nothing may go wrong unseen: `faults` collects errors of scripts and of the policy. */
export async function openPage(
  browser: Browser,
  url: string,
  options: BrowserContextOptions = {},
): Promise<{ page: Page; faults: string[] }> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options });
  const page = await context.newPage();
  const faults: string[] = [];
  page.on('pageerror', (error) => faults.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error') faults.push(message.text());
  });
  await page.goto(url);
  await settled(page);
  return { page, faults };
}

/** Waits until everything was read and drawn; returns the page's state. */
export async function settled(page: Page): Promise<AppState> {
  await page.waitForFunction(() => window.linewright?.state().ready || document.querySelector('.messages p, .invite'));
  return page.evaluate(() => window.linewright.state());
}

export async function seek(page: Page, time: number): Promise<AppState> {
  await page.evaluate((t) => window.linewright.seek(t), time);
  return settled(page);
}

/** Clicks on a row of the Gantt chart of a run at a tick. */
export async function clickChart(page: Page, run: number, row: string, t: number): Promise<void> {
  const point = await page.evaluate(([r, name, tick]) => window.linewright.pointOf(r, name, tick), [
    run,
    row,
    t,
  ] as const);
  if (!point) throw new Error(`the chart has no row ${row}`);
  await page.mouse.click(point.x, point.y);
  await settled(page);
}

export async function serve(
  answer: (request: IncomingMessage, response: ServerResponse) => void,
): Promise<{ url: string; server: Server }> {
  const server = createServer((request, response) => {
    if (request.url !== '/') return answer(request, response);
    response.setHeader('content-type', 'text/html; charset=utf-8');
    response.end(readFileSync(PAGE));
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`, server };
}
