// Lesson pages as a person uses them: in Chromium, from a file, with the network cut.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const here = fileURLToPath(new URL('.', import.meta.url));
const merge2d = process.env.MERGE2D ?? join(here, '../../../build/merge2d');
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const kCourse = ['one-step', 'contact-forces', 'what-merging-is', 'how-fast-is-still', 'let-it-breathe', 'momentum', 'one-sweep', 'unmerging',
  'cycles', 'limits', 'the-engine-decides', 'your-own-scene'];

let folder;
let browser;
const files = {};

function make(name, source = name, more = []) {
  files[name] = join(folder, `${name}.html`);
  execFileSync(merge2d, ['lesson', source, '-o', files[name], '--quiet', ...more], { cwd: folder });
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
  make('long-names', 'long-names.toml');
  make('what-merging-is');
  make('contact-forces');
  make('one-sweep');
  make('how-fast-is-still');
  make('books');
  make('evil', 'evil.toml');
  make('tower-platform', 'tower-platform', ['--steps', '400']);
  make('small', 'long-names.toml', ['--no-live']);
  make('cycles', 'cycles', ['--embed']);
  execFileSync(merge2d, ['lesson', '--course', '-o', 'course', '--quiet'], { cwd: folder });
  files.course = join(folder, 'course', 'index.html');
  for (const name of kCourse) files[`course/${name}`] = join(folder, 'course', `${name}.html`);
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** A page that is open, without a network, and complains about every error and request. */
async function open(name, options = {}, hash = '') {
  const context = await browser.newContext({ offline: true, viewport: { width: 1280, height: 860 }, ...options });
  const page = await context.newPage();
  const trouble = [];
  page.on('pageerror', (error) => trouble.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error') trouble.push(message.text()); });
  page.on('request', (request) => { if (!/^(file|about|data):/.test(request.url())) trouble.push(`asked for ${request.url()}`); });
  const start = Date.now();
  await page.goto(`file://${files[name]}${hash}`);
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

test('what is checked in was made from the sources', () => {
  execFileSync('node', ['build.mjs', join(folder, 'dist')], { cwd: join(here, '..') });
  for (const file of ['player.js', 'player.css']) {
    assert.equal(readFileSync(join(folder, 'dist', file), 'utf8'), readFileSync(join(here, '../dist', file), 'utf8'),
      `${file} is out of date: npm run build`);
  }
});

test('a page opens within two seconds, from a file, and is small', async () => {
  for (const name of ['what-merging-is', 'books']) {
    assert.ok(statSync(files[name]).size < 3_000_000);
    const { took, close } = await open(name);
    assert.ok(took < 2000 * Number(process.env.SLOW ?? 5), `${name} took ${took} ms`);
    await close();
  }
});

test('play moves on, pause stops', async () => {
  const { page, step, close } = await open('books');
  await page.click('button[aria-label=Play]');
  await page.waitForFunction(() => Number(document.querySelector('.slider').value) > 5);
  await page.click('button[aria-label=Pause]');
  const at = await step();
  await page.waitForTimeout(150);
  assert.equal(await step(), at);
  await close();
});

test('buttons and the slider step, and stages can be chosen', async () => {
  const { page, step, stage, close } = await open('books');
  await page.click('button[aria-label="One step forward"]');
  assert.equal(await step(), 1);
  await page.click('.stage:nth-child(7)');
  assert.equal(await stage(), 7);
  assert.match(await page.textContent('.now h2'), /Solve contacts/);
  await page.locator('.slider').fill('200');
  assert.equal(await step(), 200);
  await page.click('button[aria-label="To the end"]');
  assert.equal(await step(), Number(await page.getAttribute('.slider', 'max')));
  await close();
});

test('the keyboard alone does everything', async () => {
  const { page, step, stage, close } = await open('books');
  await page.keyboard.press('ArrowRight');
  assert.equal(await step(), 1);
  await page.keyboard.press('ArrowDown');
  assert.deepEqual([await step(), await stage()], [2, 1]);
  await page.keyboard.press('ArrowUp');
  assert.deepEqual([await step(), await stage()], [1, 11]);
  await page.keyboard.press('m');
  assert.ok((await step()) > 1);
  assert.match(await page.textContent('.now .events'), /merged|came apart/);
  await page.keyboard.press('End');
  await page.keyboard.press('Home');
  assert.equal(await step(), 0);
  await page.keyboard.press('2');
  assert.equal(await page.getAttribute('.chips > [data-layer=forces]', 'aria-pressed'), 'true');
  await page.keyboard.press('?');
  assert.ok(await page.isVisible('dialog'));
  await page.keyboard.press('Escape');
  await page.waitForSelector('dialog', { state: 'hidden' });
  await page.waitForFunction(() => document.activeElement === document.body);
  await page.keyboard.press(' ');
  await page.waitForFunction(() => Number(document.querySelector('.slider').value) > 2);
  await page.keyboard.press(' ');
  assert.equal(await page.locator('button[aria-label=Play]').count(), 1);
  await close();
});

test('the sweep and the full solve show impulses before and after, in a step with an impact', async () => {
  const { page, close } = await open('one-sweep');
  const impact = await page.$eval('#data', (data) =>
    JSON.parse(data.textContent).traces[0].head.events.find(([, type]) => type === 'impact')[0]);
  await page.locator('.slider').fill(String(impact));
  const at = async (stage) => {
    await page.click(`.stage:nth-child(${stage})`);
    const path = (layer) => page.getAttribute(`.layer.${layer}`, 'd');
    return {
      title: await page.textContent('section:has(> .impulses) h2'),
      rows: await page.$$eval('.impulses tbody tr', (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent))),
      text: await page.textContent('.impulses p'),
      equation: await page.textContent('.equation'),
      forces: `${await path('force')}${await path('inner')}`,
      earlier: await path('earlier'),
    };
  };
  const [warm, swept, solved] = [await at(4), await at(5), await at(7)];
  assert.match(warm.title, /of the last step/);
  assert.match(swept.title, /before and after the sweep/);
  assert.match(solved.title, /before and after the full solve/);

  // What the sweep begins with is what the warm start gave; both stages change it.
  const named = (rows, name) => rows.find((row) => row[0] === name);
  for (const [name, normal] of warm.rows) {
    const row = named(swept.rows, name);
    if (row) assert.equal(row[1], normal);
  }
  for (const { rows, text } of [swept, solved]) {
    assert.ok(rows.some(([, before, after]) => before !== after));
    assert.match(text, /changed [1-9]\d* of \d+ impulses/);
  }
  assert.notDeepEqual(swept.rows, warm.rows);
  assert.notDeepEqual(solved.rows, swept.rows);

  assert.equal(warm.earlier, '');
  assert.notEqual(swept.earlier, '');
  assert.notEqual(solved.earlier, '');
  assert.equal(new Set([warm.forces, swept.forces, solved.forces]).size, 3);
  assert.equal(new Set([warm.equation, swept.equation, solved.equation]).size, 3);

  await page.click('.stage:nth-child(8)');
  assert.ok(!(await page.isVisible('.impulses')));
  await close();
});

test('a click on a contact or a body shows its numbers against their limits', async () => {
  const { page, close } = await open('what-merging-is');
  await page.keyboard.press('n'); // to a part whose numbers are not hidden by a question
  for (let i = 0; i < 40 && !(await page.getAttribute('.layer.active', 'd')); ++i) await page.keyboard.press('ArrowRight');
  const mark = await page.$eval('.layer.active', (path) => {
    const at = path.getPointAtLength(0).matrixTransform(path.getScreenCTM());
    return [at.x + 3, at.y];
  });
  await page.mouse.click(...mark);
  assert.match(await page.textContent('.inspector h3'), /^(platform|brick \d+) and brick \d+$/);
  assert.ok((await page.locator('.inspector .threshold').count()) > 0);
  await page.locator('.picture.interactive .body:not(.fixed)').first().click();
  assert.match(await page.textContent('.inspector h3'), /^brick \d+$/);
  assert.match(await page.textContent('.inspector dl'), /Mass/);
  await close();
});

test('a question waits for an answer, then shows and explains', async () => {
  const { page, step, close } = await open('what-merging-is', { reducedMotion: 'reduce' });
  const asked = await step();
  assert.ok(await page.isDisabled('.lesson .primary'));
  await page.click('.option:has-text("no, all of them move")');
  await page.click('.lesson .primary');
  assert.match(await page.textContent('.verdict'), /Right\./);
  assert.ok((await step()) > asked);
  await page.keyboard.press('n');
  assert.match(await page.textContent('.place'), /Part 2/);
  await close();
});

test('bodies are answers that can be clicked, and questions can be skipped', async () => {
  const { page, close } = await open('what-merging-is', { reducedMotion: 'reduce' });
  for (let i = 0; i < 3; ++i) await page.keyboard.press('n');
  await page.locator('.picture [data-body="1"]').click();
  assert.equal(await page.locator('.ask input:checked').count(), 1);
  await page.click('text=Show me instead');
  assert.match(await page.textContent('.verdict'), /The answer: Free at step/);
  await close();
});

test('what if shows another run, and says so', async () => {
  const { page, close } = await open('what-merging-is');
  await page.click('.menu > summary');
  await page.selectOption('select[aria-label^="What if"]', '1');
  assert.match(await page.textContent('.badge'), /reference/);
  assert.equal(await page.locator('.body.c0').count(), 0);
  await close();
});

test('a slider over a threshold shows the runs that were computed beforehand', async () => {
  const { page, step, close } = await open('how-fast-is-still');
  await page.locator('.slider').fill('300');
  const merged = [];
  await page.click('.menu > summary');
  for (const [at, value] of ['0.001', '0.01', '0.1', '1'].entries()) {
    await page.locator('.threshold-slider input').fill(String(at));
    assert.equal(await page.textContent('.threshold-slider output'), value);
    assert.equal(await page.getAttribute('.threshold-slider input', 'aria-valuetext'), value);
    assert.equal(await step(), 300);
    merged.push(Number(await page.textContent('.facts .fact:nth-child(1) strong')));
  }
  assert.ok(merged[0] > merged[3], `bodies simulated: ${merged}`);
  await page.selectOption('select[aria-label^="What if"]', '1');
  assert.equal(await page.textContent('.threshold-slider output'), '–');
  await close();
});

test('the reference can be seen as a ghost or beside the picture', async () => {
  const { page, close } = await open('how-fast-is-still');
  await page.locator('.slider').fill('300');
  const other = page.locator('.frame:has(> .picture:not(.interactive))');
  assert.ok(!(await other.isVisible()));
  await page.keyboard.press('9');
  assert.ok(await other.isVisible());
  assert.match(await other.textContent(), /Reference/);
  assert.equal(await other.locator('.body.c0').count(), 0);
  await page.keyboard.press('9');
  assert.ok(!(await other.isVisible()));
  await close();
});

test('the reference has an outline only where it is elsewhere', async () => {
  const { page, close } = await open('what-merging-is', {}, '#part=4&step=400');
  await page.click('text=Show me instead');
  const outlines = page.locator('.picture.interactive .ghosts path:visible');
  await page.locator('.slider').fill('400');
  assert.equal(await outlines.count(), 0);
  assert.match(await page.textContent('.chips > [data-layer=ghost]'), /within \d mm/);
  await page.keyboard.press('End');
  assert.ok((await outlines.count()) > 0);
  await close();
});

test('a narrow window needs no sideways scrolling', async () => {
  for (const name of ['what-merging-is', 'books', 'how-fast-is-still']) {
    const { page, close } = await open(name, { viewport: { width: 360, height: 740 } });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360);
    await close();
  }
});

test('the words of the ribbon stay whole', async () => {
  for (const width of [360, 400, 640, 1280]) {
    const { page, close } = await open('what-merging-is', { viewport: { width, height: 740 } });
    const broken = await page.locator('.ribbon .name').evaluateAll((names) => names.filter((name) => {
      const room = name.parentElement.clientWidth;
      name.style.cssText = 'width: min-content; max-width: none; hyphens: manual; overflow-wrap: normal';
      return name.offsetWidth > room;
    }).map((name) => name.textContent));
    assert.deepEqual(broken, [], `at ${width}`);
    await close();
  }
});

test('no label covers another or leaves the picture', async () => {
  const { page, close } = await open('long-names');
  if (!(await page.locator('.picture.interactive .labels text').count())) await page.keyboard.press('8');
  const [frame, boxes] = await page.evaluate(() => {
    const box = (node) => node.getBoundingClientRect().toJSON();
    const picture = document.querySelector('.picture.interactive');
    return [box(picture), [...picture.querySelectorAll('.labels text')].map(box)];
  });
  assert.ok(boxes.length >= 3);
  for (const [i, a] of boxes.entries()) {
    assert.ok(a.left >= frame.left && a.right <= frame.right, 'inside');
    for (const b of boxes.slice(i + 1)) {
      assert.ok(a.right <= b.left || b.right <= a.left || a.bottom <= b.top + 4 || b.bottom <= a.top + 4, 'apart');
    }
  }
  await close();
});

/** With the engine there, and the run taken over at a step. */
async function takenOver(name, step, options = {}) {
  const opened = await open(name, options);
  await opened.page.waitForSelector('html[data-engine]');
  await opened.page.locator('.slider').fill(String(step));
  await opened.page.keyboard.press('t');
  await opened.page.waitForSelector('html.taken-over');
  return opened;
}
const centre = (page, body) => page.$eval(`.picture.interactive [data-body="${body}"]`, (node) => {
  const box = node.getBoundingClientRect();
  return [box.left + box.width / 2, box.top + box.height / 2];
});
const freeBodies = (page) => page.locator('.picture.interactive .body.free:visible').count();

test('a brick that is dragged off the tower comes free, and the page says why', async () => {
  const { page, step, close } = await takenOver('tower-platform', 300);
  const names = await page.$eval('#data', (data) => JSON.parse(data.textContent).traces[0].head.bodies.map((body) => body.name));
  const brick = names.indexOf('brick[0,26]');
  const shown = `brick ${1 + names.filter((name) => name.startsWith('brick[')).indexOf('brick[0,26]')}`;
  const before = await freeBodies(page);
  const [x, y] = await centre(page, brick);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 40, y - 30, { steps: 5 });
  await page.mouse.move(x - 120, y - 90, { steps: 5 });
  await page.waitForFunction(() => Number(document.querySelector('.slider').value) > 320);
  assert.notEqual(await page.getAttribute('.layer.hand', 'd'), '');
  await page.mouse.up();
  await page.waitForFunction((at) => Number(document.querySelector('.slider').value) > at, await step());
  await page.keyboard.press(' ');
  assert.ok((await freeBodies(page)) > before, 'bodies came free');
  assert.match(await page.textContent('.deeds'), /dragged brick \d+.*let brick \d+ go/s);

  // To the step in which it came apart from a neighbour, and why.
  await page.evaluate(() => { location.hash = 'step=300&bodies=brick[0,26]'; });
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press('m');
    const button = page.locator('.now .events button', { hasText: new RegExp(`${shown}\\b.*came apart`) });
    if (await button.count() === 0) continue;
    await button.first().evaluate((node) => node.click());
    await page.waitForFunction((name) => document.querySelector('.why h2').textContent.includes(name), shown);
    break;
  }
  assert.match(await page.textContent('.why h2'), /^Came apart/);
  assert.match(await page.textContent('.why-text'), /They came apart: .*(above|pressure|carries|edge)/);
  assert.ok((await page.locator('.why .tests tbody tr').count()) > 0);
  assert.match(await page.textContent('.stages .stage:nth-child(6) .result'), /welds? cut/);

  await page.keyboard.press('t');
  assert.equal(await page.locator('html.taken-over').count(), 0);
  assert.ok(await page.evaluate(() => document.querySelector('.live-panel').hidden));
  await close();
});

