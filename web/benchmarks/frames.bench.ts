// Measures on the page: how soon a log is on the screen, first in a browser that has just been started and has not drawn
// in 3D yet, and frames per second while it plays. Prints; asserts nothing.
// Run with `make web-bench`. SIZE=1920x1080 and MEASURE_SECONDS=20 change what is measured.

import { test } from 'vitest';
import { exported, launch, openPage, settled } from '../tests/browser';
import { crowdLog } from '../tests/crowd';
import { logText } from '../tests/support';

const [width, height] = (process.env.SIZE ?? '1280x720').split('x').map(Number) as [number, number];
const SECONDS = Number(process.env.MEASURE_SECONDS ?? 8);

test('the page', async () => {
  const browser = await launch();
  const cases: [string, { name: string; text: string }[]][] = [
    ['the duct line, 2 people and 2 robots', [{ name: 'routed', text: logText('routed') }]],
    [
      'two runs of it',
      [
        { name: 'a', text: logText('routed') },
        { name: 'b', text: logText('routed_fifo') },
      ],
    ],
    ['50 people and 50 robots', [{ name: 'crowd', text: crowdLog(50, 600) }]],
  ];
  const first = await openPage(browser, exported(cases[0]![1]), { viewport: { width, height } });
  const coldAfter = await first.page.evaluate(() => window.linewright.shownAfterMs());
  console.log(`first page of a new browser: ${cases[0]![0]}: on screen ${Math.round(coldAfter)} ms after opening`);
  await first.page.context().close();
  for (const [what, logs] of cases) {
    const { page } = await openPage(browser, exported(logs), { viewport: { width, height } });
    const shownAfter = await page.evaluate(() => window.linewright.shownAfterMs());
    const renderer = await page.evaluate(() => {
      const gl = document.createElement('canvas').getContext('webgl2')!;
      const info = gl.getExtension('WEBGL_debug_renderer_info');
      return String(info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : 'unknown renderer');
    });
    await page.evaluate(() => window.linewright.seek(10));
    await settled(page);
    await page.keyboard.press('Space');
    await page.waitForTimeout(SECONDS * 1000);
    const { framesPerSecond, longestMs, scriptMs } = await page.evaluate(() => window.linewright.meter());
    console.log(
      `${what}, ${width} × ${height}: on screen ${Math.round(shownAfter)} ms after opening; ` +
        `${framesPerSecond.toFixed(1)} frames/s, longest ${Math.round(longestMs)} ms, ` +
        `of a frame ${scriptMs.toFixed(1)} ms by the page itself, the rest by ${renderer}`,
    );
    await page.context().close();
  }
  await browser.close();
});
