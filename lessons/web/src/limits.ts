// The limits of Table 1, by their keys in scene files.
/** A number that can be changed while a run goes on. */
export interface Limit {
  key: string;
  label: string;
  unit: string;
  paper: number;
  low: number;
  high: number;
  whole?: boolean;
}

/** Table 1 of the paper. */
export const kLimits: Limit[] = [
  { key: 'merging.velocity', label: 'Merge below', unit: 'm/s', paper: 0.01, low: 1e-4, high: 1 },
  { key: 'unmerging.velocity', label: 'Unmerge above', unit: 'm/s', paper: 0.02, low: 1e-4, high: 2 },
  { key: 'merging.sliding', label: 'Merge: slip below', unit: 'm/s', paper: 0.01, low: 1e-4, high: 1 },
  { key: 'unmerging.sliding', label: 'Unmerge: slip above', unit: 'm/s', paper: 0.01, low: 1e-4, high: 1 },
  { key: 'merging.breathing', label: 'Change of overlap below', unit: 'm', paper: 1e-5, low: 1e-8, high: 1e-2 },
  { key: 'sleeping.velocity', label: 'Sleep below', unit: 'm/s', paper: 1e-5, low: 1e-7, high: 1e-1 },
  { key: 'merging.steps', label: 'Calm steps before merging', unit: 'steps', paper: 3, low: 1, high: 20, whole: true },
  { key: 'unmerging.steps', label: 'Steps above before unmerging', unit: 'steps', paper: 3, low: 1, high: 20, whole: true },
];
export const kTimeStep: Limit = { key: 'step', label: 'Time step h', unit: 's', paper: 0.01, low: 1e-3, high: 5e-2 };

/** Which limit a test of a pair is against. */
const kLimitOf: Record<string, Record<string, string>> = {
  Unmerge: { 'relative-motion': 'unmerging.velocity', sliding: 'unmerging.sliding' },
  AccumulateRelativeMotion: { 'relative-motion': 'merging.velocity', sliding: 'merging.sliding', breathing: 'merging.breathing' },
};
/** The limit on the other side: a pair between the two neither merges nor comes apart. */
const kOther: Record<string, string> = { 'unmerging.velocity': 'merging.velocity', 'unmerging.sliding': 'merging.sliding' };

/** A second value to be seen beside the limit of a test: the other limit, or else the paper's value. */
export function besideLimit(stage: string, criterion: string, threshold: number, settings: (key: string) => number | undefined): { label: string; value: number } | null {
  const key = kLimitOf[stage]?.[criterion];
  if (!key) return null;
  const differs = (value: number | undefined): value is number => value !== undefined && value > 0 && Math.abs(value / threshold - 1) > 0.02;
  const other = kOther[key] ? settings(kOther[key]) : undefined;
  if (differs(other)) return { label: 'merge', value: other };
  const paper = kLimits.find((limit) => limit.key === key)?.paper;
  return differs(paper) ? { label: 'paper', value: paper } : null;
}
