// The world as vector graphics.
import { contactMarks, focus, forces, graph, heat } from './contacts';
import { svg } from './dom';
import { lookOf } from './groups';
import { boxOnPicture } from './camera';
import type { Vec } from './head';
import { type Box, Labels } from './labels';
import { hands, loads, loadsShown, pullsShown } from './hands';
import { boxes, corners, newCollections, springs, velocities, ways } from './motions';
import { Lens } from './lens';
import { type Sight, sightOf } from './sight';
import { kLast } from './stages';
import type { State } from './state';
import { fixed, outline } from './strokes';
import type { Contact, Trace } from './trace';
import { extents, kHeight, kWidth, type Scales, scalesOf, View } from './view';

/** From back to front. */
const kPaths = ['springs', 'boxes', 'centre', 'graph', 'welds', 'cone', 'heat-calm', 'heat-warm', 'heat-near', 'heat-over',
  'idle', 'merged', 'active', 'broken', 'cut', 'fresh', 'earlier', 'force', 'friction', 'inner', 'velocity', 'before', 'corners', 'focus', 'loads', 'hand', 'aim'];
const kLayers = [springs, boxes, newCollections, graph, heat, contactMarks, forces, velocities, ways, corners, focus, loads, hands];

/** A line on a body has a rim of the background, so that it is seen on every colour. */
const kRimmed = ['welds', 'broken', 'cut', 'force', 'friction', 'inner', 'velocity', 'loads', 'hand', 'aim', 'corners', 'before'];

const kBlink = 200; // ms

let pictures = 0;

export class Picture {
  readonly root: SVGSVGElement;
  onPick: (hit: { body?: number; contact?: Contact; at: Vec; turn: number; of: number }) => void = () => {};
  readonly view: View;
  readonly lens: Lens;
  private scales: Scales;
  private world: number;
  private shown: readonly unknown[] = []; // the bodies that there are shapes of
  private readonly bodies: SVGGElement[] = [];
  private readonly ghosts: SVGPathElement[] = [];
  private readonly paths = new Map<string, SVGPathElement>();
  private readonly bodyRoot = svg('g', { class: 'bodies' });
  private readonly ghostGroup = svg('g', { class: 'ghosts' });
  private readonly labels = new Labels();
  private readonly numbers = svg('g', { class: 'numbers' });
  private readonly aimText = svg('text', { class: 'aim-size' });
  private contacts: Contact[] = [];
  private cursor: number | undefined;
  private below = ''; // the pairs under the last click, and which of them was chosen
  private order: string[] = [];
  private seen = 0; // the last step that was drawn
  private readonly blinking = new Map<number, number>(); // bodies, and until when [ms]
  private turn = 0;

  constructor(trace: Trace, interactive = true) {
    this.view = new View(trace.head.camera);
    this.world = trace.world;
    this.scales = scalesOf(trace, this.view);
    this.root = svg('svg', {
      viewBox: `0 0 ${kWidth} ${kHeight}`, class: interactive ? 'picture interactive' : 'picture', role: 'img', 'aria-label': trace.head.title,
    });
    this.root.append(this.hatch(), this.bodyRoot, this.ghostGroup);
    this.buildBodies(trace);
    for (const id of kPaths) {
      if (kRimmed.includes(id)) {
        const rim = svg('path', { class: `layer rim rim-${id}` });
        this.paths.set(`rim ${id}`, rim);
        this.root.append(rim);
      }
      const path = svg('path', { class: `layer ${id}` });
      this.paths.set(id, path);
      this.root.append(path);
    }
    this.lens = new Lens(this.root, this.view);
    this.root.append(this.numbers, this.labels.root, this.aimText, this.lens.scaleBar);
    if (interactive) this.root.addEventListener('click', (event) => this.click(event));
  }

