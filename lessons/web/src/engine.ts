// The engine itself, compiled to WebAssembly: lessons/web/engine/engine.cpp.
import { unzlibSync } from 'fflate';

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  reserve(size: number): number;
  result(): number;
  resultSize(): number;
  openWorld(): number;
  closeWorld(world: number): void;
  skipTo(world: number, step: number): number;
  stepWorld(world: number): number;
  seeWorld(world: number): number;
  traceWorld(world: number, step: number): number;
  saveWorld(world: number): number;
  restoreWorld(world: number): number;
  pushBody(world: number, body: number, x: number, y: number, px: number, py: number): void;
  dragBody(world: number, body: number, gx: number, gy: number, x: number, y: number): void;
  letGo(world: number, body: number): void;
  dragForce(world: number, body: number, axis: number): number;
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

  open(toml: string, mode: string): World {
    this.write(new TextEncoder().encode(`${mode}\n${toml}`));
    return new World(this, this.done(this.exports.openWorld()));
  }
}

export class World {
  constructor(private readonly engine: Engine, private readonly handle: number) {}

  /** A step, with all that the page shows of one: lessons/step_text.cpp. */
  step(): unknown {
    this.engine.done(this.engine.exports.stepWorld(this.handle));
    return JSON.parse(this.engine.text());
  }
  see(): unknown {
    this.engine.done(this.engine.exports.seeWorld(this.handle));
    return JSON.parse(this.engine.text());
  }
  skipTo(step: number): void {
    this.engine.done(this.engine.exports.skipTo(this.handle, step));
  }
  /** The lines of the trace up to a step. */
  traceBytes(step: number): Uint8Array {
    this.engine.done(this.engine.exports.traceWorld(this.handle, step));
    return this.engine.read();
  }
  trace(step: number): string {
    return new TextDecoder().decode(this.traceBytes(step));
  }
  save(): Uint8Array {
    this.engine.done(this.engine.exports.saveWorld(this.handle));
    return this.engine.read();
  }
  restore(bytes: Uint8Array): void {
    this.engine.write(bytes);
    this.engine.done(this.engine.exports.restoreWorld(this.handle));
  }
  push(body: number, at: [number, number], impulse: [number, number]): void {
    this.engine.exports.pushBody(this.handle, body, ...at, ...impulse);
  }
  drag(body: number, grip: [number, number], target: [number, number]): void {
    this.engine.exports.dragBody(this.handle, body, ...grip, ...target);
  }
  letGo(body: number): void {
    this.engine.exports.letGo(this.handle, body);
  }
  force(body: number): [number, number] {
    return [0, 1].map((axis) => this.engine.exports.dragForce(this.handle, body, axis)) as [number, number];
  }
  close(): void {
    this.engine.exports.closeWorld(this.handle);
  }
}
