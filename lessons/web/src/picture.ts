// The world as vector graphics.
import { number, svg } from './dom';
import { kLast, kPositions, kStages, kUnmerge } from './stages';
import type { State } from './state';
import type { BodyInfo, Contact, Trace, Vec } from './trace';

const kWidth = 1000;
const kHeight = 720;

/** World to picture: metres and y up to units and y down. */
export class View {
  readonly scale: number;
  constructor(private readonly cx: number, private readonly cy: number, height: number) {
    this.scale = kHeight / height;
  }
  x(x: number): number {
    return kWidth / 2 + (x - this.cx) * this.scale;
  }
  y(y: number): number {
    return kHeight / 2 - (y - this.cy) * this.scale;
  }
  world(px: number, py: number): Vec {
    return [this.cx + (px - kWidth / 2) / this.scale, this.cy - (py - kHeight / 2) / this.scale];
  }
}

/** Criteria whose value grows towards a limit. */
const kLimits = ['relative-motion', 'sliding', 'breathing', 'opening', 'cone'];

let pictures = 0;

const fixed = (value: number): string => value.toFixed(1);

/** The pieces of a body as one path, in units about its centre of mass. */
function outline(pieces: (number | Vec)[][], scale: number): string {
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

function arrow(x: number, y: number, dx: number, dy: number): string {
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

/** Colour class of a contact that is `ratio` times its limit: ten steps per decade either side. */
export function heatClass(ratio: number): string {
  if (ratio >= 1) return 'heat-over';
  if (ratio >= 0.5) return 'heat-near';
  if (ratio >= 0.1) return 'heat-warm';
  return 'heat-calm';
}

export class Picture {
  readonly root: SVGSVGElement;
  readonly view: View;
  onPick: (hit: { body?: number; contact?: Contact }) => void = () => {};
  private readonly bodies: SVGGElement[] = [];
  private readonly ghosts: SVGPathElement[] = [];
  private readonly layer = new Map<string, SVGPathElement>();
  private readonly ghostGroup: SVGGElement;
  private readonly labels: SVGGElement;
  private readonly numbers = svg('g', { class: 'numbers' });
  private readonly focusMark: SVGPathElement;
  private contacts: Contact[] = [];
  private readonly mark: number;
  private readonly forceScale: number;
  private readonly velocityScale: number;

  constructor(trace: Trace, readonly interactive = true) {
    const [cx, cy, height] = trace.head.camera;
    this.view = new View(cx, cy, height);
    const g = Math.hypot(...trace.head.gravity) || 9.81;
    const masses = trace.head.bodies.filter((b) => b.motion === 'dynamic').map((b) => b.mass).sort((a, b) => a - b);
    const typical = masses.length > 0 ? masses[masses.length >> 1] : 1;
    const size = Math.sqrt(kWidth * kHeight) / 16;
    this.velocityScale = size;
    const widths = trace.head.bodies.filter((b) => b.motion === 'dynamic').map(thinnest).sort((a, b) => a - b);
    const width = widths.length > 0 ? widths[widths.length >> 1] * this.view.scale : 40;
    // As long as a body's width for its weight, but no arrow much longer than a fifth of the picture.
    this.forceScale = Math.min(Math.max(0.9 * size, Math.min(2.5 * size, width)) / (typical * g),
      (0.2 * kHeight) / Math.max(1e-9, strongForce(trace)));
    this.mark = Math.max(2, Math.min(5, 0.16 * width));
    this.root = svg('svg', {
      viewBox: `0 0 ${kWidth} ${kHeight}`, class: interactive ? 'picture interactive' : 'picture', role: 'img', 'aria-label': trace.head.title,
    });
    // Each picture its own: what is hidden lends no pattern to what is shown.
    const id = `hatch-${++pictures}`;
    this.root.style.setProperty('--fixed-fill', `url(#${id})`);
    const hatch = svg('pattern', { id, width: 8, height: 8, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' },
      svg('rect', { width: 8, height: 8, class: 'hatch-back' }), svg('line', { x1: 0, y1: 0, x2: 0, y2: 8, class: 'hatch-line' }));
    this.root.append(svg('defs', {}, hatch));
    this.ghostGroup = svg('g', { class: 'ghosts' });
    const bodyGroup = svg('g', { class: 'bodies' });
    const order = trace.head.bodies.map((_, i) => i)
      .sort((a, b) => Number(trace.head.bodies[a].motion === 'dynamic') - Number(trace.head.bodies[b].motion === 'dynamic'));
    for (const i of order) {
      const info = trace.head.bodies[i];
      const d = outline(info.pieces, this.view.scale);
      const group = svg('g', { class: 'body', 'data-body': i }, svg('path', { d, class: info.boundary.length > 0 ? 'fill' : 'fill edge' }));
      if (info.boundary.length > 0) {
        const s = this.view.scale;
        const line = info.boundary.map(([x, y, u, v]) => `M${fixed(x * s)} ${fixed(-y * s)}L${fixed(u * s)} ${fixed(-v * s)}`).join('');
        group.append(svg('path', { d: line, class: 'edge' }));
      }
      this.bodies[i] = group;
      bodyGroup.append(group);
      if (info.motion === 'dynamic') {
        this.ghosts[i] = svg('path', { d });
        this.ghostGroup.append(this.ghosts[i]);
      }
    }
    this.root.append(bodyGroup, this.ghostGroup);
    for (const id of ['springs', 'boxes', 'centre', 'graph', 'welds', 'cone', 'heat-calm', 'heat-warm', 'heat-near', 'heat-over',
      'idle', 'merged', 'active', 'broken', 'cut', 'fresh', 'force', 'friction', 'inner', 'velocity', 'before', 'corners']) {
      const path = svg('path', { class: `layer ${id}` });
      this.layer.set(id, path);
      this.root.append(path);
    }
    this.focusMark = svg('path', { class: 'layer focus' });
    this.labels = svg('g', { class: 'labels' });
    this.root.append(this.focusMark, this.numbers, this.labels, this.scaleBar());
    if (interactive) this.root.addEventListener('click', (event) => this.click(event));
  }

  private scaleBar(): SVGGElement {
    const longest = (0.2 * kWidth) / this.view.scale;
    const power = 10 ** Math.floor(Math.log10(longest));
    const round = [5, 2, 1].map((m) => m * power).find((m) => m <= longest) ?? power;
    const length = round * this.view.scale;
    const text = svg('text', { x: fixed(24 + length / 2), y: kHeight - 28 }, round >= 1 ? `${round} m` : `${number(round * 100)} cm`);
    return svg('g', { class: 'scale-bar' },
      svg('path', { d: `M24 ${kHeight - 26}v8h${fixed(length)}v-8` }), text);
  }

  private set(id: string, d: string): void {
    const path = this.layer.get(id);
    if (path && path.getAttribute('d') !== d) path.setAttribute('d', d);
  }

  private place(node: SVGElement, trace: Trace, body: number, step: number): void {
    const pose = trace.pose(body, step);
    const degrees = (-pose.angle * 180) / Math.PI;
    node.setAttribute('transform', `translate(${fixed(this.view.x(pose.x))} ${fixed(this.view.y(pose.y))}) rotate(${degrees.toFixed(2)})`);
  }

  draw(state: State): void {
    const trace = state.trace;
    const before = Math.max(0, state.step - 1);
    const posed = state.stage >= kPositions ? state.step : before;
    const grouped = groupedAt(trace, state.step, state.stage);
    for (let i = 0; i < this.bodies.length; ++i) {
      const node = this.bodies[i];
      const there = trace.present(i, posed);
      node.style.display = there ? '' : 'none';
      if (!there) continue;
      this.place(node, trace, i, posed);
      node.setAttribute('class', `body ${lookOf(trace, i, posed, grouped[i])}`);
    }
    this.drawGhosts(state, posed);
    this.contacts = trace.head.full ? trace.contactsAt(contactStep(state), posed) : [];
    this.drawContacts(state);
    this.drawForces(state);
    this.drawGraph(state, posed, grouped);
    this.drawHeat(state);
    this.drawSprings(state, posed);
    this.drawVelocities(state, posed);
    this.drawStage(state, posed, grouped);
    this.drawFocus(state, posed);
    this.drawLabels(state, posed, grouped);
  }

  private drawGhosts(state: State, posed: number): void {
    const reference = state.reference;
    const shown = state.layers.has('ghost') && reference !== undefined && reference !== state.trace;
    this.ghostGroup.style.display = shown ? '' : 'none';
    if (!shown) return;
    for (const [i, ghost] of this.ghosts.entries()) {
      if (!ghost) continue;
      const there = reference.present(i, posed);
      ghost.style.display = there ? '' : 'none';
      if (there) this.place(ghost, reference, i, posed);
    }
  }

  private drawContacts(state: State): void {
    const marks = { idle: '', merged: '', active: '', broken: '', cut: '', fresh: '' };
    if (state.layers.has('contacts')) {
      for (const c of this.contacts) {
        const x = this.view.x(c.x);
        const y = this.view.y(c.y);
        if (c.internal) marks.merged += square(x, y, 0.85 * this.mark);
        else if (c.lambdaN > 0) marks.active += disc(x, y, this.mark);
        else if (this.carried(state, c)) marks.broken += cross(x, y, this.mark);
        else marks.idle += disc(x, y, 0.4 * this.mark);
        if (c.fresh && state.stage <= 1) marks.fresh += disc(x, y, 9);
      }
    }
    if (state.stage >= kUnmerge) {
      for (const [, type, a, b] of state.trace.eventsAt.get(state.step) ?? []) {
        if (type !== 'unmerge') continue;
        for (const c of this.contacts) {
          if (c.a !== Math.min(a, b) || c.b !== Math.max(a, b)) continue;
          const x = this.view.x(c.x);
          const y = this.view.y(c.y);
          marks.cut += cross(x, y, 2 * this.mark);
        }
      }
    }
    for (const [id, d] of Object.entries(marks)) this.set(id, d);
  }

  /** Whether a contact that carries nothing now did so one step before: it has just broken. */
  private carried(state: State, contact: Contact): boolean {
    const before = state.trace.contact(contact.track, state.step - 1);
    return before !== null && before.lambdaN > 0;
  }

  private drawForces(state: State): void {
    let force = '';
    let friction = '';
    let inner = '';
    let cone = '';
    const stage = kStages[state.stage].id;
    const scale = this.forceScale / state.trace.head.h;
    if (state.layers.has('forces')) {
      const picked = state.selection;
      const conesOf = (c: Contact) => (picked?.kind === 'pair' ? c.a === picked.a && c.b === picked.b : this.contacts.length <= 12);
      const withCone = (stage === 'SolveLCP' || stage === 'Unmerge' || stage === 'SingleIterationPGS');
      for (const c of this.contacts) {
        if (c.lambdaN <= 0) continue;
        const x = this.view.x(c.x);
        const y = this.view.y(c.y);
        const [tx, ty] = [-c.ny, c.nx];
        const fx = scale * (c.lambdaN * c.nx + c.lambdaT * tx);
        const fy = scale * (c.lambdaN * c.ny + c.lambdaT * ty);
        const d = arrow(x, y, fx, -fy);
        if (c.internal) inner += d;
        else force += d;
        if (c.state === 'sliding') friction += arrow(x, y, scale * c.lambdaT * tx, -scale * c.lambdaT * ty);
        if (withCone && conesOf(c)) {
          const n = scale * c.lambdaN;
          const point = (side: number) =>
            `${fixed(x + n * (c.nx + side * c.mu * tx))} ${fixed(y - n * (c.ny + side * c.mu * ty))}`;
          cone += `M${fixed(x)} ${fixed(y)}L${point(1)}L${point(-1)}z`;
        }
      }
    }
    this.set('force', force);
    this.set('friction', friction);
    this.set('inner', inner);
    this.set('cone', cone);
  }

  private drawGraph(state: State, posed: number, grouped: Int32Array): void {
    let graph = '';
    let welds = '';
    let boxes = '';
    const trace = state.trace;
    if (state.layers.has('graph')) {
      const seen = new Set<string>();
      for (const c of this.contacts) {
        const key = `${c.a}-${c.b}`;
        if (seen.has(key)) continue;
        seen.add(key);
        let line = '';
        for (const body of [c.a, c.b]) {
          // To the centre of a body that moves; a fixed one is met at the contact.
          if (trace.head.bodies[body].motion !== 'dynamic') continue;
          const pose = trace.pose(body, posed);
          line += `M${fixed(this.view.x(c.x))} ${fixed(this.view.y(c.y))}L${fixed(this.view.x(pose.x))} ${fixed(this.view.y(pose.y))}`;
        }
        if (c.internal) welds += line;
        else graph += line;
      }
    }
    if (state.layers.has('boxes')) {
      for (const box of boxesAt(trace, posed, grouped)) {
        boxes += `M${box.map(([x, y]) => `${fixed(this.view.x(x))} ${fixed(this.view.y(y))}`).join('L')}z`;
      }
    }
    this.set('graph', graph);
    this.set('welds', welds);
    this.set('boxes', boxes);
  }

  private drawHeat(state: State): void {
    const paths: Record<string, string> = { 'heat-calm': '', 'heat-warm': '', 'heat-near': '', 'heat-over': '' };
    if (state.layers.has('heat') && state.trace.head.full) {
      const ratios = new Map<string, number>();
      for (const d of state.trace.decisionsAt(contactStep(state))) {
        if (!(d.threshold > 0) || !kLimits.includes(d.criterion.criterion)) continue;
        const key = `${d.a}-${d.b}`;
        ratios.set(key, Math.max(ratios.get(key) ?? 0, Math.abs(d.value) / d.threshold));
      }
      for (const c of this.contacts) {
        const ratio = ratios.get(`${c.a}-${c.b}`);
        if (ratio !== undefined) paths[heatClass(ratio)] += disc(this.view.x(c.x), this.view.y(c.y), 7);
      }
    }
    for (const [id, d] of Object.entries(paths)) this.set(id, d);
  }

  /** What only this stage does: where bodies were, how box corners move, who is new. */
  private drawStage(state: State, posed: number, grouped: Int32Array): void {
    const { trace, step } = state;
    let [before, corners, centre] = ['', '', ''];
    const stage = kStages[state.stage].id;
    const still = !state.playing && step > 0;
    if (still && stage === 'AdvancePositions') {
      for (let i = 0; i < this.bodies.length; ++i) {
        if (trace.head.bodies[i].motion === 'pinned' || !trace.present(i, step - 1) || !trace.present(i, step)) continue;
        const [was, is] = [trace.pose(i, step - 1), trace.pose(i, step)];
        // The way of one step is short: it is drawn ten times as long.
        before += arrow(this.view.x(was.x), this.view.y(was.y), 10 * this.view.scale * (is.x - was.x), -10 * this.view.scale * (is.y - was.y));
      }
    }
    const pair = state.selection?.kind === 'pair' ? state.selection : null;
    if (still && stage === 'AccumulateRelativeMotion' && pair) {
      const motion = (body: number) => {
        const pose = trace.pose(body, posed);
        const v = trace.velocity(body, step);
        return (x: number, y: number): Vec => [v.vx - v.omega * (y - pose.y), v.vy + v.omega * (x - pose.x)];
      };
      const [of, against] = [motion(pair.a), motion(pair.b)];
      const dynamic = [pair.a, pair.b].filter((body) => trace.head.bodies[body].motion === 'dynamic');
      const limit = this.velocityScale / 0.05;
      for (const body of dynamic) {
        const members = grouped[body] < 0 ? [body] : [...grouped.keys()].filter((i) => grouped[i] === grouped[body]);
        for (const [x, y] of boxOf(trace, posed, members)) {
          const [a, b] = [of(x, y), against(x, y)];
          const [px, py] = [this.view.x(x), this.view.y(y)];
          const [dx, dy] = [limit * (a[0] - b[0]), -limit * (a[1] - b[1])];
          const long = Math.max(1, Math.hypot(dx, dy) / (3 * this.velocityScale));
          corners += disc(px, py, 4) + arrow(px, py, dx / long, dy / long);
        }
      }
    }
    if (still && state.stage === kLast) {
      const born = new Set((trace.eventsAt.get(step) ?? []).filter((e) => e[1] === 'merge').map((e) => e[4]));
      for (const id of born) {
        const members = trace.members(id, step);
        if (members.length === 0) continue;
        let [mass, mx, my] = [0, 0, 0];
        for (const i of members) {
          const m = trace.head.bodies[i].mass;
          const pose = trace.pose(i, posed);
          [mass, mx, my] = [mass + m, mx + m * pose.x, my + m * pose.y];
        }
        const [x, y] = [this.view.x(mx / mass), this.view.y(my / mass)];
        centre += `${disc(x, y, 7)}M${fixed(x - 11)} ${fixed(y)}h22M${fixed(x)} ${fixed(y - 11)}v22`;
        centre += `M${boxOf(trace, posed, members).map(([u, v]) => `${fixed(this.view.x(u))} ${fixed(this.view.y(v))}`).join('L')}z`;
      }
    }
    this.set('before', before);
    this.set('corners', corners);
    this.set('centre', centre);
    this.drawOrder(state, stage);
  }

  /** The sweep's order: how many contacts from what is new. */
  private drawOrder(state: State, stage: string): void {
    this.numbers.replaceChildren();
    if (state.playing || (stage !== 'ContactOrdering' && stage !== 'SingleIterationPGS')) return;
    const order = state.trace.head.orders?.find(([step]) => step === state.step);
    if (!order) return;
    const depth = new Map(order[1].map(([a, b, d]) => [`${Math.min(a, b)}-${Math.max(a, b)}`, d]));
    for (const c of this.contacts) {
      const d = depth.get(`${c.a}-${c.b}`);
      if (d === undefined) continue;
      const [x, y] = [this.view.x(c.x), this.view.y(c.y)];
      this.numbers.append(svg('circle', { cx: fixed(x), cy: fixed(y), r: 9, class: d === 1 ? 'seed' : 'visit', style: `opacity:${Math.max(0.35, 1.1 - 0.1 * d).toFixed(2)}` }),
        svg('text', { x: fixed(x), y: fixed(y + 4) }, String(d)));
    }
  }

  private drawSprings(state: State, posed: number): void {
    let d = '';
    const place = (body: number, x: number, y: number): Vec | null => {
      if (body < 0) return [x, y];
      if (!state.trace.present(body, posed)) return null;
      const pose = state.trace.pose(body, posed);
      const [c, s] = [Math.cos(pose.angle), Math.sin(pose.angle)];
      return [pose.x + c * x - s * y, pose.y + s * x + c * y];
    };
    for (const [body, x, y, to, tx, ty] of state.trace.head.springs) {
      const from = place(body, x, y);
      const end = place(to, tx, ty);
      if (from && end) d += coil(this.view.x(from[0]), this.view.y(from[1]), this.view.x(end[0]), this.view.y(end[1]));
    }
    this.set('springs', d);
  }

  private drawVelocities(state: State, posed: number): void {
    let d = '';
    const always = kStages[state.stage].id === 'AdvanceVelocities' && state.step > 0 && !state.playing;
    if (state.layers.has('velocities') || always) {
      const at = state.stage >= 7 ? state.step : Math.max(0, state.step - 1);
      for (let i = 0; i < this.bodies.length; ++i) {
        if (state.trace.head.bodies[i].motion === 'pinned' || !state.trace.present(i, posed) || !state.trace.present(i, at)) continue;
        const pose = state.trace.pose(i, posed);
        const v = state.trace.velocity(i, at);
        const speed = Math.hypot(v.vx, v.vy);
        // Long arrows are drawn shorter: the eye still compares them.
        const scale = (this.velocityScale * Math.min(1, 3 / Math.max(speed, 1e-9))) / 1;
        d += arrow(this.view.x(pose.x), this.view.y(pose.y), scale * v.vx, -scale * v.vy);
      }
    }
    this.set('velocity', d);
  }

  private drawFocus(state: State, posed: number): void {
    const selection = state.selection;
    let d = '';
    for (const [i, node] of this.bodies.entries()) {
      const picked = selection?.kind === 'body' ? selection.body === i
        : selection?.kind === 'pair' ? selection.a === i || selection.b === i : false;
      node.classList.toggle('picked', picked);
    }
    if (selection?.kind === 'pair') {
      for (const c of this.contacts) {
        if (c.a === selection.a && c.b === selection.b) d += disc(this.view.x(c.x), this.view.y(c.y), 9);
      }
    }
    void posed;
    this.focusMark.setAttribute('d', d);
  }

  /** Marks bodies as chosen or right. */
  show(marks: Map<number, string> = new Map()): void {
    for (const [i, node] of this.bodies.entries()) {
      for (const look of ['chosen', 'right']) node.classList.toggle(look, marks.get(i) === look);
    }
  }

  private drawLabels(state: State, posed: number, grouped: Int32Array): void {
    this.labels.replaceChildren();
    if (!state.layers.has('labels')) return;
    const sums = new Map<number, { x: number; y: number; n: number }>();
    const few = this.bodies.length <= 40;
    for (let i = 0; i < this.bodies.length; ++i) {
      if (!state.trace.present(i, posed)) continue;
      const pose = state.trace.pose(i, posed);
      if (few && state.trace.head.bodies[i].motion === 'dynamic') this.label(pose.x, pose.y, state.trace.name(i), 'name');
      if (grouped[i] < 0) continue;
      const sum = sums.get(grouped[i]) ?? { x: 0, y: 0, n: 0 };
      sums.set(grouped[i], { x: sum.x + pose.x, y: sum.y + pose.y, n: sum.n + 1 });
    }
    for (const [id, sum] of sums) {
      this.label(sum.x / sum.n, sum.y / sum.n + (few ? 22 / this.view.scale : 0), `C${id}`, 'collection-name');
    }
  }

  private label(x: number, y: number, text: string, kind: string): void {
    this.labels.append(svg('text', { x: fixed(this.view.x(x)), y: fixed(this.view.y(y) + 5), class: kind }, text));
  }

  /** The nearest contact within reach of a finger, else the body below the pointer. */
  private click(event: MouseEvent): void {
    const matrix = this.root.getScreenCTM();
    if (!matrix) return;
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    let best: Contact | undefined;
    let least = 10;
    for (const c of this.contacts) {
      const distance = Math.hypot(this.view.x(c.x) - at.x, this.view.y(c.y) - at.y);
      if (distance < least) {
        least = distance;
        best = c;
      }
    }
    const group = (event.target as Element).closest('[data-body]');
    this.onPick({ contact: best, body: group ? Number(group.getAttribute('data-body')) : undefined });
  }
}

/** A force that few contacts exceed, from a sample of the run [N]. */
function strongForce(trace: Trace): number {
  const forces: number[] = [];
  if (trace.head.full) {
    for (let i = 1; i <= 12; ++i) {
      const step = Math.round((i * trace.head.steps) / 12);
      for (const c of trace.contactsAt(step)) if (c.lambdaN > 0) forces.push(c.lambdaN / trace.head.h);
    }
  }
  forces.sort((a, b) => a - b);
  return forces[Math.floor(0.97 * forces.length)] ?? 0;
}

/** The smaller extent of a body [m]. */
function thinnest(info: BodyInfo): number {
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
  return Math.min(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys));
}

function disc(x: number, y: number, r: number): string {
  return `M${fixed(x - r)} ${fixed(y)}a${fixed(r)} ${fixed(r)} 0 1 0 ${fixed(2 * r)} 0a${fixed(r)} ${fixed(r)} 0 1 0 ${fixed(-2 * r)} 0z`;
}

function square(x: number, y: number, r: number): string {
  return `M${fixed(x - r)} ${fixed(y - r)}h${fixed(2 * r)}v${fixed(2 * r)}h${fixed(-2 * r)}z`;
}

function cross(x: number, y: number, r: number): string {
  return `M${fixed(x - r)} ${fixed(y - r)}l${fixed(2 * r)} ${fixed(2 * r)}m0 ${fixed(-2 * r)}l${fixed(-2 * r)} ${fixed(2 * r)}`;
}

function coil(x: number, y: number, u: number, v: number): string {
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

/** Contacts are known after each step; before the first there are none. */
export function contactStep(state: State): number {
  return state.step;
}

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

function lookOf(trace: Trace, body: number, step: number, collection: number): string {
  if (trace.head.bodies[body].motion !== 'dynamic') return 'fixed';
  if (trace.asleep(body, step)) return 'asleep';
  return collection < 0 ? 'free' : `c${trace.slot(collection)}`;
}

/** Oriented boxes: of free bodies in their own frame, of collections in that of their first body. */
function boxesAt(trace: Trace, step: number, grouped: Int32Array): Vec[][] {
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
