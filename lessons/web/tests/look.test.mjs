// Sizes, labels, languages, paper and pictures of pages.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileOf, here, open } from './support.mjs';

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
  'zoomed-fourfold': [{ width: 320, height: 256 }, '#part=2', 'light'],
};
/** Compares a picture with the reference shot of that name, or becomes it. */
async function looksAs(page, name, shot) {
  const file = join(here, 'reference', `${name}.jpg`);
  if (process.env.UPDATE_SHOTS) writeFileSync(file, shot);
  const share = await difference(page, shot.toString('base64'), readFileSync(file).toString('base64'));
  assert.ok(share < 0.03, `${(100 * share).toFixed(1)} % of the picture differ: look at it, and if it is right, UPDATE_SHOTS=1`);
}

for (const [name, [viewport, hash, colorScheme]] of Object.entries(kShots)) {
  test(`the page looks as in the reference shot ${name}`, async () => {
    const { page, close } = await open('what-merging-is', { viewport, colorScheme, reducedMotion: 'reduce', deviceScaleFactor: 0.5 }, hash);
    await page.waitForSelector('html[data-engine]');
    if (!/question/.test(name)) await page.waitForFunction(() => document.querySelector('.stage .result').textContent !== '');
    const shot = await page.screenshot({ type: 'jpeg', quality: 70 });
    await looksAs(page, name, shot);
    await close();
  });
}

test('on grey paper it looks as in the reference shot print-grey', async () => {
  const { page, close } = await open('what-merging-is', { viewport: { width: 800, height: 1100 }, deviceScaleFactor: 0.5 });
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  await page.emulateMedia({ media: 'print' });
  await page.evaluate(() => { document.documentElement.style.filter = 'grayscale(1)'; });
  await looksAs(page, 'print-grey', await page.screenshot({ type: 'jpeg', quality: 70 }));
  await close();
});

test('a page for a frame in another page is compact, and works in a sandbox', async () => {
  const { page, close } = await open('cycles', { viewport: { width: 900, height: 600 } });
  assert.ok(!(await page.isVisible('header')));
  await page.goto('about:blank');
  await page.setContent(`<iframe sandbox="allow-scripts" style="width: 880px; height: 580px" srcdoc="${readFileSync(fileOf('cycles'), 'utf8').replace(/&/g, '&amp;').replace(/"/g, '&quot;')}"></iframe>`);
  const frame = page.frameLocator('iframe');
  for (let i = 0; i < 13 && !/Part 2/.test(await frame.locator('.lesson .place').textContent()); ++i) await frame.locator('.lesson .primary').click();
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

test('reasons are told in German and French, with the numbers of the engine', async () => {
  const kEnglish = /\b(the|of|they|when|above|below|stays?|steps?|merged?|limit)\b/i;
  for (const [language, text, outlook] of [['de', /^Sie bleiben getrennt: .* liegt über /, /^Sie verschmelzen, wenn /], ['fr', /^Ils restent séparés : .* dépasse /, /^Ils fusionnent si /]]) {
    const { page, close } = await open('what-merging-is', {}, `#part=2&language=${language}&bodies=brick[0,0]%26brick[0,1]`);
    await page.waitForSelector('.why-text p.outlook');
    const [told, then] = await page.$$eval('.why-text p', (lines) => lines.map((line) => line.textContent));
    assert.match(told, text);
    assert.match(then, outlook);
    assert.match(told, /\d 1\/s .*\b2 1\/s/);
    const all = await page.locator('.why-body').innerText();
    assert.doesNotMatch(all, kEnglish);
    await close();
  }
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
