// The layers of the picture that lie on bodies: velocities, the way of a step, boxes, springs.
import { boxesAt, boxOf } from './groups';
import type { Vec } from './head';
import type { Paths, Sight } from './sight';
import { kVelocities } from './stages';
import { arrow, coil, disc, fixed, polygon } from './strokes';

export function velocities(sight: Sight): Paths {
  const { state, trace, view, posed } = sight;
  const always = sight.stage === 'AdvanceVelocities' && sight.still;
  if (!state.layers.has('velocities') && !always) return { velocity: '' };
  const at = state.stage >= kVelocities ? state.step : Math.max(0, state.step - 1);
  let velocity = '';
  for (const [i, body] of trace.head.bodies.entries()) {
    if (body.motion === 'pinned' || !trace.present(i, posed) || !trace.present(i, at)) continue;
    const pose = trace.pose(i, posed);
    const v = trace.velocity(i, at);
    const scale = view.scale / sight.perMetre;
    if (scale * Math.hypot(v.vx, v.vy) < 4) continue; // a dot, not an arrow
    velocity += arrow(view.x(pose.x), view.y(pose.y), scale * v.vx, -scale * v.vy);
  }
  return { velocity };
}

/** From where bodies were to where they are. */
export function ways(sight: Sight): Paths {
  if (!sight.still || sight.stage !== 'AdvancePositions') return { before: '' };
  const { trace, view } = sight;
  const { step } = sight.state;
  const scale = 10 * view.scale; // the way of one step is short: it is drawn ten times as long
  let before = '';
  for (const [i, body] of trace.head.bodies.entries()) {
    if (body.motion === 'pinned' || !trace.present(i, step - 1) || !trace.present(i, step)) continue;
    const [was, is] = [trace.pose(i, step - 1), trace.pose(i, step)];
    before += arrow(view.x(was.x), view.y(was.y), scale * (is.x - was.x), -scale * (is.y - was.y));
  }
  return { before };
}

/** How the corners of the boxes of the selected pair move against the other body. */
export function corners(sight: Sight): Paths {
  const { trace, view, posed, grouped } = sight;
  const { selection, step } = sight.state;
  if (!sight.still || sight.stage !== 'AccumulateRelativeMotion' || selection?.kind !== 'pair') return { corners: '' };
  const motion = (body: number) => {
    const pose = trace.pose(body, posed);
    const v = trace.velocity(body, step);
    return (x: number, y: number): Vec => [v.vx - v.omega * (y - pose.y), v.vy + v.omega * (x - pose.x)];
  };
  const [of, against] = [motion(selection.a), motion(selection.b)];
  const limit = sight.scales.velocity / 0.05;
  let paths = '';
  for (const body of [selection.a, selection.b]) {
    if (trace.head.bodies[body].motion !== 'dynamic') continue;
    const members = grouped[body] < 0 ? [body] : [...grouped.keys()].filter((i) => grouped[i] === grouped[body]);
    for (const [x, y] of boxOf(trace, posed, members)) {
      const [a, b] = [of(x, y), against(x, y)];
      const [dx, dy] = [limit * (a[0] - b[0]), -limit * (a[1] - b[1])];
      const long = Math.max(1, Math.hypot(dx, dy) / (3 * sight.scales.velocity));
      paths += disc(...view.at([x, y]), 4) + arrow(...view.at([x, y]), dx / long, dy / long);
    }
  }
  return { corners: paths };
}

/** Centre of mass and box of the collections that this step makes. */
export function newCollections(sight: Sight): Paths {
  const { trace, view, posed } = sight;
  const { step } = sight.state;
  if (!sight.still || sight.stage !== 'Merge') return { centre: '' };
  const born = new Set((trace.eventsAt.get(step) ?? []).filter((e) => e[1] === 'merge').map((e) => e[4]));
  let centre = '';
  for (const id of born) {
    const members = trace.members(id, step);
    if (members.length === 0) continue;
    let [mass, mx, my] = [0, 0, 0];
    for (const i of members) {
      const m = trace.head.bodies[i].mass;
      const pose = trace.pose(i, posed);
      [mass, mx, my] = [mass + m, mx + m * pose.x, my + m * pose.y];
    }
    const [x, y] = view.at([mx / mass, my / mass]);
    centre += `${disc(x, y, 7)}M${fixed(x - 11)} ${fixed(y)}h22M${fixed(x)} ${fixed(y - 11)}v22`;
    centre += polygon(boxOf(trace, posed, members).map((corner) => view.at(corner)));
  }
  return { centre };
}

export function boxes(sight: Sight): Paths {
  if (!sight.state.layers.has('boxes')) return { boxes: '' };
  const all = boxesAt(sight.trace, sight.posed, sight.grouped);
  return { boxes: all.map((box) => polygon(box.map((corner) => sight.view.at(corner)))).join('') };
}

export function springs(sight: Sight): Paths {
  const { trace, view, posed } = sight;
  const place = (body: number, x: number, y: number): Vec | null => {
    if (body < 0) return [x, y];
    if (!trace.present(body, posed)) return null;
    const pose = trace.pose(body, posed);
    const [c, s] = [Math.cos(pose.angle), Math.sin(pose.angle)];
    return [pose.x + c * x - s * y, pose.y + s * x + c * y];
  };
  let d = '';
  for (const [body, x, y, to, tx, ty] of trace.head.springs) {
    const from = place(body, x, y);
    const end = place(to, tx, ty);
    if (from && end) d += coil(...view.at(from), ...view.at(end));
  }
  return { springs: d };
}
