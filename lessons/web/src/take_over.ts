// The panel of a run that was taken over: tools, limits, the list of changes, the way back.
import { h, number } from './dom';
import { kLimits, kTimeStep, type Limit } from './limits';
import { roving } from './rail';
import type { State, Tool } from './state';

const kTools: { id: Tool; label: string; sign: string; how: string }[] = [
  { id: 'drag', label: 'Drag', sign: '✥', how: 'Drag any body; let go while it moves to throw it.' },
  { id: 'push', label: 'Push', sign: '→', how: 'Pull an arrow from a body: its impulse stands beside it.' },
  { id: 'throw', label: 'Throw', sign: '↗', how: 'Pull an arrow from a body: it gets that velocity.' },
  { id: 'pin', label: 'Pin', sign: '⚲', how: 'Click a body to hold it where it is; click again to let it go.' },
  { id: 'box', label: 'Add box', sign: '▭', how: 'Click where a box is to appear.' },
  { id: 'disc', label: 'Add disc', sign: '○', how: 'Click where a disc is to appear.' },
  { id: 'delete', label: 'Delete', sign: '✕', how: 'Click a body to take it out.' },
  { id: 'ask', label: 'Ask why', sign: '?', how: 'Click two bodies: why are they merged, or not?' },
];

const kModes = ['merge+sleep', 'merge', 'sleep', 'reference'];

/** A slider for one setting of the run: it applies from the next step on. */
function slider(state: State, limit: Limit): HTMLElement {
  const log = !limit.whole;
  const to = (value: number) => (log ? Math.log10(value) : value);
  const from = (at: number) => (log ? Number((10 ** at).toPrecision(2)) : Math.round(at));
  const was = h('span', { class: 'was' });
  const tick = h('span', { class: 'paper-tick', 'aria-hidden': true }, 'paper');
  const [low, high] = [to(limit.low), to(limit.high)];
  tick.style.left = `${(100 * (to(limit.paper) - low)) / (high - low)}%`;
  const input = h('input', {
    type: 'range', min: low, max: high, step: log ? 0.01 : 1, 'aria-label': limit.label, 'data-key': limit.key,
    oninput: () => show(from(Number(input.value))),
    onchange: () => state.act(`set ${limit.key}=${from(Number(input.value))}`),
  });
  let first: number | undefined; // at the fork
  let now = limit.paper;
  // The value can be typed, too; a text that is no number is not taken.
  const typed = h('input', {
    type: 'text', class: 'typed', inputmode: 'decimal', autocomplete: 'off', 'aria-label': `${limit.label}, value in ${limit.unit}`,
    onchange: () => {
      const value = Number(typed.value.trim().replace(',', '.'));
      if (value > 0 && (log || Number.isInteger(value))) state.act(`set ${limit.key}=${value}`);
      else show(now);
    },
  });
  const show = (value: number) => {
    now = value;
    typed.value = log && value >= 1e-3 ? value.toFixed(3) : String(value);
    input.setAttribute('aria-valuetext', `${number(value)} ${limit.unit}, paper ${number(limit.paper)}`);
    was.textContent = first !== undefined && first !== value ? `was ${number(first)}` : '';
  };
  return settingRow(state, limit.label, h('span', {}, typed, ` ${limit.unit}`), was, h('div', { class: 'track' }, input, tick), (settings, atFork) => {
    first = Number(atFork[limit.key]);
    const value = Number(settings[limit.key]);
    if (document.activeElement !== input || Number(from(Number(input.value))) !== value) input.value = String(to(Math.max(value, 1e-12)));
    if (document.activeElement !== typed) show(value);
  });
}

type Settings = Record<string, number | string | boolean | number[]>;

