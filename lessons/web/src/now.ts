// The events of this stage of this step, in words: for the eye and for the screen reader.
import { h, plural } from './dom';
import type { EventRow } from './head';
import { impulsesText } from './impulses';
import { kLast, kStages, stageAt } from './stages';
import type { State } from './state';
import type { Trace } from './trace';

const kReasons: Record<string, string> = {
  broken: 'its contact broke', sliding: 'it slides', 'relative-motion': 'it moves', user: 'it was pulled',
};

/** "brick[1,2] and brick[2,2] merged" */
export function eventText(trace: Trace, row: EventRow): string {
  const [, type, a, b, collection, reason] = row;
  const pair = a === b ? trace.name(a) : `${trace.name(a)} and ${trace.name(b)}`;
  switch (type) {
    case 'merge': return `${pair} merged into C${collection}`;
    case 'unmerge': return `${pair} came apart${kReasons[reason] ? `: ${kReasons[reason]}` : ''}`;
    case 'impact': return `${pair} hit each other`;
    case 'sleep': return `${pair} fell asleep`;
    case 'wake': return `${pair} woke up`;
    case 'break': return `the joint of ${pair} broke`;
    case 'emit': return `${trace.name(a)} appeared`;
    default: return `${type}: ${pair}`;
  }
}

const kStageOfEvent: Record<string, string> = {
  merge: 'Merge', unmerge: 'Unmerge', impact: 'ContactOrdering', sleep: 'SleepAndWake', wake: 'SleepAndWake',
};

/** The events of the moment that is shown. */
export function eventsShown(state: State): EventRow[] {
  const rows = state.trace.eventsAt.get(state.step) ?? [];
  return rows.filter((row) => {
    const at = stageAt(kStageOfEvent[row[1]]);
    return state.stage === kLast || at === state.stage;
  });
}

/** Those of the selected body come first. */
function chosenFirst(state: State, rows: EventRow[]): EventRow[] {
  const s = state.selection;
  if (s?.kind !== 'body') return rows;
  const concerns = (row: EventRow) => Number(row[2] === s.body || row[3] === s.body);
  return [...rows].sort((p, q) => concerns(q) - concerns(p));
}

/** One paragraph that says what can be seen. */
export function describe(state: State): string {
  const s = state.trace.stats(state.step);
  const head = state.step === 0 ? 'The beginning.'
    : `Step ${state.step} of ${state.steps}, ${state.time.toFixed(2)} seconds, stage ${state.stage + 1} of 11: ${kStages[state.stage].label}.`;
  const events = eventsShown(state);
  const told = events.slice(0, 3).map((row) => `${eventText(state.trace, row)}.`).join(' ');
  const more = events.length > 3 ? ` And ${plural(events.length - 3, 'more event')}.` : '';
  const inside = impulsesText(state);
  return `${head} ${plural(s.active, 'body is simulated', 'bodies are simulated')}, ${plural(s.collections, 'collection')}, ${plural(s.contacts, 'contact')} solved, ${s.internal} inside collections, ${s.asleep} asleep. ${told}${more}${inside && ` ${inside}`}`;
}

/** Where the numbers of contacts are those of an earlier step, which one: of a long run not every step is kept whole. */
function keptAt(state: State): string {
  const { keyframes: every } = state.trace.head;
  if (every === undefined || state.step % every === 0) return '';
  return `Contacts and numbers are those of step ${state.step - (state.step % every)}: of this long run every step whose number is a multiple of ${every} is kept whole.`;
}

export function nowCard(state: State): HTMLElement {
  const title = h('h2', {});
  const what = h('p', { class: 'what' });
  const section = h('span', { class: 'section' });
  const facts = h('div', { class: 'facts' });
  const kept = h('p', { class: 'hint' });
  const events = h('ul', { class: 'events' });
  const live = h('div', { class: 'visually-hidden', 'aria-live': 'polite', role: 'status' });
  const fact = (value: number, label: string) => h('div', { class: 'fact' }, h('strong', {}, String(value)), h('span', {}, label));
  let spoken = 0;
  state.onChange(() => {
    const stage = kStages[state.stage];
    title.replaceChildren(state.step === 0 ? 'The beginning' : `${state.stage + 1} · ${stage.label} `, section);
    section.textContent = state.step === 0 ? '' : stage.section;
    what.textContent = state.step === 0 ? 'Nothing has moved yet. Press Space to play, → to take one time step, ↓ to go through its eleven stages.' : stage.what;
    const s = state.trace.stats(state.step);
    facts.replaceChildren(fact(s.active, s.active === 1 ? 'body simulated' : 'bodies simulated'), fact(s.collections, s.collections === 1 ? 'collection' : 'collections'),
      fact(s.contacts, 'contacts solved'), fact(s.internal, 'inside'), fact(s.asleep, 'asleep'));
    kept.textContent = keptAt(state);
    kept.hidden = kept.textContent === '';
    const rows = chosenFirst(state, eventsShown(state));
    events.replaceChildren(...rows.slice(0, 6).map((row) => h('li', { class: row[1] },
      h('button', {
        type: 'button', class: 'link',
        onclick: () => {
          const [, , a, b] = row;
          state.selection = a === b ? { kind: 'body', body: a } : { kind: 'pair', a: Math.min(a, b), b: Math.max(a, b) };
          state.changed();
        },
      }, eventText(state.trace, row)))), ...(rows.length > 6 ? [h('li', {}, `and ${rows.length - 6} more`)] : []));
    window.clearTimeout(spoken);
    if (!state.playing) spoken = window.setTimeout(() => { live.textContent = describe(state); }, 250);
  });
  return h('section', { class: 'card now', 'aria-label': 'This step' }, title, what, facts, kept, events, live);
}
