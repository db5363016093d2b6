// Hands on a live run: loads on a body are drawn, and a pointer in the picture pulls, pushes, throws, pins, adds.
import { number } from './dom';
import type { Vec } from './head';
import type { Picture } from './picture';
import type { Paths, Sight } from './sight';
import type { State } from './state';
import { arrow, coil, disc, fixed } from './strokes';
import type { Trace } from './trace';

/** The force of each hand in words, and where its arrow begins. */
export function pullsShown({ state, view }: Sight): { at: Vec; told: string }[] {
  const { live } = state;
  if (!live || state.trace !== live.trace || state.step !== live.trace.known) return [];
  return live.hands(state.step).map(([, , , tx, ty, fx, fy]) => ({ at: view.at([tx, ty]), told: `${number(Math.hypot(fx, fy))} N` }));
}

/** The springs of hands, with their forces. */
export function hands(sight: Sight): Paths {
  const { state, view, scales } = sight;
  const { live } = state;
  if (!live || state.trace !== live.trace || state.step !== live.trace.known) return { hand: '' };
  let hand = '';
  for (const [, x, y, tx, ty, fx, fy] of live.hands(state.step)) {
    const [px, py] = view.at([x, y]);
    const [qx, qy] = view.at([tx, ty]);
    const long = Math.max(1, (Math.hypot(fx, fy) * scales.force) / 260);
    hand += coil(px, py, qx, qy) + disc(qx, qy, 7) + arrow(px, py, (fx * scales.force) / long, (-fy * scales.force) / long);
  }
  return { hand };
}

/** A load of the scene itself: where it acts, its arrow, and its size in words. */
export interface Load {
  from: Vec;
  to: Vec;
  told: string;
}

export function loadsShown(sight: Sight): Load[] {
  const { state, trace, view, scales, posed } = sight;
  const out: Load[] = [];
  // The arrow ends at the body; its number stands beside it, so a small one need not be hard to see.
  const add = (x: number, y: number, fx: number, fy: number, length: number, told: string) => {
    const size = Math.hypot(fx, fy) || 1;
    out.push({ from: [x - (length * fx) / size, y + (length * fy) / size], to: [x, y], told });
  };
  for (const [body, ax, ay, fx, fy, from, until] of trace.head.forces ?? []) {
    if (state.time < from || state.time > (until ?? Infinity) || !trace.present(body, posed)) continue;
    const pose = trace.pose(body, posed);
    const [c, s] = [Math.cos(pose.angle), Math.sin(pose.angle)];
    const [x, y] = view.at([pose.x + c * ax - s * ay, pose.y + s * ax + c * ay]);
    const size = Math.hypot(fx, fy);
    add(x, y, fx, fy, Math.min(160, Math.max(50, size * scales.force)), `${number(size)} N`);
  }
  for (const [, ax, ay, ix, iy, time] of trace.head.impulses ?? []) {
    // From the step before to a quarter of a second after it.
    if (state.time < time - 1.5 * trace.lengthOf(state.step) || state.time > time + 0.25) continue;
    const [x, y] = view.at([ax, ay]);
    add(x, y, ix, iy, 90, `${number(Math.hypot(ix, iy))} N s`);
  }
  return out;
}

/** The arrows of the loads. */
export function loads(sight: Sight): Paths {
  return { loads: loadsShown(sight).map(({ from, to }) => arrow(...from, to[0] - from[0], to[1] - from[1])).join('') };
}

/** In the frame of a body. */
function gripOf(trace: Trace, body: number, step: number, [x, y]: [number, number]): [number, number] {
  const pose = trace.pose(body, step);
  const [c, s] = [Math.cos(pose.angle), Math.sin(pose.angle)];
  return [c * (x - pose.x) + s * (y - pose.y), c * (y - pose.y) - s * (x - pose.x)];
}

const short = (value: number) => Number(value.toFixed(4));

interface Pull {
  body: number;
  grip: [number, number];
  from: [number, number];
  to: [number, number];
  told: string; // the line that was done last
}

