// Collections over time: a lane for each, as thick as it is large; who joined whom, and who left.
import { h, plural, svg } from './dom';
import type { State } from './state';
import type { Trace } from './trace';
import { stepOf } from './tracks';

interface Life {
  id: number;
  first: number;
  last: number;
  most: number;
  lane: number;
  sizes: [step: number, size: number][];
}
interface Link {
  step: number;
  from: number;
  to: number;
}

const kWidth = 1000;
const kMostLanes = 14;

function livesOf(trace: Trace): { lives: Life[]; links: Link[] } {
  const lives = new Map<number, Life>();
  const links = new Map<string, Link>();
  const sizes = new Map<number, number>();
  const members = Int32Array.from(trace.bodies, () => -1);
  const changes = new Map<number, number[]>(); // bodies by steps
  trace.bodies.forEach((track, body) => {
    for (let i = 0; i < track.collection.length; ++i) {
      if (i > 0 && track.collection[i] === track.collection[i - 1]) continue;
      const step = stepOf(track, i);
      const list = changes.get(step);
      if (list) list.push(body);
      else changes.set(step, [body]);
    }
  });
  for (const [step, bodies] of [...changes].sort((a, b) => a[0] - b[0])) {
    const touched = new Set<number>();
    for (const body of bodies) {
      const now = trace.collection(body, step);
      const was = members[body];
      if (now === was) continue;
      members[body] = now;
      for (const [id, by] of [[was, -1], [now, 1]]) {
        if (id < 0) continue;
        sizes.set(id, (sizes.get(id) ?? 0) + by);
        touched.add(id);
      }
      if (was >= 0 && now >= 0) links.set(`${step}-${was}-${now}`, { step, from: was, to: now });
    }
    for (const id of touched) {
      const size = sizes.get(id) ?? 0;
      const life = lives.get(id) ?? { id, first: step, last: trace.head.steps, most: 0, lane: 0, sizes: [] };
      life.sizes.push([step, size]);
      life.most = Math.max(life.most, size);
      life.last = size > 0 ? trace.head.steps : step;
      lives.set(id, life);
    }
  }
  // Each takes the first lane that is free for all of its life; long lives come first.
  const all = [...lives.values()];
  const ends: [number, number][][] = [];
  for (const life of [...all].sort((a, b) => (b.last - b.first) * b.most - (a.last - a.first) * a.most)) {
    let lane = ends.findIndex((taken) => taken.every(([from, to]) => life.last < from || life.first > to));
    if (lane < 0) lane = ends.push([]) - 1;
    ends[lane].push([life.first, life.last]);
    life.lane = lane;
  }
  return { lives: all.sort((a, b) => a.id - b.id), links: [...links.values()] };
}

export function familyTree(state: State): HTMLElement {
  const holder = h('div', { class: 'family' });
  const cursor = svg('path', { class: 'cursor' });
  let drawn: Trace | null = null;
  let height = 0;
  const x = (step: number) => (kWidth * step) / Math.max(1, state.steps);
  const build = () => {
    const { lives, links } = livesOf(state.trace);
    const lanes = Math.min(kMostLanes, 1 + Math.max(-1, ...lives.map((life) => life.lane)));
    const pitch = 18;
    height = Math.max(1, lanes) * pitch + 6;
    const y = (life: Life) => 3 + pitch * (life.lane + 0.5);
    const largest = Math.max(2, ...lives.map((life) => life.most));
    const root = svg('svg', {
      viewBox: `0 0 ${kWidth} ${height}`, preserveAspectRatio: 'none', role: 'img', style: `height:${height}px`,
      'aria-label': `${plural(lives.length, 'collection')} over the whole run`,
      onclick: (event) => {
        const box = root.getBoundingClientRect();
        state.goTo((((event as MouseEvent).clientX - box.left) / box.width) * state.steps);
      },
    });
    const byId = new Map(lives.map((life) => [life.id, life]));
    let d = '';
    for (const link of links) {
      const [a, b] = [byId.get(link.from), byId.get(link.to)];
      if (a && b && a.lane < lanes && b.lane < lanes && a !== b) d += `M${x(link.step).toFixed(1)} ${y(a)}V${y(b)}`;
    }
    root.append(svg('path', { class: 'links', d }));
    for (const life of lives) {
      if (life.lane >= lanes) continue;
      const slot = state.trace.slot(life.id);
      for (const [i, [step, size]] of life.sizes.entries()) {
        if (size <= 0) continue;
        const end = life.sizes[i + 1]?.[0] ?? state.steps;
        const thick = 3 + (pitch - 5) * (Math.log(size + 1) / Math.log(largest + 1));
        root.append(svg('rect', {
          class: `life k${slot}`, x: x(step).toFixed(1), width: Math.max(1.2, x(end) - x(step)).toFixed(1),
          y: (y(life) - thick / 2).toFixed(1), height: thick.toFixed(1),
        }, svg('title', {}, `C${life.id}: ${plural(size, 'body', 'bodies')}`)));
      }
    }
    root.append(cursor);
    holder.replaceChildren(lives.length > 0 ? root : h('p', { class: 'hint' }, 'Nothing merges in this run.'));
  };
  state.onChange(() => {
    if (drawn !== state.trace) {
      drawn = state.trace;
      build();
    }
    cursor.setAttribute('d', `M${x(state.step).toFixed(1)} 0V${height}`);
  });
  return h('section', { class: 'card', 'aria-label': 'Family tree of the collections' },
    h('h2', {}, 'Collections over time'),
    h('p', { class: 'hint' }, 'A lane for each collection, the thicker the more bodies it has; upright lines where bodies change over. Click to go there.'),
    holder);
}
