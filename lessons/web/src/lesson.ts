// The lesson beside the picture: parts, and questions that are asked before they are shown.
import { h } from './dom';
import { kLast, stageAt } from './stages';
import type { LayerId, Selection, State } from './state';

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
  question: Question | null;
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
  done: boolean;
  skipped: boolean;
}

export class LessonPanel {
  readonly root: HTMLElement;
  private current = 0;
  private readonly given: Given[];
  private readonly place = h('p', { class: 'place' });
  private readonly title = h('h2', { tabindex: -1 });
  private readonly text = h('div');
  private readonly ask = h('div', { class: 'ask' });
  private readonly back: HTMLButtonElement;
  private readonly next: HTMLButtonElement;
  private readonly copied = h('span', { class: 'copied', role: 'status' });

  constructor(private readonly lesson: Lesson, private readonly state: State, private readonly pageTitle: string) {
    this.given = lesson.parts.map(() => ({ chosen: new Set(), done: false, skipped: false }));
    this.back = h('button', { type: 'button', class: 'plain', onclick: () => this.move(-1) }, '← Back');
    this.next = h('button', { type: 'button', class: 'primary', onclick: () => this.move(1) }, 'Next →');
    const copy = lesson.parts.some((part) => part.question)
      ? h('button', { type: 'button', class: 'link', onclick: () => this.copy() }, 'Copy my answers') : null;
    this.root = h('section', { class: 'card lesson', 'aria-label': 'Lesson' },
      this.place, this.title, this.text, this.ask,
      h('div', { class: 'turn' }, this.back, this.next, h('span', { class: 'grow' }), copy, this.copied));
    // Playing halts where the next part begins, and before a question is answered.
    state.stopBefore = (from, to) => {
      const question = this.pending();
      if (question && question.reveal > from && question.reveal <= to) return Math.max(from, question.reveal - 1);
      const following = lesson.parts[this.current + 1];
      return following && following.trace === state.traces.indexOf(state.trace) && following.step > from && following.step <= to
        ? following.step : undefined;
    };
    this.show(0);
  }

  private pending(): Question | null {
    const given = this.given[this.current];
    return given.done || given.skipped ? null : this.lesson.parts[this.current].question;
  }

  /** A click in the picture that means an option. True when it was one. */
  pick(bodies: number[]): boolean {
    const question = this.pending();
    if (!question) return false;
    const same = (option: Option) => option.bodies.length > 0 && option.bodies.length === bodies.length
      && option.bodies.every((body) => bodies.includes(body));
    const at = question.options.findIndex(same);
    if (at < 0) return false;
    this.choose(at, !this.given[this.current].chosen.has(at));
    this.drawQuestion();
    return true;
  }

  /** Bodies that are marked in the picture, and how. */
  marked(): Map<number, string> {
    const out = new Map<number, string>();
    const question = this.lesson.parts[this.current].question;
    const given = this.given[this.current];
    if (!question) return out;
    for (const [i, option] of question.options.entries()) {
      const look = given.done && option.right ? 'right' : given.chosen.has(i) ? 'chosen' : '';
      if (look) for (const body of option.bodies) out.set(body, look);
    }
    return out;
  }

  move(by: number): void {
    const to = this.current + by;
    if (to >= 0 && to < this.lesson.parts.length) {
      this.show(to);
      this.title.focus({ preventScroll: true });
    }
  }

  private show(index: number): void {
    this.current = index;
    const part = this.lesson.parts[index];
    const { state } = this;
    const n = this.lesson.parts.length;
    this.place.textContent = `Part ${index + 1} of ${n}${index === 0 && this.lesson.minutes ? ` · about ${this.lesson.minutes} minutes` : ''}`;
    this.title.textContent = part.title;
    this.text.replaceChildren(...(index === 0 && this.lesson.intro ? [prose(this.lesson.intro)] : []), prose(part.html));
    this.back.disabled = index === 0;
    this.next.disabled = index === n - 1;
    state.playing = false;
    state.trace = state.traces[part.trace];
    if (part.layers.length > 0) {
      state.layers.clear();
      for (const layer of part.layers) state.layers.add(layer);
    }
    state.selection = selectionOf(part.select);
    this.drawQuestion();
    state.goTo(part.step, part.stage ? stageIndex(part.stage) : kLast);
  }