test('push, pin, add, delete, limits, back and undo in a run of one’s own', async () => {
  const { page, step, close } = await takenOver('books', 100);
  const told = () => page.textContent('.deeds');
  const there = () => page.locator('.picture.interactive .body:visible').count();
  const dynamic = Number(await page.locator('.picture.interactive .body:not(.fixed)').first().getAttribute('data-body'));
  await page.click('[data-tool=pin]');
  await page.mouse.click(...await centre(page, dynamic));
  assert.match(await told(), /pinned/);
  const bodies = await there();
  await page.click('[data-tool=disc]');
  const frame = await page.locator('.frame').first().boundingBox();
  await page.mouse.click(frame.x + frame.width / 2, frame.y + 60);
  assert.equal(await there(), bodies + 1);
  await page.click('[data-tool=push]');
  await page.mouse.move(...await centre(page, dynamic));
  await page.mouse.down();
  const [x, y] = await centre(page, dynamic);
  await page.mouse.move(x + 50, y, { steps: 4 });
  assert.match(await page.textContent('.aim-text'), /N s/);
  await page.mouse.up();
  assert.match(await told(), /pushed .* N s/);
  await page.locator('[data-key="merging.velocity"]').focus();
  const at = await step();
  await page.keyboard.press('ArrowRight');
  assert.equal(await step(), at, 'arrows in a slider move that slider alone');
  await page.waitForFunction(() => /merging\.velocity: 0\.01 → /.test(document.querySelector('.deeds').textContent));
  await page.click('.live-panel h2');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowDown');
  assert.equal(await step(), at + 2);
  await page.keyboard.press('Home');
  assert.equal(await step(), 100);
  for (let i = 0; i < 4; ++i) await page.keyboard.press('z');
  assert.match(await told(), /Nothing yet/);
  assert.equal(await there(), bodies);
  await close();
});