function settingRow(state: State, label: string, output: HTMLElement, was: HTMLElement, control: HTMLElement, read: (now: Settings, atFork: Settings) => void): HTMLElement {
  state.onChange(() => {
    if (!state.live || state.playing) return;
    read(settingsNow(state), settingsAtFork(state));
  });
  return h('div', { class: 'limit' }, h('div', { class: 'limit-head' }, h('span', {}, label), h('span', {}, output, was)), control);
}

let cached: { key: string; now: Settings; fork: Settings } | null = null;
function cachedSettings(state: State): { now: Settings; fork: Settings } {
  const { live } = state;
  if (!live) return { now: {}, fork: {} };
  const key = `${live.fork}|${live.deeds.filter((deed) => deed.step <= state.step).map((deed) => deed.line).filter((line) => line.startsWith('set')).join(';')}`;
  if (cached?.key !== key) {
    const gone = live.deeds.filter((deed) => deed.line.startsWith('set') && deed.step <= state.step);
    const now = live.settings(state.step);
    cached = { key, now, fork: cached && gone.length > 0 && cached.key.startsWith(`${live.fork}|`) ? cached.fork : now };
  }
  return cached;
}
const settingsNow = (state: State) => cachedSettings(state).now;
const settingsAtFork = (state: State) => cachedSettings(state).fork;

function gravitySlider(state: State): HTMLElement {
  const output = h('output');
  const was = h('span', { class: 'was' });
  const input = h('input', {
    type: 'range', min: -20, max: 5, step: 0.1, 'aria-label': 'Gravity, upwards', 'data-key': 'gravity',
    oninput: () => { output.textContent = `${input.value} m/s²`; },
    onchange: () => state.act(`set "gravity=[0, ${Number(input.value).toFixed(2)}]"`),
  });
  return settingRow(state, 'Gravity, upwards', output, was, h('div', { class: 'track' }, input), (now, atFork) => {
    const g = (now.gravity as number[] | undefined)?.[1] ?? 0;
    const first = (atFork.gravity as number[] | undefined)?.[1] ?? 0;
    input.value = String(g);
    output.textContent = `${number(g)} m/s²`;
    input.setAttribute('aria-valuetext', `${number(g)} metres per second squared`);
    was.textContent = first !== g ? `was ${number(first)}` : '';
  });
}

function frictionSlider(state: State): HTMLElement {
  const output = h('output', {}, 'as the bodies have it');
  const input = h('input', {
    type: 'range', min: 0, max: 1.5, step: 0.01, value: 0.6, 'aria-label': 'Friction of all bodies', 'data-key': 'friction',
    'aria-valuetext': 'as the bodies have it',
    oninput: () => {
      output.textContent = `μ = ${Number(input.value).toFixed(2)}`;
      input.setAttribute('aria-valuetext', Number(input.value).toFixed(2));
    },
    onchange: () => state.act(`set friction=${Number(input.value).toFixed(2)}`),
  });
  state.onChange(() => {
    const last = state.live?.deeds.filter((deed) => deed.line.startsWith('set friction=')).pop();
    if (!last && document.activeElement !== input) output.textContent = 'as the bodies have it';
  });
  return h('div', { class: 'limit' }, h('div', { class: 'limit-head' }, h('span', {}, 'Friction of all bodies'), output), h('div', { class: 'track' }, input));
}

function modeChoice(state: State): HTMLElement {
  const select = h('select', { 'aria-label': 'Mode', onchange: () => state.act(`set mode=${select.value}`) },
    ...kModes.map((mode) => h('option', { value: mode }, mode)));
  state.onChange(() => {
    if (state.live && !state.playing) select.value = String(settingsNow(state).mode ?? 'merge+sleep');
  });
  return h('label', { class: 'limit limit-head' }, 'Mode', select);
}

