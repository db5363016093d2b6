// A question as it is asked: choices, or a field for a number, and the verdict.
import { type Given, judged } from './answers';
import { h } from './dom';
import type { Question } from './lesson';
import type { Trace } from './trace';

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

export function choices(question: Question, given: Given, at: number, trace: Trace, choose: (index: number, on: boolean) => void): HTMLElement {
  const alike = ofOneKind(question, trace);
  const options = shownOrder(question).map((i) => {
    const option = question.options[i];
    const input = h('input', {
      'aria-label': alike ? trace.name(option.bodies[0]) : undefined,
      type: question.several ? 'checkbox' : 'radio', name: `answer ${at}`, value: i, checked: given.chosen.has(i), disabled: given.done,
      onchange: () => choose(i, input.checked),
    });
    const mark = given.done ? (option.right ? ' ✓' : given.chosen.has(i) ? ' ✗' : '') : '';
    const look = given.done ? (option.right ? 'option right' : given.chosen.has(i) ? 'option wrong' : 'option') : 'option';
    return h('label', { class: look }, input, h('span', {}, alike ? String(trace.short(option.bodies[0]).number) : trace.told(option.text), mark && h('strong', {}, mark)));
  });
  const inPicture = question.options.some((option) => option.bodies.length > 0);
  return h('fieldset', {},
    h('legend', {}, question.ask), inPicture && !given.done ? h('p', { class: 'hint' }, 'Choose in the picture or here. Nothing is counted.') : null,
    h('div', { class: alike ? 'options by-number' : question.options.length > 6 ? 'options many' : 'options' }, ...options));
}

export function numberField(question: Question, given: Given, typed: () => void, enter: () => void): HTMLElement {
  const input = h('input', {
    type: 'text', inputmode: 'decimal', autocomplete: 'off', value: given.typed, disabled: given.done, 'aria-label': question.ask,
    oninput: () => {
      given.typed = input.value;
      typed();
    },
    onkeydown: (event) => {
      if ((event as KeyboardEvent).key === 'Enter') enter();
    },
  });
  return h('fieldset', {}, h('legend', {}, question.ask), h('span', { class: 'number-answer' }, input, question.number?.unit ?? ''));
}

export function verdict(question: Question, given: Given, trace: Trace): HTMLElement {
  const { right, found, rights, falses } = judged(question, given);
  const words = given.skipped ? 'The answer: ' : right ? 'Right. '
    : question.several ? `${found} of ${rights}, ${falses === 0 ? 'no false ones' : `${falses} false`}. ` : 'Not quite. ';
  return h('p', { class: given.skipped ? 'verdict' : right ? 'verdict right' : 'verdict wrong', tabindex: -1 },
    h('strong', {}, words), trace.told(question.because));
}