test('a limit can be typed, and an arrow that is pulled has its size beside it until Esc', async () => {
  const { page, close } = await takenOver('books', 100);
  await page.fill('.typed >> nth=1', '0,5');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => /unmerging\.velocity: 0\.02 → 0\.5/.test(document.querySelector('.deeds').textContent));
  await page.fill('.typed >> nth=0', 'much');
  await page.keyboard.press('Enter');
  assert.equal(await page.inputValue('.typed >> nth=0'), '0.010');
  await page.click('[data-tool=throw]');
  const dynamic = Number(await page.locator('.picture.interactive .body:not(.fixed)').first().getAttribute('data-body'));
  const [x, y] = await centre(page, dynamic);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y, { steps: 4 });
  assert.match(await page.textContent('.aim-size'), /m\/s/);
  await page.keyboard.press('Escape');
  assert.equal(await page.textContent('.aim-size'), '');
  await page.mouse.up();
  assert.ok(!/threw/.test(await page.textContent('.deeds')));
  await close();
});

test('the reference runs beside one’s own run, with the same pulls', async () => {
  const { page, close } = await takenOver('what-merging-is', 300);
  await page.selectOption('select[aria-label="Beside it"]', 'reference');
  const other = page.locator('.frame:has(> .picture:not(.interactive))');
  assert.match(await other.locator('.frame-head').textContent(), /Reference.*largest offset \d+ mm/);
  assert.equal(await other.locator('.body.c0, .body.c1, .body.c2').count(), 0);
  await page.selectOption('select[aria-label="Beside it"]', 'paper');
  assert.match(await other.locator('.frame-head').textContent(), /paper/);
  await close();
});

