// The picture without eyes or without a mouse: its description, and a cursor that goes from body to body.
import { h, number } from './dom';
import type { Picture } from './picture';
import type { State } from './state';
import type { Trace } from './trace';

const kDirections: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const kMost = 40; // bodies that a description names

function belongs(trace: Trace, body: number, step: number): string {
  const { motion } = trace.head.bodies[body];
  if (motion !== 'dynamic') return motion;
  const collection = trace.collection(body, step);
  return `${trace.asleep(body, step) ? 'asleep, ' : ''}${collection < 0 ? 'free' : `in C${collection}`}`;
}

/** "to the left", of a velocity. */
function way(vx: number, vy: number): string {
  const across = Math.abs(vx) > 0.4 * Math.abs(vy) ? (vx < 0 ? 'to the left' : 'to the right') : '';
  const along = Math.abs(vy) > 0.4 * Math.abs(vx) ? (vy < 0 ? 'down' : 'up') : '';
  return [along, across].filter(Boolean).join(' and ');
}

/** One body: who it is, where it belongs, how it moves, which bodies it touches. */
export function bodyInWords(state: State, body: number): string {
  const { trace, step } = state;
  const { vx, vy } = trace.velocity(body, step);
  const speed = Math.hypot(vx, vy);
  const touched = new Set(trace.contactsAt(step).filter((c) => c.a === body || c.b === body).map((c) => (c.a === body ? c.b : c.a)));
  return [`${trace.name(body)}, ${belongs(trace, body, step)}`, speed < 5e-4 ? 'at rest' : `${number(speed, 2)} m/s ${way(vx, vy)}`,
    touched.size > 0 ? `touches ${[...touched].map((other) => trace.name(other)).join(', ')}` : 'touches nothing'].join(', ') + '.';
}

/** Which bodies are where: by collections, from the left to the right. */
export function whoIsWhere(state: State): string {
  const { trace, step } = state;
  const groups = new Map<string, number[]>();
  const there = trace.head.bodies.map((_, i) => i).filter((i) => trace.present(i, step));
  for (const i of there) {
    const key = belongs(trace, i, step);
    groups.set(key, [...(groups.get(key) ?? []), i]);
  }
  const x = (body: number) => trace.pose(body, step).x;
  const told = [...groups].map(([key, bodies]) => `${key}: ${bodies.length > kMost ? `${bodies.length} bodies`
    : bodies.sort((a, b) => x(a) - x(b)).map((body) => trace.name(body)).join(', ')}`);
  return `${trace.head.title}, ${state.time.toFixed(2)} s, from the left to the right. ${told.join('. ')}.`;
}

/** The nearest body in a direction; the first one is the nearest to the middle of the picture. */
function neighbour(state: State, picture: Picture, from: number | undefined, [dx, dy]: [number, number]): number | undefined {
  const { trace, step } = state;
  const seen = picture.lens.visible;
  const [cx, cy] = from === undefined || !trace.present(from, step) ? picture.view.world((seen.left + seen.right) / 2, (seen.top + seen.bottom) / 2)
    : [trace.pose(from, step).x, trace.pose(from, step).y];
  let best: number | undefined;
  let least = Infinity;
  for (let body = 0; body < trace.head.bodies.length; ++body) {
    if (body === from || !trace.present(body, step)) continue;
    const pose = trace.pose(body, step);
    const [px, py] = picture.view.at([pose.x, pose.y]);
    if (px < seen.left || px > seen.right || py < seen.top || py > seen.bottom) continue;
    const [along, aside] = [(pose.x - cx) * dx + (pose.y - cy) * dy, Math.abs((pose.x - cx) * dy) + Math.abs((pose.y - cy) * dx)];
    const far = from === undefined ? Math.hypot(pose.x - cx, pose.y - cy) : along > 1e-6 ? along + 2 * aside : Infinity;
    if (far >= least) continue;
    least = far;
    best = body;
  }
  return best;
}

/** Arrows go to the neighbour in that direction, Enter chooses it; a second Enter makes the pair. */
export function bodyCursor(frame: HTMLElement, picture: Picture, state: State, choose: (body: number) => void): void {
  const live = h('p', { class: 'visually-hidden', role: 'status', 'aria-live': 'polite' });
  frame.append(live);
  let at: number | undefined;
  frame.addEventListener('keydown', (event) => {
    if (event.target !== frame || event.ctrlKey || event.metaKey || event.altKey) return;
    const direction = kDirections[event.key];
    if (direction) {
      at = neighbour(state, picture, at, direction) ?? at;
      if (at === undefined) return;
      picture.showCursor(at);
      live.textContent = bodyInWords(state, at);
    } else if (event.key === 'Enter' && at !== undefined) {
      choose(at);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  });
  frame.addEventListener('focusout', () => {
    at = undefined;
    picture.showCursor(undefined);
  });
  let due = 0;
  state.onChange(() => {
    window.clearTimeout(due);
    if (!state.playing) due = window.setTimeout(() => picture.root.setAttribute('aria-label', whoIsWhere(state)), 200);
  });
}