/** `play` makes a run go on that stands while somebody pulls at it. */
export function listenToHands(picture: Picture, state: State, play: () => void, say: (text: string) => void): void {
  let pull: Pull | null = null;
  let pan: DOMPoint | null = null;

  const world = (event: PointerEvent): [number, number] => {
    const at = picture.point(event);
    return at ? picture.view.world(at.x, at.y) : [0, 0];
  };
  const isDynamic = (body: number) => state.trace.head.bodies[body].motion === 'dynamic';

  picture.root.addEventListener('pointerdown', (event) => {
    picture.lens.moved = false;
    if (event.button !== 0) return;
    const body = picture.bodyAt(event);
    if (body !== undefined && state.live && pullsWith(state.tool) && isDynamic(body)) {
      const at = world(event);
      pull = { body, grip: gripOf(state.trace, body, state.step, at), from: at, to: at, told: '' };
      picture.root.setPointerCapture(event.pointerId);
      event.preventDefault();
    } else if (body === undefined || !state.live) {
      pan = picture.point(event);
    }
  });

  picture.root.addEventListener('pointermove', (event) => {
    if (pull) {
      pull.to = world(event);
      const [dx, dy] = [pull.to[0] - pull.from[0], pull.to[1] - pull.from[1]];
      if (!picture.lens.moved && Math.hypot(dx, dy) * picture.view.scale < 6) return;
      picture.lens.moved = true;
      if (state.tool === 'drag') {
        if (!state.playing) play();
      } else {
        const [x, y] = picture.view.at(pull.from);
        picture.aim(arrow(x, y, dx * picture.view.scale, -dy * picture.view.scale), aimText(state, pull), picture.view.at(pull.to));
        say(aimText(state, pull));
      }
    } else if (pan && event.buttons === 1) {
      const at = picture.point(event);
      if (!at || (!picture.lens.moved && Math.hypot(at.x - pan.x, at.y - pan.y) < 8)) return;
      picture.lens.moved = true;
      picture.lens.moveBy(at.x - pan.x, at.y - pan.y);
    }
  });

  const lift = () => {
    pan = null;
    if (!pull) return;
    const done = pull;
    pull = null;
    picture.aim('');
    if (!picture.lens.moved) return;
    if (state.tool === 'drag') {
      if (done.told) state.act(`drop @${done.body}`);
    } else {
      const line = aimLine(state, done);
      if (line) state.act(line);
    }
    window.setTimeout(() => { picture.lens.moved = false; }, 0);
  };
  picture.root.addEventListener('pointerup', lift);
  const cancel = () => {
    if (pull?.told) state.act(`drop @${pull.body}`);
    pull = null;
    pan = null;
    picture.aim('');
  };
  picture.root.addEventListener('pointercancel', cancel);
  document.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !pull) return;
    event.stopPropagation();
    cancel();
    say('');
  }, true);

  // A hand that moves is a change before each step in which it has moved.
  state.beforeSteps = () => {
    if (!pull || state.tool !== 'drag' || !picture.lens.moved) return;
    const line = `drag @${pull.body} to ${short(pull.to[0])} ${short(pull.to[1])} grip ${short(pull.grip[0])} ${short(pull.grip[1])}`;
    if (line === pull.told) return;
    pull.told = line;
    state.act(line);
  };

  picture.root.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey) return; // the page scrolls with the wheel alone
    event.preventDefault();
    picture.lens.zoomBy(Math.exp(-0.002 * event.deltaY), picture.point(event) ?? undefined);
  }, { passive: false });
}

function pullsWith(tool: State['tool']): boolean {
  return tool === 'drag' || tool === 'push' || tool === 'throw';
}

/** A pull of a metre throws with so many metres per second. */
const kSpeedPerMetre = 5;

function aimed(state: State, { body, from, to }: Pull): [number, number] {
  const factor = state.tool === 'push' ? kSpeedPerMetre * state.trace.head.bodies[body].mass : kSpeedPerMetre;
  return [factor * (to[0] - from[0]), factor * (to[1] - from[1])];
}

function aimText(state: State, pull: Pull): string {
  const [x, y] = aimed(state, pull);
  const degrees = Math.round((Math.atan2(y, x) * 180) / Math.PI);
  return `${Math.hypot(x, y).toFixed(1)} ${state.tool === 'push' ? 'N s' : 'm/s'}, ${Math.abs(degrees)}° ${degrees < 0 ? 'down' : 'up'}`;
}

function aimLine(state: State, pull: Pull): string {
  const [x, y] = aimed(state, pull).map(short);
  return state.tool === 'push' ? `push @${pull.body} ${x} ${y} at ${short(pull.from[0])} ${short(pull.from[1])}` : `throw @${pull.body} ${x} ${y}`;
}

/** The command of a click with a tool; empty where it chooses. */
export function clickLine(state: State, body: number | undefined, at: [number, number]): string {
  const size = 0.06 * state.trace.head.camera[2];
  const place = `${short(at[0])} ${short(at[1])}`;
  switch (state.tool) {
    case 'box': return `add box ${place} ${short(1.6 * size)} ${short(0.8 * size)}`;
    case 'disc': return `add disc ${place} ${short(0.6 * size)}`;
    case 'pin': return body === undefined ? '' : `${isPinned(state, body) ? 'unpin' : 'pin'} @${body}`;
    case 'delete': return body === undefined ? '' : `delete @${body}`;
    default: return '';
  }
}

/** Whether the reader pinned it last. */
function isPinned(state: State, body: number): boolean {
  const last = state.live?.deeds.filter((deed) => new RegExp(`^(un)?pin @${body}$`).test(deed.line)).pop();
  return last ? last.line.startsWith('pin') : state.trace.head.bodies[body].motion === 'pinned';
}

/** Force of the hand as text, beside its arrow. */
export function handText(state: State): string {
  const { live } = state;
  if (!live || state.step !== live.trace.known) return '';
  return live.hands(state.step).map(([body, , , , , fx, fy]) =>
    `${state.trace.name(body)} is pulled with ${fixed(Math.hypot(fx, fy))} N.`).join(' ');
}
