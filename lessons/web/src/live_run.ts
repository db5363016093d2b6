// The actions of a reader on a run, and the worlds of the engine behind it.
import type { Engine, Hand, Reason, World } from './engine';
import { LiveTrace } from './live';
import type { Trace } from './trace';

/** One thing that the reader did. */
export interface Deed {
  step: number;
  line: string;
  told: string;
}

/** Which other world goes beside the own one. */
export type Beside = 'reference' | 'paper';

/** Settings in which the other world differs on purpose stay as they are there. */
const kItsOwn = /^set (mode|merging\.rule|unmerging\.rule|merging\.cycles)=/;

const kPaper = ['set merging.rule=paper', 'set unmerging.rule=paper', 'set merging.cycles=off'];

export class LiveRun {
  readonly trace: LiveTrace;
  readonly deeds: Deed[] = [];
  private readonly world: World;
  private other: { kind: Beside; world: World; trace: LiveTrace } | null = null;

  constructor(private readonly engine: Engine, readonly prepared: Trace, readonly fork: number) {
    this.world = engine.open(prepared.head.toml, prepared.head.mode);
    this.trace = new LiveTrace(this.world, prepared, fork, 'your run');
  }

  /** Executes a command after a step; later ones are forgotten. Throws a refusal. */
  act(step: number, line: string): string {
    const told = this.world.change(step, line);
    const later = this.deeds.findIndex((deed) => deed.step > step);
    if (later >= 0) this.deeds.length = later;
    this.deeds.push({ step, line, told });
    this.trace.changedAt(step);
    if (this.other && !kItsOwn.test(line)) {
      this.other.world.change(step, line);
      this.other.trace.changedAt(step);
    }
    return told;
  }

  /** Takes the last deed back, a drag as a whole. Gives the step of it. */
  undo(): number | undefined {
    const last = this.deeds.pop();
    if (!last) return undefined;
    let count = 1;
    const body = /^(?:drag|drop) (@\d+)/.exec(last.line)?.[1];
    const begins = (deed: Deed) => deed.line.startsWith(`drag ${body} `);
    while (body && this.deeds.length > 0 && begins(this.deeds[this.deeds.length - 1])) {
      this.deeds.pop();
      ++count;
    }
    const step = this.world.undo(count);
    this.trace.changedAt(step);
    this.other?.world.close(); // it is made anew when it is looked at
    this.other = null;
    return step;
  }

  /** The same run as reference, or by the paper's rule from the fork on, with the same deeds. */
  beside(kind: Beside, past = this.prepared): LiveTrace {
    if (this.other?.kind === kind) return this.other.trace;
    this.other?.world.close();
    const { head } = this.prepared;
    const world = this.engine.open(head.toml, kind === 'reference' ? 'reference' : head.mode);
    if (kind === 'paper') for (const line of kPaper) world.change(this.fork, line);
    const before = kind === 'reference' && past.head.steps >= this.fork ? past : this.prepared;
    const trace = new LiveTrace(world, before, this.fork, kind === 'reference' ? 'reference' : 'the paper’s rule', kind === 'reference' ? kind : head.mode);
    for (const deed of this.deeds) if (!kItsOwn.test(deed.line)) world.change(deed.step, deed.line);
    if (this.deeds.length > 0) trace.changedAt(Math.min(...this.deeds.map((deed) => deed.step)));
    this.other = { kind, world, trace };
    return trace;
  }

  settings(step: number): Record<string, number | string | boolean | number[]> {
    return this.world.settings(step);
  }
  hands(step: number): Hand[] {
    return this.world.hands(step);
  }
  why(step: number, a: number, b: number): Reason {
    return this.world.why(step, a, b);
  }
  approach(step: number): boolean {
    return this.trace.reach(step);
  }
  resultsOf(step: number): string[] {
    return this.trace.results.get(step) ?? this.world.step(step).results;
  }
  close(): void {
    this.world.close();
    this.other?.world.close();
  }
}

/** The engine's look into steps of a prepared run. */
export class Probe {
  private readonly world: World;
  private readonly results = new Map<number, string[]>();
  private reached = 0;

  constructor(engine: Engine, trace: Trace) {
    this.world = engine.open(trace.head.toml, trace.head.mode);
  }

  /** Goes towards a step for a few milliseconds; true when it is there. */
  approach(step: number): boolean {
    if (this.reached > step) this.reached = step - 1;
    const until = performance.now() + 12;
    while (this.reached < step - 1 && performance.now() < until) {
      this.reached = Math.min(step - 1, this.reached + 10);
      this.world.see(this.reached);
    }
    return this.reached >= step - 1;
  }
  resultsOf(step: number): string[] {
    let found = this.results.get(step);
    if (!found) this.results.set(step, found = this.world.step(step).results);
    return found;
  }
  why(step: number, a: number, b: number): Reason {
    return this.world.why(step, a, b);
  }
}
