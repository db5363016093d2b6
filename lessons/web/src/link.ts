// Links to a moment: #part=4&step=402&stage=6&bodies=ball%26brick%5B0%2C5%5D&do=… opens there; %26 stands between two names.
import type { LessonPanel } from './lesson_panel';
import type { Picture } from './picture';
import { kLast } from './stages';
import type { State } from './state';

export function linkTo(state: State, part: number | undefined): string {
  const words = new URLSearchParams();
  if (part !== undefined) words.set('part', String(part + 1));
  const run = state.traces.indexOf(state.prepared);
  if (run > 0) words.set('run', String(run));
  words.set('step', String(state.step));
  if (state.stage !== kLast) words.set('stage', String(state.stage + 1));
  const s = state.selection;
  if (s) words.set('bodies', (s.kind === 'pair' ? [s.a, s.b] : [s.body]).map((body) => state.trace.head.bodies[body].name).join('&'));
  if (state.live) {
    words.set('fork', String(state.live.fork));
    for (const deed of state.live.deeds) words.append('do', `${deed.step} ${deed.line}`);
  }
  return `${location.href.split('#')[0]}#${words}`;
}

/** Puts a text where one can paste it from; where that is not allowed, to be copied by hand. */
export function copied(text: string, status: HTMLElement): void {
  const byHand = () => {
    const area = document.createElement('textarea');
    area.readOnly = true;
    area.rows = 4;
    area.setAttribute('aria-label', 'To be copied');
    area.value = text;
    status.replaceChildren(area);
    area.select();
  };
  const done = () => {
    status.textContent = 'Copied.';
    window.setTimeout(() => { if (status.textContent === 'Copied.') status.textContent = ''; }, 4000);
  };
  if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, byHand);
  else byHand();
}

/** Opens the moment that the address names, at first and when it changes. */
export function listenToAddress(state: State, panel: LessonPanel | null): void {
  const open = () => {
    const words = new URLSearchParams(location.hash.slice(1));
    if (!words.has('step') && !words.has('part')) return;
    const whole = (key: string) => {
      const value = Number(words.get(key));
      return words.has(key) && Number.isInteger(value) && value >= 0 ? value : undefined;
    };
    const part = whole('part');
    if (panel && part) panel.goToPart(part - 1);
    const run = whole('run');
    if (run !== undefined && state.traces[run]) state.trace = state.traces[run];
    const bodies = (words.get('bodies') ?? '').split('&').map((name) => state.trace.head.bodies.findIndex((body) => body.name === name)).filter((body) => body >= 0);
    if (bodies.length === 2) state.selection = { kind: 'pair', a: Math.min(...bodies), b: Math.max(...bodies) };
    else if (bodies.length === 1) state.selection = { kind: 'body', body: bodies[0] };
    const stage = whole('stage');
    const step = whole('step');
    const there = () => { if (step !== undefined) state.goTo(step, stage ? Math.min(kLast, stage - 1) : kLast); };
    const fork = whole('fork');
    if (fork === undefined) return there();
    const replay = () => {
      state.goTo(fork);
      if (!state.takeOver()) return;
      for (const deed of words.getAll('do')) {
        const [, at, line] = /^(\d+) (.*)$/.exec(deed) ?? [];
        if (!line) continue;
        state.goTo(Number(at));
        state.act(line);
      }
      there();
    };
    if (state.engine) replay();
    else state.onEngine(replay);
  };
  window.addEventListener('hashchange', open);
  open();
}

/** Keeps the selected body in the middle of a picture that shows a part. */
export function follow(state: State, picture: Picture): void {
  state.onChange(() => {
    if (picture.lens.isWhole || state.selection?.kind !== 'body' || !state.playing) return;
    const { body } = state.selection;
    if (!state.trace.present(body, state.step)) return;
    const pose = state.trace.pose(body, state.step);
    picture.lens.centre(picture.view.x(pose.x), picture.view.y(pose.y));
  });
}
