// Momentum and energy before and after bodies merge and part.
import { h, number } from './dom';
import { kStages } from './stages';
import type { State } from './state';

const kShown = 7;

export function ledger(state: State): HTMLElement {
  const body = h('tbody');
  const note = h('p', { class: 'hint' });
  const table = h('table', {},
    h('thead', {}, h('tr', {}, ...['Step', 'What', 'Momentum x', 'Momentum y', 'Angular', 'Energy'].map((t) => h('th', { scope: 'col' }, t)))), body);
  let drawn = '';
  state.onChange(() => {
    const rows = state.trace.head.ledger ?? [];
    const after = rows.findIndex((row) => row[0] > state.step);
    const last = after < 0 ? rows.length : after;
    const key = `${state.trace.label}-${last}`;
    if (key === drawn) return;
    drawn = key;
    note.textContent = rows.length === 0 ? 'Nothing merges or unmerges in this run.'
      : 'Sums over all bodies, just before and after the stage, in N s, N m s and J. Merging keeps momentum and may lose a trace of energy; what is welded to a fixed body gives its momentum to it (⚓).';
    body.replaceChildren(...rows.slice(Math.max(0, last - kShown), last).reverse().map((row) => {
      const [step, stage, anchored, ...sums] = row;
      const cell = (at: number, kept: boolean) => {
        const [was, is] = [sums[2 * at], sums[2 * at + 1]];
        const scale = Math.max(1e-6, 1e-4 * Math.abs(was), 1e-4 * Math.sqrt(Math.abs(sums[6])));
        const wrong = kept && !anchored && Math.abs(is - was) > scale;
        return h('td', { class: wrong ? 'wrong' : '' }, number(is), h('small', {}, `${is >= was ? '+' : '−'}${number(Math.abs(is - was), 2)}`));
      };
      return h('tr', {},
        h('td', {}, h('button', { type: 'button', class: 'link', onclick: () => state.goTo(step, stage) }, String(step))),
        h('td', {}, kStages[stage].label, anchored ? ' ⚓' : ''), cell(0, true), cell(1, true), cell(2, true), cell(3, false));
    }));
  });
  return h('section', { class: 'card', 'aria-label': 'Ledger of momentum and energy' }, h('h2', {}, 'Ledger'),
    h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Momentum and energy at each merge and split' }, table), note);
}
