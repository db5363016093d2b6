// Why two bodies are one, or not, in other languages: by the names and numbers that the engine gives, not by its sentence.
import { number } from './dom';
import type { Reason } from './engine';
import table from './reasons.json';

type Test = Reason['tests'][number];
const kRefusals = ['cycle', 'freedoms', 'patience'];
type Sentences = (typeof table)['de'];

/** Fills {name} with values. */
function filled(sentence: string, values: Record<string, string>): string {
  return sentence.replace(/\{(\w+)\}/g, (_, name: string) => values[name] ?? '');
}

function counted([one, many]: string[], n: number): string {
  return n === 1 ? one : filled(many, { n: String(n) });
}

function clause(words: Sentences, test: Test): string {
  const measure = words.measure[test.criterion as keyof Sentences['measure']];
  const unit = test.unit ? ` ${test.unit}` : '';
  const values = {
    measure: measure ?? '', value: `${number(Math.abs(test.value))}${measure ? unit : ''}`, limit: `${number(test.threshold)}${measure ? unit : ''}`,
    count: String(test.count), needed: String(test.needed),
  };
  if (measure) return filled(Math.abs(test.value) >= test.threshold ? words.clause.over : words.clause.under, values);
  return filled(words.clause[test.criterion as keyof Sentences['clause']] ?? words.clause.steps, values);
}

/** Sentences about a pair; null where the language is the engine's own. `decisive` is the test that decided. */
export function reasonIn(language: string, reason: Reason, decisive: Test | null): { text: string; outlook: string } | null {
  const words = (table as Record<string, Sentences>)[language];
  if (!words) return null;
  const failing = reason.tests.filter((test) => ['unmerge', 'cut', 'apart'].includes(test.verdict));
  // A ready pair that waits is told the refusal, which no gauge shows as a number.
  const refusal = reason.outcome === 'waiting' && reason.tests.find((one) => one.verdict === 'wait' && kRefusals.includes(one.criterion));
  const told = failing.length > 0 && decisive && !failing.includes(decisive) ? failing[0] : decisive;
  const test = (refusal || told) ?? failing[0] ?? reason.tests[reason.tests.length - 1] ?? null;
  const others = failing.filter((one) => one !== test).length;
  const because = (test ? clause(words, test) : words.clause.user) + (others > 0 ? counted(words.more, others) : '');
  const { kind, measure, limit, steps } = reason.condition;
  const unit = reason.tests.find((one) => one.criterion === measure)?.unit ?? '';
  return {
    text: filled(words.outcome[reason.outcome as keyof Sentences['outcome']] ?? '', { because }),
    outlook: filled(words.condition[kind as keyof Sentences['condition']] ?? '', {
      measure: words.measure[measure as keyof Sentences['measure']] ?? '', limit: `${number(limit)} ${unit}`,
      steps: counted(kind === 'wait' ? words.after : words.steps, Math.max(1, steps)),
    }),
  };
}
