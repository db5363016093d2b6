// The reference beside the picture, at the same step and stage.
import { h } from './dom';
import { Picture } from './picture';
import { State } from './state';

export function beside(state: State, frame: HTMLElement): HTMLElement {
  const root = h('div', { class: 'frames' }, frame);
  const { reference } = state;
  if (!reference) return root;
  const shown = new State(state.traces);
  shown.trace = reference;
  let other: { picture: Picture; frame: HTMLElement } | null = null; // only while it is seen
  state.onChange(() => {
    const wanted = state.layers.has('beside') && state.trace !== reference;
    root.classList.toggle('two', wanted);
    if (!wanted) {
      other?.frame.remove();
      other = null;
      return;
    }
    if (!other) {
      const picture = new Picture(reference, false);
      other = { picture, frame: h('div', { class: 'frame' }, picture.root, h('div', { class: 'badge' }, 'Reference: nothing merged')) };
      root.append(other.frame);
    }
    Object.assign(shown, { stage: state.stage, playing: state.playing, selection: state.selection });
    shown.step = Math.min(state.step, shown.steps);
    shown.layers.clear();
    for (const layer of state.layers) shown.layers.add(layer);
    other.picture.draw(shown);
  });
  return root;
}