test('a link to a run of one’s own replays it', async () => {
  const link = `#step=330&fork=300&do=${encodeURIComponent('300 pin @1')}&do=${encodeURIComponent('305 push @2 1 0')}`;
  const { page, step, close } = await open('tower-platform', {}, link);
  await page.waitForSelector('html.taken-over');
  assert.equal(await step(), 330);
  assert.match(await page.textContent('.deeds'), /pinned .*pushed/s);
  await close();
});

test('a link opens the moment, the stage and the bodies', async () => {
  const { page, step, stage, close } = await open('what-merging-is', {}, '#part=2&step=200&stage=5&bodies=brick[0,0]%26brick[0,1]');
  assert.deepEqual([await step(), await stage()], [200, 5]);
  assert.match(await page.textContent('.inspector h3'), /^brick 1 and brick 3$/);
  assert.match(await page.textContent('.place'), /Part 2/);
  await close();
});

test('answers and place survive a reload', async () => {
  const { page, close } = await open('what-merging-is', { reducedMotion: 'reduce' });
  await page.click('.option:has-text("no, all of them move")');
  await page.click('.lesson .primary');
  await page.keyboard.press('n');
  await page.reload();
  await page.waitForSelector('html[data-ready]');
  assert.match(await page.textContent('.place'), /Part 2/);
  await page.keyboard.press('p');
  assert.match(await page.textContent('.verdict'), /Right/);
  await close();
});

