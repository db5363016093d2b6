// The keyboard, and the page that tells of it.
import { h } from './dom';
import type { Transport } from './controls';
import { toggleLayer } from './controls';
import { kLayers, type State } from './state';

const kKeys: [string, string][] = [
  ['Space', 'play and pause'],
  ['← →', 'one time step back, forward'],
  ['↑ ↓', 'one stage back, forward'],
  ['M', 'to the next merge or unmerge'],
  ['[ ]', 'to the previous, next event'],
  ['Home End', 'to the start, to the end'],
  ['R', 'the reference beside it'],
  ['T', 'take over; again: show the prepared run'],
  ['Z', 'undo what you did last'],
  ['W', 'why'],
  ['Q', 'to the question'],
  ['D', 'more numbers'],
  ['F', 'fit the picture; + − with Shift zoom'],
  ['+ −', 'faster, slower'],
  ['1 … 9', 'layers of the picture'],
  ['N P', 'next, previous part of the lesson'],
  ['Tab', 'to the picture; there arrows go from body to body, Enter chooses'],
  ['Esc', 'select nothing'],
  ['?', 'this help'],
];

export function helpDialog(): HTMLDialogElement {
  const dialog = h('dialog', { class: 'help', 'aria-labelledby': 'help-title' });
  dialog.append(h('h2', { id: 'help-title' }, 'Keys'),
    h('dl', {}, ...kKeys.flatMap(([key, what]) => [h('dt', {}, ...key.split(' ').map((k) => h('kbd', {}, k))), h('dd', {}, what)])),
    h('button', { type: 'button', onclick: () => dialog.close() }, 'Close'));
  return dialog;
}

export interface KeyActions {
  help: () => void;
  part: (by: number) => void;
  takeOver: () => void;
  why: () => void;
  question: () => void;
  fit: () => void;
  more: () => void;
}

export function listenToKeys(state: State, transport: Transport, actions: KeyActions): void {
  const onKey = (event: KeyboardEvent) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (target.closest('dialog, textarea, select, input:not([type=range], [type=radio], [type=checkbox])')) return;
    // A slider has its own arrows, a choice too.
    if (target.closest('input, [role=tablist]') && /^(Arrow|Home|End|Page| )/.test(event.key)) return;
    if (target.closest('summary') && (event.key === ' ' || event.key === 'Enter')) return;
    // Buttons keep Space and Enter.
    if (target.closest('button, a') && (event.key === ' ' || event.key === 'Enter')) return;
    const action = actionOf(event.key);
    if (!action) return;
    event.preventDefault();
    action();
  };
  const still = (action: () => void) => () => {
    state.playing = false;
    action();
  };
  const actionOf = (key: string): (() => void) | undefined => {
    switch (key) {
      case ' ': return transport.toggle;
      case 'ArrowLeft': return still(() => state.goTo(state.step - 1, state.stage));
      case 'ArrowRight': return still(() => state.goTo(state.step + 1, state.stage));
      case 'ArrowUp': return still(() => state.moveStage(-1));
      case 'ArrowDown': return still(() => state.moveStage(1));
      case 'm': case 'M': return still(() => state.nextEvent(['merge', 'unmerge'], 1));
      case '[': return still(() => state.nextEvent(undefined, -1));
      case ']': return still(() => state.nextEvent(undefined, 1));
      case 'Home': return still(() => state.goTo(state.first));
      case 'End': return still(() => state.goTo(state.steps));
      case 'r': case 'R': return () => toggleLayer(state, kLayers.findIndex((layer) => layer.id === 'beside') + 1);
      case 't': case 'T': return actions.takeOver;
      case 'z': case 'Z': return () => state.undo();
      case 'w': case 'W': return actions.why;
      case 'q': case 'Q': return actions.question;
      case 'f': case 'F': return actions.fit;
      case 'd': case 'D': return actions.more;
      case '+': case '=': return () => transport.faster(1);
      case '-': return () => transport.faster(-1);
      case 'n': case 'N': return () => actions.part(1);
      case 'p': case 'P': return () => actions.part(-1);
      case 'Escape': return () => {
        state.selection = null;
        state.changed();
      };
      case '?': return actions.help;
      default: return /^[1-9]$/.test(key) ? () => toggleLayer(state, Number(key)) : undefined;
    }
  };
  document.addEventListener('keydown', onKey);
}
