// Pan, zoom and fit: which part of the picture is seen. The scale bar tells how large it is.
import { number, svg } from './dom';
import { fixed } from './strokes';
import { kHeight, kWidth, type View } from './view';

const kClosest = 12;

export class Lens {
  readonly scaleBar = svg('g', { class: 'scale-bar' });
  /** Whether the pointer that was just lifted has moved the picture: then it has chosen nothing. */
  moved = false;
  /** Called when the visible part of the picture changes. */
  onChange: () => void = () => {};
  /** Units of the picture per pixel. */
  unit = 1;
  private x = 0;
  private y = 0;
  private zoom = 1;

  constructor(private readonly root: SVGSVGElement, private readonly view: View) {
    this.apply();
    new ResizeObserver(() => this.apply()).observe(root);
  }

  get isWhole(): boolean {
    return this.zoom === 1 && this.x === 0 && this.y === 0;
  }

  fit(): void {
    [this.x, this.y, this.zoom] = [0, 0, 1];
    this.apply();
  }
  /** By a factor, about a point of the picture that stays where it is. */
  zoomBy(factor: number, at: { x: number; y: number } = { x: this.x + kWidth / 2 / this.zoom, y: this.y + kHeight / 2 / this.zoom }): void {
    const zoom = Math.min(kClosest, Math.max(0.25, this.zoom * factor));
    this.x = at.x - ((at.x - this.x) * this.zoom) / zoom;
    this.y = at.y - ((at.y - this.y) * this.zoom) / zoom;
    this.zoom = zoom;
    this.apply();
  }
  moveBy(dx: number, dy: number): void {
    this.x -= dx;
    this.y -= dy;
    this.apply();
  }
  /** Brings a point of the picture to the middle. */
  centre(x: number, y: number): void {
    this.x = x - kWidth / 2 / this.zoom;
    this.y = y - kHeight / 2 / this.zoom;
    this.apply();
  }

  private apply(): void {
    this.root.setAttribute('viewBox', `${fixed(this.x)} ${fixed(this.y)} ${fixed(kWidth / this.zoom)} ${fixed(kHeight / this.zoom)}`);
    this.drawScaleBar();
    this.onChange();
  }

  private drawScaleBar(): void {
    // Units of the picture per pixel of the screen, so that words keep their size.
    const box = this.root.getBoundingClientRect();
    const unit = box.width > 0 ? Math.max(kWidth / box.width, kHeight / box.height) : 1;
    this.unit = unit / this.zoom;
    this.root.style.setProperty('--u', this.unit.toFixed(4));
    const perMetre = (this.view.scale * this.zoom) / unit;
    const longest = 160 / perMetre; // metres in 160 pixels
    const power = 10 ** Math.floor(Math.log10(longest));
    const round = [5, 2, 1].map((m) => m * power).find((m) => m <= longest) ?? power;
    const length = round * perMetre;
    // The picture is in the middle of its frame: its left edge may be left of the fitted part.
    const [left, top] = [this.x - Math.max(0, box.width * unit - kWidth) / 2 / this.zoom, this.y - Math.max(0, box.height * unit - kHeight) / 2 / this.zoom];
    this.scaleBar.setAttribute('transform', `translate(${fixed(left)} ${fixed(top)}) scale(${(unit / this.zoom).toFixed(4)})`);
    this.scaleBar.replaceChildren(svg('path', { d: `M16 24v8h${fixed(length)}v-8` }),
      svg('text', { x: fixed(16 + length / 2), y: 20 }, round >= 1 ? `${round} m` : `${number(round * 100)} cm`));
  }
}
