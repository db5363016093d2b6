// A recorded run: places, contacts and decisions at each time step.
import type { Criterion, EventRow, Head, Packed } from './head';
import { type ShortName, shortNames, withShortNames, written } from './names';
import { type BodyTrack, ByPair, type Column, type ContactTrack, type DecisionTrack, type Inside, endOf, placeIn, readBody, readContact, readDecision, readEvents, readInside, stepOf } from './tracks';
import { Unpacker } from './unpack';

/** A quantity that is kept in codes: some spread evenly, some over many decades. */
export type Scale = (code: number) => number;

export interface Pose {
  x: number;
  y: number;
  angle: number;
}

export interface Contact {
  track: ContactTrack;
  a: number;
  b: number;
  mu: number;
  x: number;
  y: number;
  nx: number;
  ny: number;
  gap: number;
  lambdaN: number;
  lambdaT: number;
  wN: number;
  wT: number;
  state: 'broken' | 'sticking' | 'sliding';
  internal: boolean;
  fresh: boolean;
}

/** Along the normal and along the tangent [N s]. */
export type Impulse = [normal: number, tangent: number];

/** Before and after the single sweep, and with which the full solve begins. */
export interface Impulses {
  warm: Impulse;
  swept: Impulse;
  begin: Impulse;
  inner: boolean;
}

export interface Decision {
  a: number;
  b: number;
  criterion: Criterion;
  value: number;
  threshold: number;
  count: number;
  needed: number;
  passed: boolean;
}

export interface Stats {
  active: number;
  collections: number;
  asleep: number;
  contacts: number;
  internal: number;
  penetration: number;
  kinetic: number;
  potential: number;
  px: number;
  py: number;
  angular: number;
}

const kStats = 11;
export const kStates = ['broken', 'sticking', 'sliding'] as const;

function logarithmic(floor: number, steps: number): Scale {
  return (code) => Math.sign(code) * floor * (2 ** (Math.abs(code) / steps) - 1);
}

/** The data of a run, and the meaning of its columns. */
export interface TraceParts {
  head: Head;
  label: string;
  world: number;
  bodies: BodyTrack[];
  contacts: ContactTrack[];
  decisions: DecisionTrack[];
  insides: Map<number, Inside>;
  stats: Column[]; // a column for each number, a sample for each step
  amount: Scale;
  fine: Scale;
}

/** A packed run, as it is in the page. */
export function partsOf(packed: Packed): TraceParts {
  const { head, label, world } = packed;
  const read = new Unpacker(packed.data);
  const { full, every, criteria } = head;
  const parts: TraceParts = {
    head, label, world, bodies: [], contacts: [], decisions: [], insides: new Map(), stats: [],
    amount: logarithmic(head.amount[0], head.amount[1]), fine: logarithmic(1e-6, 1024),
  };
  const long = head.keyframes !== undefined;
  for (let i = 0; i < head.bodies.length; ++i) parts.bodies.push(readBody(read, full, long));
  if (full) {
    for (let n = read.number(), i = 0; i < n; ++i) parts.contacts.push(readContact(read, every, i));
    for (let n = read.number(); n > 0; --n) parts.decisions.push(readDecision(read, every, criteria));
    for (let n = read.number(); n > 0; --n) {
      const inside = readInside(read);
      parts.insides.set(inside.step, inside);
    }
  }
  for (let i = 0; i < kStats; ++i) parts.stats.push(read.column());
  if (long) head.events = readEvents(read, head.event_types ?? [], head.event_reasons ?? []);
  return parts;
}

export class Trace {
  readonly head: Head;
  readonly label: string;
  /** Runs of the same scene are of one world. */
  readonly world: number;
  readonly bodies: BodyTrack[];
  readonly contacts: ContactTrack[];
  readonly decisions: DecisionTrack[];
  readonly eventsAt = new Map<number, EventRow[]>();
  protected readonly insides: Map<number, Inside>;
  protected readonly slots = new Map<number, number>();
  protected readonly contactsOf: ByPair<ContactTrack>;
  protected readonly decisionsOf: ByPair<DecisionTrack>;
  private shorts: ShortName[] = [];
  private shortOf = new Map<string, string>();
  private readonly statColumns: Column[];
  private readonly amount: Scale;
  private readonly fine: Scale;

