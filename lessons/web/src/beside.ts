// Another run beside the picture, at the same step and stage: the reference, or the paper's rule.
import { h, plural } from './dom';
import { Picture } from './picture';
import { State } from './state';
import type { Trace } from './trace';

function nameOf(state: State): string {
  return state.live && state.besideKind === 'paper' ? 'The paper’s rule' : 'Reference, nothing merged';
}

/** The largest distance of a body between the two runs [m]. */
function offset(one: Trace, other: Trace, step: number): number {
  let most = 0;
  for (let body = 0; body < Math.min(one.bodies.length, other.bodies.length); ++body) {
    if (!one.present(body, step) || !other.present(body, step)) continue;
    const [p, q] = [one.pose(body, step), other.pose(body, step)];
    most = Math.max(most, Math.hypot(p.x - q.x, p.y - q.y));
  }
  return most;
}

export function beside(state: State, own: Picture, frame: HTMLElement): HTMLElement {
  const root = h('div', { class: 'frames' }, frame);
  const shown = new State(state.traces);
  let other: { of: Trace; picture: Picture; frame: HTMLElement; label: HTMLElement } | null = null; // only while it is seen
  state.onChange(() => {
    const reference = state.layers.has('beside') ? state.reference : undefined;
    const wanted = reference !== undefined && state.trace !== reference;
    root.classList.toggle('two', wanted);
    if (!wanted || other?.of !== reference) {
      other?.frame.remove();
      other = null;
    }
    if (!wanted) return;
    if (!other) {
      const picture = new Picture(reference, false);
      const label = h('div', { class: 'frame-head' });
      other = { of: reference, picture, label, frame: h('div', { class: 'frame second' }, picture.root, label) };
      root.append(other.frame);
    }
    Object.assign(shown, { stage: state.stage, playing: state.playing, selection: state.selection, trace: reference });
    shown.step = Math.min(state.step, shown.steps);
    shown.layers.clear();
    for (const layer of state.layers) shown.layers.add(layer);
    other.picture.lens.follow(own.lens);
    other.picture.draw(shown);
    const s = reference.stats(shown.step);
    other.label.replaceChildren(h('strong', {}, nameOf(state)), h('span', {}, `${plural(s.active, 'simulated body', 'simulated bodies')}, ${plural(s.contacts, 'contact')} to solve`),
      h('span', {}, `largest offset ${(1000 * offset(state.trace, reference, shown.step)).toFixed(0)} mm`));
  });
  return root;
}
