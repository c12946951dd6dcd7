// The keys, and the dialog that lists them.

import { layerNames } from './settings.js';

// [keys as the browser names them, keys as shown, meaning, action]
export function allKeys(view) {
  const { player } = view;
  return [
    [[' '], 'space', 'play, pause', () => player.toggle()],
    [['.'], '.', 'step by 10 ms', () => player.step(1)],
    [[','], ',', 'step back', () => player.step(-1)],
    [['ArrowRight'], '→', 'forward by 1 s', () => player.jump(1)],
    [['ArrowLeft'], '←', 'back by 1 s', () => player.jump(-1)],
    [['Home'], 'Home', 'to the start', () => player.seek(0)],
    [['End'], 'End', 'to the end', () => player.seek(Infinity)],
    [[']'], ']', 'faster', () => player.changeSpeed(1)],
    [['['], '[', 'slower', () => player.changeSpeed(-1)],
    [['n'], 'n', 'next loss', () => player.send('next_loss')],
    [['p'], 'p', 'previous loss', () => player.send('previous_loss')],
    [['b'], 'b', 'second tracker beside the first', () => view.toggleSecond()],
    [['1'], '1', 'events', () => view.choose('events')],
    [['2'], '2', 'surface', () => view.choose('surface')],
    [['3'], '3', 'heat map', () => view.choose('heat')],
    [['+', '='], '+', 'events of a longer time', () => view.changeWindow(1)],
    [['-'], '-', 'events of a shorter time', () => view.changeWindow(-1)],
    ...Object.entries(layerNames).map(([name, [key, meaning]]) => [
      [key], key, meaning, () => view.toggleLayer(name)]),
    [['i'], 'i', 'save the picture as PNG', () => view.savePicture()],
    [['s'], 's', 'services and channels of the live bus', () => view.toggleServices()],
    [['a'], 'a', 'all messages or the first', () => view.toggleMessages()],
    [['d'], 'd', 'dark or light', () => view.toggleTheme()],
    [['?'], '?', 'these keys', () => view.toggleHelp()],
    [['Escape'], 'Esc', 'close', () => view.closeAll()],
  ];
}

// What a browser does with this key where a control was reached by keyboard.
function isForControl({ key, target }) {
  if (!target.matches('button, select, input, summary')) return false;
  if (target.matches('select, input') && key.length > 1) return true;
  return key === ' ' && target.matches(':focus-visible');
}

export function listenToKeys(keys) {
  const actions = new Map();
  for (const [names, , , action] of keys) for (const name of names) actions.set(name, action);
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const action = actions.get(event.key.length === 1 ? event.key.toLowerCase() : event.key);
    if (!action || isForControl(event)) return;
    event.preventDefault();
    if (event.target !== document.body) event.target.blur();
    action();
  });
}

export function fillHelp(dialog, keys) {
  const list = document.createElement('dl');
  for (const [, shown, meaning] of keys) {
    const row = list.appendChild(document.createElement('div'));
    const name = row.appendChild(document.createElement('dt'));
    name.appendChild(document.createElement('kbd')).textContent = shown;
    row.appendChild(document.createElement('dd')).textContent = meaning;
  }
  const head = document.createElement('h2');
  head.textContent = 'Keys';
  dialog.replaceChildren(head, list);
}
