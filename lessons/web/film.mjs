// The film of README.md: a brick is dragged out of a merged tower, and the page says why it came free.
//
//   npm --prefix lessons/web run film    needs build/merge2d, Chromium and ImageMagick's convert
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const here = fileURLToPath(new URL('.', import.meta.url));
const merge2d = process.env.MERGE2D ?? join(here, '../../build/merge2d');
const out = process.argv[2] ?? join(here, '../../docs/pictures/live-page.gif');
const folder = mkdtempSync(join(tmpdir(), 'film-'));
const lesson = join(folder, 'lesson.html');
execFileSync(merge2d, ['lesson', 'what-merging-is', '-o', lesson, '--quiet']);

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
const page = await (await browser.newContext({ viewport: { width: 1280, height: 720 } })).newPage();
const frames = [];

/** Keeps a picture that is shown for so many hundredths of a second. */
async function take(delay) {
  const path = join(folder, `${String(frames.length).padStart(3, '0')}.png`);
  await page.screenshot({ path });
  frames.push('-delay', String(delay), path);
}

const centreOf = (body) => page.$eval(`.picture.interactive [data-body="${body}"]`, (node) => {
  const box = node.getBoundingClientRect();
  return [box.left + box.width / 2, box.top + box.height / 2];
});

await page.goto(`file://${lesson}`);
await page.waitForSelector('html[data-ready][data-engine]');
await page.getByText('The saving').first().click();
await page.locator('.slider').fill('240');
await take(120);
await page.keyboard.press('t');
await page.waitForSelector('html.taken-over');
await take(80);
const names = await page.$eval('#data', (data) => JSON.parse(data.textContent).traces[0].head.bodies.map((body) => body.name));
const brick = names.filter((name) => name.startsWith('brick'))[6];
const body = names.indexOf(brick);
const [x, y] = await centreOf(body);
await page.mouse.move(x, y);
await page.mouse.down();
for (let i = 1; i <= 6; ++i) {
  await page.mouse.move(x - 30 * i, y - 4 * i, { steps: 3 });
  await take(25);
}
await page.mouse.up();
for (let i = 0; i < 3; ++i) await take(25);
await page.keyboard.press(' ');
await page.evaluate((name) => { location.hash = `step=240&bodies=${name}`; }, brick);
for (let i = 0; i < 20; ++i) {
  await page.keyboard.press('m');
  const button = page.locator('.now .events button', { hasText: /\b7\b.*came apart/ });
  if (await button.count() === 0) continue;
  await button.first().evaluate((node) => node.click());
  break;
}
await page.waitForTimeout(300);
await take(500);
await browser.close();
execFileSync('convert', ['-loop', '0', ...frames, '-resize', '60%', '+dither', '-colors', '64', '-layers', 'OptimizePlus', out]);
rmSync(folder, { recursive: true });
