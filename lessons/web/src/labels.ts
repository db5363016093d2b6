// Names in a picture: none covers another, none lies on a body that it does not name, and none leaves the picture.
import { svg } from './dom';
import { fixed } from './strokes';

export interface Box { left: number; right: number; top: number; bottom: number }

const kLongest = 32; // characters; the inspector tells the whole name
const kSizes = { name: 13, number: 13, 'collection-name': 13 };
/** Where a name may go that finds no room on its body: rows of its height above, then below. */
const kRows = [0, -1, 1, -2, 2, -3, 3];

export class Labels {
  readonly root = svg('g', { class: 'labels' });
  /** Units of the picture per pixel: words keep their size on the screen. */
  unit = 1;
  private frame: Box = { left: 0, right: 0, top: 0, bottom: 0 };
  private taken: Box[] = [];

  /** Begins anew in a part of the picture; some places are not free. */
  clear(frame: Box, taken: Box[] = []): void {
    this.root.replaceChildren();
    this.frame = frame;
    this.taken = [...taken];
  }

  private half(text: string, kind: keyof typeof kSizes): number {
    return 0.31 * kSizes[kind] * this.unit * [...text].length + 2;
  }

  /** A number at the left inside of a body, where it fits: whether it did. A name stands high, above arrows at the centre. */
  inside(body: Box, text: string, high = false): boolean {
    const size = kSizes.number * this.unit;
    const width = 2 * this.half(text, 'number');
    if (width + 4 * this.unit > body.right - body.left || 1.05 * size > body.bottom - body.top) return false;
    const roomy = body.right - body.left > 2.5 * width;
    const x = roomy ? body.left + 8 * this.unit : (body.left + body.right) / 2;
    this.root.append(svg('text', { x: fixed(x), y: fixed((high && body.bottom - body.top > 3 * size ? body.top + 1.1 * size : (body.top + body.bottom) / 2) + 0.35 * size), class: roomy ? 'number start' : 'number' }, text));
    return true;
  }

  /** A body that sleeps has a "z" in its right upper corner, where there is room. */
  asleep(body: Box): void {
    const size = 12 * this.unit;
    if (body.right - body.left < 3.5 * size || body.bottom - body.top < 1.4 * size) return;
    this.root.append(svg('text', { x: fixed(body.right - size), y: fixed(body.top + 1.1 * size), class: 'z' }, 'z'));
  }

  /** Near a place in the picture; where everything is taken, it stays away. */
  put(x: number, y: number, text: string, kind: keyof typeof kSizes): void {
    const characters = [...text];
    const shown = characters.length > kLongest ? `${characters.slice(0, kLongest - 1).join('')}…` : text;
    const size = kSizes[kind] * this.unit, half = this.half(shown, kind), height = 1.2 * size;
    const { frame } = this;
    const middle = Math.min(Math.max(x, frame.left + half), frame.right - half);
    for (const rows of kRows) {
      const base = Math.min(Math.max(y + rows * height, frame.top + 0.6 * height), frame.bottom - 0.6 * height);
      const box = { left: middle - half, right: middle + half, top: base - 0.5 * height, bottom: base + 0.5 * height };
      if (this.taken.some((other) => overlap(box, other))) continue;
      this.taken.push(box);
      this.root.append(svg('text', { x: fixed(middle), y: fixed(base + 0.35 * size), class: kind }, shown));
      return;
    }
  }

  /** The name of a collection beside one of its bodies, with a line to it: the first place that is free. */
  pill(members: Box[], text: string, look: string, bodies: Box[]): void {
    const u = this.unit;
    const [width, height] = [2 * this.half(text, 'collection-name') + 34 * u, 24 * u];
    for (const gap of [30 * u, 60 * u, 110 * u]) {
      for (const box of members) {
        const y = (box.top + box.bottom) / 2;
        for (const side of [1, -1]) {
          const edge = side > 0 ? box.right : box.left;
          const left = side > 0 ? edge + gap : edge - gap - width;
          const place = { left, right: left + width, top: y - height / 2, bottom: y + height / 2 };
          const room = { left: Math.min(left, edge), right: Math.max(left + width, edge), top: place.top, bottom: place.bottom };
          if (!within(place, this.frame) || this.taken.some((other) => overlap(place, other))) continue;
          if (bodies.some((other) => other !== box && overlap(room, other))) continue;
          const from = edge - side * Math.min(8 * u, (box.right - box.left) / 4);
          return this.addPill(place, text, look, [from, y], [side > 0 ? left : left + width, y]);
        }
      }
      for (const box of members) {
        const x = (box.left + box.right) / 2;
        for (const side of [-1, 1]) {
          const edge = side < 0 ? box.top : box.bottom;
          const y = edge + side * (gap + height / 2);
          const place = { left: x - width / 2, right: x + width / 2, top: y - height / 2, bottom: y + height / 2 };
          if (!within(place, this.frame) || this.taken.some((other) => overlap(place, other))) continue;
          if (bodies.some((other) => other !== box && overlap(place, other))) continue;
          return this.addPill(place, text, look, [x, edge - side * Math.min(8 * u, (box.bottom - box.top) / 4)], [x, y - (side * height) / 2]);
        }
      }
    }
  }

  private addPill(place: Box, text: string, look: string, from: [number, number], to: [number, number]): void {
    const u = this.unit;
    this.taken.push(place);
    const { left, top } = place;
    const [height, y] = [place.bottom - top, (top + place.bottom) / 2];
    this.root.append(
      svg('path', { class: 'leader', d: `M${from.map(fixed).join(' ')}L${to.map(fixed).join(' ')}` }),
      svg('circle', { class: 'leader-end', cx: fixed(from[0]), cy: fixed(from[1]), r: fixed(2.5 * u) }),
      svg('rect', { class: 'pill', x: fixed(left), y: fixed(top), width: fixed(place.right - left), height: fixed(height), rx: fixed(height / 2) }),
      svg('rect', { class: `swatch ${look}`, x: fixed(left + 9 * u), y: fixed(y - 6 * u), width: fixed(12 * u), height: fixed(12 * u), rx: fixed(2.5 * u) }),
      svg('text', { class: 'collection-name', x: fixed(left + 26 * u), y: fixed(y + 0.35 * kSizes['collection-name'] * u) }, text));
  }
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

function within(a: Box, b: Box): boolean {
  return a.left >= b.left && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom;
}
