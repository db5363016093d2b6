// The layers of the picture that lie on contacts: marks, forces, graph, nearness to a limit.
import type { Vec } from './head';
import { aboutImpulses, changeOf } from './inside';
import type { Paths, Sight } from './sight';
import { kUnmerge } from './stages';
import { arrow, cross, disc, fixed, polygon, square } from './strokes';
import type { Contact, Impulse } from './trace';

/** Criteria whose value grows towards a limit. */
const kLimits = ['motion', 'relative-motion', 'sliding', 'breathing'];

export function contactMarks(sight: Sight): Paths {
  const { state, view } = sight;
  const { mark } = sight.scales;
  const marks = { idle: '', merged: '', active: '', broken: '', cut: '', fresh: '' };
  if (state.layers.has('contacts')) {
    for (const c of sight.contacts) {
      const [x, y] = view.at([c.x, c.y]);
      if (c.internal) marks.merged += square(x, y, 0.85 * mark);
      else if (c.lambdaN > 0) marks.active += disc(x, y, mark);
      else if (carried(sight, c)) marks.broken += cross(x, y, mark);
      else marks.idle += disc(x, y, 0.4 * mark);
      if (c.fresh && state.stage <= 1) marks.fresh += disc(x, y, 9);
    }
  }
  for (const [x, y] of partedAt(sight)) marks.cut += cross(...view.at([x, y]), 2 * mark);
  return marks;
}

/** An unmerge is marked for so many steps, or until something else happens. */
const kMarked = 20;

/** The contacts of the pairs that came apart last. */
function partedAt({ state, trace, posed }: Sight): Vec[] {
  const last = state.step - (state.stage >= kUnmerge ? 0 : 1);
  for (let step = last; step > Math.max(0, last - kMarked); --step) {
    const rows = trace.eventsAt.get(step);
    if (!rows) continue;
    return rows.filter(([, type]) => type === 'unmerge').flatMap(([, , a, b]) =>
      trace.tracksOf(Math.min(a, b), Math.max(a, b)).flatMap((track): Vec[] => {
        const c = trace.contact(track, step, posed);
        return c ? [[c.x, c.y]] : [];
      }));
  }
  return [];
}

/** Whether a contact that carries nothing now did so one step before: it has just broken. */
function carried(sight: Sight, contact: Contact): boolean {
  const before = sight.trace.contact(contact.track, sight.state.step - 1);
  return before !== null && before.lambdaN > 0;
}

/** Impulses as forces; stages that are about impulses show those before them too, broad and pale. */
export function forces(sight: Sight): Paths {
  const paths = { earlier: '', force: '', friction: '', inner: '', cone: '' };
  const { state, stage } = sight;
  const changing = aboutImpulses(state);
  if (!state.layers.has('forces') && !changing) return paths;
  const scale = sight.scales.force / sight.trace.lengthOf(state.step);
  const withCone = stage === 'SolveLCP' || stage === 'Unmerge' || stage === 'SingleIterationPGS';
  for (const c of sight.contacts) {
    const [x, y] = sight.view.at([c.x, c.y]);
    const [tx, ty] = [-c.ny, c.nx];
    const along = ([n, t]: Impulse): Vec => [scale * (n * c.nx + t * tx), -scale * (n * c.ny + t * ty)];
    const change = changing ? changeOf(state, c) : null;
    if (change && stage !== 'WarmStart') paths.earlier += arrow(x, y, ...along(change.before));
    if (c.lambdaN <= 0) continue;
    paths[c.internal ? 'inner' : 'force'] += arrow(x, y, ...along([c.lambdaN, c.lambdaT]));
    if (c.state === 'sliding') paths.friction += arrow(x, y, scale * c.lambdaT * tx, -scale * c.lambdaT * ty);
    if (withCone && hasCone(sight, c)) {
      const n = scale * c.lambdaN;
      const point = (side: number): Vec => [x + n * (c.nx + side * c.mu * tx), y - n * (c.ny + side * c.mu * ty)];
      paths.cone += polygon([[x, y], point(1), point(-1)]);
    }
  }
  return paths;
}

/** Cones of the selected pair; without one of all contacts, where these are few. */
function hasCone(sight: Sight, c: Contact): boolean {
  const picked = sight.state.selection;
  return picked?.kind === 'pair' ? c.a === picked.a && c.b === picked.b : sight.contacts.length <= 12;
}

export function graph(sight: Sight): Paths {
  const paths = { graph: '', welds: '' };
  if (!sight.state.layers.has('graph')) return paths;
  const { trace, view } = sight;
  const seen = new Set<string>();
  for (const c of sight.contacts) {
    const key = `${c.a}-${c.b}`;
    if (seen.has(key)) continue;
    seen.add(key);
    for (const body of [c.a, c.b]) {
      // To the centre of a body that moves; a fixed one is met at the contact.
      if (trace.head.bodies[body].motion !== 'dynamic') continue;
      const pose = trace.pose(body, sight.posed);
      paths[c.internal ? 'welds' : 'graph'] +=
        `M${fixed(view.x(c.x))} ${fixed(view.y(c.y))}L${fixed(view.x(pose.x))} ${fixed(view.y(pose.y))}`;
    }
  }
  return paths;
}

export function heat(sight: Sight): Paths {
  const paths: Paths = { 'heat-calm': '', 'heat-warm': '', 'heat-near': '', 'heat-over': '' };
  const { state, trace } = sight;
  if (!state.layers.has('heat') || !trace.head.full) return paths;
  const ratios = new Map<string, number>();
  for (const d of trace.decisionsAt(state.step)) {
    if (!(d.threshold > 0) || !kLimits.includes(d.criterion.criterion)) continue;
    const key = `${d.a}-${d.b}`;
    ratios.set(key, Math.max(ratios.get(key) ?? 0, Math.abs(d.value) / d.threshold));
  }
  for (const c of sight.contacts) {
    const ratio = ratios.get(`${c.a}-${c.b}`);
    if (ratio !== undefined) paths[heatClass(ratio)] += disc(...sight.view.at([c.x, c.y]), 7);
  }
  return paths;
}

/** Colour class of a contact that is `ratio` times its limit. */
function heatClass(ratio: number): string {
  if (ratio >= 1) return 'heat-over';
  if (ratio >= 0.5) return 'heat-near';
  if (ratio >= 0.1) return 'heat-warm';
  return 'heat-calm';
}

/** The contacts of the selected pair. */
export function focus(sight: Sight): Paths {
  const { selection } = sight.state;
  if (selection?.kind !== 'pair') return { focus: '' };
  const picked = sight.contacts.filter((c) => c.a === selection.a && c.b === selection.b);
  return { focus: picked.map((c) => disc(...sight.view.at([c.x, c.y]), 9)).join('') };
}
