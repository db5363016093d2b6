// Why two bodies are one, or not: one sentence, a gauge, and the change that would alter it. The engine says it.
import { h, number, plural, svg } from './dom';
import type { Reason } from './engine';
import { criterionName } from './inspector';
import { besideLimit } from './limits';
import { eventsShown, eventText } from './now';
import { reasonIn } from './reasons';
import { kStages } from './stages';
import type { State } from './state';

type Test = Reason['tests'][number];

const kParting = ['unmerge', 'cut', 'apart'];

/** The test that decides: the one that failed most, else the nearest to its limit. */
function decisive(reason: Reason): Test | null {
  let best: Test | null = null;
  const ratio = (test: Test) => Math.abs(test.value) / test.threshold;
  const measured = reason.tests.filter((test) => test.threshold > 0 && test.unit !== '');
  const failed = measured.filter((test) => kParting.includes(test.verdict));
  for (const test of failed.length > 0 ? failed : measured) {
    if (!best || ratio(test) > ratio(best)) best = test;
  }
  return best;
}

const kWidth = 240;

/** The value against its limit, over decades: below it on the left of the tick, above it on the right. */
export function gauge(test: Test, second: { label: string; value: number } | null = null): HTMLElement {
  const value = Math.abs(test.value);
  const over = value >= test.threshold;
  // Friction that holds as much as it can is neither below its limit nor above it.
  const look = Math.abs(value / test.threshold - 1) < 1e-3 ? 'at' : over ? 'over' : 'under';
  const at = (x: number) => kWidth * Math.min(1, Math.max(0.02, 0.6 + 0.2 * Math.log10(Math.max(1e-12, x) / test.threshold)));
  const end = Math.min(kWidth - 6, at(value));
  const limit = at(test.threshold);
  const words = `${number(value, 3)} ${test.unit}`;
  const beside = second ? at(second.value) : 0;
  const told = second ? `${second.label} ${number(second.value)}` : '';
  return h('figure', { class: `gauge ${look}` },
    svg('svg', { viewBox: `0 0 ${kWidth} 62`, role: 'img', 'aria-label': `${words}, limit ${number(test.threshold)} ${test.unit}${told && `, ${told} ${test.unit}`}` },
      svg('path', { class: 'beyond', d: `M${limit} 24H${kWidth}v10H${limit}z` }),
      svg('path', { class: 'rest', d: `M0 24H${limit}v10H0z` }),
      svg('path', { class: 'bar', d: `M0 24H${end.toFixed(1)}v10H0z` }),
      svg('path', { class: 'pointer', d: `M${end.toFixed(1)} 23l-5 -7h10z` }),
      svg('path', { class: 'tick', d: `M${limit} 20V38` }),
      svg('text', { x: Math.min(kWidth - 42, Math.max(42, end)).toFixed(1), y: 11, class: 'value' }, words),
      svg('text', { x: limit, y: 52 }, `limit ${number(test.threshold)}`),
      second && svg('path', { class: 'second-tick', d: `M${beside.toFixed(1)} 21V37` }),
      second && svg('text', { class: 'second', x: Math.min(kWidth - 34, Math.max(34, beside + (beside < limit ? -38 : 38))).toFixed(1), y: 52 }, told)),
    test.needed > 1 ? steps(test) : null);
}

/** A count is drawn as dots. */
function steps(test: Test): HTMLElement {
  const n = Math.min(test.needed, 8);
  return h('figcaption', {}, ...Array.from({ length: n }, (_, i) => h('span', { class: i < test.count ? 'dot full' : 'dot', 'aria-hidden': true })),
    ` ${Math.min(test.count, test.needed)} of ${test.needed} steps`);
}

function tests(reason: Reason): HTMLElement {
  const relation = (test: Test) => (test.threshold > 0 ? `${number(test.value)} of ${number(test.threshold)} ${test.unit}` : number(test.value));
  return h('table', { class: 'tests' }, h('thead', {}, h('tr', {}, ...['Test', 'Equation', 'Value of limit', 'Verdict'].map((text) => h('th', { scope: 'col' }, text)))),
    h('tbody', {}, ...reason.tests.map((test) => h('tr', {}, h('th', { scope: 'row', title: test.text }, criterionName(test.criterion)),
      h('td', {}, test.equation), h('td', {}, relation(test)), h('td', {}, test.verdict)))));
}

const kWords: Record<string, RegExp> = { 'relative-motion': /relative motion|moved|against/, sliding: /slip/, breathing: /overlap/, load: /impulse between/, motion: /relative motion/ };

/** Of several reasons the one that the gauge shows, with the number of the others; the table has them all. */
function shortened(text: string, test: Test | null): string {
  const clauses = text.replace(/\.$/, '').split(/; (?![^(]*\))/);
  const found = /^(.*?: )(.*)$/.exec(clauses[0]);
  if (clauses.length < 2 || !found) return text;
  clauses[0] = found[2];
  const word = test && kWords[test.criterion];
  const chosen = (word && clauses.find((clause) => word.test(clause) && clause.includes(number(test.threshold)))) || clauses[0];
  return `${found[1]}${chosen}. And ${plural(clauses.length - 1, 'more reason')}.`;
}

