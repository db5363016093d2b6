// A lesson page: reads the recorded runs inside it and shows them.
import { layerSwitches, ribbon, transport } from './controls';
import { h } from './dom';
import { inspector } from './inspector';
import { helpDialog, listenToKeys } from './keys';
import { nowCard } from './now';
import { Picture } from './picture';
import { State } from './state';
import { Trace, type Packed } from './trace';

interface PageData {
  title: string;
  lesson: null;
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
  picture.onPick = ({ body, contact }) => {
    state.selection = contact ? { kind: 'pair', a: contact.a, b: contact.b }
      : body !== undefined ? { kind: 'body', body } : null;
    state.changed();
  };
  state.onChange(() => picture.draw(state));
  app.append(
    h('header', {}, h('h1', {}, data.title),
      h('div', { class: 'tools' }, themeButton(),
        h('button', { type: 'button', class: 'plain', onclick: () => help.showModal() }, 'Keys', h('kbd', { 'aria-hidden': true }, '?')))),
    h('main', {},
      h('div', { class: 'stage-area' },
        h('div', { class: 'frame' }, picture.root),
        controls.root, layerSwitches(state), ribbon(state)),
      h('div', { class: 'side' }, nowCard(state), inspector(state))),
    help);
  listenToKeys(state, controls, { help: () => help.showModal(), part: () => {} });
  state.changed();
  document.documentElement.dataset.ready = 'true';
}

start();
