// The content of the picture at one moment: the layers are drawn from it.
import { groupedAt } from './groups';
import { contactsOfStage } from './inside';
import { kPositions, kStages, kVelocities } from './stages';
import type { State } from './state';
import type { Contact, Trace } from './trace';
import type { Scales, View } from './view';

export interface Sight {
  state: State;
  trace: Trace;
  stage: string;
  still: boolean; // not playing, and after the beginning
  posed: number; // the step whose places are shown
  grouped: Int32Array;
  contacts: Contact[];
  view: View;
  scales: Scales;
  perMetre: number; // an arrow of a metre means so many metres per second; 0 without arrows
}

/** The `d` of the path of each layer. */
export type Paths = Record<string, string>;

export function sightOf(state: State, view: View, scales: Scales): Sight {
  const { trace, step, stage } = state;
  const posed = stage >= kPositions ? step : Math.max(0, step - 1);
  return {
    state, trace, view, scales, posed,
    stage: kStages[stage].id,
    still: !state.playing && step > 0,
    grouped: groupedAt(trace, step, stage),
    contacts: contactsOfStage(state, posed),
    perMetre: velocityScale(state, posed),
  };
}

/** One scale for all arrows of a picture, a round one: the fastest takes up to a quarter of the height. */
function velocityScale(state: State, posed: number): number {
  const { trace, stage } = state;
  if (!state.layers.has('velocities') && kStages[stage].id !== 'AdvanceVelocities') return 0;
  const at = stage >= kVelocities ? state.step : Math.max(0, state.step - 1);
  let fastest = 0;
  for (const [i, body] of trace.head.bodies.entries()) {
    if (body.motion === 'pinned' || !trace.present(i, posed) || !trace.present(i, at)) continue;
    const v = trace.velocity(i, at);
    fastest = Math.max(fastest, Math.hypot(v.vx, v.vy));
  }
  const least = Math.max(0.1, fastest / (0.25 * trace.head.camera[2]));
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((m) => m * power).find((value) => value >= 0.999 * least) ?? least;
}