  /** Each picture its own: what is hidden lends no pattern to what is shown. */
  private hatch(): SVGDefsElement {
    const id = `hatch-${++pictures}`;
    this.root.style.setProperty('--fixed-fill', `url(#${id})`);
    return svg('defs', {}, svg('pattern', { id, width: 8, height: 8, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' },
      svg('rect', { width: 8, height: 8, class: 'hatch-back' }), svg('line', { x1: 0, y1: 0, x2: 0, y2: 8, class: 'hatch-line' })));
  }

  /** Moving bodies stand in front of fixed ones. Names and pins may come later: a live run adds bodies. */
  private buildBodies(trace: Trace): void {
    this.bodyRoot.replaceChildren();
    this.ghostGroup.replaceChildren();
    this.bodies.length = this.ghosts.length = 0;
    const all = trace.head.bodies;
    this.shown = [...all];
    const order = all.map((_, i) => i).sort((a, b) => Number(all[a].motion === 'dynamic') - Number(all[b].motion === 'dynamic'));
    const s = this.view.scale;
    for (const i of order) {
      const info = all[i];
      const d = outline(info.pieces, s);
      this.bodies[i] = svg('g', { class: 'body', 'data-body': i }, svg('path', { d, class: info.boundary.length > 0 ? 'fill' : 'fill edge' }));
      if (info.boundary.length > 0) {
        const line = info.boundary.map(([x, y, u, v]) => `M${fixed(x * s)} ${fixed(-y * s)}L${fixed(u * s)} ${fixed(-v * s)}`).join('');
        this.bodies[i].append(svg('path', { d: line, class: 'edge' }));
      }
      this.bodyRoot.append(this.bodies[i]);
      if (info.motion !== 'dynamic') continue;
      this.ghosts[i] = svg('path', { d });
      this.ghostGroup.append(this.ghosts[i]);
    }
  }

  /** Turns to the scene of a run, where it is another one. */
  enter(trace: Trace): void {
    if (trace.world === this.world) return;
    this.world = trace.world;
    this.view.look(trace.head.camera);
    this.scales = scalesOf(trace, this.view);
    this.buildBodies(trace);
    this.lens.setHome(null);
    this.lens.fit();
  }

  draw(state: State): void {
    const all = state.trace.head.bodies;
    if (all.length !== this.shown.length || all[all.length - 1]?.name !== (this.shown[all.length - 1] as { name: string } | undefined)?.name) {
      this.buildBodies(state.trace);
    }
    const sight = sightOf(state, this.view, this.scales);
    this.contacts = sight.contacts;
    this.drawBodies(sight);
    this.drawGhosts(sight);
    for (const layer of kLayers) {
      for (const [id, d] of Object.entries(layer(sight))) this.set(id, d);
    }
    this.drawOrder(sight);
    this.lens.setSecond(sight.perMetre);
    this.drawLabels(sight);
  }

  private set(id: string, d: string): void {
    for (const path of [this.paths.get(id), this.paths.get(`rim ${id}`)]) {
      if (path && path.getAttribute('d') !== d) path.setAttribute('d', d);
    }
  }

  /** The bodies of the pairs that merge in the step that is shown blink once, when it is first shown. */
  private blink({ state, trace }: Sight): void {
    if (state.step === this.seen || state.stage < kLast) return;
    const onwards = state.step > this.seen;
    this.seen = state.step;
    if (!onwards) return;
    const until = performance.now() + kBlink;
    for (const [, type, a, b] of trace.eventsAt.get(state.step) ?? []) {
      if (type === 'merge') for (const body of [a, b]) this.blinking.set(body, until);
    }
  }

  private drawBodies(sight: Sight): void {
    const { state, trace, posed, grouped } = sight;
    const { selection } = state;
    this.blink(sight);
    const now = performance.now();
    for (const [i, node] of this.bodies.entries()) {
      const there = trace.present(i, posed);
      node.style.display = there ? '' : 'none';
      if (there) {
        this.place(node, trace, i, posed);
        const blinks = (this.blinking.get(i) ?? 0) > now ? ' blink' : '';
        node.setAttribute('class', `body ${lookOf(trace, i, posed, grouped[i])}${blinks}`);
      }
      node.classList.toggle('cursor', i === this.cursor);
      node.classList.toggle('picked', selection?.kind === 'body' ? selection.body === i
        : selection?.kind === 'pair' ? selection.a === i || selection.b === i : false);
    }
  }

  private place(node: SVGElement, trace: Trace, body: number, step: number): void {
    const pose = trace.pose(body, step);
    const degrees = (-pose.angle * 180) / Math.PI;
    node.setAttribute('transform', `translate(${fixed(this.view.x(pose.x))} ${fixed(this.view.y(pose.y))}) rotate(${degrees.toFixed(2)})`);
  }

  private drawGhosts({ state, posed }: Sight): void {
    const reference = state.reference;
    const shown = state.layers.has('ghost') && reference !== undefined && reference !== state.trace;
    this.ghostGroup.style.display = shown ? '' : 'none';
    if (!shown) return;
    for (const [i, ghost] of this.ghosts.entries()) {
      if (!ghost) continue;
      const there = reference.present(i, posed);
      // Where both runs are alike there is one outline, that of the body.
      const differs = there && apart(reference, state.trace, i, posed) * this.view.scale > 2 * this.lens.unit;
      ghost.style.display = differs ? '' : 'none';
      if (differs) this.place(ghost, reference, i, posed);
    }
  }

  /** The sweep's order: how many contacts from what is new. */
  private drawOrder({ state, stage, contacts, view }: Sight): void {
    this.numbers.replaceChildren();
    if (state.playing || (stage !== 'ContactOrdering' && stage !== 'SingleIterationPGS')) return;
    const order = state.trace.head.orders?.find(([step]) => step === state.step);
    if (!order) return;
    const depth = new Map(order[1].map(([a, b, d]) => [`${Math.min(a, b)}-${Math.max(a, b)}`, d]));
    for (const c of contacts) {
      const d = depth.get(`${c.a}-${c.b}`);
      if (d === undefined) continue;
      const [x, y] = view.at([c.x, c.y]);
      this.numbers.append(svg('circle', { cx: fixed(x), cy: fixed(y), r: 9, class: d === 1 ? 'seed' : 'visit', style: `opacity:${Math.max(0.35, 1.1 - 0.1 * d).toFixed(2)}` }),
        svg('text', { x: fixed(x), y: fixed(y + 4) }, String(d)));
    }
  }

  private drawLabels(sight: Sight): void {
    const { state, trace, posed, grouped, view } = sight;
    const frame = this.lens.visible;
    const unit = this.lens.unit;
    this.labels.unit = unit;
    // The scale bar and the counts, and the buttons of the zoom.
    this.labels.clear(frame, [{ ...frame, bottom: frame.top + 36 * unit }, { ...frame, left: frame.right - 90 * unit, top: frame.bottom - 40 * unit }]);
    const boxes = trace.head.bodies.map((_, i) => (trace.present(i, posed) ? boxOnPicture(trace, view, i, posed) : null));
    for (const { at, told } of pullsShown(sight)) this.labels.put(at[0], at[1] - 18 * unit, told, 'name');
    for (const { from, to, told } of loadsShown(sight)) this.labels.put(from[0], Math.min(from[1], to[1]) - 13 * unit, told, 'name');
    const named = state.layers.has('labels') && boxes.length <= 60;
    for (const [i, body] of trace.head.bodies.entries()) {
      const box = boxes[i];
      if (!box) continue;
      const { base, number } = trace.short(i);
      if (body.motion === 'scripted') this.labels.put((Math.max(box.left, frame.left) + Math.min(box.right, frame.right)) / 2, (box.top + box.bottom) / 2, `${base} ↔`, 'name');
      if (body.motion === 'dynamic' && trace.asleep(i, posed)) this.labels.asleep(box);
      if (!named || body.motion !== 'dynamic') continue;
      const inside = this.labels.inside(box, number > 0 ? String(number) : base, number === 0);
      // A body of its own is named beside it; members of an array would be mistaken for others.
      if (!inside && number === 0) this.labels.put((box.left + box.right) / 2, box.top - 9 * unit, base, 'name');
    }
    if (!state.veiled || named) this.drawPills(state, trace, boxes, grouped);
  }

  /** The largest collections, each beside one of its bodies. */
  private drawPills(state: State, trace: Trace, boxes: (Box | null)[], grouped: Int32Array): void {
    const members = new Map<number, number[]>();
    for (const [i, id] of grouped.entries()) if (id >= 0 && boxes[i]) members.set(id, [...(members.get(id) ?? []), i]);
    const moving = boxes.filter((box, i) => box !== null && trace.head.bodies[i].motion === 'dynamic') as Box[];
    const narrow = this.root.getBoundingClientRect().width < 480;
    const largest = [...members].sort(([, a], [, b]) => b.length - a.length).slice(0, 6);
    for (const [id, all] of largest) {
      const own = all.filter((i) => trace.head.bodies[i].motion === 'dynamic');
      if (own.length === 0) continue;
      const places = own.map((i) => boxes[i] as Box).sort((a, b) => b.right - a.right);
      const some = places.length <= 14 ? places : places.filter((_, k) => k % Math.ceil(places.length / 14) === 0);
      const asleep = own.some((i) => trace.asleep(i, state.step));
      this.labels.pill(some, narrow ? `C${id} · ${own.length}` : `C${id} · ${membersText(trace, all, own)}`, asleep ? 'asleep' : `c${trace.slot(id)}`, moving);
    }
  }

  /** The body on which the cursor of the keyboard is. */
  showCursor(body: number | undefined): void {
    this.cursor = body;
    for (const [i, node] of this.bodies.entries()) node.classList.toggle('cursor', i === body);
  }

  /** Marks bodies as chosen or right. */
  show(marks: Map<number, string> = new Map()): void {
    for (const [i, node] of this.bodies.entries()) {
      for (const look of ['chosen', 'right']) node.classList.toggle(look, marks.get(i) === look);
    }
  }

  /** Where a pointer is, in units of the picture. */
  point(event: { clientX: number; clientY: number }): DOMPoint | null {
    const matrix = this.root.getScreenCTM();
    return matrix ? new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse()) : null;
  }
  /** The body below a pointer. */
  bodyAt(event: Event): number | undefined {
    const group = (event.target as Element).closest('[data-body]');
    return group ? Number(group.getAttribute('data-body')) : undefined;
  }
  /** Draws the arrow that is being pulled, with its size beside its head. */
  aim(d: string, told = '', head: Vec = [0, 0]): void {
    this.set('aim', d);
    this.aimText.textContent = told;
    this.aimText.setAttribute('x', fixed(head[0] + 12 * this.lens.unit));
    this.aimText.setAttribute('y', fixed(head[1] - 10 * this.lens.unit));
  }

