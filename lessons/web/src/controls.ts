// The transport, the slider over time and the legend that switches layers.
import { h, svg } from './dom';
import { apart } from './picture';
import { type Flag, kSliderInset, lanes } from './lanes';
import { kLayers, kOfReference, type LayerId, type State } from './state';

const kSpeeds = [0.02, 0.1, 0.25, 0.5, 1, 2, 4];

export interface Transport {
  root: HTMLElement;
  toggle: () => void;
  play: () => void;
  faster: (by: number) => void;
  speed: HTMLElement;
}

const kPlay = 'M7 4v16l13-8z';
const kPause = 'M6 4h4v16h-4zM14 4h4v16h-4z';

export function iconButton(label: string, icon: string, action: () => void, key?: string): HTMLButtonElement {
  return h('button', { type: 'button', class: 'icon', 'aria-label': label, title: key ? `${label} (${key})` : label, onclick: action },
    svg('svg', { viewBox: '0 0 24 24', 'aria-hidden': true }, svg('path', { d: icon })));
}

/** Moves on with the clock while the state plays. */
function clockwork(state: State): () => void {
  let before = 0;
  let rest = 0;
  const frame = (now: number) => {
    if (!state.playing) return;
    const h0 = state.trace.lengthOf(state.step + 1);
    const due = rest + ((now - before) / 1000) * (state.speed / h0);
    before = now;
    const whole = Math.min(Math.floor(due), Math.max(1, Math.ceil(0.25 / h0)), state.live ? 4 : Infinity);
    rest = Math.min(1, due - Math.floor(due));
    if (whole > 0) {
      state.beforeSteps();
      if (!state.playing) return;
      const target = state.live ? state.step + whole : Math.min(state.steps, state.step + whole);
      const stop = state.stopBefore(state.step, target);
      state.goTo(stop?.step ?? target);
      if (stop) state.pause(stop.why);
      else if (!state.live && state.step >= state.steps) state.pause('Stopped: the end of the recorded run.');
    }
    requestAnimationFrame(frame);
  };
  return () => {
    before = performance.now();
    rest = 0;
    requestAnimationFrame(frame);
  };
}

