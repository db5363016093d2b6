// A lesson page: reads the recorded runs inside it and shows them; with its engine one can take over.
import { beside } from './beside';
import { closesOutside, iconButton, layerSwitches, transport } from './controls';
import { h, svg } from './dom';
import { Engine } from './engine';
import { equationCard } from './equation';
import { familyTree } from './family';
import { clickLine, handText, listenToHands } from './hands';
import { handout } from './handout';
import type { Packed } from './head';
import { impulseCard } from './impulses';
import { inspector } from './inspector';
import { helpDialog, listenToKeys } from './keys';
import { ledger } from './ledger';
import { answersAsText } from './answers';
import type { CoursePlace, Lesson } from './lesson';
import { LessonPanel } from './lesson_panel';
import { homeOf, isEnough } from './camera';
import { bodyCursor } from './cursor';
import type { Box } from './labels';
import { speak } from './language';
import { copied, follow, linkTo, listenToAddress } from './link';
import { nowCard } from './now';
import { Picture } from './picture';
import { ribbon } from './rail';
import { soundSwitch } from './sound';
import { State } from './state';
import { livePanel } from './take_over';
import { partsOf, Trace } from './trace';
import { badge, thresholdSlider, whatIf } from './whatif';
import { whyCard } from './why';

interface PageData {
  title: string;
  lesson: Lesson | null;
  traces: Packed[];
  course: CoursePlace;
  embed: boolean;
  language: string;
}

function themeButton(): HTMLButtonElement {
  const button = h('button', { type: 'button', class: 'item', onclick: () => turn() }, 'Dark colours');
  const root = document.documentElement;
  const system = matchMedia('(prefers-color-scheme: dark)');
  let chosen = false;
  const follow = () => {
    if (!chosen) root.dataset.theme = system.matches ? 'dark' : 'light';
    button.setAttribute('aria-pressed', String(root.dataset.theme === 'dark'));
  };
  const turn = () => {
    chosen = true;
    root.dataset.theme = root.dataset.theme === 'dark' ? 'light' : 'dark';
    follow();
  };
  system.addEventListener('change', follow);
  follow();
  return button;
}

/** The words of a page of a scene alone, in the place of a lesson. */
function sceneWords(state: State, title: string, now: HTMLElement): HTMLElement {
  const next = h('button', { type: 'button', class: 'primary', onclick: () => { if (!state.nextEvent(['merge', 'unmerge'], 1)) state.goTo(0); } });
  state.onChange(() => {
    next.textContent = state.trace.eventSteps(['merge', 'unmerge']).some((step) => step > state.step) ? 'Watch the next merge or unmerge' : 'From the start again';
  });
  return h('section', { class: 'words panel', 'aria-label': 'The run' },
    h('div', { class: 'scrolls', tabindex: 0 }, h('h2', {}, title),
      h('p', {}, 'Bodies that move as one are simulated as one. Play, step, choose two bodies to read why they are merged or not, or take over.'), now),
    h('div', { class: 'actions' }, next));
}

function menu(...items: (Node | null)[]): HTMLElement {
  const details = h('details', { class: 'menu' }, h('summary', { 'aria-label': 'Menu', title: 'Menu' }, '☰'), h('div', { class: 'popover' }, ...items));
  closesOutside(details);
  return details;
}

/** Shows the panel of the lesson, or that of a run that was taken over. */
function switchPanels(state: State, usual: HTMLElement, live: HTMLElement): void {
  let was = false;
  state.onChange(() => {
    const now = state.live !== null;
    usual.hidden = now;
    live.hidden = !now;
    if (was !== now) document.documentElement.classList.toggle('taken-over', now);
    was = now;
  });
}

function liveHeader(state: State): HTMLElement {
  const words = h('p', { class: 'live-words' });
  state.onChange(() => {
    if (!state.live) return;
    words.replaceChildren(h('span', { class: 'red', 'aria-hidden': true }, '●'), h('strong', {}, 'You have taken over'), ` at ${state.trace.timeAt(state.live.fork).toFixed(2)} s. The prepared run is kept.`);
  });
  return words;
}

/** Two bodies in turn make a pair. */
function choose(state: State, hit: { body?: number; a?: number; b?: number }): void {
  const s = state.selection;
  if (hit.a !== undefined && hit.b !== undefined) state.selection = { kind: 'pair', a: hit.a, b: hit.b };
  else if (hit.body === undefined) state.selection = null;
  else if (s?.kind === 'body' && s.body !== hit.body) {
    state.selection = { kind: 'pair', a: Math.min(s.body, hit.body), b: Math.max(s.body, hit.body) };
  } else state.selection = { kind: 'body', body: hit.body };
  state.changed();
}

function counts(state: State): HTMLElement {
  const root = h('p', { class: 'counts' });
  state.onChange(() => {
    root.hidden = state.veiled;
    const s = state.trace.stats(state.step);
    const part = (n: number, one: string, many: string) => [h('strong', {}, String(n)), ` ${n === 1 ? one : many}`];
    root.replaceChildren(h('strong', { class: 'only-two' }, state.live ? 'Your run' : 'This run'), ...part(s.collections, 'collection', 'collections'), ' · ', ...part(s.active, 'simulated body', 'simulated bodies'), ' · ', ...part(s.contacts, 'contact to solve', 'contacts to solve'));
  });
  return root;
}