test('play that stops says why', async () => {
  const { page, close } = await open('what-merging-is');
  await page.keyboard.press(' ');
  await page.waitForFunction(() => /a question first/.test(document.querySelector('.notice').textContent));
  await close();
});

test('what tells the answer is hidden until there is one', async () => {
  const { page, close } = await open('what-merging-is', { reducedMotion: 'reduce' });
  await page.waitForSelector('html[data-engine]');
  for (let i = 0; i < 3; ++i) await page.keyboard.press('n');
  assert.ok(!(await page.isVisible('.counts')));
  assert.equal((await page.locator('.stage .result').allTextContents()).join(''), '');
  const marks = await page.getAttribute('.mark.unmerge', 'd');
  assert.equal(marks, '');
  await page.click('text=Show me instead');
  assert.ok(await page.isVisible('.counts'));
  await page.waitForFunction(() => document.querySelector('.stage .result').textContent !== '');
  await close();
});

for (const [width, height] of [[1440, 900], [1280, 720], [820, 1180], [390, 844]]) {
  test(`picture, time and stages are in view at ${width} × ${height}`, async () => {
    const { page, close } = await open('what-merging-is', { viewport: { width, height } });
    for (const place of ['.picture.interactive', '.play', '.stages', '.lesson .primary', '.words h2', '.take-over']) {
      const box = await page.locator(place).first().boundingBox();
      assert.ok(box && box.y >= 0 && box.y + Math.min(box.height, 20) <= height && box.x >= 0 && box.x + box.width <= width + 1, `${place}: ${JSON.stringify(box)}`);
    }
    const last = await page.locator('.stage').last().boundingBox();
    assert.ok(last.y + last.height <= height, 'all eleven stages');
    await close();
  });
}

test('the question is a few tab stops away', async () => {
  const { page, close } = await open('what-merging-is');
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.textContent), 'To the question');
  await page.keyboard.press('Enter');
  assert.ok(await page.evaluate(() => document.activeElement.closest('.ask') !== null));
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('q');
  assert.ok(await page.evaluate(() => document.activeElement.closest('.ask') !== null));
  await close();
});

test('without the engine a page plays, and says that it cannot be taken over', async () => {
  const { page, step, close } = await open('small');
  assert.ok(statSync(files.small).size < 400_000);
  await page.keyboard.press('ArrowRight');
  assert.equal(await step(), 1);
  assert.ok(await page.isDisabled('.take-over'));
  await page.keyboard.press('t');
  assert.match(await page.textContent('.notice'), /--no-live/);
  await close();
});

