// Where the world is in the picture, and how long things are drawn.
import type { BodyInfo, Vec } from './head';
import type { Trace } from './trace';

export const kWidth = 1000;
export const kHeight = 720;

/** World to picture: metres and y up to units and y down. */
export class View {
  scale = 1;
  private cx = 0;
  private cy = 0;

  constructor(camera: [number, number, number]) {
    this.look(camera);
  }
  /** Looks at a place with so many metres in height. */
  look([cx, cy, height]: [number, number, number]): void {
    [this.cx, this.cy, this.scale] = [cx, cy, kHeight / height];
  }
  x(x: number): number {
    return kWidth / 2 + (x - this.cx) * this.scale;
  }
  y(y: number): number {
    return kHeight / 2 - (y - this.cy) * this.scale;
  }
  /** Back from the picture to the world. */
  world(x: number, y: number): Vec {
    return [this.cx + (x - kWidth / 2) / this.scale, this.cy - (y - kHeight / 2) / this.scale];
  }
  at([x, y]: Vec): Vec {
    return [this.x(x), this.y(y)];
  }
}

/** How much of the picture a quantity takes; the same for a whole run. */
export interface Scales {
  mark: number; // radius of a contact
  force: number; // per newton
  velocity: number; // per metre per second
}

export function scalesOf(trace: Trace, view: View): Scales {
  const g = Math.hypot(...trace.head.gravity) || 9.81;
  const dynamic = trace.head.bodies.filter((b) => b.motion === 'dynamic');
  const typical = middle(dynamic.map((b) => b.mass)) ?? 1;
  const thin = middle(dynamic.map(thinnest));
  const width = thin === undefined ? 40 : thin * view.scale;
  const size = Math.sqrt(kWidth * kHeight) / 16;
  return {
    velocity: size,
    // As long as a body's width for its weight, but no arrow much longer than a fifth of the picture.
    force: Math.min(Math.max(0.9 * size, Math.min(2.5 * size, width)) / (typical * g),
      (0.2 * kHeight) / Math.max(1e-9, strongForce(trace))),
    mark: Math.max(2, Math.min(5, 0.16 * width)),
  };
}

function middle(values: number[]): number | undefined {
  return values.sort((a, b) => a - b)[values.length >> 1];
}

/** A force that few contacts exceed, from a sample of the run [N]. */
function strongForce(trace: Trace): number {
  const forces: number[] = [];
  if (trace.head.full) {
    for (let i = 1; i <= 12; ++i) {
      const step = Math.round((i * trace.head.steps) / 12);
      for (const c of trace.contactsAt(step)) if (c.lambdaN > 0) forces.push(c.lambdaN / trace.lengthOf(step));
    }
  }
  forces.sort((a, b) => a - b);
  return forces[Math.floor(0.97 * forces.length)] ?? 0;
}

/** Extent of a body along its own x axis [m]. */
export function widthOf(info: BodyInfo): number {
  const [left, right] = extents(info);
  return right - left;
}

/** The smaller extent of a body [m]. */
function thinnest(info: BodyInfo): number {
  const [left, right, bottom, top] = extents(info);
  return Math.min(right - left, top - bottom);
}

/** Left, right, bottom, top in its own frame [m]. */
export function extents(info: BodyInfo): [number, number, number, number] {
  const xs: number[] = [];
  const ys: number[] = [];
  for (const piece of info.pieces) {
    if (typeof piece[0] === 'number') {
      const [x, y, r] = piece as number[];
      xs.push(x - r, x + r);
      ys.push(y - r, y + r);
    } else {
      for (const [x, y] of piece as Vec[]) {
        xs.push(x);
        ys.push(y);
      }
    }
  }
  return [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
}
