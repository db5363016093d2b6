// A lesson as the page gets it: lessonJson() in lessons/lesson.cpp writes it.
import { h } from './dom';
import { kLast, stageAt } from './stages';
import type { LayerId, Selection } from './state';

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