test('a student goes through the whole course, with right and wrong answers', async () => {
  const { page, close } = await open('course', { reducedMotion: 'reduce' });
  assert.equal(await page.locator('li a').count(), kCourse.length);
  await page.click('li a >> nth=0');
  for (const [n, name] of kCourse.entries()) {
    await page.waitForURL(`**/${name}.html`);
    await page.waitForSelector('html[data-ready]');
    assert.match(await page.textContent('.kicker'), new RegExp(`Lesson ${n + 1} of ${kCourse.length}`));
    const parts = await page.locator('.dot-part').count();
    for (let part = 0; part < parts; ++part) {
      for (;;) {
        const fields = page.locator('.ask fieldset');
        const open = page.locator('.ask fieldset:has(input:not(:disabled))');
        if (await open.count() === 0) break;
        const number = open.locator('.number-answer input');
        const options = open.locator('.option');
        if (await number.count()) await number.fill('1,96');
        else await options.nth((n + part) % (await options.count())).click();
        await page.click('.lesson .primary');
        assert.match(await page.locator('.verdict').last().textContent(), /^(Right\.|Not quite\.|\d+ of \d+)/);
        assert.ok((await fields.count()) >= 1);
      }
      await page.click('.lesson .primary');
      if (part + 1 < parts) assert.match(await page.textContent('.place'), new RegExp(`Part ${part + 2}`));
    }
  }
  await page.waitForURL('**/index.html');
  await close();
});

test('a student with a keyboard alone answers, takes over, moves a limit, and comes back', async () => {
  const { page, close } = await open('what-merging-is', { reducedMotion: 'reduce' });
  await page.waitForSelector('html[data-engine]');
  const press = async (...keys) => { for (const key of keys) await page.keyboard.press(key); };
  const focused = (selector) => page.evaluate((wanted) => document.activeElement?.closest(wanted) !== null, selector);
  const tabTo = async (selector, most) => {
    for (let i = 0; i < most; ++i) {
      await press('Tab');
      if (await focused(selector)) return;
    }
    assert.fail(`${selector} is not within ${most} tab stops`);
  };
  await press('Tab', 'Enter', 'ArrowDown');
  assert.equal(await page.locator('.ask input:checked').count(), 1);
  await tabTo('.lesson .primary', 3);
  await press('Enter');
  assert.ok(await focused('.verdict'), 'after Check the focus is on the verdict');
  await press('n');
  assert.ok(await focused('.words h2'), 'after Next it is on the heading');
  await press('n', 'n', 'q', ' ');
  assert.match(await page.textContent('.lesson .primary'), /Check 1/);
  await tabTo('.lesson .primary', 15);
  await press('Enter');
  assert.match(await page.locator('.verdict').textContent(), /brick 9/);
  await press('t');
  await page.waitForSelector('html.taken-over');
  await page.focus('[data-key="merging.velocity"]');
  await press('ArrowLeft');
  await page.waitForFunction(() => /merging\.velocity/.test(document.querySelector('.deeds').textContent));
  await page.evaluate(() => document.activeElement.blur());
  await press('z');
  assert.match(await page.textContent('.deeds'), /Nothing yet/);
  await press('t');
  assert.equal(await page.locator('html.taken-over').count(), 0);
  await close();
});

test('a student with a phone answers by finger and drags a brick', async () => {
  const { page, close } = await open('what-merging-is', { reducedMotion: 'reduce', viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  await page.waitForSelector('html[data-engine]');
  await page.tap('.option >> nth=1');
  await page.tap('.lesson .primary');
  assert.match(await page.textContent('.verdict'), /Right|Not quite/);
  await page.tap('.lesson .primary');
  assert.match(await page.textContent('.place'), /Part 2/);
  for (const place of ['.picture.interactive', '.play', '.take-over', '.lesson .primary', '.marks']) {
    const box = await page.locator(place).first().boundingBox();
    assert.ok(box && box.y >= 0 && box.y + box.height <= 844 && box.x >= -1 && box.x + box.width <= 391, `${place}: ${JSON.stringify(box)}`);
  }
  await page.tap('.take-over');
  await page.waitForSelector('html.taken-over');
  const names = await page.$eval('#data', (data) => JSON.parse(data.textContent).traces[0].head.bodies.map((body) => body.name));
  const [x, y] = await centre(page, names.indexOf('brick[1,5]'));
  const finger = await page.context().newCDPSession(page);
  const touch = (type, points) => finger.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x, y }]);
  for (let i = 1; i <= 6; ++i) await touch('touchMove', [{ x: x + 12 * i, y: y - 6 * i }]);
  await page.waitForFunction(() => /dragged brick 12/.test(document.querySelector('.deeds').textContent));
  await touch('touchEnd', []);
  await page.waitForFunction(() => /let brick 12 go/.test(document.querySelector('.deeds').textContent));
  await close();
});

