// The eleven stages of Algorithm 1, each in one sentence.
import stages from './stages.json';

export interface Stage {
  id: string;
  label: string;
  what: string;
  section: string;
}

export const kStages: Stage[] = stages;

/** Where a stage stands in Algorithm 1. */
export const stageAt = (id: string): number => kStages.findIndex((stage) => stage.id === id);

export const kLast = kStages.length - 1;
export const kVelocities = stageAt('AdvanceVelocities');
export const kPositions = stageAt('AdvancePositions');
export const kSweep = stageAt('SingleIterationPGS');
export const kSolve = stageAt('SolveLCP');
export const kUnmerge = stageAt('Unmerge');
