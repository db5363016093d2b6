// A run that the reader has taken over: the engine simulates it, this keeps it as the page keeps a prepared one.
import type { StateText, StepText, World } from './engine';
import type { Head } from './head';
import type { BodyTrack, ContactTrack, DecisionTrack, Samples } from './tracks';
import { Trace } from './trace';

/** Samples that come step by step. */
class GrowingSamples implements Samples {
  readonly list: number[] = []; // steps, ascending

  at(step: number): number {
    let low = 0;
    let high = this.list.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.list[middle] < step) low = middle + 1;
      else high = middle;
    }
    return this.list[low] === step ? low : -1;
  }
  *steps(): Generator<[number, number]> {
    for (const [i, step] of this.list.entries()) yield [step, i];
  }
  /** How many samples there are up to a step. */
  upTo(step: number): number {
    let n = this.list.length;
    while (n > 0 && this.list[n - 1] > step) --n;
    return n;
  }
}

const kBodyColumns = ['x', 'y', 'angle', 'vx', 'vy', 'omega', 'collection', 'asleep'] as const;
const kContactColumns = ['x', 'y', 'normal', 'gap', 'lambdaN', 'lambdaT', 'wN', 'wT', 'state', 'internal', 'fresh'] as const;
const kDecisionColumns = ['value', 'count', 'passed'] as const;

type Growing<T, K extends string> = Omit<T, K | 'spans'> & Record<K, number[]> & { spans: GrowingSamples };
type LiveContact = Growing<ContactTrack, (typeof kContactColumns)[number]>;
type LiveDecision = Growing<DecisionTrack, (typeof kDecisionColumns)[number]>;
type LiveBody = Omit<BodyTrack, (typeof kBodyColumns)[number]> & Record<(typeof kBodyColumns)[number], number[]>;

const columns = <K extends string>(names: readonly K[]) =>
  Object.fromEntries(names.map((name) => [name, [] as number[]])) as Record<K, number[]>;

/** Cuts the samples after the first `n`. */
function cut<K extends string>(track: Record<K, number[]>, names: readonly K[], n: number): void {
  for (const name of names) track[name].length = Math.min(track[name].length, n);
}

const same = (code: number) => code;

export class LiveTrace extends Trace {
  /** The last step that was simulated. */
  known: number;
  /** The results of the stages, by steps. */
  readonly results = new Map<number, string[]>();
  private readonly contactOf = new Map<string, LiveContact>();
  private readonly decisionOf = new Map<string, LiveDecision>();
  private readonly numbers: number[][];
  private readonly times: number[] = [];
  private pace: number; // the length of the steps after the known ones

  constructor(private readonly run: World, prepared: Trace, readonly fork: number, label: string, mode = prepared.head.mode) {
    const head: Head = {
      ...prepared.head, mode, every: 1, keyframes: undefined, length: 1, angle: 1, bodies: [...prepared.head.bodies], steps: Math.max(prepared.head.steps, fork),
      events: prepared.head.events.filter(([step]) => step <= fork),
      colors: [...prepared.head.colors],
      ledger: prepared.head.ledger?.filter(([step]) => step <= fork),
      orders: prepared.head.orders?.filter(([step]) => step <= fork),
      full: true,
    };
    const stats = Array.from({ length: 11 }, () => [] as number[]);
    super({
      head, label, world: prepared.world, bodies: head.bodies.map((_, i) => bodyUpTo(prepared, i, fork)), contacts: [], decisions: [],
      insides: new Map(), stats, amount: same, fine: same,
    });
    this.numbers = stats;
    this.pace = head.h;
    for (let step = 0; step <= fork; ++step) this.times.push(prepared.timeAt(step));
    this.copyStats(prepared, fork);
    this.copyContacts(prepared, fork);
    this.copyDecisions(prepared, fork);
    this.known = fork;
    this.look(fork);
  }

  private copyStats(prepared: Trace, fork: number): void {
    for (let step = 0; step <= fork; ++step) {
      const s = prepared.stats(step);
      [s.active, s.collections, s.asleep, s.contacts, s.internal, s.penetration, s.kinetic, s.potential, s.px, s.py, s.angular]
        .forEach((value, i) => this.numbers[i].push(value));
    }
  }