  /** The nearest contact within reach of a finger or a mouse, else the body below the pointer. */
  private click(event: MouseEvent): void {
    if (this.lens.moved) return;
    const at = this.point(event);
    const matrix = this.root.getScreenCTM();
    if (!at || !matrix) return;
    const coarse = (event as PointerEvent).pointerType === 'touch';
    const reach = (coarse ? 22 : 12) / matrix.a;
    const far = (c: Contact) => Math.hypot(this.view.x(c.x) - at.x, this.view.y(c.y) - at.y);
    const near = this.contacts.filter((c) => far(c) < reach).sort((p, q) => far(p) - far(q))
      .filter((c, i, all) => all.findIndex((one) => one.a === c.a && one.b === c.b) === i);
    // Several pairs under one finger are chosen in turn.
    const key = near.map((c) => `${c.a}-${c.b}`).sort().join();
    this.turn = key !== '' && key === this.below ? (this.turn + 1) % near.length : 0;
    if (key !== this.below) this.order = near.map((c) => `${c.a}-${c.b}`);
    this.below = key;
    const best = near.find((c) => `${c.a}-${c.b}` === this.order[this.turn]);
    this.onPick({ contact: best, body: this.bodyAt(event), at: this.view.world(at.x, at.y), turn: this.turn, of: near.length });
  }
}

