// The equation of the active stage, its symbols filled with the numbers of this step.
import { h, number } from './dom';
import { changed, changeOf, changesAt, contactsOfStage, type Change } from './inside';
import { kStages } from './stages';
import type { State } from './state';
import type { Contact, Decision } from './trace';

type Node = MathMLElement | string;

function math(tag: string, ...children: Node[]): MathMLElement {
  const node = document.createElementNS('http://www.w3.org/1998/Math/MathML', tag) as MathMLElement;
  node.append(...children);
  return node;
}
const mi = (text: string) => math('mi', text);
const mn = (value: number) => math('mn', number(value));
const mo = (text: string) => math('mo', text);
const text = (value: string) => math('mtext', value);
const sub = (base: string, index: string) => named(base + index, math('msub', mi(base), math('mrow', mi(index))));
/** The number of a symbol: both light up together. */
const mv = (symbol: string, value: number) => named(symbol, mn(value));

function named(symbol: string, node: MathMLElement): MathMLElement {
  node.dataset.symbol = symbol;
  return node;
}
const row = (...children: Node[]) => math('mrow', ...children);

interface Line {
  symbols: MathMLElement;
  numbers: MathMLElement | null;
  more?: MathMLElement;
  note: string;
}

function block(node: MathMLElement): MathMLElement {
  const root = math('math', node);
  root.setAttribute('display', 'block');
  return root;
}

/** The contact that is meant: of the selection or else of all, the one that the stage changes most, or presses most. */
function contactMeant(state: State): Contact | null {
  const all = contactsOfStage(state);
  const s = state.selection;
  const wanted = s?.kind === 'pair' ? all.filter((c) => c.a === s.a && c.b === s.b)
    : s?.kind === 'body' ? all.filter((c) => c.a === s.body || c.b === s.body) : all;
  const most = changesAt(state, wanted)[0];
  if (most && changed(most)) return most.contact;
  return wanted.reduce<Contact | null>((best, c) => (!best || c.lambdaN > best.lambdaN ? c : best), null);
}

/** What the stage does to the contact, in words; nothing where it does not work on impulses. */
function deed(state: State, change: Change | null): string {
  if (!change) return '';
  switch (kStages[state.stage].id) {
    case 'WarmStart': return change.was === 'new' ? ' It is new and begins with nothing.' : ' It begins with the impulse of the last step.';
    case 'SingleIterationPGS': return changed(change) ? ' The sweeps inside change it.' : ' The sweeps inside leave it as it was.';
    default: return changed(change) ? ' The full solve changes it.' : ' The full solve leaves it as it was.';
  }
}

/** The decision that is meant: of the selection, else the one nearest to its limit. */
function decisionMeant(state: State, criteria: string[], stage: string): Decision | null {
  const s = state.selection;
  let best: Decision | null = null;
  const far = (d: Decision) => Math.abs(Math.log10(Math.max(1e-12, Math.abs(d.value)) / d.threshold));
  for (const d of state.trace.decisionsAt(state.step)) {
    if (d.criterion.stage !== stage || !criteria.includes(d.criterion.criterion) || !(d.threshold > 0)) continue;
    if (s?.kind === 'pair' && (d.a !== s.a || d.b !== s.b)) continue;
    if (s?.kind === 'body' && d.a !== s.body && d.b !== s.body) continue;
    if (!best || far(d) < far(best)) best = d;
  }
  return best;
}

/** Values below a hundredth of gravity's part are rounding of the recorded velocities. */
function rest(value: number, gravity: number): number {
  return Math.abs(value) < 0.01 * Math.abs(gravity) ? 0 : value;
}

function between(state: State, x: { a: number; b: number }): string {
  return `${state.trace.name(x.a)} and ${state.trace.name(x.b)}`;
}

function bodyMeant(state: State): number {
  const s = state.selection;
  if (s?.kind === 'body') return s.body;
  const dynamic = (i: number) => state.trace.head.bodies[i].motion === 'dynamic' && state.trace.present(i, state.step) && state.trace.present(i, state.step - 1);
  if (s?.kind === 'pair') return dynamic(s.b) ? s.b : s.a;
  return state.trace.head.bodies.findIndex((_, i) => dynamic(i));
}

/** Whether a collection is welded to a body that forces do not move. */
function heldFast(state: State, collection: number): boolean {
  const { trace, step } = state;
  const fixed = (body: number) => trace.head.bodies[body].motion !== 'dynamic';
  return trace.contactsAt(step).some((c) => c.internal && ((fixed(c.a) && trace.collection(c.b, step) === collection) || (fixed(c.b) && trace.collection(c.a, step) === collection)));
}

