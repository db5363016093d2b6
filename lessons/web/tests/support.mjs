// Lesson pages in Chromium, from a file, with the network cut: helpers that the tests of pages share.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

export const here = fileURLToPath(new URL('.', import.meta.url));
export const merge2d = process.env.MERGE2D ?? join(here, '../../../build/merge2d');

export const kCourse = ['one-step', 'contact-forces', 'what-merging-is', 'how-fast-is-still', 'let-it-breathe', 'momentum', 'one-sweep', 'unmerging',
  'cycles', 'limits', 'the-engine-decides', 'your-own-scene'];

export let folder;
export let browser;
const files = {};

/** The arguments of pages that are not those of a lesson or scene of their name. */
const kMade = {
  'long-names': ['long-names.toml'],
  evil: ['evil.toml'],
  'tower-platform': ['tower-platform', '--steps', '400'],
  small: ['long-names.toml', '--no-live'],
  cycles: ['cycles', '--embed'],
  long: ['funnel', '--steps', '2200'],
};

/** A page, made when it is first asked for; "course" is the list of all lessons, "course/NAME" one of them. */
export function fileOf(name) {
  if (files[name]) return files[name];
  if (/^course(\/|$)/.test(name)) {
    execFileSync(merge2d, ['lesson', '--course', '-o', 'course', '--quiet'], { cwd: folder });
    files.course = join(folder, 'course', 'index.html');
    for (const lesson of kCourse) files[`course/${lesson}`] = join(folder, 'course', `${lesson}.html`);
  } else {
    const file = join(folder, `${name}.html`);
    execFileSync(merge2d, ['lesson', ...(kMade[name] ?? [name]), '-o', file, '--quiet'], { cwd: folder });
    files[name] = file;
  }
  return files[name];
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'merge2d-pages-'));
  writeFileSync(join(folder, 'evil.toml'), `format = 1
title = "<script>window.hacked = 1</script><img src=x onerror='window.hacked = 1'>"
duration = 0.5
[[body]]
name = "</script><b>"
circle = 0.5
`);
  const bodies = [-4.4, -4.1, 4.4].map((x, i) => `[[body]]
name = "a body whose name goes on and on ${i}"
at = [${x}, 0]
circle = 0.1
`);
  writeFileSync(join(folder, 'long-names.toml'), `format = 1
duration = 0.1
gravity = [0, 0]
camera = { center = [0, 0], height = 6.5 }
${bodies.join('')}`);
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** A page that is open, without a network, and complains about every error and request. */
export async function open(name, options = {}, hash = '') {
  const context = await browser.newContext({ offline: true, viewport: { width: 1280, height: 860 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(180_000); // of a machine that does much else
  const trouble = [];
  page.on('pageerror', (error) => trouble.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error') trouble.push(message.text()); });
  page.on('request', (request) => { if (!/^(file|about|data):/.test(request.url())) trouble.push(`asked for ${request.url()}`); });
  const file = fileOf(name);
  const start = Date.now();
  await page.goto(`file://${file}${hash}`);
  await page.waitForSelector('html[data-ready], main > ol');
  return {
    page, took: Date.now() - start,
    step: () => page.$eval('.slider', (slider) => Number(slider.value)),
    stage: () => page.$eval('[aria-current=step] .number', (node) => Number(node.textContent)),
    close: async () => {
      await context.close();
      assert.deepEqual(trouble, []);
    },
  };
}

/** With the engine there, and the run taken over at a step. */
export async function takenOver(name, step, options = {}) {
  const opened = await open(name, options);
  await opened.page.waitForSelector('html[data-engine]');
  await opened.page.locator('.slider').fill(String(step));
  await opened.page.keyboard.press('t');
  await opened.page.waitForSelector('html.taken-over');
  return opened;
}
export const centre = (page, body) => page.$eval(`.picture.interactive [data-body="${body}"]`, (node) => {
  const box = node.getBoundingClientRect();
  return [box.left + box.width / 2, box.top + box.height / 2];
});
export const freeBodies = (page) => page.locator('.picture.interactive .body.free:visible').count();
