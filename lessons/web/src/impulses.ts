// The impulses before and after the stage, as numbers.
import { h, number, plural } from './dom';
import { aboutImpulses, type Change, changed, changesAt } from './inside';
import { kStages } from './stages';
import type { State } from './state';

const kShown = 8;

interface Words {
  title: string;
  done: (changes: Change[]) => string;
}

const changes = (all: Change[]) => `${all.filter(changed).length} of ${plural(all.length, 'impulse')}`;

const kWords: Record<string, Words> = {
  WarmStart: {
    title: 'Impulses of the last step',
    done: (all) => `${plural(all.filter((c) => c.after[0] > 0).length, 'contact')} of ${all.length} begin with the impulse of the last step, the others with none.`,
  },
  SingleIterationPGS: {
    title: 'Impulses before and after the sweep',
    done: (all) => `The sweep changed ${changes(all)}.`,
  },
  SolveLCP: {
    title: 'Impulses before and after the full solve',
    done: (all) => `The full solve changed ${changes(all)}; ${all.filter((c) => c.contact.state === 'sliding').length} on the edge of the cone.`,
  },
};

/** What this stage did to the impulses, or why that cannot be said; empty at other stages. */
export function impulsesText(state: State): string {
  if (!aboutImpulses(state)) return '';
  const { id } = kStages[state.stage];
  const sweeping = state.trace.sweeping(state.step);
  const all = changesAt(state);
  if (sweeping === undefined) {
    return state.trace.contactsAt(state.step).length === 0 ? 'Nothing touches in this step.'
      : 'The impulses inside this step are not in the page, which would be too large with all of them: shown are those of the end of the step.';
  }
  if (id === 'SingleIterationPGS' && !sweeping) return 'No load inside is new in this step, so the impulses stay as they were.';
  if (all.length === 0) return id === 'SolveLCP' ? 'All contacts are inside collections: there is nothing to solve.' : 'Nothing touches in this step.';
  return kWords[id].done(all);
}

/** The warm start has no before: it is what comes before the sweep. */
function columns(state: State): { solved: boolean; both: boolean } {
  const { id } = kStages[state.stage];
  return { solved: id === 'SolveLCP', both: id !== 'WarmStart' };
}

function rows(state: State, all: Change[]): HTMLElement[] {
  const { selection, trace } = state;
  const picked = (c: Change) => selection?.kind === 'pair' && c.contact.a === selection.a && c.contact.b === selection.b;
  const shown = [...all.filter(picked), ...all.filter((c) => !picked(c))].slice(0, kShown);
  const { solved, both } = columns(state);
  return shown.map((change) => {
    const { contact, before, after, was } = change;
    const points = trace.tracksOf(contact.a, contact.b).filter((t) => t.spans.at(state.step) >= 0);
    const point = points.length > 1 ? `point ${points.indexOf(contact.track) + 1}` : '';
    const pair = h('button', {
      type: 'button', class: 'link',
      onclick: () => {
        state.selection = { kind: 'pair', a: contact.a, b: contact.b };
        state.changed();
      },
    }, `${trace.name(contact.a)} and ${trace.name(contact.b)}`);
    const condition = !solved ? '' : was === contact.state ? was : `${was} → ${contact.state}`;
    const more = [point, condition].filter((text) => text !== '').join(', ');
    return h('tr', { class: picked(change) ? 'picked' : '' }, h('th', { scope: 'row' }, pair, h('small', {}, more)),
      ...[0, 1].flatMap((i) => [both ? h('td', {}, number(before[i])) : null, h('td', { class: 'after' }, number(after[i]))]));
  });
}

function table(state: State, all: Change[]): HTMLElement {
  const { solved, both } = columns(state);
  const head = (text: string, span = 1) => h('th', { scope: span > 1 ? 'colgroup' : 'col', colspan: span }, text);
  const times = both ? [head('before'), head('after'), head('before'), head('after')] : [];
  return h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Impulses before and after' }, h('table', {},
    h('thead', {},
      h('tr', {}, both ? h('td') : head('Contact'), ...['Normal λₙ [N s]', 'Friction λₜ [N s]'].map((text) => head(text, both ? 2 : 1))),
      both ? h('tr', {}, head(solved ? 'Contact, and its state' : 'Contact'), ...times) : null),
    h('tbody', {}, ...rows(state, all))));
}

export function impulseCard(state: State): HTMLElement {
  const title = h('h2');
  const body = h('div', { class: 'impulses' });
  const root = h('section', { class: 'card', 'aria-label': 'Impulses of this stage' }, title, body);
  state.onChange(() => {
    root.hidden = !aboutImpulses(state);
    if (root.hidden) return;
    const all = changesAt(state);
    const more = all.length > kShown ? h('p', { class: 'hint' }, `The ${kShown} ${columns(state).both ? 'that changed most' : 'largest'}; ${all.length - kShown} more.`) : null;
    const nearest = state.trace.sweeping(state.step) === undefined ? state.trace.nearestInside(state.step) : undefined;
    const go = nearest === undefined ? null : h('button', { type: 'button', class: 'link', onclick: () => state.goTo(nearest, state.stage) }, `To step ${nearest}, the nearest that has them`);
    title.textContent = kWords[kStages[state.stage].id].title;
    body.replaceChildren(...[h('p', {}, impulsesText(state)), go, all.length > 0 ? table(state, all) : null, more].filter((node) => node !== null));
  });
  return root;
}