/** The source of a test: an equation or a section of the paper, or the page of a criterion of our own. */
function source(d: { criterion: { equation: string } }): string {
  const { equation } = d.criterion;
  return equation === '(17)' ? 'Eqs. (15)–(17)' : equation.startsWith('(') ? `Eq. ${equation}` : equation;
}

function line(state: State): Line | null {
  const { trace, step } = state;
  const hh = trace.lengthOf(step);
  switch (kStages[state.stage].id) {
    case 'ContactDetection': case 'WarmStart': case 'SingleIterationPGS': case 'SolveLCP': {
      const c = contactMeant(state);
      const symbols = row(mn(0), mo('≤'), sub('w', 'n'), mo('⊥'), sub('λ', 'n'), mo('≥'), mn(0), mo(','), mo('|'), sub('λ', 't'), mo('|'), mo('≤'), named('μ', mi('μ')), sub('λ', 'n'));
      if (!c) return { symbols, numbers: null, note: 'Eqs. (4)–(7). Nothing touches now.' };
      // The velocity is known at the end of the step; before and after a stage the impulse alone.
      const change = changeOf(state, c);
      return {
        symbols,
        numbers: change
          ? row(sub('λ', 'n'), mo(':'), mv('λn', change.before[0]), mo('→'), mv('λn', change.after[0]), text('\u2009N\u2009s'),
            ...(kStages[state.stage].id === 'SolveLCP' ? [text(',\u2002'), sub('w', 'n'), mo('='), mv('wn', c.wN), text('\u2009m/s')] : []))
          : row(sub('w', 'n'), mo('='), mv('wn', c.wN), text('\u2009m/s,\u2002'), sub('λ', 'n'), mo('='), mv('λn', c.lambdaN), text('\u2009N\u2009s')),
        more: row(mo('|'), mv('λt', c.lambdaT), mo('|'), mo(Math.abs(c.lambdaT) >= 0.98 * c.mu * c.lambdaN ? '=' : '≤'), mv('μ', c.mu), mo('·'), mv('λn', c.lambdaN), mo('='), mn(c.mu * c.lambdaN), text('\u2009N\u2009s')),
        note: `Eqs. (4)–(7), for ${between(state, c)}${c.internal ? ', inside a collection' : ''}.${deed(state, change)}`,
      };
    }
    case 'ContactOrdering': return null;
    case 'SleepAndWake': {
      const d = decisionMeant(state, ['rest'], 'AccumulateRelativeMotion');
      const symbols = row(math('msubsup', mi('v'), mi('rel'), mi('max')), mo('<'), sub('ε', 'sleep'));
      return { symbols, numbers: d ? row(mn(Math.abs(d.value)), mo(Math.abs(d.value) < d.threshold ? '<' : '≥'), mn(d.threshold), text('\u2009m/s')) : null, note: d ? `Section 7, for ${trace.name(d.a)}: against the world.` : 'Section 7: the same measure, against the world.' };
    }
    case 'Unmerge': {
      const d = decisionMeant(state, ['motion', 'sliding', 'relative-motion'], 'Unmerge');
      if (!d) return null;
      const symbols = d.criterion.criterion === 'sliding'
        ? row(mo('|'), sub('w', 't'), mo('|'), mo('>'), mi('ε'), text('\u2002and\u2002'), mo('|'), sub('λ', 't'), mo('|'), mo('='), mi('μ'), sub('λ', 'n'))
        : row(math('msubsup', mi('v'), mi('rel'), mi('max')), mo('>'), mi('ε'));
      return { symbols, numbers: row(mn(Math.abs(d.value)), mo(Math.abs(d.value) > d.threshold ? '>' : '≤'), mn(d.threshold), text('\u2009m/s')), note: `${d.criterion.criterion}, ${source(d)}, for ${between(state, d)}: the weld ${d.passed ? 'holds' : 'is cut'}.` };
    }
    case 'AdvanceVelocities': {
      const symbols = row(sub('u', '+'), mo('='), sub('u', '−'), mo('+'), mi('h'), math('msup', mi('M'), row(mo('−'), mn(1))), mi('f'), mo('+'), mi('h'), math('msup', mi('M'), row(mo('−'), mn(1))), math('msup', mi('J'), mi('T')), mi('λ'));
      const b = bodyMeant(state);
      if (b < 0 || step === 0) return { symbols, numbers: null, note: 'Eq. (8).' };
      const [was, is] = [trace.velocity(b, step - 1), trace.velocity(b, step)];
      const g = hh * trace.head.gravity[1];
      return {
        symbols,
        numbers: row(mv('u+', is.vy), mo('='), mv('u−', was.vy), mo('+'), mo('('), mn(g), mo(')'), mo('+'), mo('('), mn(rest(is.vy - was.vy - g, g)), mo(')'), text('\u2009m/s')),
        note: `Eq. (8), upwards, for ${trace.name(b)}: before, by gravity, by all the rest.`,
      };
    }
    case 'AccumulateRelativeMotion': {
      const d = decisionMeant(state, ['relative-motion'], 'AccumulateRelativeMotion');
      const symbols = row(named('v', math('msubsup', mi('v'), mi('rel'), mi('max'))), mo('='), math('munder', mo('max'), row(mi('p'), mo('∈'), text('OBBs'))), mo('|'), sub('v', 'rel'), mo('('), mi('p'), mo(')'), mo('|'), mo('<'), named('ε', mi('ε')));
      return { symbols, numbers: d ? row(mv('v', Math.abs(d.value)), mo(d.passed ? '<' : '≥'), mv('ε', d.threshold), text('\u2009m/s')) : null, note: d ? `${source(d)}, for ${between(state, d)}: ${d.passed ? `calm; ${d.count} of ${d.needed} steps` : 'too fast; the count starts again'}.` : 'Eqs. (15)–(17). No free pair is in contact now.' };
    }
    case 'AdvancePositions': {
      const symbols = row(sub('x', '+'), mo('='), sub('x', '−'), mo('+'), mi('h'), sub('v', '+'));
      const b = bodyMeant(state);
      if (b < 0 || step === 0) return { symbols, numbers: null, note: '' };
      const v = trace.velocity(b, step);
      const [was, is] = [trace.pose(b, step - 1), trace.pose(b, step)];
      return { symbols, numbers: row(mn(is.y), mo('='), mn(was.y), mo('+'), mn(hh), mo('·'), mo('('), mn(v.vy), mo(')'), text('\u2009m')), note: `Upwards, for ${trace.name(b)}.` };
    }
    default: {
      const merged = (trace.eventsAt.get(step) ?? []).find((e) => e[1] === 'merge');
      const symbols = row(sub('v', 'c'), mo('='), math('mfrac', row(sub('m', 'c'), sub('v', 'c'), mo('+'), sub('m', 'b'), sub('v', 'b')), row(sub('m', 'c'), mo('+'), sub('m', 'b'))));
      if (!merged) return null; // there is nothing to be filled in
      const members = trace.members(merged[4], step);
      // Welded to a body that never moves, its mass is infinite: the paper's m_c.
      if (heldFast(state, merged[4])) return { symbols, numbers: row(sub('m', 'c'), mo('='), mi('∞'), text(',\u2002'), sub('v', 'c'), mo('='), text('that of what holds it')), note: `Eqs. (10)–(14): C${merged[4]} is welded to a body that does not respond to forces.` };
      const mass = members.reduce((sum, b) => sum + trace.head.bodies[b].mass, 0);
      const v = (axis: 'vx' | 'vy') => members.reduce((sum, b) => sum + trace.head.bodies[b].mass * trace.velocity(b, step)[axis], 0) / mass;
      return { symbols, numbers: row(sub('v', 'c'), mo('='), mo('('), mn(v('vx')), mo(','), mn(v('vy')), mo(')'), text('\u2009m/s,\u2002'), sub('m', 'c'), mo('='), mn(mass), text('\u2009kg')), note: `Eqs. (10)–(14): C${merged[4]} has ${members.length} ${members.length === 1 ? 'body' : 'bodies'} now.` };
    }
  }
}