  constructor(parts: TraceParts) {
    this.head = parts.head;
    this.label = parts.label;
    this.world = parts.world;
    this.bodies = parts.bodies;
    this.contacts = parts.contacts;
    this.decisions = parts.decisions;
    this.insides = parts.insides;
    this.statColumns = parts.stats;
    this.amount = parts.amount;
    this.fine = parts.fine;
    this.contactsOf = new ByPair(this.contacts);
    this.decisionsOf = new ByPair(this.decisions);
    for (const row of this.head.events) this.addEvent(row);
    for (const [id, slot] of this.head.colors) this.slots.set(id, slot);
  }

  protected addEvent(row: EventRow): void {
    const list = this.eventsAt.get(row[0]);
    if (list) list.push(row);
    else this.eventsAt.set(row[0], [row]);
  }

  /** Whether a step is known, or can be made to be: a live run goes on to it. */
  reach(step: number): boolean {
    return step <= this.head.steps;
  }

  /** Its short name. */
  name(body: number): string {
    return written(this.short(body));
  }
  short(body: number): ShortName {
    this.shorten();
    return this.shorts[body];
  }
  /** A sentence of the engine, with short names. */
  told(text: string): string {
    this.shorten();
    return withShortNames(text, this.shortOf);
  }
  /** A live run adds bodies, and forgets them again. */
  private shorten(): void {
    const { bodies } = this.head;
    if (this.shorts.length === bodies.length && this.shortOf.has(bodies[bodies.length - 1]?.name)) return;
    this.shorts = shortNames(this.head.bodies);
    this.shortOf = new Map(this.head.bodies.map((body, i) => [body.name, written(this.shorts[i])]));
  }

  /** The time after a step [s]. */
  timeAt(step: number): number {
    return step * this.head.h;
  }
  /** The length of a step [s]. */
  lengthOf(_step: number): number {
    return this.head.h;
  }
  /** The step that ends at a time, with fractions. */
  stepAt(time: number): number {
    return time / this.head.h;
  }

  present(body: number, step: number): boolean {
    const track = this.bodies[body];
    return step >= track.first && step < endOf(track);
  }

  pose(body: number, step: number): Pose {
    const track = this.bodies[body];
    const [i, part] = placeIn(track, step);
    const between = (column: Column) => (part === 0 ? column[i] : column[i] + part * (column[i + 1] - column[i]));
    return {
      x: between(track.x) * this.head.length,
      y: between(track.y) * this.head.length,
      angle: between(track.angle) * this.head.angle,
    };
  }

  velocity(body: number, step: number): { vx: number; vy: number; omega: number } {
    const track = this.bodies[body];
    const [i] = placeIn(track, step);
    if (track.vx && track.vy && track.omega) {
      return { vx: this.amount(track.vx[i]), vy: this.amount(track.vy[i]), omega: this.amount(track.omega[i]) };
    }
    // Of the way that ends at this step; of keyframes the way that this step lies on.
    const [from, to] = track.at && track.at[i] < step ? [i, Math.min(i + 1, track.x.length - 1)] : [Math.max(0, i - 1), i];
    const dt = Math.max(1, stepOf(track, to) - stepOf(track, from)) * this.head.h;
    return {
      vx: ((track.x[to] - track.x[from]) * this.head.length) / dt,
      vy: ((track.y[to] - track.y[from]) * this.head.length) / dt,
      omega: ((track.angle[to] - track.angle[from]) * this.head.angle) / dt,
    };
  }

  collection(body: number, step: number): number {
    const track = this.bodies[body];
    return this.present(body, step) ? track.collection[placeIn(track, step)[0]] : -1;
  }

  asleep(body: number, step: number): boolean {
    const track = this.bodies[body];
    return this.present(body, step) && track.asleep[placeIn(track, step)[0]] === 1;
  }

  slot(collection: number): number {
    return this.slots.get(collection) ?? 0;
  }

