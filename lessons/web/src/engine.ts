// The engine itself, compiled to WebAssembly: lessons/web/engine/engine.cpp.
import { unzlibSync } from 'fflate';
import type { BodyInfo, EventRow } from './head';

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  reserve(size: number): number;
  result(): number;
  resultSize(): number;
  openWorld(): number;
  closeWorld(world: number): void;
  stepWorld(world: number, step: number): number;
  seeWorld(world: number, step: number): number;
  changeWorld(world: number, step: number): number;
  undoWorld(world: number, count: number): number;
  bodiesOfWorld(world: number): number;
  settingsOfWorld(world: number, step: number): number;
  whyInWorld(world: number, step: number, a: number, b: number): number;
  handsOnWorld(world: number, step: number): number;
  openTraced(): number;
  closeTraced(world: number): void;
  traceWorld(world: number, step: number): number;
}

/** All that the engine asks of its surroundings: room, and a place for a last word. */
function surroundings(): WebAssembly.Imports {
  const none = () => 0;
  return {
    env: { emscripten_notify_memory_growth: none },
    wasi_snapshot_preview1: {
      clock_time_get: none, fd_write: none, fd_close: none, fd_seek: none, environ_sizes_get: none, environ_get: none,
      proc_exit: () => { throw new Error('the engine has stopped'); },
    },
  };
}

export class Engine {
  private constructor(readonly exports: Exports) {}

  /** From base64 of zlib, as it is in the page. */
  static async load(base64: string): Promise<Engine> {
    const packed = Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
    const { instance } = await WebAssembly.instantiate(unzlibSync(packed) as Uint8Array<ArrayBuffer>, surroundings());
    const exports = instance.exports as unknown as Exports;
    exports._initialize();
    return new Engine(exports);
  }

  write(bytes: Uint8Array): void {
    const at = this.exports.reserve(bytes.length);
    new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
  }
  read(): Uint8Array {
    return new Uint8Array(this.exports.memory.buffer, this.exports.result(), this.exports.resultSize()).slice();
  }
  text(): string {
    return new TextDecoder().decode(this.read());
  }
  /** Whatever gives 0 has left the reason. */
  done(result: number): number {
    if (result === 0) throw new Error(this.text());
    return result;
  }

  private opened(toml: string, mode: string, open: () => number): number {
    this.write(new TextEncoder().encode(`${mode}\n${toml}`));
    return this.done(open());
  }
  open(toml: string, mode: string): World {
    return new World(this, this.opened(toml, mode, this.exports.openWorld));
  }
  /** For its trace alone. */
  traced(toml: string, mode: string): TracedWorld {
    return new TracedWorld(this, this.opened(toml, mode, this.exports.openTraced));
  }
  json<T>(result: number): T {
    this.done(result);
    return JSON.parse(this.text()) as T;
  }
}

/** The output of lessons/step_text.cpp. */
export interface StateText {
  step: number;
  t: number; // [s]
  bodies: number[][];
  contacts: number[][];
  decisions: [a: number, b: number, stage: string, criterion: string, equation: string, threshold: number, needed: number,
    value: number, count: number, passed: number][];
  events: EventRow[];
  stats: number[];
  colors: [number, number][];
}
export interface StepText extends StateText {
  sweeping: boolean;
  inside: number[][];
  order: [number, number, number][];
  ledger: number[][];
  results: string[];
}

/** The output of lessons/why.cpp. */
export interface Reason {
  outcome: string;
  condition: { kind: string; measure: string; limit: number; steps: number };
  heading: string;
  text: string;
  outlook: string;
  tests: {
    criterion: string; stage: string; equation: string; verdict: string; value: number; threshold: number;
    count: number; needed: number; unit: string; text: string;
  }[];
}

/** A drag that holds: body, grip, target [m], force [N]. */
export type Hand = [body: number, x: number, y: number, tx: number, ty: number, fx: number, fy: number];

/** A run in the engine: steps in any order, and changes by hand between them (lessons/timeline.h). */
export class World {
  constructor(private readonly engine: Engine, private readonly handle: number) {}

  step(step: number): StepText {
    return this.engine.json(this.engine.exports.stepWorld(this.handle, step));
  }
  /** The state after a step and the changes made there. */
  see(step: number): StateText {
    return this.engine.json(this.engine.exports.seeWorld(this.handle, step));
  }
  /** Executes after a step a command of lessons/hand.h; gives a sentence about the change. Throws a refusal. */
  change(step: number, line: string): string {
    this.engine.write(new TextEncoder().encode(line));
    this.engine.done(this.engine.exports.changeWorld(this.handle, step));
    return this.engine.text();
  }
  /** Takes back the last changes; gives the step of the first of them. */
  undo(count: number): number {
    return this.engine.exports.undoWorld(this.handle, count) - 1;
  }
  bodies(): BodyInfo[] {
    return this.engine.json(this.engine.exports.bodiesOfWorld(this.handle));
  }
  settings(step: number): Record<string, number | string | boolean | number[]> {
    return this.engine.json(this.engine.exports.settingsOfWorld(this.handle, step));
  }
  why(step: number, a: number, b: number): Reason {
    return this.engine.json(this.engine.exports.whyInWorld(this.handle, step, a, b));
  }
  hands(step: number): Hand[] {
    return this.engine.json(this.engine.exports.handsOnWorld(this.handle, step));
  }
  close(): void {
    this.engine.exports.closeWorld(this.handle);
  }
}

export class TracedWorld {
  constructor(private readonly engine: Engine, private readonly handle: number) {}

  /** The lines of the trace up to a step. */
  bytes(step: number): Uint8Array {
    this.engine.done(this.engine.exports.traceWorld(this.handle, step));
    return this.engine.read();
  }
  close(): void {
    this.engine.exports.closeTraced(this.handle);
  }
}