/** Under the pointer, or with the focus, a symbol lights up its numbers, and its arrows in the picture. */
function lightUp(body: HTMLElement): void {
  const light = (symbol: string | undefined) => {
    for (const node of body.querySelectorAll<MathMLElement>('[data-symbol]')) node.classList.toggle('lit', node.dataset.symbol === symbol);
    document.documentElement.dataset.lit = symbol ?? '';
  };
  const symbolOf = (event: Event) => (event.target as Element).closest<MathMLElement>('[data-symbol]')?.dataset.symbol;
  body.addEventListener('pointerover', (event) => light(symbolOf(event)));
  body.addEventListener('pointerleave', () => light(undefined));
  body.addEventListener('focusin', (event) => light(symbolOf(event)));
  body.addEventListener('focusout', () => light(undefined));
}

export function equationCard(state: State): HTMLElement {
  const body = h('div', { class: 'equation' });
  const root = h('section', { class: 'card equation-card', 'aria-label': 'Equation of this stage' }, h('h2', {}, 'Equation'), body);
  lightUp(body);
  state.onChange(() => {
    if (state.playing) return;
    const found = state.veiled ? null : line(state);
    root.hidden = !found;
    if (!found) return body.replaceChildren();
    for (const node of found.symbols.querySelectorAll<MathMLElement>('[data-symbol]')) node.tabIndex = 0;
    body.replaceChildren(block(found.symbols), ...(found.numbers ? [block(found.numbers)] : []), ...(found.more ? [block(found.more)] : []), h('p', { class: 'hint' }, found.note));
  });
  return root;
}
