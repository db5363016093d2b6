// Shapes as the `d` of an SVG path.
import type { Vec } from './head';

export const fixed = (value: number): string => value.toFixed(1);

/** The pieces of a body as one path, in units about its centre of mass. */
export function outline(pieces: (number | Vec)[][], scale: number): string {
  let d = '';
  for (const piece of pieces) {
    if (typeof piece[0] === 'number') {
      const [x, y, r] = (piece as number[]).map((v) => v * scale);
      d += `M${fixed(x - r)} ${fixed(-y)}a${fixed(r)} ${fixed(r)} 0 1 0 ${fixed(2 * r)} 0a${fixed(r)} ${fixed(r)} 0 1 0 ${fixed(-2 * r)} 0z`;
      if (pieces.length === 1) d += `M${fixed(x)} ${fixed(-y)}h${fixed(r)}`;
    } else {
      d += `M${(piece as Vec[]).map(([x, y]) => `${fixed(x * scale)} ${fixed(-y * scale)}`).join('L')}z`;
    }
  }
  return d;
}

export function arrow(x: number, y: number, dx: number, dy: number): string {
  const length = Math.hypot(dx, dy);
  if (length < 2) return '';
  const head = Math.min(9, 0.5 * length);
  const ux = dx / length;
  const uy = dy / length;
  const tx = x + dx;
  const ty = y + dy;
  const bx = tx - head * ux;
  const by = ty - head * uy;
  const w = 0.4 * head;
  return `M${fixed(x)} ${fixed(y)}L${fixed(bx)} ${fixed(by)}M${fixed(tx)} ${fixed(ty)}L${fixed(bx - w * uy)} ${fixed(by + w * ux)}L${fixed(bx + w * uy)} ${fixed(by - w * ux)}z`;
}

export function disc(x: number, y: number, r: number): string {
  return `M${fixed(x - r)} ${fixed(y)}a${fixed(r)} ${fixed(r)} 0 1 0 ${fixed(2 * r)} 0a${fixed(r)} ${fixed(r)} 0 1 0 ${fixed(-2 * r)} 0z`;
}

export function square(x: number, y: number, r: number): string {
  return `M${fixed(x - r)} ${fixed(y - r)}h${fixed(2 * r)}v${fixed(2 * r)}h${fixed(-2 * r)}z`;
}

export function cross(x: number, y: number, r: number): string {
  return `M${fixed(x - r)} ${fixed(y - r)}l${fixed(2 * r)} ${fixed(2 * r)}m0 ${fixed(-2 * r)}l${fixed(-2 * r)} ${fixed(2 * r)}`;
}

export function coil(x: number, y: number, u: number, v: number): string {
  const length = Math.hypot(u - x, v - y);
  if (length < 8) return `M${fixed(x)} ${fixed(y)}L${fixed(u)} ${fixed(v)}`;
  const [ax, ay] = [(u - x) / length, (v - y) / length];
  const turns = 12;
  let d = `M${fixed(x)} ${fixed(y)}`;
  for (let i = 0; i <= turns; ++i) {
    const along = length * (0.15 + (0.7 * i) / turns);
    const side = i === 0 || i === turns ? 0 : i % 2 === 0 ? 5 : -5;
    d += `L${fixed(x + ax * along - ay * side)} ${fixed(y + ay * along + ax * side)}`;
  }
  return `${d}L${fixed(u)} ${fixed(v)}`;
}

/** A closed line through points. */
export function polygon(points: Vec[]): string {
  return `M${points.map(([x, y]) => `${fixed(x)} ${fixed(y)}`).join('L')}z`;
}
