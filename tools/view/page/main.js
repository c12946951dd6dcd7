// Joins the parts of the page.

import { inMicroseconds, short } from './canvas.js';
import { drawCharts } from './charts.js';
import { allKeys, fillHelp, listenToKeys } from './keys.js';
import { PictureFeed } from './pictures.js';
import { Player } from './player.js';
import { control, whenConnectionChanges } from './server.js';
import { showServices } from './services.js';
import {
  backdropNames, change, layerNames, settings, stepOfWindow, toggleLayer, whenSettingsChange,
  windowOfStep, windowSteps,
} from './settings.js';
import { StateFeed } from './state.js';

const byId = (id) => document.getElementById(id);
const kOff = 'off';

class View {
  constructor() {
    this.connectionProblem = '';
    this.controlProblem = '';
    this.allMessages = false;
    this.state = null;
    this.player = new Player((problem) => {
      this.controlProblem = problem;
      this.showMessages();
    });
    this.feeds = [
      new PictureFeed(byId('picture-0'), 'camera', 0),
      new PictureFeed(byId('picture-1'), 'camera', 1),
      new PictureFeed(byId('table'), 'table'),
    ];
    this.makeTools();
    const keys = allKeys(this);
    fillHelp(byId('help'), keys);
    listenToKeys(keys);
    whenConnectionChanges((problem) => {
      this.connectionProblem = problem;
      this.showMessages();
    });
    whenSettingsChange(() => this.showSettings());
    this.stateFeed = new StateFeed((state, feed) => this.show(state, feed));
  }

  makeTools() {
    for (const [name, text] of Object.entries(backdropNames)) {
      const button = document.createElement('button');
      button.textContent = text;
      button.dataset.backdrop = name;
      button.onclick = () => this.choose(name);
      byId('backdrops').append(button);
    }
    for (const [name, [key, meaning]] of Object.entries(layerNames)) {
      const label = document.createElement('label');
      const box = label.appendChild(document.createElement('input'));
      box.type = 'checkbox';
      box.dataset.layer = name;
      box.onchange = () => toggleLayer(name);
      label.append(` ${meaning} `);
      label.appendChild(document.createElement('kbd')).textContent = key;
      byId('layers').querySelector('.menu').append(label);
    }
    byId('window').max = windowSteps;
    byId('window').oninput = (event) => change({ windowUs: windowOfStep(Number(event.target.value)) });
    byId('theme-button').onclick = () => this.toggleTheme();
    byId('save-button').onclick = () => this.savePicture();
    byId('help-button').onclick = () => this.toggleHelp();
    byId('services-button').onclick = () => this.toggleServices();
    for (const side of [0, 1]) {
      byId(`tracker-${side}`).onchange = (event) => this.track(side, event.target.value);
    }
  }

  choose(backdrop) { change({ backdrop }); }
  toggleLayer(name) { toggleLayer(name); }
  toggleTheme() { change({ theme: settings.theme === 'dark' ? 'light' : 'dark' }); }
  changeWindow(by) {
    const step = Math.min(Math.max(stepOfWindow(settings.windowUs) + by, 0), windowSteps);
    change({ windowUs: windowOfStep(step) });
  }

  toggleHelp() {
    const dialog = byId('help');
    if (dialog.open) dialog.close();
    else dialog.showModal();
    dialog.onclick = () => dialog.close();
  }

  toggleServices() {
    // A recording has none.
    byId('services').hidden = byId('services-button').hidden || !byId('services').hidden;
  }

  toggleMessages() {
    this.allMessages = !this.allMessages;
    this.showMessages();
  }

