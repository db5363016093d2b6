// Lesson pages: playing, stepping, choosing, comparing.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileOf, folder, here, merge2d, open } from './support.mjs';

test('what is checked in was made from the sources', () => {
  execFileSync('node', ['build.mjs', join(folder, 'dist')], { cwd: join(here, '..') });
  for (const file of ['player.js', 'player.css']) {
    assert.equal(readFileSync(join(folder, 'dist', file), 'utf8'), readFileSync(join(here, '../dist', file), 'utf8'),
      `${file} is out of date: npm run build`);
  }
});

test('a page opens within two seconds, from a file, and is small', async () => {
  for (const name of ['what-merging-is', 'books']) {
    assert.ok(statSync(fileOf(name)).size < 3_000_000);
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

test('a link opens the moment, the stage and the bodies', async () => {
  const { page, step, stage, close } = await open('what-merging-is', {}, '#part=2&step=200&stage=5&bodies=brick[0,0]%26brick[0,1]');
  assert.deepEqual([await step(), await stage()], [200, 5]);
  assert.match(await page.textContent('.inspector h3'), /^brick 1 and brick 3$/);
  assert.match(await page.textContent('.place'), /Part 2/);
  await close();
});

test('a merge blinks once, an unmerge keeps its crosses until something else happens', async () => {
  const { page, step, close } = await open('books');
  const first = await page.$eval('#data', (data) => JSON.parse(data.textContent).traces[0].head.events.find(([, type]) => type === 'merge')[0]);
  await page.locator('.slider').fill(String(first));
  assert.ok((await page.locator('.body.blink').count()) >= 1);
  await page.waitForTimeout(260);
  await page.keyboard.press('ArrowUp');
  assert.equal(await page.locator('.body.blink').count(), 0);
  const [parted, after] = await page.$eval('#data', (data) => {
    const events = JSON.parse(data.textContent).traces[0].head.events;
    const steps = [...new Set(events.map(([k]) => k))];
    const at = steps.find((k, i) => events.some(([s, type]) => s === k && type === 'unmerge') && (steps[i + 1] ?? Infinity) > k + 3);
    return [at, steps.find((k) => k > at) ?? Infinity];
  });
  const crosses = () => page.getAttribute('.layer.cut', 'd');
  await page.locator('.slider').fill(String(parted));
  assert.ok(await crosses());
  await page.locator('.slider').fill(String(parted + 2));
  assert.ok(await crosses(), 'two steps later');
  await page.locator('.slider').fill(String(Math.min(after, parted + 25)));
  if (after > parted + 25) assert.equal(await crosses(), '');
  assert.ok(await step());
  await close();
});

test('collections are counted from C1, in the page as in files and the terminal', async () => {
  const { page, close } = await open('books');
  const row = await page.$eval('#data', (data) => JSON.parse(data.textContent).traces[0].head.events.find(([, type]) => type === 'merge'));
  assert.equal(row[4], 1);
  await page.locator('.slider').fill(String(row[0]));
  assert.match(await page.locator('.picture.interactive .labels').textContent(), /C1\b/);
  assert.match(await page.innerText('.now .events'), /merged into C1\b/);
  const told = execFileSync(merge2d, ['explain', 'books', '--at', String(row[0])], { encoding: 'utf8' });
  assert.match(told, /into C1\b/);
  const trace = execFileSync(merge2d, ['run', 'books', '--steps', String(row[0]), '--trace', '-', '--quiet'], { encoding: 'utf8' });
  assert.equal(JSON.parse(trace.trim().split('\n').pop()).events.find(({ type }) => type === 'merge').collection, 1);
  await close();
});

test('without the engine a page plays, and says that it cannot be taken over', async () => {
  const { page, step, close } = await open('small');
  assert.ok(statSync(fileOf('small')).size < 400_000);
  await page.keyboard.press('ArrowRight');
  assert.equal(await step(), 1);
  assert.ok(await page.isDisabled('.take-over'));
  await page.keyboard.press('t');
  assert.match(await page.textContent('.notice'), /--no-live/);
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

test('titles and names stay text', async () => {
  const { page, close } = await open('evil');
  assert.equal(await page.evaluate(() => window.hacked), undefined);
  assert.match(await page.textContent('h1'), /<script>window\.hacked = 1<\/script>/);
  await page.locator('.picture .body').click();
  assert.equal(await page.textContent('.inspector h3'), '</script><b>');
  await close();
});

test('at Unmerge the card shows the test that was made, with the source in its record', async () => {
  const { page, close } = await open('unmerging');
  const unmerge = await page.$eval('#data', (data) =>
    JSON.parse(data.textContent).traces[0].head.events.find(([, type]) => type === 'unmerge')[0]);
  await page.locator('.slider').fill(String(unmerge));
  await page.click('.stage:nth-child(6)');
  assert.match(await page.textContent('.equation-card'), /motion, docs\/decisions\/decided\.md#decision, for .*: the weld is cut/);
  assert.doesNotMatch(await page.textContent('.equation-card'), /Eqs?\. \((17|19|20)\)/);
  await page.locator('.slider').fill('1');
  await page.click('.stage:nth-child(6)');
  assert.ok(await page.isHidden('.equation-card'), 'no weld is tested in a quiet step');
  await close();
});

test('a symbol of an equation lights up its number', async () => {
  const { page, close } = await open('contact-forces');
  await page.locator('.equation math >> nth=0').locator('[data-symbol="λn"]').first().hover();
  const lit = await page.locator('.equation .lit').count();
  assert.ok(lit >= 2, `${lit} lit`);
  assert.equal(await page.getAttribute('html', 'data-lit'), 'λn');
  await close();
});

test('a long run moves between its keyframes, and has its events in the steps in which they were', async () => {
  const { page, close } = await open('long');
  const head = await page.$eval('#data', (data) => JSON.parse(data.textContent).traces[0].head);
  assert.ok(head.keyframes > 1);
  assert.equal(head.events.length, 0); // they are packed
  const lines = execFileSync(merge2d, ['run', 'funnel', '--steps', '2200', '--trace', '-', '--quiet'], { encoding: 'utf8', maxBuffer: 2 ** 30 })
    .trim().split('\n').map((line) => JSON.parse(line)).filter(({ step }) => step !== undefined);
  const merged = lines.findLast(({ events }) => events?.some(({ type }) => type === 'merge'));
  for (const step of [1001, 1717, merged.step]) {
    await page.locator('.slider').fill(String(step));
    const { bodies } = lines.find((line) => line.step === step);
    const drawn = await page.$$eval('.picture.interactive .body', (all) => all.filter(({ style }) => style.display !== 'none').length);
    assert.ok(Math.abs(drawn - bodies.length) <= 1, `${drawn} bodies are drawn of ${bodies.length}`);
  }
  assert.match(await page.textContent('.now .events'), /merged/);
  await page.locator('.slider').fill(String(2 * head.keyframes + 1));
  assert.match(await page.textContent('.now .hint'), new RegExp(`those of step ${2 * head.keyframes}:`));
  await page.locator('.slider').fill(String(2 * head.keyframes));
  assert.ok(await page.locator('.now .hint').isHidden());
  await page.click('button[aria-label=Play]');
  await page.waitForFunction((from) => Number(document.querySelector('.slider').value) > from, 2 * head.keyframes + 20);
  await close();
});
