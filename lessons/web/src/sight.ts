// What the picture shows at one moment: the layers are drawn from it.
import { groupedAt } from './groups';
import { contactsOfStage } from './inside';
import { kPositions, kStages } from './stages';
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
  };
}
