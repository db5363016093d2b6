// A lesson page in Firefox, which is driven over WebDriver BiDi; skipped where there is no Firefox.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import puppeteer from 'puppeteer-core';

const here = fileURLToPath(new URL('.', import.meta.url));
const merge2d = process.env.MERGE2D ?? join(here, '../../../build/merge2d');
const firefox = process.env.FIREFOX ?? '/usr/bin/firefox-esr';
const skip = existsSync(firefox) ? false : 'there is no Firefox: apt-get install firefox-esr';

let folder;
let browser;

before(async () => {
  if (skip) return;
  folder = mkdtempSync(join(tmpdir(), 'merge2d-firefox-'));
  execFileSync(merge2d, ['lesson', 'what-merging-is', '-o', join(folder, 'page.html'), '--quiet']);
  browser = await puppeteer.launch({ browser: 'firefox', executablePath: firefox, headless: true, timeout: 120_000 });
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

test('a question is answered, a run is taken over, and a brick is pushed', { skip }, async () => {
  const page = await browser.newPage();
  page.setDefaultTimeout(120_000);
  const trouble = [];
  page.on('pageerror', (error) => trouble.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error') trouble.push(message.text()); });
  await page.setViewport({ width: 1280, height: 800 });
  await page.goto(`file://${join(folder, 'page.html')}`);
  await page.waitForSelector('html[data-engine]');
  await page.click('.option');
  await page.click('.lesson .primary');
  assert.match(await page.$eval('.verdict', (node) => node.textContent), /Right|Not quite/);
  await page.keyboard.press('n');
  await page.keyboard.press('t');
  await page.waitForSelector('html.taken-over');
  await page.click('[data-tool=push]');
  const [x, y] = await page.$eval('.picture.interactive .body:not(.fixed)', (node) => {
    const box = node.getBoundingClientRect();
    return [box.left + box.width / 2, box.top + box.height / 2];
  });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y, { steps: 4 });
  await page.mouse.up();
  assert.match(await page.$eval('.deeds', (node) => node.textContent), /pushed brick \d+/);
  await page.evaluate(() => document.activeElement.blur()); // arrows among the tools choose a tool
  await page.keyboard.press('ArrowRight');
  assert.ok((await page.$eval('.slider', (slider) => Number(slider.value))) > 20);
  await page.close();
  assert.deepEqual(trouble, []);
});