function start(): void {
  const source = document.getElementById('data');
  const app = document.getElementById('app');
  if (!source || !app) return;
  const data = JSON.parse(source.textContent ?? '') as PageData;
  const state = new State(data.traces.map((packed) => new Trace(partsOf(packed))));
  const picture = new Picture(state.trace);
  const panel = data.lesson ? new LessonPanel(data.lesson, state, data.title, data.course) : null;
  document.documentElement.classList.toggle('embedded', data.embed || new URLSearchParams(location.hash.slice(1)).has('embed'));
  const takeOver = h('button', { type: 'button', class: 'plain take-over', onclick: () => toggleLive() }, 'Take over here');
  const controls = transport(state, () => panel?.flags() ?? [], takeOver);
  const toggleLive = () => {
    if (state.live) state.giveBack();
    else if (!state.takeOver()) state.pause('This page has no engine in it: it was made with --no-live.');
  };
  const live = livePanel(state, panel ? 'Back to the lesson' : 'Back to the prepared run');
  const help = helpDialog();
  const now = nowCard(state);
  const words = panel?.root ?? sceneWords(state, data.title, now);
  // Names keep their size and their places when one zooms.
  let due = 0;
  const redraw = () => {
    cancelAnimationFrame(due);
    due = requestAnimationFrame(() => picture.draw(state));
  };
  const frame = h('div', { class: 'frame', id: 'picture', tabindex: 0, role: 'group', 'aria-label': 'The world: arrows go from body to body, Enter chooses one, a second one makes a pair' }, picture.root, counts(state), badge(state), lensButtons(picture, redraw));

  picture.onPick = ({ body, contact, at, turn, of }) => {
    if (state.live) {
      const line = clickLine(state, body, at);
      if (line) return void state.act(line);
    }
    const bodies = contact ? [contact.a, contact.b] : body !== undefined ? [body] : [];
    if (panel?.pick(bodies) || (body !== undefined && panel?.pick([body]))) return;
    state.notice = contact && of > 1 ? `${turn + 1} of ${of} pairs here: click again for the next.` : '';
    choose(state, contact ? { a: contact.a, b: contact.b } : { body });
  };
  listenToHands(picture, state, controls.play, live.say);
  state.onChange(() => picture.enter(state.trace));
  if (panel) aim(picture, state, panel);
  bodyCursor(frame, picture, state, (body) => picture.onPick({ body, at: [0, 0], turn: 0, of: 0 }));
  state.onChange(() => {
    picture.draw(state);
    picture.show(panel?.marked());
    if (state.live && state.layers.size >= 0) live.say(handText(state));
    takeOver.textContent = state.live ? 'The prepared run' : state.hasKept ? 'Take over anew' : 'Take over here';
    takeOver.disabled = !state.live && !state.engine;
  });

  const drawer = h('section', { class: 'drawer', hidden: true, 'aria-label': 'More numbers', tabindex: -1 },
    h('div', { class: 'drawer-head' }, h('h2', {}, 'More numbers'), h('button', { type: 'button', class: 'plain', onclick: () => more() }, 'Close')),
    h('div', { class: 'drawer-cards' }, panel ? now : null, inspector(state), impulseCard(state), familyTree(state), ledger(state)));
  const moreButton = h('button', { type: 'button', class: 'plain more-button', 'aria-expanded': false, onclick: () => more() }, 'More numbers');
  const more = () => {
    drawer.hidden = !drawer.hidden;
    moreButton.setAttribute('aria-expanded', String(!drawer.hidden));
    (drawer.hidden ? (moreButton.offsetParent ? moreButton : frame) : drawer).focus();
  };
  const others = whatIf(state);
  const status = h('span', { class: 'copied', role: 'status' });
  const link = h('button', { type: 'button', class: 'plain link-button', onclick: () => copied(linkTo(state, panel?.part), status) },
    svg('svg', { viewBox: '0 0 24 24', 'aria-hidden': true }, svg('path', { d: 'M10 14a4 4 0 0 0 6 0l3 -3a4 4 0 0 0 -6 -6l-1.5 1.5M14 10a4 4 0 0 0 -6 0l-3 3a4 4 0 0 0 6 6l1.5 -1.5' })), h('span', {}, 'Link to this moment'));
  const kept = h('button', { type: 'button', class: 'item', onclick: () => state.showKept() }, 'Your last run');
  state.onChange(() => { kept.hidden = !state.hasKept; });
  const answers = panel && data.lesson?.parts.some((part) => part.questions.length > 0) ? [
    h('button', { type: 'button', class: 'item', onclick: () => copied(answersAsText(panel.answers()), status) }, 'Copy my answers'),
    h('button', { type: 'button', class: 'item', onclick: () => copied(JSON.stringify(panel.answers(), null, 2), status) }, 'Copy my answers as JSON')] : [];
  app.append(
    panel ? h('a', { class: 'skip', href: '#question', onclick: (event) => { event.preventDefault(); panel.focusQuestion(); } }, 'To the question') : h('span'),
    h('a', { class: 'skip', href: '#picture', onclick: (event) => { event.preventDefault(); frame.focus(); } }, 'To the picture'),
    h('header', {},
      h('h1', {}, h('span', { class: 'kicker' }, data.course.number > 0 ? `Lesson ${data.course.number} of ${data.course.of}` : data.lesson ? 'Lesson' : 'Scene'), data.title),
      liveHeader(state), panel?.dots ?? null, h('div', { class: 'compare wide' }), status, moreButton, link,
      menu(kept, h('button', { type: 'button', class: 'item', onclick: () => more() }, 'More numbers'), themeButton(), soundSwitch(state), h('button', { type: 'button', class: 'item', onclick: () => help.showModal() }, 'Keys'),
        h('label', { class: 'item' }, 'Speed ', controls.speed), h('div', { class: 'item compare' }), thresholdSlider(state),
        ...answers, h('button', { type: 'button', class: 'item', onclick: () => window.print() }, 'Print'))),
    h('main', {}, words, live.root,
      h('section', { class: 'world panel', 'aria-label': 'World' }, beside(state, picture, frame), layerSwitches(state)),
      whyCard(state, equationCard(state)), ribbon(state), controls.root),
    drawer, help);
  if (others) placeByWidth(others, '(min-width: 1360px)', '.compare.wide', '.compare.item');
  placeByWidth(takeOver, '(max-width: 699px)', '.layers', '.take-over-place');
  switchPanels(state, words, live.root);
  listenToKeys(state, controls, {
    help: () => help.showModal(), part: (by) => panel?.move(by), takeOver: toggleLive, more, question: () => panel?.focusQuestion(),
    why: () => document.querySelector<HTMLElement>('.why')?.focus(), fit: () => picture.lens.fit(),
  });
  printing(data, state);
  follow(state, picture);
  listenToAddress(state, panel);
  state.language = new URLSearchParams(location.hash.slice(1)).get('language') ?? data.language;
  state.changed();
  speak(app, state.language);
  document.documentElement.dataset.ready = 'true';
  void loadEngine(state);
}

