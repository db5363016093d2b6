// A lesson as a student goes through it, and with a screen reader’s eyes.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { centre, kCourse, open } from './support.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

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

test('the primary button goes on stage by stage, to the next event, and then to the next part, and says so', async () => {
  const { page, step, stage, close } = await open('what-merging-is', { reducedMotion: 'reduce' });
  const label = () => page.textContent('.lesson .primary');
  await page.keyboard.press('n'); // a part about the stage Merge, the last one
  const at = await step();
  assert.match(await label(), /^Watch the next /);
  await page.click('.lesson .primary');
  assert.ok((await step()) > at);
  assert.match(await label(), /^Next: /);
  await close();
  const sweep = await open('one-sweep', { reducedMotion: 'reduce' });
  assert.equal(await sweep.stage(), 5);
  for (let n = 6; n <= 11; ++n) {
    assert.match(await sweep.page.textContent('.lesson .primary'), new RegExp(`^Stage ${n}: `));
    await sweep.page.click('.lesson .primary');
    assert.equal(await sweep.stage(), n);
  }
  assert.match(await sweep.page.textContent('.lesson .primary'), /^(Watch|Next)/);
  await sweep.close();
});

test('a lesson goes from scene to scene, each with its own camera, bodies and reference', async () => {
  const { page, close } = await open('course/limits', { reducedMotion: 'reduce' }, '#part=5');
  const shown = () => page.locator('.picture.interactive .body:visible').count();
  const names = () => page.$eval('select[aria-label^="What if"]', (select) => [...select.options].map((option) => option.textContent));
  assert.match(await page.textContent('.words h2'), /heavy tower/);
  assert.equal(await shown(), 105);
  await page.click('.menu > summary');
  assert.equal((await names()).length, 3);
  assert.ok((await names()).every((name) => /heavy tower/.test(name)));
  await page.keyboard.press('Escape');
  await page.click('text=Show me instead');
  assert.ok((await page.locator('.picture.interactive .ghosts path:visible').count()) > 8, 'the reference moves on');
  await page.keyboard.press('n');
  assert.match(await page.textContent('.words h2'), /see-saw/);
  assert.equal(await shown(), 3);
  await page.waitForSelector('html[data-engine]');
  await page.keyboard.press('t');
  await page.waitForSelector('html.taken-over');
  await page.selectOption('select[aria-label="Beside it"]', 'reference');
  assert.match(await page.locator('.frame:has(> .picture:not(.interactive))').textContent(), /Reference/);
  await page.keyboard.press('t');
  await page.keyboard.press('n');
  assert.match(await page.textContent('.words h2'), /slope/);
  assert.equal(await shown(), 2);
  for (let i = 0; i < 6; ++i) await page.keyboard.press('p');
  assert.match(await page.textContent('.words h2'), /prices/);
  assert.ok((await shown()) > 8);
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

/** Presses the primary button through the stages and the next event of a part, until it leads out of it. */
async function leavePart(page) {
  for (let i = 0; i < 13; ++i) {
    const label = await page.textContent('.lesson .primary');
    await page.click('.lesson .primary');
    if (!/^(Stage \d+: |Watch )/.test(label)) return;
  }
  assert.fail('the button never leads out of the part');
}

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
      await leavePart(page);
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
  while (/^Part 1 /.test(await page.textContent('.place'))) await page.tap('.lesson .primary');
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

/** In both themes: they differ in colours alone, so that only these are looked at twice. */
async function complaints(page) {
  // In the middle of a change of colours nothing is readable.
  const still = () => page.evaluate(() => Promise.all(document.getAnimations().map((animation) => animation.finished)));
  const run = (options) => page.evaluate((given) => window.axe.run(document, given), options);
  await page.evaluate(axe);
  const out = [];
  for (const [colorScheme, options] of [['light', {}], ['dark', { runOnly: ['color-contrast', 'link-in-text-block'] }]]) {
    await page.emulateMedia({ colorScheme });
    await still();
    const { violations } = await run(options);
    out.push(...violations.map((v) => `${colorScheme}: ${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(' | ')}`));
  }
  return out;
}

test('axe finds nothing to complain about in any lesson, taken over, in both themes', async () => {
  for (const name of kCourse) {
    const { page, close } = await open(`course/${name}`);
    await page.waitForSelector('html[data-engine]');
    await page.keyboard.press('n');
    if (await page.isVisible('.ask fieldset')) await page.click('text=Show me instead');
    await page.keyboard.press('t');
    await page.click('.all-limits summary');
    assert.deepEqual(await complaints(page), [], name);
    await close();
  }
});

test('axe finds nothing to complain about in the parts of a page, in both themes', async () => {
  for (const name of ['what-merging-is', 'contact-forces', 'books', 'one-sweep', 'how-fast-is-still']) {
    const { page, close } = await open(name);
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
    assert.deepEqual(await complaints(page), [], name);
    await close();
  }
});
