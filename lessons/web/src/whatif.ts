// "What if?": the other runs of the scene, computed beforehand. Those that differ in one threshold
// alone are on a slider over it.
import { h, number } from './dom';
import type { State } from './state';
import type { Trace } from './trace';

/** The tables of a scene in which thresholds stand. */
const kThresholds = /^(merging|unmerging|sleeping)\./;

interface Family {
  name: string; // merging.velocity
  runs: { trace: Trace; value: number }[]; // ascending
}

/** Parameters by their names, as after --set. */
function flat(parameters: Record<string, unknown>, prefix = ''): Map<string, unknown> {
  const out = new Map<string, unknown>();
  for (const [key, value] of Object.entries(parameters)) {
    const isTable = typeof value === 'object' && value !== null && !Array.isArray(value);
    const inner = isTable ? flat(value as Record<string, unknown>, `${prefix}${key}.`) : new Map([[`${prefix}${key}`, value]]);
    for (const [name, found] of inner) out.set(name, found);
  }
  return out;
}

/** The largest family of runs that differ from each other in one and the same threshold alone. */
function familyOf(traces: Trace[]): Family | null {
  const families = new Map<string, Family>();
  for (const trace of traces) {
    const parameters = flat(trace.head.parameters);
    for (const [name, value] of parameters) {
      if (!kThresholds.test(name) || typeof value !== 'number') continue;
      const others = [...parameters].filter(([other]) => other !== name);
      const key = JSON.stringify([name, trace.world, trace.head.mode, others]);
      const family = families.get(key) ?? { name, runs: [] };
      if (!family.runs.some((run) => run.value === value)) family.runs.push({ trace, value });
      families.set(key, family);
    }
  }
  const [best] = [...families.values()].sort((p, q) => q.runs.length - p.runs.length);
  if (!best || best.runs.length < 2) return null;
  best.runs.sort((p, q) => p.value - q.value);
  return best;
}

/** Shows another run at the same step. */
function show(state: State, trace: Trace): void {
  state.trace = trace;
  state.playing = false;
  state.goTo(state.step, state.stage);
}

export function thresholdSlider(state: State): HTMLElement | null {
  const family = familyOf(state.traces);
  if (!family) return null;
  const { name, runs } = family;
  const value = h('output');
  const slider = h('input', {
    type: 'range', min: 0, max: runs.length - 1, step: 1, 'aria-label': `What if: ${name}`,
    oninput: () => show(state, runs[Number(slider.value)].trace),
  });
  const root = h('label', { class: 'plain threshold-slider', title: 'Runs with other thresholds, computed beforehand' }, name, slider, value);
  state.onChange(() => {
    const at = runs.findIndex((run) => run.trace === state.trace);
    root.classList.toggle('away', at < 0); // a run that is not on the slider
    root.hidden = runs[0].trace.world !== state.trace.world;
    if (at >= 0) slider.value = String(at);
    value.textContent = at < 0 ? '–' : number(runs[at].value);
    slider.setAttribute('aria-valuetext', at < 0 ? 'another run' : number(runs[at].value));
  });
  return root;
}

export function whatIf(state: State): HTMLElement | null {
  if (state.traces.length < 2) return null;
  const select = h('select', { 'aria-label': 'What if: another run of the scene', onchange: () => show(state, state.traces[Number(select.value)]) });
  let world = -1;
  state.onChange(() => {
    const { runs } = state;
    if (state.trace.world !== world) {
      world = state.trace.world;
      select.replaceChildren(...runs.map((trace, i) => h('option', { value: state.traces.indexOf(trace) }, i === 0 ? `Compare with … (${trace.label})` : trace.label)));
      select.hidden = runs.length < 2;
    }
    select.value = String(state.traces.indexOf(state.prepared));
    select.disabled = state.live !== null;
  });
  return select;
}

export function badge(state: State): HTMLElement {
  const root = h('div', { class: 'badge' });
  state.onChange(() => {
    root.textContent = state.live || state.trace === state.runs[0] ? '' : `What if: ${state.trace.label}`;
    root.hidden = root.textContent === '';
  });
  return root;
}