/** The camera of a part: on the bodies that it is about, and on the whole when others come in. A hand moves it itself. */
function aim(picture: Picture, state: State, panel: LessonPanel): void {
  let part = -1;
  let home: Box | null = null;
  state.onChange(() => {
    if (state.live) return;
    if (panel.part !== part) {
      part = panel.part;
      const { step, reveal, trace } = panel.moment;
      home = homeOf(state.traces[trace], picture.view, step, reveal);
      picture.lens.fit();
    }
    picture.lens.setHome(home && isEnough(state.trace, picture.view, state.step, home) ? home : null);
  });
}

/** In one place where there is room, else in another. */
function placeByWidth(node: HTMLElement, query: string, there: string, else_: string): void {
  const wide = matchMedia(query);
  const place = () => document.querySelector(wide.matches ? there : else_)?.append(node);
  wide.addEventListener('change', place);
  place();
}

function lensButtons(picture: Picture, redraw: () => void): HTMLElement {
  const fit = iconButton('Fit', 'M4 4h6v2H6v4H4zM14 4h6v6h-2V6h-4zM4 14h2v4h4v2H4zM18 14h2v6h-6v-2h4z', () => picture.lens.fit(), 'F');
  picture.lens.onChange = () => {
    fit.hidden = picture.lens.isWhole;
    redraw();
  };
  fit.hidden = true;
  return h('div', { class: 'lens', role: 'group', 'aria-label': 'Zoom' }, fit,
    iconButton('Closer', 'M11 5h2v6h6v2h-6v6h-2v-6H5v-2h6z', () => picture.lens.zoomBy(1.4)),
    iconButton('Farther', 'M5 11h14v2H5z', () => picture.lens.zoomBy(1 / 1.4)));
}

/** After the page is there: nobody waits for the engine. */
async function loadEngine(state: State): Promise<void> {
  const packed = document.getElementById('engine');
  if (!packed?.textContent) return;
  try {
    state.setEngine(await Engine.load(packed.textContent));
    document.documentElement.dataset.engine = 'true';
  } catch (error) {
    state.notice = `The engine could not be started: ${String(error)}`;
  }
  state.changed();
}

function printing(data: PageData, state: State): void {
  let sheet: HTMLElement | null = null;
  let theme: string | undefined;
  const root = document.documentElement;
  window.addEventListener('beforeprint', () => {
    theme = root.dataset.theme;
    root.dataset.theme = 'light';
    sheet?.remove();
    sheet = handout(data.title, [data.course.number > 0 ? `Lesson ${data.course.number} of ${data.course.of}` : '', data.lesson?.minutes ? `about ${data.lesson.minutes} minutes` : ''].filter(Boolean).join(' · '), data.lesson, state.traces);
    document.body.append(sheet);
  });
  window.addEventListener('afterprint', () => {
    sheet?.remove();
    sheet = null;
    root.dataset.theme = theme;
  });
}

start();