export function transport(state: State, flags: () => Flag[], takeOver: HTMLElement): Transport {
  const run = clockwork(state);
  const play = iconButton('Play', kPlay, () => toggle(), 'Space');
  play.classList.add('play');
  const slider = h('input', {
    type: 'range', min: 0, max: state.steps, step: 1, value: 0, class: 'slider', 'aria-label': 'Time step',
    oninput: () => {
      state.playing = false;
      state.goTo(Number(slider.value));
    },
  });
  slider.style.marginLeft = `${kSliderInset.left - 11}px`;
  slider.style.width = `calc(100% - ${kSliderInset.left + kSliderInset.right - 22}px)`;
  const speed = h('select', { 'aria-label': 'Playback speed', onchange: () => { state.speed = Number(speed.value); } },
    ...kSpeeds.map((s) => h('option', { value: s }, s < 1 ? `1/${Math.round(1 / s)} speed` : s === 1 ? 'real time' : `${s}× speed`)));
  speed.value = String(state.speed);
  const clock = h('output', { class: 'clock' });
  const notice = h('p', { class: 'notice', role: 'status' });

  function start(): void {
    state.playing = true;
    state.notice = '';
    state.changed();
    run();
  }
  function toggle(): void {
    if (state.playing) return state.pause();
    const stop = state.stopBefore(state.step, state.step + 1);
    if (stop && stop.step <= state.step) return state.pause(stop.why);
    if (!state.live && state.step >= state.steps) state.goTo(0);
    start();
  }
  const halt = (action: () => void) => () => {
    state.playing = false;
    action();
  };

  state.onChange(() => {
    slider.max = String(state.steps);
    slider.value = String(state.step);
    slider.setAttribute('aria-valuetext', `step ${state.step} of ${state.steps}, ${state.time.toFixed(2)} seconds`);
    clock.replaceChildren(h('strong', {}, `${state.time.toFixed(2)} s`), ` · step ${state.step} of ${state.steps}`);
    notice.textContent = state.notice;
    const label = state.playing ? 'Pause' : 'Play';
    if (play.getAttribute('aria-label') !== label) {
      play.setAttribute('aria-label', label);
      play.title = `${label} (Space)`;
      play.querySelector('path')?.setAttribute('d', state.playing ? kPause : kPlay);
    }
  });

  const root = h('section', { class: 'time panel', 'aria-label': 'Time' },
    h('div', { class: 'transport' },
      h('div', { class: 'buttons', role: 'group', 'aria-label': 'Playback' },
        iconButton('To the start', 'M5 4h3v16H5zM20 4v16L9 12z', halt(() => state.goTo(state.first)), 'Home'),
        iconButton('Previous event', 'M4 12l8-7v14zM12 12l8-7v14z', halt(() => state.nextEvent(undefined, -1)), '['),
        iconButton('One step back', 'M16 5v14L6 12z', halt(() => state.goTo(state.step - 1, state.stage)), '←'),
        play,
        iconButton('One step forward', 'M8 5v14l10-7z', halt(() => state.goTo(state.step + 1, state.stage)), '→'),
        iconButton('Next event', 'M4 5l8 7-8 7zM12 5l8 7-8 7z', halt(() => state.nextEvent(undefined, 1)), ']'),
        iconButton('To the end', 'M16 4h3v16h-3zM4 4v16l11-8z', halt(() => state.goTo(state.steps)), 'End')),
      clock, notice),
    h('div', { class: 'take-over-place' }, takeOver),
    h('div', { class: 'timeline' }, lanes(state, flags), slider));
  const faster = (by: number) => {
    const at = Math.max(0, Math.min(kSpeeds.length - 1, kSpeeds.indexOf(state.speed) + by));
    state.speed = kSpeeds[at];
    speed.value = String(state.speed);
  };
  return { root, toggle, play: () => { if (!state.playing) start(); }, faster, speed };
}

/** The mark of a layer, as it is in the picture. */
const kMarks: Record<LayerId, [d: string, look: string]> = {
  contacts: ['M3 5h6v6h-6zM16 8m-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0', 'active'],
  forces: ['M12 14V4M12 2l-4 6h8z', 'force'],
  graph: ['M3 13L21 3', 'welds'],
  boxes: ['M3 3h18v10h-18z', 'boxes'],
  velocities: ['M2 8h14M22 8l-7 -4v8z', 'velocity'],
  heat: ['M12 8m-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0', 'heat-over'],
  ghost: ['M3 3h18v10h-18z', 'ghost-mark'],
  labels: ['M3 12l5 -9l5 9M5 9h6M15 12v-6M15 9a3 3 0 1 1 0 .1', 'text-mark'],
  beside: ['M2 3h8v10h-8zM14 3h8v10h-8z', 'text-mark'],
};
/** The marks of contacts, named beside their switch. */
const kOfContacts: [string, string, string][] = [
  ['merged', 'M8 4h8v8h-8z', 'merged'], ['active', 'M12 8m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0', 'solved'], ['cut', 'M8 4l8 8m0 -8l-8 8', 'came apart']];
const kFirst: LayerId[] = ['contacts', 'velocities', 'forces', 'graph', 'ghost', 'labels'];

