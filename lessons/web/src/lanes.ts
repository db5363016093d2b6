// Events over time: a lane for each kind, flags for the parts of a lesson, and where a run was taken over.
import { svg } from './dom';
import { eventText } from './now';
import type { State } from './state';

interface Lane {
  label: string;
  kinds: string[];
  mark: (x: number, y: number) => string;
}

const kLanes: Lane[] = [
  { label: 'Hits', kinds: ['impact'], mark: (x, y) => `M${x} ${y - 4}l4 8h-8z` },
  { label: 'Unmerges', kinds: ['unmerge', 'break'], mark: (x, y) => `M${x - 3} ${y - 3}l6 6m0 -6l-6 6` },
  { label: 'Merges', kinds: ['merge'], mark: (x, y) => `M${x - 2.5} ${y - 3.5}h5v7h-5z` },
  { label: 'Sleep', kinds: ['sleep', 'wake'], mark: (x, y) => `M${x - 3} ${y}a3 3 0 1 0 6 0a3 3 0 1 0 -6 0` },
];
export const kSliderInset = { left: 80, right: 14 };
/** Without names and parts where there is little room. */
const kNarrow = matchMedia('(max-width: 699px), (max-height: 499px)');

export interface Flag {
  step: number;
  label: string;
}

export function lanes(state: State, flags: () => Flag[]): SVGSVGElement {
  const root = svg('svg', { class: 'marks', role: 'img', 'aria-label': 'Events over time' });
  let width = 0;
  let drawn = '';
  let kLeft = kSliderInset.left, kRight = kSliderInset.right, kPitch = 15;
  const x = (step: number) => kLeft + ((width - kLeft - kRight) * step) / Math.max(1, state.steps);

  const draw = () => {
    const last = state.live ? state.live.trace.known : state.steps;
    const until = state.veiled ? state.step : last;
    const narrow = kNarrow.matches;
    [kLeft, kRight, kPitch] = narrow ? [11, 11, 9] : [kSliderInset.left, kSliderInset.right, 15];
    const key = [narrow, width, state.trace.label, state.trace.head.mode, until, state.steps, state.live?.deeds.length, flags().length].join('|');
    if (width === 0 || key === drawn) return;
    drawn = key;
    const shown = kLanes.filter((lane, i) => i < 3 || state.trace.eventSteps(lane.kinds).length > 0);
    const height = shown.length * kPitch + (narrow ? 2 : 18);
    root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    root.style.height = `${height}px`;
    root.replaceChildren();
    for (const [row, lane] of shown.entries()) {
      const y = row * kPitch + kPitch / 2 + 1;
      if (!narrow) root.append(svg('text', { class: 'lane-name', x: 0, y: y + 4 }, lane.label));
      root.append(svg('rect', { class: 'lane', x: kLeft, y: y - (narrow ? 3 : 6), width: Math.max(0, width - kLeft - kRight), height: narrow ? 6 : 12, rx: 2 }));
      let d = '';
      let before = -Infinity;
      for (const step of state.trace.eventSteps(lane.kinds)) {
        if (step > until) break;
        const at = x(step);
        if (at - before < 1.5) continue;
        before = at;
        d += lane.mark(Number(at.toFixed(1)), y);
      }
      root.append(svg('path', { d, class: `mark ${lane.kinds[0]}` }));
    }
    drawFork(height);
    if (!narrow) drawFlags(height);
  };

  const drawFork = (height: number) => {
    if (!state.live) return;
    const from = x(state.live.fork);
    root.append(
      svg('defs', {}, svg('pattern', { id: 'own-run', width: 6, height: 6, patternUnits: 'userSpaceOnUse' }, svg('path', { d: 'M0 6L6 0' }))),
      svg('rect', { class: 'own-run', x: from, y: 1, width: Math.max(0, width - kRight - from), height: Math.max(0, height - (kNarrow.matches ? 2 : 18)) }),
      svg('path', { class: 'fork', d: `M${from} 0V${height - 14}` }),
      svg('text', { class: 'lane-name own', x: width - kRight - 4, y: kPitch + kPitch / 2 + 5 }, 'your run'));
    for (const deed of state.live.deeds.filter((one, i, all) => all[i - 1]?.step !== one.step)) {
      root.append(svg('path', { class: 'deed', d: `M${x(deed.step)} 0v3` }));
    }
  };

  const drawFlags = (height: number) => {
    let before = -Infinity;
    for (const flag of [...flags()].sort((p, q) => p.step - q.step)) {
      const at = x(flag.step);
      const shifted = Math.max(at, before + 11); // two parts of one moment stand side by side
      before = shifted;
      root.append(svg('path', { class: 'flag', d: `M${at} ${height - 16}v5` }),
        svg('text', { class: 'flag-name', x: Math.min(shifted, width - 6), y: height - 1 }, flag.label));
    }
    if (flags().length > 0) return;
    const seconds = state.trace.timeAt(state.steps);
    const power = 10 ** Math.floor(Math.log10(Math.max(1e-6, seconds / 4)));
    const every = [1, 2, 5, 10].map((m) => m * power).find((m) => seconds / m <= 8) ?? power;
    for (let t = 0; t <= seconds + 1e-9; t += every) {
      const at = x(state.trace.stepAt(t));
      root.append(svg('path', { class: 'flag', d: `M${at} ${height - 16}v4` }),
        svg('text', { class: 'flag-name', x: at, y: height - 1 }, `${Number(t.toPrecision(6))} s`));
    }
  };

  /** The step with an event that is nearest to the pointer. */
  const eventAt = (event: MouseEvent): number | undefined => {
    const at = event.clientX - root.getBoundingClientRect().left;
    const until = state.veiled ? state.step : Infinity;
    const near = state.trace.eventSteps().filter((step) => step <= until && Math.abs(x(step) - at) < 6);
    return near.sort((p, q) => Math.abs(x(p) - at) - Math.abs(x(q) - at))[0];
  };
  const tip = svg('title');
  root.addEventListener('pointermove', (event) => {
    const step = eventAt(event);
    root.style.cursor = step === undefined ? '' : 'pointer';
    const rows = step === undefined ? [] : state.trace.eventsAt.get(step) ?? [];
    const more = rows.length > 3 ? `, and ${rows.length - 3} more` : '';
    tip.textContent = step === undefined ? '' : `${state.trace.timeAt(step).toFixed(2)} s: ${rows.slice(0, 3).map((row) => eventText(state.trace, row)).join('; ')}${more}`;
    if (tip.parentNode !== root) root.prepend(tip);
  });
  root.addEventListener('click', (event) => {
    const step = eventAt(event);
    if (step === undefined) return;
    state.playing = false;
    state.goTo(step);
  });

  new ResizeObserver(() => {
    const now = root.getBoundingClientRect().width;
    if (Math.abs(now - width) < 1) return;
    width = now;
    draw();
  }).observe(root);
  state.onChange(draw);
  return root;
}
