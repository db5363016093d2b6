// Names in a picture: none covers another, and none leaves the picture.
import { svg } from './dom';
import { fixed } from './strokes';
import { kHeight, kWidth } from './view';

interface Box { left: number; right: number; top: number; bottom: number }

const kLongest = 32; // characters; the inspector tells the whole name
const kSizes = { name: 13, 'collection-name': 16 };
/** Where a label may go instead: rows of its height below. */
const kRows = [0, 1, -1, 2, -2, 3, -3];

export class Labels {
  readonly root = svg('g', { class: 'labels' });
  /** Units of the picture per pixel: words keep their size on the screen. */
  unit = 1;
  private taken: Box[] = [];

  clear(): void {
    this.root.replaceChildren();
    this.taken = [];
  }

  /** Near a place in the picture; where everything is taken, it stays away. */
  put(x: number, y: number, text: string, kind: keyof typeof kSizes): void {
    const characters = [...text];
    const shown = characters.length > kLongest ? `${characters.slice(0, kLongest - 1).join('')}…` : text;
    const size = kSizes[kind] * this.unit, half = 0.31 * size * [...shown].length + 2, height = 1.2 * size;
    const middle = Math.min(Math.max(x, half), kWidth - half);
    for (const rows of kRows) {
      const base = Math.min(Math.max(y + rows * height, 0.6 * height), kHeight - 0.6 * height);
      const box = { left: middle - half, right: middle + half, top: base - 0.5 * height, bottom: base + 0.5 * height };
      if (this.taken.some((other) => overlap(box, other))) continue;
      this.taken.push(box);
      this.root.append(svg('text', { x: fixed(middle), y: fixed(base + 0.35 * size), class: kind }, shown));
      return;
    }
  }
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}
