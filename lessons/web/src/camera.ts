// Which part of the world a part of a lesson is about: the bodies that move there, and the ground near them.
import type { Box } from './labels';
import type { Trace } from './trace';
import { extents, kHeight, kWidth, type View } from './view';

/** The extent of a body in the picture. */
export function boxOnPicture(trace: Trace, view: View, body: number, step: number): Box {
  const pose = trace.pose(body, step);
  const [c, s] = [Math.cos(pose.angle), Math.sin(pose.angle)];
  const [left, right, bottom, top] = extents(trace.head.bodies[body]);
  let box: Box | null = null;
  for (const [x, y] of [[left, bottom], [right, bottom], [right, top], [left, top]]) {
    const [px, py] = [view.x(pose.x + c * x - s * y), view.y(pose.y + s * x + c * y)];
    box = joined(box, { left: px, right: px, top: py, bottom: py });
  }
  return box ?? { left: 0, right: 0, top: 0, bottom: 0 };
}

function joined(a: Box | null, b: Box): Box {
  return a ? { left: Math.min(a.left, b.left), right: Math.max(a.right, b.right), top: Math.min(a.top, b.top), bottom: Math.max(a.bottom, b.bottom) } : b;
}

/** The bodies that move and are in the scene's own camera at a step. */
function movingAt(trace: Trace, view: View, step: number): Box[] {
  return trace.head.bodies.flatMap((body, i) => {
    if (body.motion !== 'dynamic' || !trace.present(i, step)) return [];
    const box = boxOnPicture(trace, view, i, step);
    const [x, y] = [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
    return x >= 0 && x <= kWidth && y >= 0 && y <= kHeight ? [box] : [];
  });
}

/** What is to be seen from one step to another; null where that is nothing. */
export function homeOf(trace: Trace, view: View, from: number, to: number): Box | null {
  let home: Box | null = null;
  const samples = to > from ? 8 : 1;
  for (let k = 0; k < samples; ++k) {
    const step = Math.round(from + ((to - from) * k) / Math.max(1, samples - 1));
    for (const box of movingAt(trace, view, step)) home = joined(home, box);
  }
  if (!home) return null;
  // The bodies that hold them: as much as is near.
  const near = 0.16 * (home.bottom - home.top) + 20;
  const around = { left: home.left - 1.5 * near, right: home.right + 1.5 * near, top: home.top - near, bottom: home.bottom + near };
  for (const [i, body] of trace.head.bodies.entries()) {
    if (body.motion === 'dynamic' || !trace.present(i, from)) continue;
    const box = boxOnPicture(trace, view, i, from);
    const seen = { left: Math.max(box.left, around.left), right: Math.min(box.right, around.right), top: Math.max(box.top, around.top), bottom: Math.min(box.bottom, around.bottom) };
    if (seen.left < seen.right && seen.top < seen.bottom) home = joined(home, seen);
  }
  return home;
}

/** Whether every body that moves in the scene's camera is in a part of the picture. */
export function isEnough(trace: Trace, view: View, step: number, home: Box): boolean {
  return movingAt(trace, view, step).every((box) => {
    const [x, y] = [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
    return x >= home.left && x <= home.right && y >= home.top && y <= home.bottom;
  });
}
