// The eleven stages of Algorithm 1: what each does, in one sentence.
export interface Stage {
  id: string;
  label: string;
  what: string;
  section: string;
}

export const kStages: Stage[] = [
  { id: 'ContactDetection', label: 'Contact detection', section: 'Section 4.1',
    what: 'Finds where bodies touch. Inside a collection nothing has to be searched: its contacts are known.' },
  { id: 'ContactOrdering', label: 'Contact ordering', section: 'Section 6.2',
    what: 'Starts at what is new and walks the contact graph breadth first: near contacts are swept before far ones.' },
  { id: 'SleepAndWake', label: 'Sleep and wake', section: 'Section 7',
    what: 'What rests in the world falls asleep and costs nothing; a new contact or a push wakes it.' },
  { id: 'WarmStart', label: 'Warm start', section: 'Section 6.2',
    what: 'Takes the impulses of the last step as a first guess.' },
  { id: 'SingleIterationPGS', label: 'One PGS sweep', section: 'Section 6.2',
    what: 'One sweep over all contacts, also those inside collections, keeps their forces alive. Its velocities are only looked at, then forgotten.' },
  { id: 'Unmerge', label: 'Unmerge', section: 'Sections 6.3, 6.4',
    what: 'Cuts welds whose contact broke, slides, or moves as a pivot; what no longer hangs together comes apart.' },
  { id: 'SolveLCP', label: 'Solve contacts', section: 'Section 3',
    what: 'The full solve between free bodies and collections. What is inside a collection is left out: that is where the time is saved.' },
  { id: 'AdvanceVelocities', label: 'Advance velocities', section: 'Eq. (8)',
    what: 'Forces and impulses change the velocities.' },
  { id: 'AccumulateRelativeMotion', label: 'Relative motion', section: 'Section 5.2',
    what: 'Measures for each pair in contact how fast its fastest corner moves against the other body, and counts the calm steps.' },
  { id: 'AdvancePositions', label: 'Advance positions', section: 'Section 3',
    what: 'Everything moves on by its velocity times the time step.' },
  { id: 'Merge', label: 'Merge', section: 'Sections 4, 5',
    what: 'Pairs that were calm for enough steps become one collection, with one mass, one inertia, one velocity.' },
];

export const kLast = kStages.length - 1;
export const kPositions = kStages.findIndex((stage) => stage.id === 'AdvancePositions');
export const kSweep = kStages.findIndex((stage) => stage.id === 'SingleIterationPGS');
export const kSolve = kStages.findIndex((stage) => stage.id === 'SolveLCP');
export const kUnmerge = kStages.findIndex((stage) => stage.id === 'Unmerge');
