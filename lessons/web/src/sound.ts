// A short tone for each merge and unmerge, off by default: pitch by the size of the collection, loudness by the impulse.
import { h } from './dom';
import type { State } from './state';

const kMost = 4; // tones per step

/** The larger, the lower: two bodies are at 660 Hz. */
function pitch(bodies: number): number {
  return 660 / Math.max(1, bodies / 2) ** 0.35;
}

function tone(audio: AudioContext, hertz: number, loudness: number, falling: boolean, at: number): void {
  const oscillator = audio.createOscillator();
  const gain = audio.createGain();
  oscillator.type = falling ? 'triangle' : 'sine';
  oscillator.frequency.setValueAtTime(hertz, at);
  oscillator.frequency.exponentialRampToValueAtTime(hertz * (falling ? 0.7 : 1.25), at + 0.11);
  gain.gain.setValueAtTime(0.02 + 0.16 * Math.min(1, loudness), at);
  gain.gain.exponentialRampToValueAtTime(0.001, at + 0.13);
  oscillator.connect(gain).connect(audio.destination);
  oscillator.start(at);
  oscillator.stop(at + 0.14);
}

/** How hard the contacts of a pair press, as a part of the weight of a typical body for a step. */
function loudness(state: State, a: number, b: number): number {
  const { trace, step } = state;
  const weight = Math.max(1e-9, (trace.head.bodies[b]?.mass ?? 1) * 9.81 * trace.lengthOf(step));
  const sum = trace.contactsAt(step).reduce((total, c) => total + (c.a === Math.min(a, b) && c.b === Math.max(a, b) ? c.lambdaN : 0), 0);
  return sum / (10 * weight);
}

export function soundSwitch(state: State): HTMLElement {
  let audio: AudioContext | null = null;
  let heard = -1;
  const button = h('button', {
    type: 'button', class: 'item', 'aria-pressed': false, title: 'Rising: a merge; falling: an unmerge. The larger the collection, the lower; the stronger the impulse, the louder.',
    onclick: () => {
      audio = audio ? null : new AudioContext();
      button.setAttribute('aria-pressed', String(audio !== null));
    },
  }, 'Sound: rising merges, falling unmerges');
  state.onChange(() => {
    if (!audio || state.veiled || state.step === heard) return;
    heard = state.step;
    const events = (state.trace.eventsAt.get(state.step) ?? []).filter((row) => row[1] === 'merge' || row[1] === 'unmerge').slice(0, kMost);
    for (const [i, [, type, a, b, collection]] of events.entries()) {
      const size = collection >= 0 ? state.trace.members(collection, state.step).length : 1;
      tone(audio, pitch(size), loudness(state, a, b), type === 'unmerge', audio.currentTime + 0.03 * i);
    }
  });
  return button;
}
