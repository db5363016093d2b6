// A lesson page: reads the recorded runs inside it and shows them.
import { beside } from './beside';
import { equationCard } from './equation';
import { familyTree } from './family';
import { handout } from './handout';
import { ledger } from './ledger';
import { type Lesson, LessonPanel } from './lesson';
import { layerSwitches, ribbon, transport } from './controls';
import { h } from './dom';
import type { Packed } from './head';
import { impulseCard } from './impulses';
import { inspector } from './inspector';
import { helpDialog, listenToKeys } from './keys';
import { nowCard } from './now';
import { Picture } from './picture';
import { State } from './state';
import { Trace } from './trace';
import { badge, thresholdSlider, whatIf } from './whatif';

interface PageData {
  title: string;
  lesson: Lesson | null;
  traces: Packed[];
}

function themeButton(): HTMLButtonElement {
  const button = h('button', { type: 'button', class: 'plain', onclick: () => turn() }, 'Light or dark');
  const root = document.documentElement;
  const system = matchMedia('(prefers-color-scheme: dark)');
  let chosen = false;
  const follow = () => { if (!chosen) root.dataset.theme = system.matches ? 'dark' : 'light'; };
  const turn = () => {
    chosen = true;
    root.dataset.theme = root.dataset.theme === 'dark' ? 'light' : 'dark';
  };
  system.addEventListener('change', follow);
  follow();
  return button;
}

function start(): void {
  const source = document.getElementById('data');
  const app = document.getElementById('app');
  if (!source || !app) return;
  const data = JSON.parse(source.textContent ?? '') as PageData;
  const state = new State(data.traces.map((packed) => new Trace(packed)));
  const picture = new Picture(state.trace);
  const controls = transport(state);
  const help = helpDialog();
  const panel = data.lesson ? new LessonPanel(data.lesson, state, data.title) : null;
  picture.onPick = ({ body, contact }) => {
    const bodies = contact ? [contact.a, contact.b] : body !== undefined ? [body] : [];
    if (panel?.pick(bodies) || (body !== undefined && panel?.pick([body]))) return;
    state.selection = contact ? { kind: 'pair', a: contact.a, b: contact.b }
      : body !== undefined ? { kind: 'body', body } : null;
    state.changed();
  };
  state.onChange(() => {
    picture.draw(state);
    picture.show(panel?.marked());
  });
  app.append(
    h('header', {}, h('h1', {}, h('span', { class: 'kicker' }, data.lesson ? 'A lesson on adaptive merging' : 'Adaptive merging, step by step'), data.title),
      h('div', { class: 'tools' }, thresholdSlider(state), whatIf(state), themeButton(),
        h('button', { type: 'button', class: 'plain', onclick: () => help.showModal() }, 'Keys', h('kbd', { 'aria-hidden': true }, '?')))),
    h('main', {},
      h('div', { class: 'left' }, h('div', { class: 'stage-area' },
        beside(state, h('div', { class: 'frame' }, picture.root, badge(state))),
        controls.root, layerSwitches(state), ribbon(state)), familyTree(state), ledger(state)),
      h('div', { class: 'side' }, panel?.root ?? null, nowCard(state), equationCard(state), impulseCard(state), inspector(state))),
    help);
  listenToKeys(state, controls, { help: () => help.showModal(), part: (by) => panel?.move(by) });
  printing(data, state);
  state.changed();
  document.documentElement.dataset.ready = 'true';
}

function printing(data: PageData, state: State): void {
  let sheet: HTMLElement | null = null;
  let theme: string | undefined;
  const root = document.documentElement;
  window.addEventListener('beforeprint', () => {
    theme = root.dataset.theme;
    root.dataset.theme = 'light';
    sheet?.remove();
    sheet = handout(data.title, data.lesson, state.traces);
    document.body.append(sheet);
  });
  window.addEventListener('afterprint', () => {
    sheet?.remove();
    sheet = null;
    root.dataset.theme = theme;
  });
}

start();
