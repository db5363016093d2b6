// The lesson beside the picture: parts, and questions that are asked before they are shown.
import { type Asked, type AnswerSheet, answerSheet, type Given, Memory, numberIn } from './answers';
import { h } from './dom';
import { type CoursePlace, type Lesson, type Option, prose, type Question, selectionOf, stageIndex } from './lesson';
import { choices, numberField, verdict } from './question_view';
import { roving } from './rail';
import { kLast, kStages } from './stages';
import type { State } from './state';

/** Events that are worth a look, the rarest first, and the button that goes there. */
const kWatched: Record<string, string> = {
  break: 'Watch the joint break', wake: 'Watch it wake up', unmerge: 'Watch the next unmerge', merge: 'Watch the next merge',
  sleep: 'Watch it fall asleep', impact: 'Watch the next hit',
};

export class LessonPanel {
  readonly root: HTMLElement;
  readonly dots: HTMLElement;
  private current = 0;
  private readonly given: Given[][]; // per part, per question
  private readonly memory: Memory;
  private readonly watched = new Set<number>(); // parts
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
    state.onChange(() => this.drawActions());
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

  /** A way on inside the part, before it is left: its next stage, or its next event. */
  private within(): { label: string; go: () => void } | null {
    const { state } = this;
    const part = this.lesson.parts[this.current];
    if (state.live || this.open() || state.trace !== state.traces[part.trace]) return null;
    if (part.stage && state.step === part.step && state.stage < kLast) {
      return { label: `Stage ${state.stage + 2}: ${kStages[state.stage + 1].label}`, go: () => state.moveStage(1) };
    }
    if (this.watched.has(this.current) || part.questions.length > 0) return null;
    const last = this.lesson.parts[this.current + 1];
    const end = last && last.trace === part.trace && last.step > part.step ? last.step : state.steps;
    const next = state.trace.eventSteps(Object.keys(kWatched)).find((step) => step > state.step && step <= end);
    if (next === undefined) return null;
    const kinds = new Set((state.trace.eventsAt.get(next) ?? []).map(([, type]) => type));
    const kind = Object.keys(kWatched).find((type) => kinds.has(type)) ?? '';
    return { label: kWatched[kind], go: () => this.watch(next) };
  }

  private watch(step: number): void {
    this.watched.add(this.current);
    this.playTo(step);
  }

  private primary(): void {
    const within = this.within();
    if (this.pending()) this.answer(false);
    else if (within) within.go();
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
    this.playTo(question.reveal);
    [...this.ask.querySelectorAll<HTMLElement>('.verdict')].pop()?.focus({ preventScroll: false });
  }

  /** Plays on to a step; without motion it is shown at once. */
  private playTo(step: number): void {
    const { state } = this;
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const start = Math.max(state.step, this.lesson.parts[this.current].step);
    if (still || step <= start) {
      state.goTo(step);
      return;
    }
    // A second and a half, by single steps where these are few.
    const span = step - start;
    const stride = Math.max(1, Math.ceil(span / 50));
    const pace = Math.max(30, Math.min(250, (1500 * stride) / span));
    let due = start;
    const tick = () => {
      if (state.live || (due !== start && state.step !== due)) return; // the reader has taken over
      due = Math.min(step, due + stride);
      state.goTo(due);
      if (due < step) window.setTimeout(tick, pace);
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
    const within = this.within();
    this.next.textContent = within ? within.label : question ? (question.several && chosen > 0 ? `Check ${chosen}` : 'Check')
      : following ? `Next: ${following.title}` : this.course && this.course.number > 0 ? (this.course.next ? `Next lesson: ${this.course.next}` : 'To the list of lessons') : 'From the start again';
  }

  private drawQuestion(): void {
    this.state.veiled = this.pending() !== null;
    this.drawActions();
    this.ask.replaceChildren(...this.asked().flatMap(({ question, given }, at) => [
      question.number ? numberField(question, given, () => this.typed(), () => this.entered()) : choices(question, given, at, this.state.trace, (i, on) => this.choose(i, on)),
      ...(given.done ? [verdict(question, given, this.state.trace)] : [])]));
  }

  private typed(): void {
    this.drawActions();
    this.remember();
  }
  private entered(): void {
    if (!this.next.disabled) this.answer(false);
  }

  /** The answers, for oneself or a teacher. */
  answers(): AnswerSheet {
    return answerSheet(this.pageTitle, this.lesson, this.given);
  }
}