  private choose(index: number, on: boolean): void {
    const { chosen } = this.given[this.current];
    if (!this.lesson.parts[this.current].question?.several) chosen.clear();
    if (on) chosen.add(index);
    else chosen.delete(index);
    this.state.changed();
  }

  private answer(skip: boolean): void {
    const given = this.given[this.current];
    const question = this.lesson.parts[this.current].question;
    if (!question) return;
    given.skipped = skip;
    given.done = true;
    this.drawQuestion();
    this.reveal(question);
    this.ask.querySelector<HTMLElement>('.verdict')?.focus({ preventScroll: false });
  }

  /** Plays on to where the answer can be seen; without motion it is shown at once. */
  private reveal(question: Question): void {
    const { state } = this;
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const part = this.lesson.parts[this.current];
    const start = Math.max(state.step, part.step);
    if (still || question.reveal <= start || question.reveal - start > 400) {
      state.goTo(question.reveal);
      return;
    }
    const pace = Math.max(30, Math.min(250, 2500 / (question.reveal - start)));
    let due = start;
    const tick = () => {
      if (due !== start && state.step !== due) return; // the reader has taken over
      due = Math.min(question.reveal, state.step + 1);
      state.goTo(due);
      if (due < question.reveal) window.setTimeout(tick, pace);
    };
    tick();
  }

  private drawQuestion(): void {
    const question = this.lesson.parts[this.current].question;
    const given = this.given[this.current];
    if (!question) {
      this.ask.replaceChildren();
      return;
    }
    const options = question.options.map((option, i) => {
      const input = h('input', {
        type: question.several ? 'checkbox' : 'radio', name: 'answer', value: i, checked: given.chosen.has(i), disabled: given.done,
        onchange: () => {
          this.choose(i, input.checked);
          submit.disabled = given.chosen.size === 0 && !question.several;
        },
      });
      const mark = given.done ? (option.right ? ' ✓' : given.chosen.has(i) ? ' ✗' : '') : '';
      const look = given.done ? (option.right ? 'option right' : given.chosen.has(i) ? 'option wrong' : 'option') : 'option';
      return h('label', { class: look }, input, h('span', {}, option.text, mark && h('strong', {}, mark)));
    });
    const submit = h('button', {
      type: 'button', class: 'primary', disabled: given.chosen.size === 0 && !question.several, onclick: () => this.answer(false),
    }, 'Answer, then watch');
    const inPicture = question.options.some((option) => option.bodies.length > 0);
    const field = h('fieldset', {},
      h('legend', {}, question.ask), inPicture && !given.done ? h('p', { class: 'hint' }, 'Answer here or by a click in the picture.') : null,
      h('div', { class: question.options.length > 6 ? 'options many' : 'options' }, ...options));
    const wrong = question.options.some((option, i) => option.right !== given.chosen.has(i));
    const verdict = given.done
      ? h('p', { class: given.skipped ? 'verdict' : wrong ? 'verdict wrong' : 'verdict right', tabindex: -1 },
        h('strong', {}, given.skipped ? 'The answer: ' : wrong ? 'Not quite. ' : 'Right. '), question.because)
      : h('div', { class: 'turn' }, submit, h('button', { type: 'button', class: 'link', onclick: () => this.answer(true) }, 'Just show me'));
    this.ask.replaceChildren(field, verdict);
  }

  private copy(): void {
    const lines = [this.pageTitle, ''];
    for (const [i, part] of this.lesson.parts.entries()) {
      const { question } = part;
      if (!question) continue;
      const given = this.given[i];
      const chosen = [...given.chosen].sort((a, b) => a - b).map((at) => question.options[at].text).join('; ');
      const right = question.options.filter((option) => option.right).map((option) => option.text).join('; ');
      lines.push(`${i + 1}. ${question.ask}`, `   My answer: ${given.skipped ? '(skipped)' : chosen || '(none)'}`,
        ...(given.done ? [`   The simulation: ${right || 'none'}`] : []));
    }
    const text = lines.join('\n');
    const done = () => { this.copied.textContent = 'Copied.'; };
    const byHand = () => {
      const area = h('textarea', { readonly: true, rows: Math.min(12, lines.length), 'aria-label': 'My answers' });
      area.value = text;
      this.copied.replaceChildren(area);
      area.select();
    };
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, byHand);
    else byHand();
  }
}
