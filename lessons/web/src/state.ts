// What the page shows now, and who wants to know when that changes.
import { kLast } from './stages';
import type { Trace } from './trace';

export type Selection =
  | { kind: 'body'; body: number }
  | { kind: 'pair'; a: number; b: number }
  | null;

export const kLayers = [
  { id: 'contacts', label: 'Contacts' },
  { id: 'forces', label: 'Forces' },
  { id: 'graph', label: 'Graph' },
  { id: 'boxes', label: 'Boxes' },
  { id: 'velocities', label: 'Velocities' },
  { id: 'heat', label: 'Near a limit' },
  { id: 'ghost', label: 'Reference as ghost' },
  { id: 'labels', label: 'Labels' },
  { id: 'beside', label: 'Reference beside' },
] as const;
export type LayerId = (typeof kLayers)[number]['id'];
/** Layers that need a run without merging. */
export const kOfReference: readonly LayerId[] = ['ghost', 'beside'];

export class State {
  step = 0;
  stage = kLast;
  playing = false;
  speed = 1;
  selection: Selection = null;
  readonly layers = new Set<LayerId>(['contacts']);
  trace: Trace;
  private readonly listeners: (() => void)[] = [];

  constructor(readonly traces: Trace[]) {
    this.trace = traces[0];
  }

  get reference(): Trace | undefined {
    return this.traces.find((trace) => trace.head.mode === 'reference');
  }
  get steps(): number {
    return this.trace.head.steps;
  }
  get time(): number {
    return this.step * this.trace.head.h;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }
  changed(): void {
    for (const listener of this.listeners) listener();
  }

  goTo(step: number, stage = kLast): void {
    this.step = Math.max(0, Math.min(this.steps, Math.round(step)));
    this.stage = this.step === 0 ? kLast : stage;
    this.changed();
  }

  /** Through the stages; before the first one is the end of the step before. */
  moveStage(by: number): void {
    const now = this.step * kStagesPerStep + this.stage + by;
    const step = Math.floor(now / kStagesPerStep);
    if (step < 0 || step > this.steps) return;
    this.goTo(step, now - step * kStagesPerStep);
  }

  pause(): void {
    this.playing = false;
    this.changed();
  }

  /** Where playing has to stop on its way, as before a question. */
  stopBefore: (from: number, to: number) => number | undefined = () => undefined;

  nextEvent(types: readonly string[] | undefined, direction: 1 | -1): boolean {
    const steps = this.trace.eventSteps(types);
    const found = direction > 0
      ? steps.find((step) => step > this.step)
      : steps.reverse().find((step) => step < this.step);
    if (found === undefined) return false;
    this.goTo(found);
    return true;
  }
}

const kStagesPerStep = kLast + 1;