export function layerSwitches(state: State): HTMLElement {
  const chip = (id: LayerId, rich = false) => {
    const layer = kLayers.find((one) => one.id === id);
    const digit = kLayers.findIndex((one) => one.id === id) + 1;
    const [d, look] = kMarks[id];
    const word = h('span', { class: 'plain-word' }, layer?.label ?? id);
    const button = h('button', {
      type: 'button', class: 'chip', 'data-layer': id, title: `${layer?.label ?? id} (${digit})`, onclick: () => toggleLayer(state, digit),
      'aria-label': layer?.label ?? id,
    }, h('span', { class: 'check', 'aria-hidden': true }), rich && id === 'contacts' ? h('span', { class: 'rich' }, ...kOfContacts.flatMap(([kind, mark, word]) => [
      svg('svg', { viewBox: '0 0 24 16', class: kind, 'aria-hidden': true }, svg('path', { d: mark, class: kind })), h('span', {}, word)])) : null,
    svg('svg', { viewBox: '0 0 24 16', class: 'plain-mark', 'aria-hidden': true }, svg('path', { d, class: look })), word);
    state.onChange(() => {
      button.setAttribute('aria-pressed', String(state.layers.has(id)));
      button.hidden = kOfReference.includes(id) && !state.hasReference;
      if (id === 'ghost') word.textContent = ghostWord(state);
    });
    return button;
  };
  const rest = kLayers.map((layer) => layer.id).filter((id) => !kFirst.includes(id));
  const more = h('details', { class: 'more-layers' }, h('summary', { 'aria-label': 'More layers', title: 'More layers' }, '…'),
    h('div', { class: 'popover' }, ...[...kFirst, ...rest].map((id) => chip(id)), h('dl', { class: 'key' }, ...kKey.flatMap(([look, mark, text]) => [
      h('dt', {}, svg('svg', { viewBox: '0 0 24 16', 'aria-hidden': true }, svg('path', { d: mark, class: look }))), h('dd', {}, text)]))));
  closesOutside(more);
  const row = h('div', { class: 'chips' }, ...kFirst.map((id) => chip(id, true)));
  // Chips that find no place are in the menu alone.
  new ResizeObserver(() => {
    const chips = [...row.children] as HTMLElement[];
    for (const one of chips) one.style.visibility = one.offsetTop > chips[0].offsetTop + 4 ? 'hidden' : '';
  }).observe(row);
  return h('div', { class: 'layers', role: 'group', 'aria-label': 'Layers of the picture' }, row, more);
}

/** How near the reference is, where no outline of it is to be seen. */
function ghostWord(state: State): string {
  const { reference, trace, step } = state;
  if (!state.layers.has('ghost') || !reference || reference === trace || state.veiled) return 'Reference';
  let most = 0;
  for (const [i, body] of trace.head.bodies.entries()) {
    if (body.motion === 'dynamic' && trace.present(i, step) && i < reference.bodies.length && reference.present(i, step)) most = Math.max(most, apart(reference, trace, i, step));
  }
  return most < 0.01 ? `Reference (within ${Math.max(1, Math.ceil(1000 * most))} mm)` : 'Reference';
}

/** The legend of the marks. */
const kKey: [string, string, string][] = [
  ['merged', 'M8 4h8v8h-8z', 'merged: inside a collection, not solved'],
  ['active', 'M12 8m-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0', 'solved in this step'],
  ['broken', 'M7 3l10 10m0 -10l-10 10', 'just broken: it carries nothing'],
  ['cut', 'M7 3l10 10m0 -10l-10 10', 'came apart in this step'],
  ['inner', 'M12 14V4M12 2l-4 6h8z', 'force inside a collection'],
  ['friction', 'M2 8h14M22 8l-7 -4v8z', 'friction at its limit'],
  ['loads', 'M2 8h14M22 8l-7 -4v8z', 'what the scene pushes with'],
];

/** A menu that closes when one does something else. */
export function closesOutside(details: HTMLDetailsElement): void {
  document.addEventListener('click', (event) => {
    if (details.open && !details.contains(event.target as Node)) details.open = false;
  });
  details.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !details.open) return;
    details.open = false;
    details.querySelector('summary')?.focus();
    event.stopPropagation();
  });
}

export function toggleLayer(state: State, digit: number): void {
  const layer = kLayers[digit - 1];
  if (!layer || (kOfReference.includes(layer.id) && !state.hasReference)) return;
  if (!state.layers.delete(layer.id)) state.layers.add(layer.id);
  state.changed();
}
