// The description of a recorded run in plain JSON: lessons/encode_head.cpp writes it.
export type Vec = [number, number];
export type EventRow = [step: number, type: string, a: number, b: number, collection: number, reason: string];

export interface BodyInfo {
  name: string;
  motion: 'dynamic' | 'pinned' | 'scripted';
  mass: number;
  inertia: number;
  pieces: (number | Vec)[][];
  boundary: [number, number, number, number][];
}

export interface Criterion {
  stage: string;
  criterion: string;
  equation: string;
  threshold: number;
  needed: number;
}

export interface Head {
  scene: string;
  title: string;
  mode: string;
  full: boolean;
  h: number;
  steps: number;
  every: number; // steps between two samples of contacts and decisions
  /** Of a long run: bodies are kept in keyframes, and statistics every so many steps. */
  keyframes?: number;
  event_types?: string[];
  event_reasons?: string[];
  gravity: Vec;
  camera: [number, number, number];
  length: number;
  angle: number;
  amount: Vec;
  parameters: Record<string, unknown>;
  toml: string; // the scene, for the engine
  bodies: BodyInfo[];
  criteria: Criterion[];
  events: EventRow[];
  colors: [number, number][];
  /** The forces of the scene: body, point in its frame, force, from, until (null: for ever). */
  forces?: [number, number, number, number, number, number, number | null][];
  /** Its impulses: body, point in the world, impulse, time. */
  impulses?: [number, number, number, number, number, number][];
  springs: [number, number, number, number, number, number][];
  ledger?: number[][];
  inside?: [step: number, contacts: number][];
  orders?: [step: number, visits: [a: number, b: number, depth: number][]][];
}

export interface Packed {
  label: string;
  world: number; // the same for runs of the same scene
  head: Head;
  data: string;
}
