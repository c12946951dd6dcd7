// What the viewer chose, kept by the browser.

const kKey = 'puck-view';

export const layerNames = {
  regions: ['r', 'searched region'],
  ellipse: ['e', 'ellipse of the puck'],
  velocity: ['v', 'velocity'],
  covariance: ['c', 'uncertainty'],
  trail: ['t', 'trail of the last second'],
  truth: ['g', 'truth (ground truth)'],
  'close-up': ['u', 'close-up of the puck in a corner'],
  words: ['w', 'words'],
  legend: ['l', 'legend'],
};

export const backdropNames = { events: 'events', surface: 'surface', heat: 'heat map' };

function stored() {
  try {
    return JSON.parse(localStorage.getItem(kKey)) || {};
  } catch {
    return {};
  }
}

const systemTheme = matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark';

export const settings = {
  theme: systemTheme,
  backdrop: 'events',
  windowUs: 20000,
  hidden: [],
  ...stored(),
};

const listeners = [];

export function whenSettingsChange(callback) {
  listeners.push(callback);
  callback();
}

export function change(fields) {
  Object.assign(settings, fields);
  try {
    localStorage.setItem(kKey, JSON.stringify(settings));
  } catch {
    // A browser that keeps nothing: the choice lasts as long as the page.
  }
  for (const callback of listeners) callback();
}

export function toggleLayer(name) {
  const hidden = settings.hidden.includes(name)
    ? settings.hidden.filter((other) => other !== name)
    : [...settings.hidden, name];
  change({ hidden });
}

// Windows from 0.1 ms to 1 s in 60 even ratios.
const kShortest = 100;
const kRatio = Math.pow(10000, 1 / 60);
export const windowSteps = 60;
export const windowOfStep = (step) => Math.round(kShortest * Math.pow(kRatio, step));
export const stepOfWindow = (us) =>
  Math.min(windowSteps, Math.max(0, Math.round(Math.log(us / kShortest) / Math.log(kRatio))));
