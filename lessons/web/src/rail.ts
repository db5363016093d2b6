// The eleven stages of the step, each with its result in this one.
import { h, number } from './dom';
import { kStages } from './stages';
import type { State } from './state';

/** No "7.2e-24": what is that small is rounding. */
function tidied(text: string): string {
  return text.replace(/\d+(?:\.\d+)?e-(\d+)/g, (value, exponent) => (Number(exponent) >= 9 ? '0' : number(Number(value), 2)));
}

const kIdle = /^(nothing|none ready)/;

export function ribbon(state: State): HTMLElement {
  const title = h('h2', {});
  const note = h('p', { class: 'hint' });
  const results = kStages.map(() => h('span', { class: 'result' }));
  const buttons = kStages.map((stage, i) =>
    h('button', { type: 'button', class: 'stage', title: stage.what, onclick: () => state.goTo(Math.max(1, state.step), i) },
      h('span', { class: 'number' }, String(i + 1)), h('span', { class: 'name' }, stage.label), results[i]));
  roving(buttons);
  const now = h('span', { class: 'stage-now' });
  let waiting = 0;

  const show = (texts: string[]) => {
    for (const [i, result] of results.entries()) {
      result.textContent = tidied(texts[i] ?? '');
      buttons[i].classList.toggle('idle', texts[i] !== undefined && kIdle.test(texts[i]));
    }
    now.textContent = `${state.stage + 1} ${kStages[state.stage].label}${texts[state.stage] ? `: ${tidied(texts[state.stage])}` : ''}`;
  };
  /** Looks into the step, a little at a time, as soon as nothing moves. */
  const look = () => {
    window.clearTimeout(waiting);
    show([]);
    const { probe } = state;
    if (state.step === 0 || state.playing || !probe || state.veiled) return;
    const { step, trace } = state;
    const go = () => {
      if (state.step !== step || state.trace !== trace || state.playing || state.veiled) return;
      try {
        if (probe.approach(step)) show(probe.resultsOf(step));
        else waiting = window.setTimeout(go, 0);
      } catch {
        show([]);
      }
    };
    if (state.live) go();
    else waiting = window.setTimeout(go, 60);
  };

  state.onChange(() => {
    title.textContent = state.step === 0 ? 'Before the first step' : `Stages of step ${state.step}`;
    note.textContent = state.live ? 'your run' : '↑ ↓ to walk through';
    for (const [i, button] of buttons.entries()) {
      const current = state.step > 0 && i === state.stage;
      if (current) button.setAttribute('aria-current', 'step');
      else button.removeAttribute('aria-current');
      button.tabIndex = i === state.stage ? 0 : -1;
      button.classList.toggle('done', state.step > 0 && i < state.stage);
    }
    look();
  });
  state.onEngine(look);
  const move = (label: string, sign: string, by: number) => h('button', {
    type: 'button', class: 'icon stage-move', 'aria-label': label, onclick: () => {
      state.playing = false;
      state.moveStage(by);
    },
  }, sign);
  return h('nav', { class: 'ribbon panel', 'aria-label': 'Stages of this time step' },
    h('div', { class: 'ribbon-head' }, title, note),
    h('div', { class: 'ribbon-now' }, move('Stage before', '◀', -1), now, move('Next stage', '▶', 1)),
    h('div', { class: 'stages' }, ...buttons));
}

/** One tab stop, arrow keys inside. */
export function roving(buttons: HTMLElement[]): void {
  for (const [i, button] of buttons.entries()) {
    button.addEventListener('keydown', (event) => {
      const by = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
      if (by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      const to = buttons[(i + by + buttons.length) % buttons.length];
      to.click();
      to.focus();
    });
  }
}
