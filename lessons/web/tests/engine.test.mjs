// The engine of the pages, run in node: the same bits as the native program, and what a hand does.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { closeSync, fstatSync, mkdtempSync, openSync, readFileSync, readSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { build } from 'esbuild';

const here = fileURLToPath(new URL('.', import.meta.url));
const project = join(here, '../../..');
const merge2d = process.env.MERGE2D ?? join(project, 'build/merge2d');

let folder;
let engine;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'merge2d-engine-'));
  const outfile = join(folder, 'engine.mjs');
  await build({ entryPoints: [join(here, '../src/engine.ts')], bundle: true, format: 'esm', outfile, logLevel: 'warning' });
  const { Engine } = await import(pathToFileURL(outfile));
  engine = await Engine.load(readFileSync(join(here, '../dist/engine.b64'), 'utf8'));
});
after(() => rmSync(folder, { recursive: true, force: true }));

const tomlOf = (scene) => readFileSync(join(project, 'scenes', `${scene}.toml`), 'utf8');

/** How long the first line is: the native program writes a header. */
function headerBytes(file) {
  const start = Buffer.alloc(1 << 20);
  readSync(file, start, 0, start.length, 0);
  return start.indexOf('\n') + 1;
}

/** Whether the checked-in engine was made from today's sources: others give other numbers. */
function isOfToday() {
  try {
    execFileSync(join(project, 'scripts/build-web'), ['--check'], { stdio: 'ignore' });
    return true;
  } catch {
    return false;
  }
}
const skip = isOfToday() ? false : 'the checked-in engine is of other sources: run scripts/build-web';

for (const scene of ['tower-platform', 'pile', 'wagon', 'funnel']) {
  test(`${scene} runs to the same bytes as in the native program`, { skip }, () => {
    const steps = Number(process.env.STEPS ?? 2000);
    const file = join(folder, `${scene}.jsonl`);
    execFileSync(merge2d, ['run', scene, '--steps', String(steps), '--no-timings', '--quiet', '--trace', file]);
    const native = openSync(file, 'r');
    const world = engine.traced(tomlOf(scene), 'merge+sleep');
    let at = headerBytes(native);
    for (let step = 1; step <= steps; ++step) {
      const line = Buffer.from(world.bytes(step));
      const other = Buffer.alloc(line.length);
      readSync(native, other, 0, line.length, at);
      at += line.length;
      assert.ok(line.equals(other), `differs first at step ${step}`);
    }
    assert.equal(fstatSync(native).size, at);
    closeSync(native);
    rmSync(file);
    world.close();
  });
}

test('a run goes back and on again to the same bits, with what was done by hand', () => {
  const world = engine.open(tomlOf('tower-platform'), 'merge+sleep');
  world.change(200, 'push @40 3 1');
  world.change(210, 'add disc 0 6 0.2');
  world.change(220, 'set merging.velocity=0.05');
  const first = JSON.stringify(world.step(260));
  world.step(205);
  assert.equal(JSON.stringify(world.step(260)), first);
  assert.equal(world.undo(3), 200);
  const untouched = engine.open(tomlOf('tower-platform'), 'merge+sleep');
  assert.deepEqual(world.step(260), untouched.step(260));
  for (const one of [world, untouched]) one.close();
});

test('a hand that drags a brick tears it off, and the engine says why', () => {
  const world = engine.open(tomlOf('tower-platform'), 'merge+sleep');
  const seen = world.see(300);
  const free = (step) => step.bodies.filter((row) => row[7] < 0).length;
  const held = seen.bodies.filter((row) => row[7] >= 0).sort((p, q) => q[2] - p[2])[0];
  const [body, x, y] = held;
  world.change(300, `drag @${body} to ${x + 1.5} ${y + 1}`);
  let last;
  let why;
  for (let k = 301; k <= 360; ++k) {
    last = world.step(k);
    const parted = last.events.find(([, type, a, b]) => type === 'unmerge' && (a === body || b === body));
    if (parted && !why) why = world.why(k, parted[2], parted[3]);
  }
  assert.ok(free(last) > free(seen), 'bodies came free');
  assert.match(why.text, /came apart at step \d+: .* is (above|below)|carries|edge/);
  assert.ok(why.tests.length > 0);
  assert.ok(Math.hypot(...world.hands(301)[0].slice(5)) > 1, 'the hand pulls');
  const now = last.bodies.find((row) => row[0] === body);
  assert.ok(Math.hypot(now[1] - x - 1.5, now[2] - y - 1) < 1, 'it follows the hand');
  world.close();
});

test('what cannot be done is refused in words, and changes nothing', () => {
  const world = engine.open(tomlOf('tower-platform'), 'merge+sleep');
  assert.throws(() => world.change(10, 'push nobody 1 0'), /there is no body 'nobody'/);
  assert.throws(() => world.change(10, 'set merging.velocty=1'), /did you mean 'velocity'/);
  assert.equal(world.settings(10)['merging.velocity'], 0.01);
  world.close();
});

test('a scene that cannot be read says where', () => {
  assert.throws(() => engine.open('format = 1\n[[body]]\ncirlce = 1\n', 'merge+sleep'), /scene\.toml:3.*circle/s);
});

test('reasons have sentences in every language, by the names that the engine gives', () => {
  const reasons = JSON.parse(readFileSync(join(project, 'lessons/web/src/reasons.json'), 'utf8'));
  const namesIn = (file, list) => {
    const text = readFileSync(join(project, file), 'utf8');
    const found = new RegExp(`${list}\\[[^\\]]*\\]\\s*=\\s*\\{([^}]*)\\}`).exec(text);
    assert.ok(found, `${list} in ${file}`);
    return [...found[1].matchAll(/"([^"]+)"/g)].map(([, name]) => name);
  };
  const outcomes = [...namesIn('lessons/explain.cpp', 'kNames'), 'absent', 'one', 'one-asleep', 'by-others', 'no-touch', 'asleep', 'untested'];
  const conditions = namesIn('lessons/why.cpp', 'kNames');
  for (const [language, words] of Object.entries(reasons)) {
    assert.deepEqual(Object.keys(words.outcome).sort(), [...outcomes].sort(), language);
    assert.deepEqual(Object.keys(words.condition).sort(), [...conditions].sort(), language);
    assert.deepEqual(Object.keys(words.clause), Object.keys(reasons.de.clause), language);
  }
  // Every criterion that docs/records.md lists has words of its own, also those that few runs show.
  const records = readFileSync(join(project, 'docs/records.md'), 'utf8');
  const criteria = [...records.matchAll(/^\| [A-Z]\w+ \| `([a-z-]+)` \|/gm)].map(([, name]) => name);
  assert.ok(criteria.length > 30, `${criteria.length} criteria`);
  for (const words of Object.values(reasons)) {
    for (const criterion of criteria) assert.ok(words.measure[criterion] ?? words.clause[criterion], criterion);
  }
  for (const scene of ['tower-platform', 'books', 'slope']) {
    const world = engine.open(tomlOf(scene), 'merge+sleep');
    for (let k = 1; k <= 400; k += 3) {
      for (const [a, b] of world.step(k).decisions) {
        if (a === b) continue;
        const reason = world.why(k, a, b);
        for (const words of Object.values(reasons)) {
          assert.ok(words.outcome[reason.outcome], reason.outcome);
          assert.ok(reason.condition.kind in words.condition, reason.condition.kind);
          for (const { criterion } of reason.tests) assert.ok(words.measure[criterion] ?? words.clause[criterion], criterion);
        }
      }
    }
    world.close();
  }
});
