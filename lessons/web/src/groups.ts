// Which bodies are one, how they look, and the boxes around them.
import type { Vec } from './head';
import { kLast, kUnmerge } from './stages';
import type { Trace } from './trace';

/** Which collection each body belongs to at a stage: what merges in this step does so at its end. */
export function groupedAt(trace: Trace, step: number, stage: number): Int32Array {
  const out = new Int32Array(trace.bodies.length);
  const before = Math.max(0, step - 1);
  for (let i = 0; i < out.length; ++i) {
    const now = trace.collection(i, step);
    const was = trace.collection(i, before);
    if (stage === kLast) out[i] = now;
    else if (stage < kUnmerge) out[i] = was;
    else out[i] = now >= 0 && was >= 0 ? now : -1;
  }
  return out;
}

export function lookOf(trace: Trace, body: number, step: number, collection: number): string {
  if (trace.head.bodies[body].motion !== 'dynamic') return 'fixed';
  if (trace.asleep(body, step)) return 'asleep';
  return collection < 0 ? 'free' : `c${trace.slot(collection)}`;
}

/** Oriented boxes: of free bodies in their own frame, of collections in that of their first body. */
export function boxesAt(trace: Trace, step: number, grouped: Int32Array): Vec[][] {
  const groups = new Map<string, number[]>();
  for (let i = 0; i < grouped.length; ++i) {
    if (trace.head.bodies[i].motion !== 'dynamic' || !trace.present(i, step)) continue;
    const key = grouped[i] < 0 ? `b${i}` : `c${grouped[i]}`;
    groups.set(key, [...(groups.get(key) ?? []), i]);
  }
  return [...groups.values()].map((members) => boxOf(trace, step, members));
}

export function boxOf(trace: Trace, step: number, members: number[]): Vec[] {
  const axis = trace.pose(members[0], step).angle;
  const [c, s] = [Math.cos(axis), Math.sin(axis)];
  let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
  const take = (x: number, y: number, r: number) => {
    const u = c * x + s * y;
    const v = c * y - s * x;
    left = Math.min(left, u - r);
    right = Math.max(right, u + r);
    bottom = Math.min(bottom, v - r);
    top = Math.max(top, v + r);
  };
  for (const body of members) {
    const pose = trace.pose(body, step);
    const [pc, ps] = [Math.cos(pose.angle), Math.sin(pose.angle)];
    const world = (x: number, y: number): Vec => [pose.x + pc * x - ps * y, pose.y + ps * x + pc * y];
    for (const piece of trace.head.bodies[body].pieces) {
      if (typeof piece[0] === 'number') {
        const [x, y, r] = piece as number[];
        take(...world(x, y), r);
      } else {
        for (const [x, y] of piece as Vec[]) take(...world(x, y), 0);
      }
    }
  }
  const corner = (u: number, v: number): Vec => [c * u - s * v, s * u + c * v];
  return [corner(left, bottom), corner(right, bottom), corner(right, top), corner(left, top)];
}
