// The state of the page: run, step, stage, selection; and its listeners.
import type { Engine } from './engine';
import { type Beside, LiveRun, Probe } from './live_run';
import { kLast } from './stages';
import type { Trace } from './trace';

export type Selection =
  | { kind: 'body'; body: number }
  | { kind: 'pair'; a: number; b: number }
  | null;

export const kLayers = [
  { id: 'contacts', label: 'Contacts' },
  { id: 'forces', label: 'Forces' },
  { id: 'graph', label: 'Merged pairs' },
  { id: 'boxes', label: 'Boxes' },
  { id: 'velocities', label: 'Velocity' },
  { id: 'heat', label: 'Near a limit' },
  { id: 'ghost', label: 'Reference' },
  { id: 'labels', label: 'Names' },
  { id: 'beside', label: 'Beside' },
] as const;
export type LayerId = (typeof kLayers)[number]['id'];
/** Layers that need a run without merging. */
export const kOfReference: readonly LayerId[] = ['ghost', 'beside'];

/** The action of a pointer on a body of a live run. */
export type Tool = 'drag' | 'push' | 'throw' | 'pin' | 'box' | 'disc' | 'delete' | 'ask';

export class State {
  step = 0;
  stage = kLast;
  playing = false;
  speed = 1;
  selection: Selection = null;
  tool: Tool = 'drag';
  besideKind: Beside = 'reference';
  /** The reason why playing stopped, or a command was refused; told until something else happens. */
  notice = '';
  /** Of the page's words: en, de or fr. */
  language = 'en';
  /** Whether elements that show the answer of an open question are hidden. */
  veiled = false;
  readonly layers = new Set<LayerId>(['contacts']);
  trace: Trace;
  live: LiveRun | null = null;
  engine: Engine | null = null;
  private kept: LiveRun | null = null; // the last run, one key away
  private readonly probes = new Map<Trace, Probe>();
  private readonly listeners: (() => void)[] = [];
  private readonly engineListeners: (() => void)[] = [];

  constructor(readonly traces: Trace[]) {
    this.trace = traces[0];
  }

  /** The prepared run that is shown, or that was taken over. */
  get prepared(): Trace {
    return this.live?.prepared ?? this.trace;
  }
  /** The runs of the scene that is shown; the first of them is the usual one. */
  get runs(): Trace[] {
    const { world } = this.trace;
    return this.traces.filter((trace) => trace.world === world);
  }
  get reference(): Trace | undefined {
    const recorded = this.runs.find((trace) => trace.head.mode === 'reference');
    if (!this.live) return recorded;
    const beside = this.live.beside(this.besideKind, recorded);
    beside.reach(this.step);
    return beside;
  }
  get hasReference(): boolean {
    return this.live !== null || this.runs.some((trace) => trace.head.mode === 'reference');
  }
  /** A number among the settings in force, by its key in scene files. */
  setting(key: string): number | undefined {
    if (this.live) return Number(this.live.settings(this.step)[key]);
    const [table, name] = key.split('.');
    const value = (this.trace.head.parameters[table] as Record<string, unknown> | undefined)?.[name];
    return typeof value === 'number' ? value : undefined;
  }
  get steps(): number {
    return this.trace.head.steps;
  }
  get time(): number {
    return this.trace.timeAt(this.step);
  }
  /** The first step that can be reached: a run that was taken over begins there. */
  get first(): number {
    return this.live?.fork ?? 0;
  }

  /** Called when the engine has been read. */
  onEngine(listener: () => void): void {
    this.engineListeners.push(listener);
  }
  setEngine(engine: Engine): void {
    this.engine = engine;
    for (const listener of this.engineListeners) listener();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }
  changed(): void {
    for (const listener of this.listeners) listener();
  }

  goTo(step: number, stage = kLast): void {
    this.notice = '';
    const wanted = Math.max(0, Math.round(step));
    try {
      this.step = this.trace.reach(wanted) ? wanted : this.steps;
    } catch (error) {
      this.playing = false;
      this.notice = String(error instanceof Error ? error.message : error);
    }
    this.stage = this.step === 0 ? kLast : stage;
    this.changed();
  }

  /** Through the stages; before the first one is the end of the step before. */
  moveStage(by: number): void {
    const now = this.step * kStagesPerStep + this.stage + by;
    const step = Math.floor(now / kStagesPerStep);
    if (step < 0 || !this.trace.reach(step)) return;
    this.goTo(step, now - step * kStagesPerStep);
  }

  pause(why = ''): void {
    this.playing = false;
    this.notice = why;
    this.changed();
  }

  /** Where playing has to stop on its way, as before a question. */
  stopBefore: (from: number, to: number) => { step: number; why: string } | undefined = () => undefined;
  /** The commands by hand before the next steps of a live run. */
  beforeSteps: () => void = () => {};

  nextEvent(types: readonly string[] | undefined, direction: 1 | -1): boolean {
    const steps = this.trace.eventSteps(types);
    const found = direction > 0
      ? steps.find((step) => step > this.step)
      : steps.reverse().find((step) => step < this.step);
    if (found === undefined) return false;
    this.goTo(found);
    return true;
  }

  /** Goes on from here by the engine; false where the page has none. */
  takeOver(): boolean {
    if (this.live) return true;
    if (!this.engine) return false;
    this.veiled = false;
    this.kept?.close();
    this.kept = null;
    this.live = new LiveRun(this.engine, this.trace, this.step);
    this.trace = this.live.trace;
    this.goTo(this.step);
    return true;
  }
  /** Shows the prepared run again, at the same step. */
  giveBack(): void {
    if (!this.live) return;
    const { prepared } = this.live;
    this.kept = this.live;
    this.live = null;
    this.trace = prepared;
    this.playing = false;
    this.goTo(Math.min(this.step, prepared.head.steps));
  }
  get hasKept(): boolean {
    return this.kept !== null && !this.live;
  }
  showKept(): void {
    if (!this.kept || this.live) return;
    this.live = this.kept;
    this.kept = null;
    this.trace = this.live.trace;
    this.goTo(Math.max(this.step, this.live.fork));
  }

  /** Executes a command by hand, from the next step on. A refusal is told. */
  act(line: string): boolean {
    if (!this.live) return false;
    try {
      this.live.act(Math.max(this.step, this.live.fork), line);
      this.notice = '';
    } catch (error) {
      this.notice = String(error instanceof Error ? error.message : error);
      this.changed();
      return false;
    }
    this.goTo(Math.max(this.step, this.live.fork));
    return true;
  }
  undo(): void {
    const step = this.live?.undo();
    if (step !== undefined) this.goTo(step);
  }

  /** Looks into steps of the run that is shown; null where the page has no engine. */
  get probe(): Probe | LiveRun | null {
    if (this.live) return this.live;
    if (!this.engine || !this.trace.head.full) return null;
    let probe = this.probes.get(this.trace);
    if (!probe) this.probes.set(this.trace, probe = new Probe(this.engine, this.trace));
    return probe;
  }
}

const kStagesPerStep = kLast + 1;