test('a limit that is moved decides from the next step on', async () => {
  const { page, close } = await takenOver('books', 0);
  const collections = async () => Number(await page.textContent('.counts strong >> nth=1'));
  const goTo = (step) => page.locator('.slider').fill(String(step));
  const first = await page.$eval('#data', (data) => JSON.parse(data.textContent).traces[0].head.events.find(([, type]) => type === 'merge')[0]);
  await goTo(first);
  assert.ok((await collections()) > 0);
  await page.keyboard.press('Home');
  await page.click('.all-limits summary');
  await page.locator('[data-key="merging.steps"]').fill('20');
  await page.waitForFunction(() => /merging\.steps: 3 → 20/.test(document.querySelector('.deeds').textContent));
  await goTo(first);
  assert.equal(await collections(), 0);
  await close();
});

/** The share of cells of a coarse grid whose brightness differs by more than a sixth. */
function difference(page, one, other) {
  return page.evaluate(async (sources) => {
    const [w, h] = [120, 90];
    const cells = await Promise.all(sources.map(async (source) => {
      const image = new Image();
      image.src = `data:image/jpeg;base64,${source}`;
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [w, h];
      const context = canvas.getContext('2d');
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, 0, 0, w, h);
      return context.getImageData(0, 0, w, h).data;
    }));
    let differ = 0;
    for (let i = 0; i < w * h; ++i) {
      const grey = cells.map((data) => (data[4 * i] + data[4 * i + 1] + data[4 * i + 2]) / 3);
      differ += Math.abs(grey[0] - grey[1]) > 42 ? 1 : 0;
    }
    return differ / (w * h);
  }, [one, other]);
}

const kShots = {
  'desktop-lesson': [{ width: 1440, height: 900 }, '#part=2', 'light'],
  'laptop-question': [{ width: 1280, height: 720 }, '#part=4', 'dark'],
  'tablet-question': [{ width: 820, height: 1180 }, '#part=4', 'light'],
  'phone-lesson': [{ width: 390, height: 844 }, '#part=2', 'light'],
  'zoomed-lesson': [{ width: 720, height: 450 }, '#part=2', 'light'],
};
for (const [name, [viewport, hash, colorScheme]] of Object.entries(kShots)) {
  test(`the page looks as in the reference shot ${name}`, async () => {
    const { page, close } = await open('what-merging-is', { viewport, colorScheme, reducedMotion: 'reduce', deviceScaleFactor: 0.5 }, hash);
    await page.waitForSelector('html[data-engine]');
    if (!/question/.test(name)) await page.waitForFunction(() => document.querySelector('.stage .result').textContent !== '');
    const shot = await page.screenshot({ type: 'jpeg', quality: 70 });
    const file = join(here, 'reference', `${name}.jpg`);
    if (process.env.UPDATE_SHOTS) writeFileSync(file, shot);
    const share = await difference(page, shot.toString('base64'), readFileSync(file).toString('base64'));
    assert.ok(share < 0.03, `${(100 * share).toFixed(1)} % of the picture differ: look at it, and if it is right, UPDATE_SHOTS=1`);
    await close();
  });
}

test('a page for a frame in another page is compact, and works in a sandbox', async () => {
  const { page, close } = await open('cycles', { viewport: { width: 900, height: 600 } });
  assert.ok(!(await page.isVisible('header')));
  await page.goto('about:blank');
  await page.setContent(`<iframe sandbox="allow-scripts" style="width: 880px; height: 580px" srcdoc="${readFileSync(files.cycles, 'utf8').replace(/&/g, '&amp;').replace(/"/g, '&quot;')}"></iframe>`);
  const frame = page.frameLocator('iframe');
  await frame.locator('.lesson .primary').click();
  assert.match(await frame.locator('.lesson .place').textContent(), /Part 2/);
  await close();
});

test('the page speaks German and French', async () => {
  for (const [language, word, stage] of [['de', 'Hier übernehmen', 'Kontaktsuche'], ['fr', 'Prendre la main ici', 'Détection des contacts']]) {
    const { page, close } = await open('what-merging-is', {}, `#language=${language}`);
    assert.equal(await page.textContent('.take-over'), word);
    assert.equal(await page.textContent('.stage:nth-child(1) .name'), stage);
    assert.equal(await page.getAttribute('html', 'lang'), language);
    assert.match(await page.textContent('.prose'), /relative/);
    await close();
  }
});

