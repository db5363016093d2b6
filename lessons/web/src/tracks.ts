// The columns of a recorded run: lessons/encode.cpp writes them, these read them.
import type { Criterion, EventRow } from './head';
import type { Unpacker } from './unpack';

/** A quantity over samples: codes of a packed run, numbers of a live one. */
export type Column = ArrayLike<number>;

/** When something that comes and goes was there. */
export interface Samples {
  /** The sample of a step, or -1. */
  at(step: number): number;
  /** All sampled steps with their samples. */
  steps(): Iterable<[number, number]>;
}

/** Samples of a packed run. */
export class Spans implements Samples {
  private readonly first: Int32Array;
  private readonly count: Int32Array;
  private readonly sample: Int32Array;
  readonly size: number;

  constructor(read: Unpacker, private readonly every: number) {
    const n = read.number();
    this.first = new Int32Array(n);
    this.count = new Int32Array(n);
    this.sample = new Int32Array(n);
    let total = 0;
    for (let i = 0; i < n; ++i) {
      this.first[i] = read.number();
      this.count[i] = read.number();
      this.sample[i] = total;
      total += this.count[i];
    }
    this.size = total;
  }

  /** The sample of a step, or -1. */
  at(step: number): number {
    const at = Math.floor(step / this.every);
    let low = 0;
    let high = this.first.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.first[middle] <= at) low = middle + 1;
      else high = middle;
    }
    const i = low - 1;
    return i >= 0 && at < this.first[i] + this.count[i] ? this.sample[i] + at - this.first[i] : -1;
  }

  /** All sampled steps with their samples. */
  *steps(): Generator<[number, number]> {
    for (let i = 0; i < this.first.length; ++i) {
      for (let j = 0; j < this.count[i]; ++j) {
        yield [(this.first[i] + j) * this.every, this.sample[i] + j];
      }
    }
  }
}

export interface BodyTrack {
  first: number;
  at?: Column; // steps of the keyframes; without them there is a sample for each step
  x: Column;
  y: Column;
  angle: Column;
  collection: Column;
  asleep: Column;
  vx?: Column;
  vy?: Column;
  omega?: Column;
}

export interface ContactTrack {
  id: number;
  a: number;
  b: number;
  mu: number;
  spans: Samples;
  x: Column;
  y: Column;
  normal: Column;
  gap: Column;
  lambdaN: Column;
  lambdaT: Column;
  wN: Column;
  wT: Column;
  state: Column;
  internal: Column;
  fresh: Column;
}

export interface DecisionTrack {
  a: number;
  b: number;
  criterion: Criterion;
  spans: Samples;
  value: Column;
  count: Column;
  passed: Column;
}

/** The impulses of one step before and after its single sweep, per contact: lessons/impulses.h. */
export interface Inside {
  step: number;
  sweeping: boolean; // something was merged, so that there was a sweep
  place: Map<number, number>; // track to index
  warmN: Column;
  warmT: Column;
  sweptN: Column;
  sweptT: Column;
  beginN: Column; // of the full solve
  beginT: Column;
  inner: Column; // inside a collection during the sweep
}

/** With velocities where each step of a run is recorded in full. */
export function readBody(read: Unpacker, full: boolean, keyframes: boolean): BodyTrack {
  const track: BodyTrack = {
    first: read.number(),
    ...(keyframes ? { at: read.column() } : {}),
    x: read.column(),
    y: read.column(),
    angle: read.column(),
    collection: read.runs(),
    asleep: read.runs(),
  };
  if (full && !keyframes) {
    track.vx = read.column();
    track.vy = read.column();
    track.omega = read.column();
  }
  return track;
}

/** Where a step is among the samples of a body: the last one up to it, and how far it is to the next. */
export function placeIn(track: BodyTrack, step: number): [sample: number, part: number] {
  const { at } = track;
  if (!at) return [step - track.first, 0];
  let low = 0;
  let high = at.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (at[middle] <= step) low = middle + 1;
    else high = middle;
  }
  const i = low - 1;
  return i + 1 < at.length ? [i, (step - at[i]) / (at[i + 1] - at[i])] : [i, 0];
}

/** The first step after the last sample. */
export function endOf(track: BodyTrack): number {
  return track.at ? (track.at[track.at.length - 1] ?? -1) + 1 : track.first + track.x.length;
}

/** The step of a sample. */
export function stepOf(track: BodyTrack, sample: number): number {
  return track.at ? track.at[sample] : track.first + sample;
}

/** The events of a long run, which are packed: in a head they would be most of the page. */
export function readEvents(read: Unpacker, types: string[], reasons: string[]): EventRow[] {
  const [steps, type, a, b, collection, reason] = Array.from({ length: 6 }, () => read.column());
  return Array.from(steps, (step, i) => [step, types[type[i]], a[i], b[i], collection[i], reasons[reason[i]]]);
}

export function readContact(read: Unpacker, every: number, id: number): ContactTrack {
  return {
    id,
    a: read.number(),
    b: read.number(),
    mu: read.number() * 1e-5,
    spans: new Spans(read, every),
    x: read.column(),
    y: read.column(),
    normal: read.column(),
    gap: read.column(),
    lambdaN: read.column(),
    lambdaT: read.column(),
    wN: read.column(),
    wT: read.column(),
    state: read.runs(),
    internal: read.runs(),
    fresh: read.runs(),
  };
}

export function readDecision(read: Unpacker, every: number, criteria: Criterion[]): DecisionTrack {
  return {
    a: read.number(),
    b: read.number(),
    criterion: criteria[read.number()],
    spans: new Spans(read, every),
    value: read.column(),
    count: read.runs(),
    passed: read.runs(),
  };
}

export function readInside(read: Unpacker): Inside {
  const [step, sweeping] = [read.number(), read.number() === 1];
  const place = new Map([...read.column()].map((track, i) => [track, i]));
  const [warmN, warmT] = [read.column(), read.column()];
  const sum = (from: Int32Array, by: Int32Array) => from.map((code, i) => code + by[i]);
  const [sweptN, sweptT] = [sum(warmN, read.column()), sum(warmT, read.column())];
  const [beginN, beginT] = [sum(sweptN, read.column()), sum(sweptT, read.column())];
  return { step, sweeping, place, warmN, warmT, sweptN, sweptT, beginN, beginT, inner: read.runs() };
}

/** The tracks of each pair of bodies. */
export class ByPair<Track extends { a: number; b: number }> {
  private readonly of = new Map<string, Track[]>();
  constructor(tracks: Track[]) {
    for (const track of tracks) this.add(track);
  }
  add(track: Track): void {
    const key = `${track.a}-${track.b}`;
    const list = this.of.get(key);
    if (list) list.push(track);
    else this.of.set(key, [track]);
  }
  find(a: number, b: number): Track[] {
    return this.of.get(`${Math.min(a, b)}-${Math.max(a, b)}`) ?? [];
  }
}
