// The ribbon of stages, the transport, the slider and the layer switches.
import { h, svg } from './dom';
import { kStages } from './stages';
import { kLayers, kOfReference, type State } from './state';

const kEventKinds = ['impact', 'unmerge', 'merge', 'sleep', 'wake'] as const;
const kSpeeds = [0.02, 0.1, 0.25, 0.5, 1, 2, 4];

export function ribbon(state: State): HTMLElement {
  const buttons = kStages.map((stage, i) =>
    h('button', { type: 'button', class: 'stage', title: stage.what, onclick: () => state.goTo(Math.max(1, state.step), i) },
      h('span', { class: 'number' }, String(i + 1)), h('span', { class: 'name' }, stage.label)));
  state.onChange(() => {
    for (const [i, button] of buttons.entries()) {
      const current = state.step > 0 && i === state.stage;
      if (current) button.setAttribute('aria-current', 'step');
      else button.removeAttribute('aria-current');
      button.classList.toggle('done', state.step > 0 && i < state.stage);
    }
  });
  return h('nav', { class: 'ribbon', 'aria-label': 'Stages of this time step' }, ...buttons);
}

export interface Transport {
  root: HTMLElement;
  toggle: () => void;
  faster: (by: number) => void;
}

/** The event marks above the slider, as lanes. */
function marks(state: State): SVGSVGElement {
  const lane = 5;
  const root = svg('svg', {
    class: 'marks', viewBox: `0 0 1000 ${lane * kEventKinds.length}`, preserveAspectRatio: 'none', 'aria-hidden': true,
  });
  for (const [row, kind] of kEventKinds.entries()) {
    let d = '';
    let last = -Infinity;
    for (const step of state.trace.eventSteps([kind])) {
      const x = (1000 * step) / state.steps;
      if (x - last < 0.8) continue;
      last = x;
      d += `M${x.toFixed(1)} ${row * lane + 0.5}v${lane - 1}`;
    }
    root.append(svg('path', { d, class: `mark ${kind}` }));
  }
  return root;
}

export function transport(state: State): Transport {
  const button = (label: string, icon: string, action: () => void, key?: string) =>
    h('button', { type: 'button', class: 'icon', 'aria-label': label, title: key ? `${label} (${key})` : label, onclick: action },
      svg('svg', { viewBox: '0 0 24 24', 'aria-hidden': true }, svg('path', { d: icon })));

  const kPlay = 'M7 4v16l13-8z';
  const kPause = 'M6 4h4v16h-4zM14 4h4v16h-4z';
  const play = button('Play', kPlay, () => toggle(), 'Space');
  const slider = h('input', {
    type: 'range', min: 0, max: state.steps, step: 1, value: 0, class: 'slider', 'aria-label': 'Time step',
    oninput: () => {
      state.playing = false;
      state.goTo(Number(slider.value));
    },
  });
  const speed = h('select', { 'aria-label': 'Playback speed', onchange: () => { state.speed = Number(speed.value); } },
    ...kSpeeds.map((s) => h('option', { value: s }, s < 1 ? `1/${Math.round(1 / s)} speed` : s === 1 ? 'real time' : `${s}× speed`)));
  speed.value = String(state.speed);
  const marksHolder = h('div', { class: 'marks-holder' }, marks(state));
  const clock = h('output', { class: 'clock' });

  let before = 0;
  let rest = 0;
  const frame = (now: number) => {
    if (!state.playing) return;
    const due = rest + ((now - before) / 1000) * (state.speed / state.trace.head.h);
    before = now;
    const whole = Math.min(Math.floor(due), Math.max(1, Math.ceil(0.25 / state.trace.head.h)));
    rest = Math.min(1, due - Math.floor(due));
    if (whole > 0) {
      const target = Math.min(state.steps, state.step + whole);
      const stop = state.stopBefore(state.step, target);
      state.goTo(stop ?? target);
      if (stop !== undefined || state.step >= state.steps) state.pause();
    }
    requestAnimationFrame(frame);
  };
  function toggle(): void {
    if (state.playing) return state.pause();
    if (state.step >= state.steps) state.goTo(0);
    state.playing = true;
    before = performance.now();
    rest = 0;
    state.changed();
    requestAnimationFrame(frame);
  }
  const halt = (action: () => void) => () => {
    state.playing = false;
    action();
  };

  let marked = state.trace;
  state.onChange(() => {
    slider.value = String(state.step);
    slider.setAttribute('aria-valuetext', `step ${state.step} of ${state.steps}, ${state.time.toFixed(2)} seconds`);
    slider.style.setProperty('--done', `${(100 * state.step) / Math.max(1, state.steps)}%`);
    clock.textContent = `${state.time.toFixed(2)} s · step ${state.step} of ${state.steps}`;
    const label = state.playing ? 'Pause' : 'Play';
    if (play.getAttribute('aria-label') !== label) {
      play.setAttribute('aria-label', label);
      play.title = `${label} (Space)`;
      play.querySelector('path')?.setAttribute('d', state.playing ? kPause : kPlay);
    }
    if (marked !== state.trace) {
      marked = state.trace;
      marksHolder.replaceChildren(marks(state));
    }
  });

  const root = h('div', { class: 'transport' },
    h('div', { class: 'timeline' }, marksHolder, slider),
    h('div', { class: 'buttons', role: 'group', 'aria-label': 'Playback' },
      button('To the start', 'M5 4h3v16H5zM20 4v16L9 12z', halt(() => state.goTo(0)), 'Home'),
      button('Previous event', 'M4 12l8-7v14zM12 12l8-7v14z', halt(() => state.nextEvent(undefined, -1)), '['),
      button('One step back', 'M16 5v14L6 12z', halt(() => state.goTo(state.step - 1, state.stage)), '←'),
      play,
      button('One step forward', 'M8 5v14l10-7z', halt(() => state.goTo(state.step + 1, state.stage)), '→'),
      button('Next event', 'M4 5l8 7-8 7zM12 5l8 7-8 7z', halt(() => state.nextEvent(undefined, 1)), ']'),
      button('To the end', 'M16 4h3v16h-3zM4 4v16l11-8z', halt(() => state.goTo(state.steps)), 'End'),
      clock,
      speed));
  const faster = (by: number) => {
    const at = Math.max(0, Math.min(kSpeeds.length - 1, kSpeeds.indexOf(state.speed) + by));
    state.speed = kSpeeds[at];
    speed.value = String(state.speed);
  };
  return { root, toggle, faster };
}

export function layerSwitches(state: State): HTMLElement {
  const buttons = kLayers
    .filter((layer) => !kOfReference.includes(layer.id) || state.reference !== undefined)
    .map((layer) => {
      const digit = kLayers.indexOf(layer) + 1;
      const button = h('button', {
        type: 'button', class: 'chip', title: `Layer ${digit}`,
        onclick: () => {
          toggleLayer(state, digit);
        },
      }, h('kbd', { 'aria-hidden': true }, String(digit)), layer.label);
      state.onChange(() => button.setAttribute('aria-pressed', String(state.layers.has(layer.id))));
      return button;
    });
  return h('div', { class: 'layers', role: 'group', 'aria-label': 'Layers of the picture' }, ...buttons);
}

export function toggleLayer(state: State, digit: number): void {
  const layer = kLayers[digit - 1];
  if (!layer || (kOfReference.includes(layer.id) && !state.reference)) return;
  if (!state.layers.delete(layer.id)) state.layers.add(layer.id);
  state.changed();
}
