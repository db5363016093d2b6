// A line over time, with a threshold and a cursor; the axis may be logarithmic.
import { number, svg } from './dom';

export interface Series {
  label: string;
  unit: string;
  points: [step: number, value: number][];
  threshold?: number;
  logarithmic?: boolean;
}

const kWidth = 360;
const kHeight = 110;
const kLeft = 52;
const kRight = 8;
const kTop = 8;
const kBottom = 18;

export function chart(series: Series, steps: number, timeAt: (step: number) => number, step: number, onStep: (step: number) => void): SVGSVGElement {
  const values = series.points.map(([, v]) => v);
  const shown = series.threshold !== undefined && series.threshold > 0 ? [...values, series.threshold] : values;
  const log = series.logarithmic === true && shown.some((v) => v > 0);
  const floor = log ? Math.max(1e-9, (series.threshold ?? Math.max(...shown)) * 1e-3) : 0;
  const axis = (v: number) => (log ? Math.log10(Math.max(floor, Math.abs(v))) : v);
  let [low, high] = shown.length > 0 ? [Math.min(...shown.map(axis)), Math.max(...shown.map(axis))] : [0, 1];
  if (!log) [low, high] = [Math.min(0, low), Math.max(0, high)];
  const pad = 0.08 * (high - low || 1);
  [low, high] = [log || low < 0 ? low - pad : low, high + pad];
  const x = (s: number) => kLeft + ((kWidth - kLeft - kRight) * s) / Math.max(1, steps);
  const y = (v: number) => kTop + (kHeight - kTop - kBottom) * (1 - (axis(v) - low) / (high - low));

  const root = svg('svg', {
    viewBox: `0 0 ${kWidth} ${kHeight}`, class: 'chart', role: 'img',
    'aria-label': `${series.label} over time`,
    onclick: (event) => {
      const matrix = root.getScreenCTM();
      const mouse = event as MouseEvent;
      if (!matrix) return;
      const at = new DOMPoint(mouse.clientX, mouse.clientY).matrixTransform(matrix.inverse());
      onStep(((at.x - kLeft) / (kWidth - kLeft - kRight)) * steps);
    },
  });
  root.append(svg('path', { class: 'axis', d: `M${kLeft} ${kTop}V${kHeight - kBottom}H${kWidth - kRight}` }));
  // Ticks: decades, or the ends.
  const ticks = log
    ? Array.from({ length: Math.ceil(high) - Math.ceil(low) }, (_, i) => 10 ** (Math.ceil(low) + i))
    : [...new Set([0, Math.max(...shown, 0), Math.min(...shown, 0)])];
  for (const tick of ticks.slice(-5)) {
    root.append(svg('path', { class: 'grid', d: `M${kLeft} ${y(tick).toFixed(1)}H${kWidth - kRight}` }),
      svg('text', { x: kLeft - 5, y: (y(tick) + 3.5).toFixed(1), class: 'tick end' }, number(tick, 2)));
  }
  root.append(svg('text', { x: kLeft, y: kHeight - 5, class: 'tick' }, '0 s'),
    svg('text', { x: kWidth - kRight, y: kHeight - 5, class: 'tick end' }, `${number(timeAt(steps))} s`));
  if (series.threshold !== undefined && series.threshold > 0) {
    const at = y(series.threshold).toFixed(1);
    root.append(svg('path', { class: 'threshold', d: `M${kLeft} ${at}H${kWidth - kRight}` }));
  }
  let d = '';
  let last = -Infinity;
  const gap = Math.max(1, ...series.points.slice(0, 2).map(([s], i, all) => (i > 0 ? s - all[0][0] : 1)));
  for (const [s, v] of series.points) {
    d += `${s - last > 2 * gap ? 'M' : 'L'}${x(s).toFixed(1)} ${y(v).toFixed(1)}`;
    last = s;
  }
  root.append(svg('path', { class: 'line', d }), svg('path', { class: 'cursor', d: `M${x(step).toFixed(1)} ${kTop}V${kHeight - kBottom}` }));
  const here = series.points.find(([s]) => s === step);
  if (here) root.append(svg('circle', { class: 'point', cx: x(step).toFixed(1), cy: y(here[1]).toFixed(1), r: 3.5 }));
  return root;
}
