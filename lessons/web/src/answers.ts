// The answers of a reader: kept between two visits, judged, and copied for a teacher.
import type { Lesson, Option, Question } from './lesson';

export interface Given {
  chosen: Set<number>;
  typed: string; // a number
  done: boolean;
  skipped: boolean;
}

/** A question of a part, with what was answered to it. */
export interface Asked {
  question: Question;
  given: Given;
}

/** Answers and place, between two visits; a page whose storage is shut goes without. */
export class Memory {
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

/** A number as people write it: a comma is a point. */
export function numberIn(text: string): number {
  const bare = text.trim().replace(',', '.').replace('−', '-');
  return bare === '' ? NaN : Number(bare);
}

/** How well a question was answered. */
export interface Judgement {
  right: boolean;
  found: number; // of the right options
  rights: number;
  falses: number;
}

export function judged(question: Question, { chosen, typed }: Given): Judgement {
  const { number } = question;
  if (number) {
    const right = Math.abs(numberIn(typed) - number.value) <= number.tolerance * (1 + 1e-9);
    return { right, found: Number(right), rights: 1, falses: Number(!right) };
  }
  const rights = question.options.filter((option) => option.right).length;
  const found = question.options.filter((option, i) => option.right && chosen.has(i)).length;
  const falses = chosen.size - found;
  return { right: found === rights && falses === 0, found, rights, falses };
}

export interface AnswerSheet {
  title: string;
  answers: { part: number; ask: string; mine: string[]; skipped: boolean; simulation: string[] | null }[];
}

/** The answers, for oneself or a teacher; `given` is per part, per question. */
export function answerSheet(title: string, lesson: Lesson, given: Given[][]): AnswerSheet {
  return {
    title,
    answers: lesson.parts.flatMap(({ questions }, i) => questions.map((question, k) => {
      const mine = given[i][k];
      const texts = (wanted: (option: Option, at: number) => boolean) => question.options.filter(wanted).map((option) => option.text);
      const { number } = question;
      return {
        part: i + 1, ask: question.ask, skipped: mine.skipped,
        mine: number ? (mine.typed ? [`${mine.typed} ${number.unit}`.trim()] : []) : texts((_, at) => mine.chosen.has(at)),
        simulation: !mine.done ? null : number ? [`${Number(number.value.toPrecision(3))} ${number.unit}`.trim()] : texts((option) => option.right),
      };
    })),
  };
}

export function answersAsText({ title, answers }: AnswerSheet): string {
  return [title, '', ...answers.flatMap((one) => [`${one.part}. ${one.ask}`,
    `   My answer: ${one.skipped ? '(skipped)' : one.mine.join('; ') || '(none)'}`,
    ...(one.simulation ? [`   The simulation: ${one.simulation.join('; ') || 'none'}`] : [])])].join('\n');
}