  private copyContacts(prepared: Trace, fork: number): void {
    if (!prepared.head.full) return;
    const kStates = ['broken', 'sticking', 'sliding'];
    const { length, angle } = prepared.head;
    for (const track of prepared.contacts) {
      const mine = this.newContact(track.a, track.b, track.mu);
      for (const [step, i] of track.spans.steps()) {
        if (step >= fork) break;
        const c = prepared.contact(track, step);
        if (!c) continue;
        mine.spans.list.push(step);
        const values = [track.x[i] * length, track.y[i] * length, track.normal[i] * angle, c.gap, c.lambdaN, c.lambdaT, c.wN, c.wT,
          kStates.indexOf(c.state), Number(c.internal), Number(c.fresh)];
        kContactColumns.forEach((name, at) => mine[name].push(values[at]));
      }
    }
  }

  private copyDecisions(prepared: Trace, fork: number): void {
    for (const track of prepared.decisions) {
      const { stage, criterion, equation, threshold, needed } = track.criterion;
      const mine = this.decisionTrack(track.a, track.b, stage, criterion, equation, threshold, needed);
      for (const [step, i] of track.spans.steps()) {
        if (step > fork) break;
        const d = prepared.decisionSample(track, i);
        mine.spans.list.push(step);
        [d.value, d.count, Number(d.passed)].forEach((value, at) => mine[kDecisionColumns[at]].push(value));
      }
    }
  }

  private newContact(a: number, b: number, mu: number): LiveContact {
    const track: LiveContact = { id: this.contacts.length, a, b, mu, spans: new GrowingSamples(), ...columns(kContactColumns) };
    this.contacts.push(track);
    this.contactsOf.add(track);
    return track;
  }

  private decisionTrack(a: number, b: number, stage: string, criterion: string, equation: string, threshold: number, needed: number): LiveDecision {
    const key = [a, b, stage, criterion, threshold, needed].join('|');
    let track = this.decisionOf.get(key);
    if (!track) {
      track = { a, b, criterion: { stage, criterion, equation, threshold, needed }, spans: new GrowingSamples(), ...columns(kDecisionColumns) };
      this.decisionOf.set(key, track);
      this.decisions.push(track);
      this.decisionsOf.add(track);
    }
    return track;
  }

  override timeAt(step: number): number {
    const known = this.times.length - 1;
    return step <= known ? this.times[step] : this.times[known] + (step - known) * this.pace;
  }
  override lengthOf(step: number): number {
    return step > 0 && step < this.times.length ? this.times[step] - this.times[step - 1] : this.pace;
  }
  override stepAt(time: number): number {
    const after = this.times.findIndex((t) => t > time);
    if (after < 0) return this.times.length - 1 + (time - this.times[this.times.length - 1]) / this.pace;
    return after === 0 ? 0 : after - 1 + (time - this.times[after - 1]) / this.lengthOf(after);
  }

  override reach(step: number): boolean {
    while (this.known < step) this.add(this.run.step(this.known + 1));
    this.head.steps = Math.max(this.head.steps, this.known);
    return true;
  }

  /** Forgets the steps after a step, and looks anew at the state with the changes made there. */
  changedAt(step: number): void {
    this.known = Math.min(this.known, step);
    this.forgetAfter(step);
    this.head.bodies.splice(0, Infinity, ...this.run.bodies());
    for (let i = this.bodies.length; i < this.head.bodies.length; ++i) this.bodies.push(newBody(step));
    this.bodies.length = this.head.bodies.length;
    this.look(step);
  }

  private forgetAfter(step: number): void {
    for (const track of this.bodies as LiveBody[]) cut(track, kBodyColumns, Math.max(0, step + 1 - track.first));
    for (const track of this.contacts as LiveContact[]) this.cutTrack(track, kContactColumns, step);
    for (const track of this.decisions as LiveDecision[]) this.cutTrack(track, kDecisionColumns, step);
    this.times.length = Math.min(this.times.length, step + 1);
    for (const column of this.numbers) column.length = Math.min(column.length, step + 1);
    for (const map of [this.eventsAt, this.insides, this.results]) {
      for (const at of map.keys()) if (at > step) map.delete(at);
    }
    this.head.ledger = this.head.ledger?.filter(([at]) => at <= step);
    this.head.orders = this.head.orders?.filter(([at]) => at <= step);
  }