  stats(step: number): Stats {
    const [active, collections, asleep, contacts, internal, penetration, kinetic, potential, px, py, angular] =
      this.statColumns.map((column) => column[Math.floor(step / (this.head.keyframes ?? 1))] ?? 0);
    const fine = this.fine;
    return {
      active, collections, asleep, contacts, internal,
      penetration: fine(penetration), kinetic: fine(kinetic), potential: fine(potential),
      px: fine(px), py: fine(py), angular: fine(angular),
    };
  }

  /** A contact point at a step, seen from where its bodies are at `posed`. */
  contact(track: ContactTrack, step: number, posed = step): Contact | null {
    const i = track.spans.at(step);
    if (i < 0 || !this.present(track.a, posed)) return null;
    const frame = this.pose(track.a, posed);
    const c = Math.cos(frame.angle);
    const s = Math.sin(frame.angle);
    const x = track.x[i] * this.head.length;
    const y = track.y[i] * this.head.length;
    const normal = track.normal[i] * this.head.angle + frame.angle;
    return {
      track, a: track.a, b: track.b, mu: track.mu,
      x: frame.x + c * x - s * y,
      y: frame.y + s * x + c * y,
      nx: Math.cos(normal),
      ny: Math.sin(normal),
      gap: this.amount(track.gap[i]),
      lambdaN: this.amount(track.lambdaN[i]),
      lambdaT: this.amount(track.lambdaT[i]),
      wN: this.amount(track.wN[i]),
      wT: this.amount(track.wT[i]),
      state: kStates[track.state[i]],
      internal: track.internal[i] === 1,
      fresh: track.fresh[i] === 1,
    };
  }

  contactsAt(step: number, posed = step): Contact[] {
    const out: Contact[] = [];
    for (const track of this.contacts) {
      const contact = this.contact(track, step, posed);
      if (contact) out.push(contact);
    }
    return out;
  }

  /** The impulses of a contact inside a step, where they were kept. */
  impulses(track: ContactTrack, step: number): Impulses | null {
    const inside = this.insides.get(step);
    const i = inside?.place.get(track.id);
    if (!inside || i === undefined) return null;
    return {
      warm: [this.amount(inside.warmN[i]), this.amount(inside.warmT[i])],
      swept: [this.amount(inside.sweptN[i]), this.amount(inside.sweptT[i])],
      begin: [this.amount(inside.beginN[i]), this.amount(inside.beginT[i])],
      inner: inside.inner[i] === 1,
    };
  }

  /** Whether something was swept in a step; unknown where its inside was not kept. */
  sweeping(step: number): boolean | undefined {
    return this.insides.get(step)?.sweeping;
  }

  /** The step whose inside was kept that is nearest, if any. */
  nearestInside(step: number): number | undefined {
    let best: number | undefined;
    for (const at of this.insides.keys()) {
      if (best === undefined || Math.abs(at - step) < Math.abs(best - step)) best = at;
    }
    return best;
  }

  tracksOf(a: number, b: number): ContactTrack[] {
    return this.contactsOf.find(a, b);
  }

  decisionTracksOf(a: number, b: number): DecisionTrack[] {
    return this.decisionsOf.find(a, b);
  }

  decision(track: DecisionTrack, step: number): Decision | null {
    const i = track.spans.at(step);
    return i < 0 ? null : this.decisionSample(track, i);
  }

  decisionSample(track: DecisionTrack, i: number): Decision {
    return {
      a: track.a, b: track.b, criterion: track.criterion,
      value: this.amount(track.value[i]),
      threshold: track.criterion.threshold,
      count: track.count[i],
      needed: track.criterion.needed,
      passed: track.passed[i] === 1,
    };
  }

  decisionsAt(step: number): Decision[] {
    const out: Decision[] = [];
    for (const track of this.decisions) {
      const decision = this.decision(track, step);
      if (decision) out.push(decision);
    }
    return out;
  }

  members(collection: number, step: number): number[] {
    const out: number[] = [];
    for (let body = 0; body < this.bodies.length; ++body) {
      if (this.collection(body, step) === collection) out.push(body);
    }
    return out;
  }

  /** Steps with events, ascending. */
  eventSteps(types?: readonly string[]): number[] {
    const wanted = (rows: EventRow[]) => !types || rows.some((row) => types.includes(row[1]));
    return [...this.eventsAt].filter(([, rows]) => wanted(rows)).map(([step]) => step).sort((a, b) => a - b);
  }
}
