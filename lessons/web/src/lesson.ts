// The lesson beside the picture: parts, and questions that are asked before they are shown.
import { h } from './dom';
import { roving } from './rail';
import { kLast, stageAt } from './stages';
import type { LayerId, Selection, State } from './state';
import type { Trace } from './trace';

export interface Option {
  text: string;
  right: boolean;
  bodies: number[];
}
export interface Question {
  ask: string;
  several: boolean;
  reveal: number;
  options: Option[];
  number?: { value: number; tolerance: number; unit: string };
  because: string;
}
export interface Part {
  title: string;
  html: string;
  step: number;
  stage: string;
  trace: number;
  layers: LayerId[];
  select: number[];
  questions: Question[];
}
/** Where the lesson stands in a course. */
export interface CoursePlace {
  number: number; // 0: it stands alone
  of: number;
  next: string;
  file: string;
}

export interface Lesson {
  summary: string;
  minutes: number;
  intro: string;
  parts: Part[];
}

/** HTML that the Markdown converter made: it holds no scripts and no raw HTML. */
export function prose(html: string): HTMLElement {
  const holder = h('div', { class: 'prose' });
  holder.innerHTML = html;
  return holder;
}

export function stageIndex(id: string): number {
  const at = stageAt(id);
  return at < 0 ? kLast : at;
}

export function selectionOf(bodies: number[]): Selection {
  if (bodies.length === 1) return { kind: 'body', body: bodies[0] };
  if (bodies.length === 2) return { kind: 'pair', a: bodies[0], b: bodies[1] };
  return null;
}

interface Given {
  chosen: Set<number>;
  typed: string; // a number
  done: boolean;
  skipped: boolean;
}

/** A question of a part, with what was answered to it. */
interface Asked {
  question: Question;
  given: Given;
}

/** Answers and place, between two visits; a page whose storage is shut goes without. */
class Memory {
  constructor(private readonly key: string) {}
  read(): { part: number; given: { chosen: number[]; typed: string; done: boolean; skipped: boolean }[] } | null {
    try {
      return JSON.parse(localStorage.getItem(this.key) ?? 'null');
    } catch {
      return null;
    }
  }
  write(part: number, given: Given[]): void {
    try {
      localStorage.setItem(this.key, JSON.stringify({ part, given: given.map((one) => ({ ...one, chosen: [...one.chosen] })) }));
    } catch { /* as in a sandbox */ }
  }
}