  // The camera's pictures, side by side, into the browser's folder of downloads.
  savePicture() {
    const canvases = ['picture-0', 'picture-1'].map(byId)
      .filter((canvas) => !canvas.hidden && canvas.dataset.shown);
    if (canvases.length === 0 || !this.state) return;
    const sheet = document.createElement('canvas');
    sheet.width = canvases.reduce((width, canvas) => width + canvas.width, 0);
    sheet.height = canvases[0].height;
    let x = 0;
    for (const canvas of canvases) {
      sheet.getContext('2d').drawImage(canvas, x, 0);
      x += canvas.width;
    }
    const seconds = this.state.seconds;
    const source = this.state.playback ? this.state.source.replace(/\.[^.]*$/, '') : 'live';
    sheet.toBlob((blob) => {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(blob);
      link.download = `${source}-${seconds.toFixed(4).padStart(9, '0')}s.png`;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10e3);
    });
  }

  closeAll() {
    if (byId('help').open) byId('help').close();
    byId('services').hidden = true;
    byId('layers').open = false;
  }

  async track(side, name) {
    this.controlProblem = await control('tracker', { side, name });
    this.showMessages();
  }

  toggleSecond() {
    if (!this.state || this.state.trackers.length === 0) return;
    const [first, second] = this.state.chosen;
    const other = this.state.trackers.find((name) => name !== first && name !== kOff) || first;
    this.track(1, second && second !== kOff ? kOff : other);
  }

  showSettings() {
    document.documentElement.dataset.theme = settings.theme;
    for (const button of byId('backdrops').children) {
      button.setAttribute('aria-pressed', button.dataset.backdrop === settings.backdrop);
    }
    for (const box of byId('layers').querySelectorAll('input')) {
      box.checked = !settings.hidden.includes(box.dataset.layer);
    }
    byId('window-group').hidden = settings.backdrop !== 'events';
    byId('window').value = stepOfWindow(settings.windowUs);
    byId('window-text').textContent = inMicroseconds(settings.windowUs);
    for (const feed of this.feeds) feed.renew();
    if (this.state) drawCharts(byId('charts'), this.state, this.stateFeed);
  }

  show(state, feed) {
    this.state = state;
    // Without what every LCM URL begins and ends with.
    byId('source').textContent = state.source.replace('udpm://', '').replace(/\?[^ ,]*/, '');
    byId('source').title = state.source;
    document.title = `puck-view: ${byId('source').textContent}`;
    byId('clock').textContent = `${state.seconds.toFixed(2)} s`;
    byId('rate').textContent = `${short(state.events_per_s)} ev/s`;
    this.showTrack(state);
    this.showTrackers(state);
    this.player.show(state);
    showServices(byId('services-button'), byId('services'), state);
    this.showMessages();
    drawCharts(byId('charts'), state, feed);
  }

  showTrack(state) {
    const estimate = state.estimates[0];
    const chip = byId('track');
    chip.hidden = !state.chosen[0] || state.chosen[0] === kOff;
    const name = !estimate ? 'no estimate' : estimate.coasting ? 'coasting' : estimate.state;
    chip.dataset.state = estimate ? name : 'lost';
    chip.textContent = name + (estimate?.resting ? ', at rest' : '')
      + (estimate?.left_image ? ', left the image' : '');
  }

  showTrackers(state) {
    for (const side of [0, 1]) {
      const select = byId(`tracker-${side}`);
      const names = [...state.trackers.filter((name) => name !== kOff), kOff];
      if (select.options.length !== names.length) {
        const text = (name) => (name === kOff ? (side === 0 ? 'no tracker' : 'no second') : name);
        select.replaceChildren(...names.map((name) => new Option(text(name), name)));
      }
      if (document.activeElement !== select) select.value = state.chosen[side] || kOff;
    }
    const isSecond = Boolean(state.chosen[1]) && state.chosen[1] !== kOff;
    if (byId('picture-1').hidden === isSecond) byId('picture-1').hidden = !isSecond;
  }

  showMessages() {
    const messages = [...(this.state ? this.state.messages : [])];
    if (this.controlProblem) messages.unshift({ level: 'warning', text: this.controlProblem });
    if (this.connectionProblem) messages.unshift({ level: 'error', text: this.connectionProblem });
    // Where there is no picture, there is room.
    const isPictured = Boolean(byId('picture-0').dataset.shown);
    const key = JSON.stringify([messages, this.allMessages, isPictured]);
    if (key === this.shownMessages) return;
    this.shownMessages = key;
    const count = this.allMessages || !isPictured ? messages.length : 1;
    byId('messages').replaceChildren(...messages.slice(0, count).map(({ level, text }) => {
      const line = document.createElement('p');
      line.dataset.level = level;
      line.textContent = text;
      return line;
    }));
    if (messages.length < 2 || !isPictured) return;
    const more = byId('messages').firstChild.appendChild(document.createElement('button'));
    more.textContent = this.allMessages ? 'fewer' : `${messages.length - 1} more`;
    more.title = 'All messages or the first (a)';
    more.onclick = () => this.toggleMessages();
  }
}

new View();