/** How far a body is from where it is in another run, also by turning [m]. */
export function apart(one: Trace, other: Trace, body: number, step: number): number {
  if (body >= other.bodies.length || !one.present(body, step) || !other.present(body, step)) return Infinity;
  const [p, q] = [one.pose(body, step), other.pose(body, step)];
  const half = 0.5 * Math.max(...span(one, body));
  return Math.hypot(p.x - q.x, p.y - q.y) + half * Math.abs(p.angle - q.angle);
}

function span(trace: Trace, body: number): [number, number] {
  const [left, right, bottom, top] = extents(trace.head.bodies[body]);
  return [right - left, top - bottom];
}

/** "9 bricks", "1 brick + platform", "4 bodies". */
function membersText(trace: Trace, all: number[], own: number[]): string {
  const { base } = trace.short(own[0]);
  const alike = own.every((i) => trace.short(i).base === base);
  const held = all.find((i) => !own.includes(i));
  const what = alike ? (own.length === 1 && trace.short(own[0]).number === 0 ? base : `${own.length} ${own.length === 1 ? base : plural(base)}`) : `${own.length} bodies`;
  return held === undefined ? what : `${what} + ${trace.name(held)}`;
}

function plural(noun: string): string {
  return /(s|x|ch|sh)$/.test(noun) ? `${noun}es` : `${noun}s`;
}