  private cutTrack<K extends string>(track: Record<K, number[]> & { spans: GrowingSamples }, names: readonly K[], step: number): void {
    const n = track.spans.upTo(step);
    track.spans.list.length = n;
    cut(track, names, n);
  }

  /** The state after a step once more, as the engine has it: exact, and with the changes made there. */
  private look(step: number): void {
    const seen = this.run.see(step);
    for (const track of this.bodies as LiveBody[]) cut(track, kBodyColumns, Math.max(0, step - track.first));
    for (const track of this.contacts as LiveContact[]) this.cutTrack(track, kContactColumns, step - 1);
    this.addBodies(seen, step);
    this.addContacts(seen, step);
    seen.stats.forEach((value, i) => { this.numbers[i][step] = value; });
    this.times[step] = seen.t;
    this.pace = Number(this.run.settings(step).step);
    for (const [id, slot] of seen.colors) this.slots.set(id, slot);
  }

  private add(step: StepText): void {
    const k = step.step;
    this.addBodies(step, k);
    const tracks = this.addContacts(step, k);
    for (const [a, b, stage, criterion, equation, threshold, needed, value, count, passed] of step.decisions) {
      const track = this.decisionTrack(a, b, stage, criterion, equation, threshold, needed);
      track.spans.list.push(k);
      [value, count, passed].forEach((number, i) => track[kDecisionColumns[i]].push(number));
    }
    step.stats.forEach((value, i) => { this.numbers[i][k] = value; });
    this.times[k] = step.t;
    for (const row of step.events) this.addEvent(row);
    for (const [id, slot] of step.colors) this.slots.set(id, slot);
    this.head.ledger?.push(...step.ledger);
    if (step.order.length > 0) this.head.orders?.push([k, step.order]);
    this.addInside(step, tracks);
    this.results.set(k, step.results);
    this.known = k;
  }

  private addBodies(seen: StateText, step: number): void {
    for (const [i, ...values] of seen.bodies) {
      const track = this.bodies[i] as LiveBody;
      if (track.x.length === 0) track.first = step;
      const [x, y, angle, vx, vy, omega, collection, asleep] = values;
      [x, y, angle, vx, vy, omega, collection, asleep].forEach((value, at) => track[kBodyColumns[at]].push(value));
    }
  }

  private addContacts(seen: StateText, step: number): LiveContact[] {
    return seen.contacts.map(([a, b, feature, mu, ...values]) => {
      const key = `${a}|${b}|${feature}`;
      let track = this.contactOf.get(key);
      if (!track) this.contactOf.set(key, track = this.newContact(a, b, mu));
      track.mu = mu;
      if (track.spans.at(step) >= 0) return track;
      track.spans.list.push(step);
      const mine = track;
      kContactColumns.forEach((name, at) => mine[name].push(values[at]));
      return track;
    });
  }

  private addInside(step: StepText, tracks: LiveContact[]): void {
    const column = (at: number) => step.inside.map((row) => row[at]);
    this.insides.set(step.step, {
      step: step.step, sweeping: step.sweeping, place: new Map(step.inside.map(([contact], i) => [tracks[contact]?.id ?? -1, i])),
      warmN: column(1), warmT: column(2), sweptN: column(3), sweptT: column(4), beginN: column(5), beginT: column(6), inner: column(7),
    });
  }
}

function newBody(first: number): LiveBody {
  return { first, ...columns(kBodyColumns) };
}

/** A body of the prepared run up to a step, in metres; of a long run that step alone, since all would not fit into memory. */
function bodyUpTo(prepared: Trace, body: number, last: number): LiveBody {
  const { first } = prepared.bodies[body];
  const track = newBody(prepared.head.keyframes === undefined ? first : Math.max(first, last));
  for (let step = track.first; step <= last && prepared.present(body, step); ++step) {
    const { x, y, angle } = prepared.pose(body, step);
    const { vx, vy, omega } = prepared.velocity(body, step);
    [x, y, angle, vx, vy, omega, prepared.collection(body, step), Number(prepared.asleep(body, step))]
      .forEach((value, at) => track[kBodyColumns[at]].push(value));
  }
  return track;
}