/** The order in which choices are shown: by the question, not by its author. Numbers stay in order. */
export function shownOrder(question: Question): number[] {
  const order = question.options.map((_, i) => i);
  if (question.several || question.options.some((option) => option.bodies.length > 0 || /^\d+$/.test(option.text))) return order;
  let seed = 0;
  for (const c of question.ask) seed = (seed * 31 + (c.codePointAt(0) ?? 0)) >>> 0;
  for (let i = order.length - 1; i > 0; --i) {
    seed = (seed * 1664525 + 1013904223) >>> 0;
    const j = Math.floor((seed / 2 ** 32) * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

/** Whether all options are members of one array of bodies: then their numbers are enough. */
function ofOneKind(question: Question, trace: Trace): boolean {
  if (question.options.length < 4 || question.options.some((option) => option.bodies.length !== 1)) return false;
  const [first, ...others] = question.options.map((option) => trace.short(option.bodies[0]));
  return first.number > 0 && others.every((other) => other.base === first.base && other.number > 0);
}

/** A number as people write it: a comma is a point. */
function numberIn(text: string): number {
  const bare = text.trim().replace(',', '.').replace('−', '-');
  return bare === '' ? NaN : Number(bare);
}

function isRight({ number }: Question, { typed }: Given): boolean {
  return number !== undefined && Math.abs(numberIn(typed) - number.value) <= number.tolerance * (1 + 1e-9);
}

export class LessonPanel {
  readonly root: HTMLElement;
  readonly dots: HTMLElement;
  private current = 0;
  private readonly given: Given[][]; // per part, per question
  private readonly memory: Memory;
  private readonly place = h('p', { class: 'place' });
  private readonly title = h('h2', { tabindex: -1 });
  private readonly text = h('div');
  private readonly ask = h('div', { class: 'ask', id: 'question', tabindex: -1 });
  private readonly partsList = h('ol', { class: 'parts' });
  private readonly back: HTMLButtonElement;
  private readonly next: HTMLButtonElement;
  private readonly skip: HTMLButtonElement;

  constructor(private readonly lesson: Lesson, private readonly state: State, private readonly pageTitle: string,
    private readonly course: CoursePlace | null = null) {
    this.given = lesson.parts.map((part) => part.questions.map(() => ({ chosen: new Set(), typed: '', done: false, skipped: false })));
    this.memory = new Memory(`merge2d ${pageTitle}`);
    this.back = h('button', { type: 'button', class: 'plain', onclick: () => this.move(-1) }, 'Back');
    this.skip = h('button', { type: 'button', class: 'link', onclick: () => this.answer(true) }, 'Show me instead');
    this.next = h('button', { type: 'button', class: 'primary', onclick: () => this.primary() });
    this.dots = h('div', { class: 'dots', role: 'group', 'aria-label': 'Parts of the lesson' });
    this.root = h('section', { class: 'words panel lesson', 'aria-label': 'Lesson' },
      h('div', { class: 'scrolls', tabindex: 0 }, this.place, this.title, this.text, this.ask, this.partsList),
      h('div', { class: 'actions' }, this.back, this.skip, this.next));
    state.stopBefore = (from, to) => this.stop(from, to);
    const kept = this.memory.read();
    const all = this.given.flat();
    if (kept && kept.given.length === all.length) {
      all.forEach((given, i) => Object.assign(given, { ...kept.given[i], chosen: new Set(kept.given[i].chosen) }));
    }
    this.show(Math.min(Math.max(0, kept?.part ?? 0), lesson.parts.length - 1));
  }

  /** Playing halts where the next part begins, and before a question is answered; it says so. */
  private stop(from: number, to: number): { step: number; why: string } | undefined {
    if (this.state.live) return undefined;
    const question = this.pending();
    if (question && question.reveal >= from && question.reveal <= to) {
      return { step: Math.max(from, question.reveal - 1), why: 'Stopped: a question first. Answer it, or choose “Show me instead”.' };
    }
    const following = this.lesson.parts[this.current + 1];
    return following && following.trace === this.state.traces.indexOf(this.state.trace) && following.step > from && following.step <= to
      ? { step: following.step, why: `Stopped: here begins part ${this.current + 2}, “${following.title}”. N goes there, Space plays on.` } : undefined;
  }

  /** The questions of this part, up to the first that is open. */
  private asked(): Asked[] {
    const all = this.lesson.parts[this.current].questions.map((question, i) => ({ question, given: this.given[this.current][i] }));
    const at = all.findIndex(({ given }) => !given.done);
    return at < 0 ? all : all.slice(0, at + 1);
  }
  private open(): Asked | null {
    const last = this.asked().pop();
    return last && !last.given.done ? last : null;
  }
  private pending(): Question | null {
    return this.open()?.question ?? null;
  }

  /** Parts on the time line of the run that is shown. */
  flags(): { step: number; label: string }[] {
    const run = this.state.traces.indexOf(this.state.prepared);
    return this.lesson.parts.flatMap((part, i) => (part.trace === run ? [{ step: part.step, label: String(i + 1) }] : []));
  }
  get part(): number {
    return this.current;
  }
  /** From where to where the part goes. */
  get moment(): { step: number; reveal: number; trace: number } {
    const { step, trace, questions } = this.lesson.parts[this.current];
    return { step, trace, reveal: Math.max(step, ...questions.map((question) => question.reveal)) };
  }

  /** A click in the picture that means an option. True when it was one. */
  pick(bodies: number[]): boolean {
    const open = this.open();
    if (!open || this.state.live) return false;
    const { question, given } = open;
    const same = (option: Option) => option.bodies.length > 0 && option.bodies.length === bodies.length
      && option.bodies.every((body) => bodies.includes(body));
    const at = question.options.findIndex(same);
    if (at < 0) return false;
    this.choose(at, !given.chosen.has(at));
    this.drawQuestion();
    return true;
  }

  /** Bodies that are marked in the picture, and how. */
  marked(): Map<number, string> {
    const out = new Map<number, string>();
    const last = this.asked().pop();
    if (!last || this.state.live) return out;
    const { question, given } = last;
    for (const [i, option] of question.options.entries()) {
      const look = given.done && option.right ? 'right' : given.chosen.has(i) ? 'chosen' : '';
      if (look) for (const body of option.bodies) out.set(body, look);
    }
    return out;
  }

  /** To the question, or to the first thing that one can do. */
  focusQuestion(): void {
    const first = this.ask.querySelector<HTMLElement>('input:not(:disabled)');
    (first ?? this.next).focus();
  }

  move(by: number): void {
    const to = this.current + by;
    if (to >= 0 && to < this.lesson.parts.length) {
      this.show(to);
      this.title.focus({ preventScroll: true });
    }
  }
  goToPart(index: number): void {
    this.move(index - this.current);
  }

  private primary(): void {
    if (this.pending()) this.answer(false);
    else if (this.current + 1 < this.lesson.parts.length) this.move(1);
    else if (this.course && this.course.number > 0) location.href = this.course.file;
    else this.goToPart(0);
  }

  private show(index: number): void {
    this.current = index;
    const part = this.lesson.parts[index];
    const { state } = this;
    const n = this.lesson.parts.length;
    if (state.live) state.giveBack();
    this.place.textContent = `Part ${index + 1} of ${n}${index === 0 && this.lesson.minutes ? ` · about ${this.lesson.minutes} minutes` : ''}`;
    this.title.textContent = part.title;
    this.text.replaceChildren(...(index === 0 && this.lesson.intro ? [prose(this.lesson.intro)] : []), prose(part.html));
    state.playing = false;
    state.trace = state.traces[part.trace];
    if (part.layers.length > 0) {
      state.layers.clear();
      for (const layer of part.layers) state.layers.add(layer);
    }
    state.selection = selectionOf(part.select);
    this.root.querySelector('.scrolls')?.scrollTo(0, 0);
    this.drawParts();
    this.drawQuestion();
    this.remember();
    state.goTo(part.step, part.stage ? stageIndex(part.stage) : kLast);
  }

  private remember(): void {
    this.memory.write(this.current, this.given.flat());
  }

  private drawParts(): void {
    const state = (i: number) => (i === this.current ? 'current'
      : i < this.current || (this.given[i].length > 0 && this.given[i].every((given) => given.done)) ? 'done' : 'ahead');
    this.dots.replaceChildren(...this.lesson.parts.map((part, i) => h('button', {
      type: 'button', class: `dot-part ${state(i)}`, 'aria-label': `Part ${i + 1}: ${part.title}`, title: part.title,
      'aria-current': i === this.current ? 'step' : undefined, tabindex: i === this.current ? 0 : -1, onclick: () => this.goToPart(i),
    }, state(i) === 'done' ? '✓' : String(i + 1))));
    roving([...this.dots.querySelectorAll('button')]);
    this.partsList.replaceChildren(...this.lesson.parts.map((part, i) => h('li', { class: state(i) },
      h('button', { type: 'button', tabindex: -1, onclick: () => this.goToPart(i) }, h('span', { class: 'mark' }, state(i) === 'done' ? '✓' : String(i + 1)),
        part.title, part.questions.length > 0 ? h('small', {}, 'question') : null))));
  }

  private choose(index: number, on: boolean): void {
    const open = this.open();
    if (!open) return;
    const { chosen } = open.given;
    if (!open.question.several) chosen.clear();
    if (on) chosen.add(index);
    else chosen.delete(index);
    this.drawActions();
    this.remember();
    this.state.changed();
  }

  private answer(skip: boolean): void {
    const open = this.open();
    if (!open) return;
    const { given, question } = open;
    given.skipped = skip;
    given.done = true;
    this.drawParts();
    this.drawQuestion();
    this.remember();
    this.reveal(question);
    [...this.ask.querySelectorAll<HTMLElement>('.verdict')].pop()?.focus({ preventScroll: false });
  }

  /** Plays on to where the answer can be seen; without motion it is shown at once. */
  private reveal(question: Question): void {
    const { state } = this;
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const part = this.lesson.parts[this.current];
    const start = Math.max(state.step, part.step);
    if (still || question.reveal <= start) {
      state.goTo(question.reveal);
      return;
    }
    // A second and a half, by single steps where these are few.
    const span = question.reveal - start;
    const stride = Math.max(1, Math.ceil(span / 50));
    const pace = Math.max(30, Math.min(250, (1500 * stride) / span));
    let due = start;
    const tick = () => {
      if (state.live || (due !== start && state.step !== due)) return; // the reader has taken over
      due = Math.min(question.reveal, due + stride);
      state.goTo(due);
      if (due < question.reveal) window.setTimeout(tick, pace);
    };
    tick();
  }

  /** The one primary button names its action. */
  private drawActions(): void {
    const open = this.open();
    const question = open?.question ?? null;
    const chosen = open?.given.chosen.size ?? 0;
    this.skip.hidden = !question;
    this.back.hidden = this.current === 0;
    this.next.disabled = open !== null && (open.question.number ? Number.isNaN(numberIn(open.given.typed)) : chosen === 0 && !open.question.several);
    const following = this.lesson.parts[this.current + 1];
    this.next.textContent = question ? (question.several && chosen > 0 ? `Check ${chosen}` : 'Check')
      : following ? `Next: ${following.title}` : this.course && this.course.number > 0 ? (this.course.next ? `Next lesson: ${this.course.next}` : 'To the list of lessons') : 'From the start again';
  }

  private drawQuestion(): void {
    this.state.veiled = this.pending() !== null;
    this.drawActions();
    this.ask.replaceChildren(...this.asked().flatMap(({ question, given }, at) => [
      question.number ? this.numberField(question, given) : this.choices(question, given, at), ...(given.done ? [this.verdict(question, given)] : [])]));
  }

  private choices(question: Question, given: Given, at: number): HTMLElement {
    const alike = ofOneKind(question, this.state.trace);
    const options = shownOrder(question).map((i) => {
      const option = question.options[i];
      const input = h('input', {
        'aria-label': alike ? this.state.trace.name(option.bodies[0]) : undefined,
        type: question.several ? 'checkbox' : 'radio', name: `answer ${at}`, value: i, checked: given.chosen.has(i), disabled: given.done,
        onchange: () => this.choose(i, input.checked),
      });
      const mark = given.done ? (option.right ? ' ✓' : given.chosen.has(i) ? ' ✗' : '') : '';
      const look = given.done ? (option.right ? 'option right' : given.chosen.has(i) ? 'option wrong' : 'option') : 'option';
      return h('label', { class: look }, input, h('span', {}, alike ? String(this.state.trace.short(option.bodies[0]).number) : this.state.trace.told(option.text), mark && h('strong', {}, mark)));
    });
    const inPicture = question.options.some((option) => option.bodies.length > 0);
    return h('fieldset', {},
      h('legend', {}, question.ask), inPicture && !given.done ? h('p', { class: 'hint' }, 'Choose in the picture or here. Nothing is counted.') : null,
      h('div', { class: alike ? 'options by-number' : question.options.length > 6 ? 'options many' : 'options' }, ...options));
  }

  private numberField(question: Question, given: Given): HTMLElement {
    const input = h('input', {
      type: 'text', inputmode: 'decimal', autocomplete: 'off', value: given.typed, disabled: given.done, 'aria-label': question.ask,
      oninput: () => {
        given.typed = input.value;
        this.drawActions();
        this.remember();
      },
      onkeydown: (event) => {
        if ((event as KeyboardEvent).key === 'Enter' && !this.next.disabled) this.answer(false);
      },
    });
    return h('fieldset', {}, h('legend', {}, question.ask), h('span', { class: 'number-answer' }, input, question.number?.unit ?? ''));
  }

  private verdict(question: Question, given: Given): HTMLElement {
    if (question.number) {
      const right = isRight(question, given);
      return h('p', { class: given.skipped ? 'verdict' : right ? 'verdict right' : 'verdict wrong', tabindex: -1 },
        h('strong', {}, given.skipped ? 'The answer: ' : right ? 'Right. ' : 'Not quite. '), this.state.trace.told(question.because));
    }
    const rights = question.options.filter((option) => option.right).length;
    const found = question.options.filter((option, i) => option.right && given.chosen.has(i)).length;
    const falses = given.chosen.size - found;
    const wrong = found !== rights || falses > 0;
    const words = given.skipped ? 'The answer: ' : !wrong ? 'Right. '
      : question.several ? `${found} of ${rights}, ${falses === 0 ? 'no false ones' : `${falses} false`}. ` : 'Not quite. ';
    return h('p', { class: given.skipped ? 'verdict' : wrong ? 'verdict wrong' : 'verdict right', tabindex: -1 },
      h('strong', {}, words), this.state.trace.told(question.because));
  }

  /** The answers, for oneself or a teacher. */
  answers(): { title: string; answers: { part: number; ask: string; mine: string[]; skipped: boolean; simulation: string[] | null }[] } {
    return {
      title: this.pageTitle,
      answers: this.lesson.parts.flatMap(({ questions }, i) => questions.map((question, k) => {
        const given = this.given[i][k];
        const texts = (wanted: (option: Option, at: number) => boolean) => question.options.filter(wanted).map((option) => option.text);
        const { number } = question;
        return {
          part: i + 1, ask: question.ask, skipped: given.skipped,
          mine: number ? (given.typed ? [`${given.typed} ${number.unit}`.trim()] : []) : texts((_, at) => given.chosen.has(at)),
          simulation: !given.done ? null : number ? [`${Number(number.value.toPrecision(3))} ${number.unit}`.trim()] : texts((option) => option.right),
        };
      })),
    };
  }
  answersAsText(): string {
    const { title, answers } = this.answers();
    return [title, '', ...answers.flatMap((one) => [`${one.part}. ${one.ask}`,
      `   My answer: ${one.skipped ? '(skipped)' : one.mine.join('; ') || '(none)'}`,
      ...(one.simulation ? [`   The simulation: ${one.simulation.join('; ') || 'none'}`] : [])])].join('\n');
  }
}
