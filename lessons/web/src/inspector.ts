// The numbers of a body or of a pair in contact, now and over time, against their limits.
import { chart, type Series } from './chart';
import { h, number, plural } from './dom';
import { contactsOfStage } from './inside';
import type { State } from './state';
import { type DecisionTrack, endOf } from './tracks';

const kNames: Record<string, [string, string]> = {
  'relative-motion': ['Fastest relative motion', 'm/s'],
  motion: ['Fastest relative motion', 'm/s'],
  sliding: ['Slip', 'm/s'],
  breathing: ['Breathing: change of overlap', 'm'],
  load: ['Change of load', '1/s'],
  edge: ['On the edge of the friction cone', ''],
  broken: ['Normal impulse', 'N s'],
  count: ['Calm steps', ''],
  rest: ['Speed in the world', 'm/s'],
  hits: ['Time of hits', 's'],
};

export function criterionName(criterion: string): string {
  return kNames[criterion]?.[0] ?? criterion;
}
export function criterionUnit(criterion: string): string {
  return kNames[criterion]?.[1] ?? '';
}

function row(label: string, value: string): HTMLElement {
  return h('div', { class: 'row' }, h('dt', {}, label), h('dd', {}, value));
}

export function inspector(state: State): HTMLElement {
  const body = h('div', { class: 'inspector' });
  let drawn = '';
  state.onChange(() => {
    if (state.playing && drawn === 'none' && !state.selection) return;
    const selection = state.selection;
    if (state.veiled) {
      drawn = 'veiled';
      return body.replaceChildren(h('p', { class: 'hint' }, 'Hidden until you have answered.'));
    }
    const key = selection ? `${JSON.stringify(selection)}-${state.step}-${state.stage}-${state.trace.label}` : 'none';
    if (key === drawn) return;
    drawn = key;
    if (!selection) {
      body.replaceChildren(h('p', { class: 'hint' }, 'Click a body or a contact in the picture: its numbers appear here, over time and against their limits.'));
    } else if (selection.kind === 'body') {
      body.replaceChildren(...bodyView(state, selection.body));
    } else {
      body.replaceChildren(...pairView(state, selection.a, selection.b));
    }
  });
  return h('section', { class: 'card', 'aria-label': 'Numbers' }, h('h2', {}, 'Numbers'), body);
}

function figure(state: State, series: Series): HTMLElement {
  const now = series.points.find(([s]) => s === state.step);
  const value = now ? `${number(now[1])} ${series.unit}` : '–';
  const limit = series.threshold !== undefined && series.threshold > 0 ? ` · limit ${number(series.threshold)} ${series.unit}` : '';
  return h('figure', { class: 'trend' },
    h('figcaption', {}, h('span', {}, series.label), h('strong', {}, value), limit),
    chart(series, state.steps, (step) => state.trace.timeAt(step), state.step, (step) => state.goTo(step)));
}

