// Pan, zoom and fit: which part of the picture is seen. The scale bar tells how large it is.
import { number, svg } from './dom';
import type { Box } from './labels';
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
  /** A second scale beside the metres: " · 10 m/s". */
  private second = '';
  private home: Box | null = null;
  private athome = true;
  private paper = 0; // units per pixel on paper, which has no layout yet
  private x = 0;
  private y = 0;
  private zoom = 1;

  constructor(private readonly root: SVGSVGElement, private readonly view: View) {
    this.apply();
    new ResizeObserver(() => {
      if (this.athome) this.fit();
      else this.apply();
    }).observe(root);
  }

  get isWhole(): boolean {
    return this.athome;
  }

  fit(): void {
    this.athome = true;
    [this.x, this.y, this.zoom] = [0, 0, 1];
    if (this.home) this.fitTo(this.home);
    this.apply();
  }
  /** For a sheet of paper: so many units of the picture are a pixel, whatever the screen does. */
  onPaper(unit: number): void {
    this.paper = unit;
    this.fit();
  }
  private frame(): { width: number; height: number } {
    return this.paper > 0 ? { width: kWidth / this.paper, height: kHeight / this.paper } : this.root.getBoundingClientRect();
  }
  /** The part of the picture that one sees at first, and with "fit"; null is the whole of it. */
  setHome(home: Box | null): void {
    if (home === this.home) return;
    this.home = home;
    if (this.athome) this.fit();
  }
  /** Sees the same as another one. */
  follow(other: Lens): void {
    if (other.athome) {
      this.home = other.home;
      return this.fit();
    }
    [this.x, this.y, this.zoom, this.athome] = [other.x, other.y, other.zoom, false];
    this.apply();
  }
  /** The part that is seen, with what is beside the picture in its frame. */
  get visible(): Box {
    const { x, y, unit } = this;
    const box = this.frame();
    const [w, h] = [kWidth / this.zoom, kHeight / this.zoom];
    const [dx, dy] = box.width > 0 ? [Math.max(0, box.width * unit - w) / 2, Math.max(0, box.height * unit - h) / 2] : [0, 0];
    return { left: x - dx, right: x + w + dx, top: y - dy, bottom: y + h + dy };
  }
  /** Tells what a metre of the scale bar means as a velocity [m/s per m]; 0: nothing. */
  setSecond(perMetre: number): void {
    const second = perMetre > 0 ? String(perMetre) : '';
    if (second === this.second) return;
    this.second = second;
    this.drawScaleBar();
  }

  private fitTo(home: Box): void {
    const box = this.frame();
    const unit = box.width > 0 ? Math.max(kWidth / box.width, kHeight / box.height) : 1;
    const [w, h] = box.width > 0 ? [box.width * unit, box.height * unit] : [kWidth, kHeight];
    // Free pixels: above for the scale bar and the counts, beside for names.
    const two = this.root.closest('.two') !== null;
    const [above, beside, below] = two ? [60 * unit, 12 * unit, 44 * unit] : [44 * unit, 28 * unit, 14 * unit];
    const zoom = Math.min((w - 2 * beside) / (home.right - home.left), (h - above - below) / (home.bottom - home.top));
    this.zoom = Math.min(2.5, Math.max(0.5, zoom));
    this.x = (home.left + home.right - kWidth / this.zoom) / 2;
    this.y = (home.top + home.bottom - (kHeight + above - below) / this.zoom) / 2;
  }
  /** By a factor, about a point of the picture that stays where it is. */
  zoomBy(factor: number, at: { x: number; y: number } = { x: this.x + kWidth / 2 / this.zoom, y: this.y + kHeight / 2 / this.zoom }): void {
    const zoom = Math.min(kClosest, Math.max(0.25, this.zoom * factor));
    this.x = at.x - ((at.x - this.x) * this.zoom) / zoom;
    this.y = at.y - ((at.y - this.y) * this.zoom) / zoom;
    this.zoom = zoom;
    this.athome = false;
    this.apply();
  }
  moveBy(dx: number, dy: number): void {
    this.athome = false;
    this.x -= dx;
    this.y -= dy;
    this.apply();
  }
  /** Brings a point of the picture to the middle. */
  centre(x: number, y: number): void {
    this.athome = false;
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
    const box = this.frame();
    const unit = box.width > 0 ? Math.max(kWidth / box.width, kHeight / box.height) : 1;
    this.unit = unit / this.zoom;
    this.root.style.setProperty('--u', this.unit.toFixed(4));
    const perMetre = (this.view.scale * this.zoom) / unit;
    const longest = 160 / perMetre; // metres in 160 pixels
    const power = 10 ** Math.floor(Math.log10(longest));
    const round = [5, 2, 1].map((m) => m * power).find((m) => m <= longest) ?? power;
    const length = round * perMetre;
    // The picture is in the middle of its frame: its left edge may be left of the fitted part.
    // Beside another picture the heading is at the top.
    const low = this.root.closest('.two') !== null;
    const [left, top] = [this.x - Math.max(0, box.width * unit - kWidth) / 2 / this.zoom, this.y - Math.max(0, box.height * unit - kHeight) / 2 / this.zoom];
    this.scaleBar.setAttribute('transform', `translate(${fixed(left)} ${fixed(low ? top + ((box.height - 44) * unit) / this.zoom : top)}) scale(${(unit / this.zoom).toFixed(4)})`);
    this.scaleBar.replaceChildren(svg('path', { d: `M16 24v8h${fixed(length)}v-8` }),
      svg('text', { x: fixed(16 + length / 2), y: 20 }, `${round >= 1 ? `${round} m` : `${number(round * 100)} cm`}${this.second && ` · ${number(Number(this.second) * round)} m/s`}`));
  }
}