/** The heading names the pair: the sentence need not do it again. */
function pronouns(text: string, names: string): string {
  const at = text.indexOf(names);
  if (text.includes(`The weld of ${names}`)) return text.replace(`The weld of ${names}`, 'Their weld');
  return at < 0 ? text : text.replace(names, at === 0 ? 'They' : 'them');
}

/** "0.072 m/s" stands out. */
function sentence(text: string): Node[] {
  return text.split(/(\d[\d.,]* (?:m\/s|mm\/s|mm|m|N s|steps?)\b)/).map((part, i) => (i % 2 ? h('strong', {}, part) : document.createTextNode(part)));
}

export function whyCard(state: State, equation: HTMLElement): HTMLElement {
  const title = h('h2', { id: 'why' });
  const text = h('div', { class: 'why-text' });
  const holder = h('div', { class: 'why-gauge' });
  const all = h('details', { class: 'all-tests' });
  const root = h('section', { class: 'why panel', 'aria-labelledby': 'why', tabindex: 0 },
    h('div', { class: 'why-body' }, h('div', { class: 'why-words' }, title, text, all), holder), equation);
  let waiting = 0;

  const empty = (heading: string, words: string) => {
    title.textContent = heading;
    text.replaceChildren(h('p', { class: 'hint' }, words));
    holder.replaceChildren();
    all.hidden = true;
  };
  const show = (reason: Reason, names: string) => {
    title.replaceChildren(state.trace.told(reason.heading), h('span', { class: 'names' }, h('span', {}, names), ', ', h('span', {}, `step ${state.step}`)));
    const test = decisive(reason);
    const other = reasonIn(state.language, reason, test);
    const told = other?.text ?? pronouns(shortened(state.trace.told(reason.text), test), names).replace(` at step ${state.step}`, '').replace(/;? ?docs\/[^\s)]+/g, '').replace(' ()', '');
    const outlook = other?.outlook ?? state.trace.told(reason.outlook);
    text.replaceChildren(h('p', {}, ...sentence(told)), ...(outlook ? [h('p', { class: 'outlook' }, ...sentence(outlook))] : []));
    holder.replaceChildren(...(test ? [gauge(test, besideLimit(test.stage, test.criterion, test.threshold, (key) => state.setting(key)))] : []));
    text.append(...nextBroken());
    all.hidden = reason.tests.length === 0;
    all.replaceChildren(h('summary', {}, `All ${reason.tests.length} tests of this pair`), tests(reason));
  };
  /** To the next of the pairs that came apart in this step. */
  const nextBroken = (): HTMLElement[] => {
    const s = state.selection;
    const broken = (state.trace.eventsAt.get(state.step) ?? []).filter(([, type]) => type === 'unmerge').map(([, , a, b]) => [Math.min(a, b), Math.max(a, b)]);
    const at = broken.findIndex(([a, b]) => s?.kind === 'pair' && s.a === a && s.b === b);
    if (at < 0 || broken.length < 2) return [];
    const [a, b] = broken[(at + 1) % broken.length];
    return [h('button', {
      type: 'button', class: 'link', onclick: () => {
        state.selection = { kind: 'pair', a, b };
        state.changed();
      },
    }, `Next pair (${broken.length} came apart)`)];
  };
  const ask = (a: number, b: number) => {
    const { probe, step, trace } = state;
    if (!probe) return empty('Why?', 'This page has no engine in it; the numbers of the pair are below.');
    const still = () => state.step === step && state.trace === trace && state.selection?.kind === 'pair' && !state.playing;
    const go = () => {
      if (!still()) return;
      try {
        if (probe.approach(step)) show(probe.why(step, a, b), `${trace.name(a)} and ${trace.name(b)}`);
        else waiting = window.setTimeout(go, 0);
      } catch (error) {
        empty('Why?', String(error instanceof Error ? error.message : error));
      }
    };
    waiting = window.setTimeout(go, state.live ? 0 : 60);
  };

  const look = () => {
    window.clearTimeout(waiting);
    const s = state.selection;
    const stage = kStages[state.stage];
    if (state.veiled) return empty('Why?', 'The reasons are hidden until you have answered. Then choose any pair to see its value against the limit.');
    if (s?.kind === 'pair' && state.step > 0) {
      if (state.playing) return;
      return ask(s.a, s.b);
    }
    if (s?.kind === 'body') return empty(state.trace.name(s.body), 'Choose a second body to read why the two are merged, or not.');
    if (state.step > 0 && state.stage !== kStages.length - 1) return empty(`${state.stage + 1} · ${stage.label}`, stage.what);
    empty('Why?', 'Choose two bodies that touch, or the contact between them: here stands why they are merged, or not.');
    const rows = eventsShown(state).filter((row) => row[2] !== row[3]).slice(0, 3);
    text.append(...rows.map((row) => h('button', {
      type: 'button', class: 'link', onclick: () => {
        state.selection = { kind: 'pair', a: Math.min(row[2], row[3]), b: Math.max(row[2], row[3]) };
        state.changed();
      },
    }, eventText(state.trace, row))));
  };
  state.onChange(look);
  state.onEngine(look);
  return root;
}