function bodyView(state: State, id: number): HTMLElement[] {
  const trace = state.trace;
  const info = trace.head.bodies[id];
  const out: HTMLElement[] = [h('h3', {}, trace.name(id))];
  if (!trace.present(id, state.step)) return [...out, h('p', {}, 'It is not there yet.')];
  const pose = trace.pose(id, state.step);
  const v = trace.velocity(id, state.step);
  const collection = trace.collection(id, state.step);
  const belongs = info.motion !== 'dynamic' ? info.motion
    : trace.asleep(id, state.step) ? 'asleep'
    : collection < 0 ? 'free' : `in collection C${collection}`;
  const neighbours = [...new Set(trace.contacts
    .filter((c) => (c.a === id || c.b === id) && c.spans.at(state.step) >= 0)
    .map((c) => (c.a === id ? c.b : c.a)))];
  out.push(h('dl', {},
    ...(trace.name(id) === info.name ? [] : [row('Name in the scene', info.name)]),
    row('State', belongs),
    row('Mass', `${number(info.mass)} kg`),
    row('Place', `(${number(pose.x)}, ${number(pose.y)}) m`),
    row('Velocity', `(${number(v.vx)}, ${number(v.vy)}) m/s`),
    row('Spin', `${number(v.omega)} rad/s`)));
  if (neighbours.length > 0) {
    out.push(h('p', { class: 'touching' }, 'Touches ',
      ...neighbours.flatMap((other, i) => [i > 0 ? ', ' : '', h('button', {
        type: 'button', class: 'link',
        onclick: () => {
          state.selection = { kind: 'pair', a: Math.min(id, other), b: Math.max(id, other) };
          state.changed();
        },
      }, trace.name(other))])));
  }
  const track = trace.bodies[id];
  const speed: Series = { label: 'Speed', unit: 'm/s', points: [] };
  const every = Math.max(1, Math.floor(state.steps / 600));
  for (let s = track.first; s < endOf(track); ++s) {
    if (s % every !== 0 && s !== state.step) continue;
    const w = trace.velocity(id, s);
    speed.points.push([s, Math.hypot(w.vx, w.vy)]);
  }
  out.push(figure(state, speed));
  return out;
}

function decisionSeries(state: State, track: DecisionTrack): Series {
  const { criterion } = track;
  const points: [number, number][] = [];
  for (const [step, i] of track.spans.steps()) points.push([step, Math.abs(state.trace.decisionSample(track, i).value)]);
  return {
    label: `${criterionName(criterion.criterion)} (${criterion.stage === 'Unmerge' ? 'to unmerge' : 'to merge'})`,
    unit: criterionUnit(criterion.criterion), points, threshold: criterion.threshold, logarithmic: true,
  };
}

function pairView(state: State, a: number, b: number): HTMLElement[] {
  const trace = state.trace;
  const out: HTMLElement[] = [h('h3', {}, `${trace.name(a)} and ${trace.name(b)}`)];
  const tracks = trace.tracksOf(a, b);
  const contacts = contactsOfStage(state).filter((c) => tracks.includes(c.track));
  if (contacts.length === 0) out.push(h('p', {}, 'They do not touch at this step.'));
  const hh = trace.lengthOf(state.step);
  const first = contacts[0];
  if (first) {
    const normal = contacts.reduce((sum, c) => sum + c.lambdaN, 0) / hh;
    const friction = contacts.reduce((sum, c) => sum + c.lambdaT, 0) / hh;
    const most = first.mu * normal;
    out.push(h('dl', {},
      row('State', first.internal ? 'welded, inside a collection' : contacts.some((c) => c.state === 'sliding') ? 'sliding' : 'touching'),
      row('Contact points', plural(contacts.length, 'point')),
      row('Normal force', `${number(normal)} N`),
      row('Friction', Math.abs(friction) > 0.98 * most && most > 0 ? `at its limit of ${number(most)} N (μ = ${number(first.mu)})`
        : `${number(friction)} N of at most ${number(most)} N (μ = ${number(first.mu)})`),
      row('Gap', `${number(Math.min(...contacts.map((c) => c.gap)) * 1000)} mm`)));
  }
  const now: Series[] = [];
  for (const track of trace.decisionTracksOf(a, b)) {
    const name = track.criterion.criterion;
    if (['motion', 'relative-motion', 'sliding', 'breathing'].includes(name)) now.push(decisionSeries(state, track));
  }
  out.push(...now.map((series) => figure(state, series)));
  const forces: Series = { label: 'Normal force', unit: 'N', points: [] };
  const sums = new Map<number, number>();
  for (const track of tracks) {
    for (const [step] of track.spans.steps()) {
      const c = trace.contact(track, step);
      if (c) sums.set(step, (sums.get(step) ?? 0) + c.lambdaN / hh);
    }
  }
  forces.points = [...sums].sort((p, q) => p[0] - q[0]);
  if (forces.points.length > 0) out.push(figure(state, forces));
  return out;
}