function besideChoice(state: State): HTMLElement {
  const select = h('select', {
    'aria-label': 'Beside it', onchange: () => {
      if (select.value === '') state.layers.delete('beside');
      else {
        state.besideKind = select.value as 'reference' | 'paper';
        state.layers.add('beside');
      }
      state.changed();
    },
  }, h('option', { value: '' }, 'nothing'), h('option', { value: 'reference' }, 'the reference: nothing merged'), h('option', { value: 'paper' }, 'the same by the paper’s rule'));
  state.onChange(() => { select.value = state.layers.has('beside') ? state.besideKind : ''; });
  return h('label', { class: 'limit limit-head' }, 'Beside it', select);
}

/** A drag is told once. */
function deeds(state: State): HTMLElement[] {
  const all = state.live?.deeds ?? [];
  const shown = all.filter((deed, i) => !(/^drag /.test(deed.line) && /^drag /.test(all[i + 1]?.line ?? '')));
  if (shown.length === 0) return [h('li', { class: 'hint' }, 'Nothing yet.')];
  return shown.slice(-8).map((deed) => h('li', {}, h('button', {
    type: 'button', class: 'link', onclick: () => {
      state.playing = false;
      state.goTo(deed.step);
    },
  }, `${state.trace.timeAt(deed.step).toFixed(2)} s`), ` ${state.trace.told(deed.told)}`));
}

export interface LivePanel {
  root: HTMLElement;
  say: (text: string) => void;
}

export function livePanel(state: State, wayBack: string): LivePanel {
  const title = h('p', { class: 'place' });
  const how = h('p', { class: 'hint' });
  const tools = kTools.map((tool) => h('button', {
    type: 'button', class: 'tool', 'data-tool': tool.id, onclick: () => {
      state.tool = tool.id;
      state.selection = null;
      state.changed();
    },
  }, h('span', { 'aria-hidden': true }, tool.sign), tool.label));
  roving(tools);
  const done = h('ol', { class: 'deeds' });
  const status = h('p', { class: 'aim-text', role: 'status' });
  const papers = h('button', {
    type: 'button', class: 'link', onclick: () => {
      for (const limit of kLimits) state.act(`set ${limit.key}=${limit.paper}`);
    },
  }, 'Back to the paper’s values');
  const undo = h('button', { type: 'button', class: 'plain', onclick: () => state.undo() }, 'Undo');
  const again = h('button', {
    type: 'button', class: 'link', onclick: () => {
      state.playing = false;
      state.goTo(state.first);
    },
  }, 'Again from where you took over');
  const back = h('button', { type: 'button', class: 'primary', onclick: () => state.giveBack() }, wayBack);
  state.onChange(() => {
    if (!state.live) return;
    title.textContent = `Your run, since ${state.trace.timeAt(state.live.fork).toFixed(2)} s`;
    for (const button of tools) {
      const on = button.dataset.tool === state.tool;
      button.setAttribute('aria-pressed', String(on));
      button.tabIndex = on ? 0 : -1;
    }
    how.textContent = kTools.find((tool) => tool.id === state.tool)?.how ?? '';
    done.replaceChildren(...deeds(state));
    undo.disabled = state.live.deeds.length === 0;
  });
  const root = h('section', { class: 'words panel live-panel', 'aria-label': 'Your run' },
    h('div', { class: 'scrolls', tabindex: 0 },
      title, h('h2', {}, 'Try it yourself'),
      h('div', { class: 'tools-grid', role: 'group', 'aria-label': 'Tools' }, ...tools), how, status,
      besideChoice(state),
      h('h3', {}, 'Limits ', h('span', { class: 'hint' }, '(Table 1 of the paper)')),
      ...kLimits.slice(0, 2).map((limit) => slider(state, limit)),
      h('details', { class: 'all-limits' }, h('summary', {}, 'All eight limits, friction, gravity, time step, mode'),
        ...kLimits.slice(2).map((limit) => slider(state, limit)), frictionSlider(state), gravitySlider(state), slider(state, kTimeStep), modeChoice(state)),
      papers,
      h('h3', {}, 'What you changed'), done, again),
    h('div', { class: 'actions' }, undo, back));
  return { root, say: (text) => { status.textContent = text; } };
}
