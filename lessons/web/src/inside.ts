// Quantities inside a time step: impulses before and after the single sweep and the full solve.
import { kLast, kSolve, kSweep, kStages, kUnmerge } from './stages';
import type { State } from './state';
import type { Contact, Impulse } from './trace';

/** The stages whose work are impulses. */
const kOfImpulses = ['WarmStart', 'SingleIterationPGS', 'SolveLCP'];

/** What a stage did to the impulse of a contact. */
export interface Change {
  contact: Contact; // after the stage
  before: Impulse;
  after: Impulse;
  was: Contact['state'] | 'new'; // as the last step left it
}

/** Contacts with the impulses that they have after the stage; where that was not kept, of the step's end. */
export function contactsOfStage(state: State, posed = state.step): Contact[] {
  const { trace, step, stage } = state;
  if (!trace.head.full) return [];
  return trace.contactsAt(step, posed).map((contact) => {
    const kept = trace.impulses(contact.track, step);
    if (!kept || stage === kLast) return contact;
    const internal = kept.inner && (stage < kUnmerge || contact.internal);
    if (stage >= kSolve) return { ...contact, internal };
    const [lambdaN, lambdaT] = stage < kSweep ? kept.warm : stage === kSweep ? kept.swept : kept.begin;
    return { ...contact, internal, lambdaN, lambdaT, state: stateOf(lambdaN, lambdaT, contact.mu) };
  });
}

/** Codes are rounded: what is within half a percent of the cone is on its edge. */
function stateOf(normal: number, tangent: number, mu: number): Contact['state'] {
  if (normal <= 0) return 'broken';
  return Math.abs(tangent) >= 0.995 * mu * normal ? 'sliding' : 'sticking';
}

/** Whether this stage is about impulses, and what shows is one stage of a step. */
export function aboutImpulses(state: State): boolean {
  return !state.playing && state.step > 0 && state.trace.head.full && kOfImpulses.includes(kStages[state.stage].id);
}

/** What the stage did to a contact of `contactsOfStage`; null where it does nothing, or that was not kept. */
export function changeOf(state: State, contact: Contact): Change | null {
  const { trace, step, stage } = state;
  const kept = trace.impulses(contact.track, step);
  const solved = stage === kSolve;
  if (!kept || !aboutImpulses(state) || (solved && contact.internal)) return null;
  const last = trace.contact(contact.track, step - 1);
  return {
    contact, before: solved ? kept.begin : kept.warm, after: [contact.lambdaN, contact.lambdaT], was: last?.state ?? 'new',
  };
}

/** How much an impulse changed [N s]. */
function sizeOf({ before, after }: Change): number {
  return Math.hypot(after[0] - before[0], after[1] - before[1]);
}

/** More than rounding. */
export function changed(change: Change): boolean {
  return sizeOf(change) > 0.01 * Math.max(Math.hypot(...change.before), Math.hypot(...change.after));
}

/** What the stage did to all that it works on, the largest changes first, of equal ones the largest impulses. */
export function changesAt(state: State, contacts = contactsOfStage(state)): Change[] {
  return contacts.map((contact) => changeOf(state, contact)).filter((change) => change !== null)
    .sort((p, q) => sizeOf(q) - sizeOf(p) || Math.hypot(...q.after) - Math.hypot(...p.after));
}
