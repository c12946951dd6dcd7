// Services and channels at a glance: a button with the count of faults, and a panel of tables.

import { inMicroseconds, short } from './canvas.js';

function element(name, text = '', className = '') {
  const made = document.createElement(name);
  made.textContent = text;
  if (className) made.className = className;
  return made;
}

// `columns`: [head, cell(row), class].
function table(rows, columns, isBad) {
  const made = element('table');
  const head = made.appendChild(element('tr'));
  for (const [name, , kind] of columns) head.append(element('th', name, kind));
  for (const row of rows) {
    const line = made.appendChild(element('tr', '', isBad(row) ? 'bad' : ''));
    for (const [, cell, kind] of columns) line.append(element('td', cell(row), kind));
  }
  return made;
}

function uptime(seconds) {
  if (seconds < 120) return `${Math.round(seconds)} s`;
  return seconds < 7200 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

const latencies = (service) => service.latencies
  .filter((one) => one.p50_us !== null)
  .map((one) => `${one.name}: ${inMicroseconds(one.p50_us)}, ${inMicroseconds(one.p99_us)}`)
  .join('\n');

const kTroubles = /lost|late|reject|dropped|skipped|fail|overflow|malformed|duplicate/;
const troubles = (service) => service.counters
  .filter(([name, value]) => value > 0 && kTroubles.test(name) && !name.endsWith('_us'))
  .map(([name, value]) => `${name} ${short(value)}`)
  .join(', ');

const counted = (count, name) => `${count || 'no'} ${name}${count === 1 ? '' : 's'}`;

export function showServices(button, panel, state) {
  const { services, channels } = state;
  button.hidden = services.length === 0 && channels.length === 0;
  const ill = services.filter((one) => !one.healthy).length
    + channels.filter((one) => one.trouble).length;
  const isBad = ill > 0 || services.length === 0;
  button.textContent = `${isBad ? '✕' : '✓'} ${counted(services.length, 'service')}`
    + (ill ? `, ${counted(ill, 'problem')}` : '');
  button.className = isBad ? 'bad' : '';
  if (panel.hidden) return;
  panel.replaceChildren(
    element('h2', 'Services'),
    table(services, [
      ['service', (one) => `${one.healthy ? '' : '✕ '}${one.name}`],
      ['state', (one) => one.state + (one.state_text ? `: ${one.state_text}` : '')],
      ['host', (one) => `${one.host} ${one.pid}`],
      ['up', (one) => uptime(one.uptime_s), 'number'],
      ['losses', troubles],
      ['latencies: median, 99 %', latencies, 'lines'],
    ], (one) => !one.healthy),
    element('h2', 'Channels, as received here'),
    table(channels, [
      ['channel', (one) => `${one.trouble ? '✕ ' : ''}${one.name}`],
      ['messages/s', (one) => short(one.messages_per_s), 'number'],
      ['bytes/s', (one) => short(one.bytes_per_s), 'number'],
      ['received', (one) => short(one.received), 'number'],
      ['lost', (one) => short(one.lost), 'number'],
      ['late', (one) => short(one.late), 'number'],
      ['malformed', (one) => short(one.malformed), 'number'],
      ['age', (one) => (one.age_s === null ? '–' : `${one.age_s} s`), 'number'],
    ], (one) => one.trouble),
  );
}
