// The world as vector graphics.
import { contactMarks, focus, forces, graph, heat } from './contacts';
import { svg } from './dom';
import { lookOf } from './groups';
import type { BodyInfo, Vec } from './head';
import { Labels } from './labels';
import { hands, loads } from './hands';
import { boxes, corners, newCollections, springs, velocities, ways } from './motions';
import { Lens } from './lens';
import { type Sight, sightOf } from './sight';
import type { State } from './state';
import { fixed, outline } from './strokes';
import type { Contact, Trace } from './trace';
import { kHeight, kWidth, type Scales, scalesOf, View, widthOf } from './view';

/** From back to front. */
const kPaths = ['springs', 'boxes', 'centre', 'graph', 'welds', 'cone', 'heat-calm', 'heat-warm', 'heat-near', 'heat-over',
  'idle', 'merged', 'active', 'broken', 'cut', 'fresh', 'earlier', 'force', 'friction', 'inner', 'velocity', 'before', 'corners', 'focus', 'loads', 'hand', 'aim'];
const kLayers = [springs, boxes, newCollections, graph, heat, contactMarks, forces, velocities, ways, corners, focus, loads, hands];

/** A line on a body has a rim of the background, so that it is seen on every colour. */
const kRimmed = ['welds', 'broken', 'cut', 'force', 'friction', 'inner', 'velocity', 'loads', 'hand', 'aim', 'corners', 'before'];

let pictures = 0;

export class Picture {
  readonly root: SVGSVGElement;
  onPick: (hit: { body?: number; contact?: Contact; at: Vec }) => void = () => {};
  readonly view: View;
  readonly lens: Lens;
  private readonly scales: Scales;
  private shown: readonly unknown[] = []; // the bodies that there are shapes of
  private readonly bodies: SVGGElement[] = [];
  private readonly ghosts: SVGPathElement[] = [];
  private readonly paths = new Map<string, SVGPathElement>();
  private readonly bodyRoot = svg('g', { class: 'bodies' });
  private readonly ghostGroup = svg('g', { class: 'ghosts' });
  private readonly labels = new Labels();
  private readonly numbers = svg('g', { class: 'numbers' });
  private contacts: Contact[] = [];

  constructor(trace: Trace, interactive = true) {
    const [cx, cy, height] = trace.head.camera;
    this.view = new View(cx, cy, height);
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
    this.root.append(this.numbers, this.labels.root, this.lens.scaleBar);
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
    this.drawLabels(sight);
  }

  private set(id: string, d: string): void {
    for (const path of [this.paths.get(id), this.paths.get(`rim ${id}`)]) {
      if (path && path.getAttribute('d') !== d) path.setAttribute('d', d);
    }
  }

  private drawBodies({ state, trace, posed, grouped }: Sight): void {
    const { selection } = state;
    for (const [i, node] of this.bodies.entries()) {
      const there = trace.present(i, posed);
      node.style.display = there ? '' : 'none';
      if (there) {
        this.place(node, trace, i, posed);
        node.setAttribute('class', `body ${lookOf(trace, i, posed, grouped[i])}`);
      }
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
      ghost.style.display = there ? '' : 'none';
      if (there) this.place(ghost, reference, i, posed);
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

  private drawLabels({ state, trace, posed, grouped, view }: Sight): void {
    this.labels.clear();
    this.labels.unit = this.lens.unit;
    // Scripted bodies are told apart from pinned ones.
    for (const [i, body] of trace.head.bodies.entries()) {
      if (body.motion !== 'scripted' || !trace.present(i, posed)) continue;
      const pose = trace.pose(i, posed);
      this.labels.put(view.x(pose.x), view.y(pose.y), `${body.name} ↔`, 'name');
    }
    if (!state.layers.has('labels')) return;
    const sums = new Map<number, { x: number; y: number; n: number }>();
    const few = this.bodies.length <= 40;
    for (const [i, body] of trace.head.bodies.entries()) {
      if (!trace.present(i, posed)) continue;
      const pose = trace.pose(i, posed);
      if (few && body.motion === 'dynamic') this.labels.put(view.x(pose.x), view.y(pose.y), this.nameThatFits(body), 'name');
      if (grouped[i] < 0) continue;
      const sum = sums.get(grouped[i]) ?? { x: 0, y: 0, n: 0 };
      sums.set(grouped[i], { x: sum.x + pose.x, y: sum.y + pose.y, n: sum.n + 1 });
    }
    for (const [id, sum] of sums) {
      this.labels.put(view.x(sum.x / sum.n), view.y(sum.y / sum.n), `C${id} · ${sum.n}`, 'collection-name');
    }
  }

  /** "0,5" of brick[0,5] where the whole name would lie on the neighbours. */
  private nameThatFits(body: BodyInfo): string {
    const room = widthOf(body) * this.view.scale;
    const short = /\[([^\]]*)\]$/.exec(body.name);
    return short && 8 * this.lens.unit * body.name.length > room ? short[1] : body.name;
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
  /** Draws the arrow that is being pulled. */
  aim(d: string): void {
    this.set('aim', d);
  }

  /** The nearest contact within reach of a finger or a mouse, else the body below the pointer. */
  private click(event: MouseEvent): void {
    if (this.lens.moved) return;
    const at = this.point(event);
    const matrix = this.root.getScreenCTM();
    if (!at || !matrix) return;
    const coarse = (event as PointerEvent).pointerType === 'touch';
    let best: Contact | undefined;
    let least = (coarse ? 22 : 12) / matrix.a;
    for (const c of this.contacts) {
      const distance = Math.hypot(this.view.x(c.x) - at.x, this.view.y(c.y) - at.y);
      if (distance < least) {
        least = distance;
        best = c;
      }
    }
    this.onPick({ contact: best, body: this.bodyAt(event), at: this.view.world(at.x, at.y) });
  }
}
