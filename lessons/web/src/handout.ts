// The page on paper: a comic strip of the key states, with their text and questions.
import { homeOf } from './camera';
import { h } from './dom';
import { type Lesson, prose, type Question, selectionOf, stageIndex } from './lesson';
import { describe } from './now';
import { Picture } from './picture';
import { shownOrder } from './question_view';
import { kLast } from './stages';
import { State } from './state';
import type { Trace } from './trace';

/** Without a lesson: the beginning, up to six steps with the most events, the end. */
function keySteps(trace: Trace): number[] {
  const busiest = [...trace.eventsAt].sort((a, b) => b[1].length - a[1].length).slice(0, 6).map(([step]) => step);
  return [...new Set([0, ...busiest, trace.head.steps])].sort((a, b) => a - b);
}

/** With its choices, to be ticked; of many there is a line to write on. */
function questionOnPaper(question: Question, trace: Trace): HTMLElement {
  const choices = question.options.length > 0 && question.options.length <= 12 ? shownOrder(question).map((i) => h('li', {}, `☐ ${trace.told(question.options[i].text)}`)) : [];
  return h('div', { class: 'blank' }, h('p', {}, choices.length > 0 ? question.ask : `${question.ask} ______________________________`), h('ul', {}, ...choices));
}

export function handout(title: string, place: string, lesson: Lesson | null, traces: Trace[]): HTMLElement {
  const strip = h('div', { class: 'strip' });
  const panel = (heading: string, step: number, stage: number, trace: number, home: boolean, set: (state: State) => void, text: HTMLElement | null, questions: HTMLElement[]) => {
    const state = new State(traces);
    state.trace = traces[trace];
    state.step = step;
    state.stage = step === 0 ? kLast : stage;
    set(state);
    const picture = new Picture(state.trace, false);
    picture.lens.setHome(home ? homeOf(state.trace, picture.view, step, step) : null);
    picture.lens.onPaper(2.6);
    picture.draw(state);
    strip.append(h('article', {}, h('div', { class: 'told' }, h('h3', {}, heading), text, ...questions), h('figure', {}, picture.root, h('figcaption', { class: 'caption' }, describe(state)))));
  };
  if (lesson) {
    for (const [i, part] of lesson.parts.entries()) {
      panel(`${i + 1}. ${part.title}`, part.step, stageIndex(part.stage), part.trace, true, (state) => {
        if (part.layers.length > 0) state.layers.clear();
        for (const layer of part.layers) state.layers.add(layer);
        state.selection = selectionOf(part.select);
      }, prose(part.html), part.questions.map((question) => questionOnPaper(question, traces[part.trace])));
    }
  } else {
    for (const step of keySteps(traces[0])) {
      panel(`${traces[0].timeAt(step).toFixed(2)} s`, step, kLast, 0, false, () => {}, null, []);
    }
  }
  return h('div', { class: 'handout', 'aria-hidden': true }, h('h1', {}, title),
    h('p', { class: 'sheet-head' }, h('span', {}, place), h('span', {}, 'Name ______________________________')),
    h('p', { class: 'sheet-key' }, '■ merged   ○ solved   ✕ came apart   → velocity   grey: a free body   C: a collection, with its number of bodies'), lesson?.intro ? prose(lesson.intro) : null, strip);
}
