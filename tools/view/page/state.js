// Asks for the state ten times a second and keeps the charts' samples of the last 10 s.

import { getJson, pause } from './server.js';

const kPeriod_ms = 100;
const kKept_us = 10e6;
const kColumns = ['time_us', 'events_per_s', 'truth_x', 'truth_y'];
const kSides = ['x', 'y', 'error', 'doubtful'];

function emptySamples() {
  const samples = {};
  for (const name of kColumns) samples[name] = [];
  for (const name of kSides) samples[name] = [[], []];
  return samples;
}

export class StateFeed {
  constructor(onState) {
    this.onState = onState;
    this.run = -1;
    this.samples = emptySamples();
    this.latencies = []; // {at, rows} for each state.
    this.listen();
  }

  async listen() {
    for (;;) {
      if (document.hidden) {
        await new Promise((wake) => {
          document.addEventListener('visibilitychange', wake, { once: true });
        });
        continue;
      }
      const newest = this.samples.time_us.length ? this.samples.time_us.at(-1) : 0;
      const state = await getJson(`state?since_us=${newest}&run=${this.run}`);
      if (state) this.take(state);
      await pause(state ? kPeriod_ms : 500);
    }
  }

  take(state) {
    if (state.run !== this.run) {
      this.samples = emptySamples();
      this.run = state.run;
    }
    for (const name of kColumns) this.samples[name].push(...state.samples[name]);
    for (const name of kSides) {
      for (const side of [0, 1]) this.samples[name][side].push(...state.samples[name][side]);
    }
    this.forget();
    const at = performance.now();
    this.latencies.push({ at, rows: state.latencies });
    while (at - this.latencies[0].at > kKept_us / 1e3) this.latencies.shift();
    this.onState(state, this);
  }

  forget() {
    const times = this.samples.time_us;
    let old = 0;
    while (old < times.length && times.at(-1) - times[old] > kKept_us) ++old;
    if (old === 0) return;
    for (const name of kColumns) this.samples[name].splice(0, old);
    for (const name of kSides) for (const side of [0, 1]) this.samples[name][side].splice(0, old);
  }
}