test('a symbol of an equation lights up its number', async () => {
  const { page, close } = await open('contact-forces');
  await page.locator('.equation math >> nth=0').locator('[data-symbol="λn"]').first().hover();
  const lit = await page.locator('.equation .lit').count();
  assert.ok(lit >= 2, `${lit} lit`);
  assert.equal(await page.getAttribute('html', 'data-lit'), 'λn');
  await close();
});

test('zoom, pan and fit', async () => {
  const { page, close } = await open('books');
  const box = () => page.getAttribute('.picture.interactive', 'viewBox');
  const whole = await box();
  await page.click('button[aria-label=Closer]');
  assert.notEqual(await box(), whole);
  await page.keyboard.press('f');
  assert.equal(await box(), whole);
  await close();
});

test('it prints as a comic strip', async () => {
  const { page, close } = await open('what-merging-is');
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  await page.emulateMedia({ media: 'print' });
  assert.equal(await page.locator('.strip article:visible').count(), 5);
  assert.ok(!(await page.isVisible('#app')));
  await page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
  assert.equal(await page.locator('.handout').count(), 0);
  await page.emulateMedia({ media: 'screen' });
  assert.ok((await page.pdf()).length > 10_000);
  await close();
});

test('titles and names stay text', async () => {
  const { page, close } = await open('evil');
  assert.equal(await page.evaluate(() => window.hacked), undefined);
  assert.match(await page.textContent('h1'), /<script>window\.hacked = 1<\/script>/);
  await page.locator('.picture .body').click();
  assert.equal(await page.textContent('.inspector h3'), '</script><b>');
  await close();
});

test('bodies are chosen with the keyboard, and told in words', async () => {
  const { page, close } = await open('what-merging-is', {}, '#part=2');
  await page.focus('#picture');
  await page.keyboard.press('ArrowUp');
  const first = await page.textContent('#picture > [role=status]');
  assert.match(first, /^brick \d+, in C\d+, .*touches .*brick \d+/);
  await page.keyboard.press('Enter');
  await page.keyboard.press('ArrowUp');
  assert.notEqual(await page.textContent('#picture > [role=status]'), first);
  await page.keyboard.press('Enter');
  assert.match(await page.textContent('.inspector h3'), /^brick \d+ and brick \d+$/);
  await page.waitForFunction(() => /in C\d+: (brick \d+, )+brick \d+/.test(document.querySelector('.picture.interactive').getAttribute('aria-label')));
  await close();
});

test('the screen reader hears each state', async () => {
  const { page, close } = await open('books');
  await page.keyboard.press('m');
  await page.waitForFunction(() => /merged|apart/.test(document.querySelector('[role=status][aria-live]').textContent));
  assert.match(await page.getAttribute('.slider', 'aria-valuetext'), /step \d+ of \d+/);
  await close();
});

for (const colorScheme of ['light', 'dark']) {
  test(`axe finds nothing to complain about in any lesson, taken over, in ${colorScheme}`, async () => {
    for (const name of kCourse) {
      const { page, close } = await open(`course/${name}`, { colorScheme });
      await page.waitForSelector('html[data-engine]');
      await page.keyboard.press('n');
      if (await page.isVisible('.ask fieldset')) await page.click('text=Show me instead');
      await page.keyboard.press('t');
      await page.click('.all-limits summary');
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => window.axe.run());
      assert.deepEqual(violations.map((v) => `${name}: ${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(' | ')}`), []);
      await close();
    }
  });
}

for (const colorScheme of ['light', 'dark']) {
  test(`axe finds nothing to complain about in ${colorScheme}`, async () => {
    for (const name of ['what-merging-is', 'contact-forces', 'books', 'one-sweep', 'how-fast-is-still']) {
      const { page, close } = await open(name, { colorScheme });
      await page.keyboard.press('n');
      await page.keyboard.press('m');
      await page.locator('.picture .body:not(.fixed)').first().click({ force: true });
      if (name === 'contact-forces') await page.click('text=Show me instead');
      if (name === 'how-fast-is-still') await page.keyboard.press('9');
      if (name === 'one-sweep') await page.click('.stage:nth-child(7)');
      if (name === 'books' || name === 'what-merging-is') {
        await page.waitForSelector('html[data-engine]');
        await page.keyboard.press('t');
        await page.click('.all-limits summary');
      } else if (name !== 'contact-forces') await page.keyboard.press('d');
      // In the middle of a change of colours nothing is readable.
      await page.evaluate(() => Promise.all(document.getAnimations().map((animation) => animation.finished)));
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => window.axe.run());
      assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(' | ')}`), []);
      await close();
    }
  });
}
