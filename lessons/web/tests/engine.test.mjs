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
    const world = engine.open(tomlOf(scene), 'merge+sleep');
    let at = headerBytes(native);
    for (let step = 1; step <= steps; ++step) {
      const line = Buffer.from(world.traceBytes(step));
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

test('a saved world goes on to the same bytes', () => {
  const world = engine.open(tomlOf('tower-platform'), 'merge+sleep');
  world.skipTo(200);
  const saved = world.save();
  const first = world.trace(260);
  world.restore(saved);
  assert.equal(world.trace(260), first);
  world.close();
});

test('a hand that drags a brick tears it off, and the engine says why', () => {
  const world = engine.open(tomlOf('tower-platform'), 'merge+sleep');
  world.skipTo(300);
  const seen = world.see();
  const free = (step) => step.bodies.filter((row) => row[7] < 0).length;
  const held = seen.bodies.filter((row) => row[7] >= 0).sort((p, q) => q[2] - p[2])[0];
  const [body, x, y] = held;
  world.drag(body, [0, 0], [x + 1.5, y + 1]);
  let last;
  let reasons = [];
  for (let i = 0; i < 60; ++i) {
    last = world.step();
    reasons = reasons.concat(last.decisions.filter((row) => row[2] === 'Unmerge' && row[9] === 0 && (row[0] === body || row[1] === body)));
  }
  assert.ok(free(last) > free(seen), 'bodies came free');
  assert.ok(reasons.length > 0, 'a criterion was broken');
  const [,,, , , threshold, , value] = reasons[0];
  assert.ok(Number.isFinite(value) && Number.isFinite(threshold));
  const now = last.bodies.find((row) => row[0] === body);
  assert.ok(Math.hypot(now[1] - x - 1.5, now[2] - y - 1) < 1, 'it follows the hand');
  world.close();
});

test('a scene that cannot be read says where', () => {
  assert.throws(() => engine.open('format = 1\n[[body]]\ncirlce = 1\n', 'merge+sleep'), /scene\.toml:3.*circle/s);
});
