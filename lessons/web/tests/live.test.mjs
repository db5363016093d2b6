// Runs that a reader has taken over.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { centre, freeBodies, open, takenOver } from './support.mjs';

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

test('the time step can be changed in a run of one’s own, and time goes on from there', async () => {
  const { page, step, close } = await takenOver('books', 100);
  const seconds = async () => Number(/([\d.]+) seconds/.exec(await page.getAttribute('.slider', 'aria-valuetext'))[1]);
  assert.equal(await seconds(), 1);
  await page.click('.all-limits summary');
  await page.fill('.typed[aria-label^="Time step"]', '0.002');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => /step: 0\.01 s → 0\.002 s/.test(document.querySelector('.deeds').textContent));
  await page.locator('.slider').fill('150');
  assert.equal(await step(), 150);
  assert.ok(Math.abs((await seconds()) - 1.1) < 1e-6);
  await page.locator('.slider').fill('120');
  assert.ok(Math.abs((await seconds()) - 1.04) < 1e-6);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('z');
  await page.locator('.slider').fill('150');
  assert.ok(Math.abs((await seconds()) - 1.5) < 1e-6, 'taken back');
  await close();
});

test('a gauge shows the value of the paper beside a limit that is another one', async () => {
  const change = (line) => `&do=${encodeURIComponent(`0 set ${line}`)}`;
  const bodies = '&bodies=cookbook%26diary';
  const { page, close } = await open('books', {}, `#step=2&fork=0${change('merging.velocity=0.05')}${change('merging.breathing=1e-9')}${bodies}`);
  await page.waitForSelector('html.taken-over');
  await page.waitForSelector('.gauge .second-tick', { state: 'attached' });
  const [limit, paper] = await page.$$eval('.gauge text:not(.value)', (texts) => texts.map((text) => text.textContent));
  assert.match(limit, /^limit (0\.05|1\.0·10⁻⁹)$/);
  assert.match(paper, /^paper (0\.01|1\.0·10⁻⁵)$/);
  assert.match(await page.getAttribute('.gauge svg', 'aria-label'), /limit .*, paper /);
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
