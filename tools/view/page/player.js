// Playing of a recording: buttons, speed, and the timeline with the rate of events and the losses.

import { colours, prepared } from './canvas.js';
import { control, getJson, pause } from './server.js';

const kSpeeds = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 0];
const byId = (id) => document.getElementById(id);
const speedText = (speed) => (speed === 0 ? 'max' : `${speed} ×`);

export class Player {
  constructor(onProblem) {
    this.onProblem = onProblem;
    this.state = null;
    this.timeline = null;
    for (const speed of kSpeeds) byId('speed').add(new Option(speedText(speed), String(speed)));
    byId('play').onclick = () => this.toggle();
    byId('back').onclick = () => this.step(-1);
    byId('forward').onclick = () => this.step(1);
    byId('speed').onchange = (event) => this.send('speed', { value: Number(event.target.value) });
    byId('next-loss').onclick = () => this.send('next_loss');
    byId('previous-loss').onclick = () => this.send('previous_loss');
    this.listenToTimeline();
    this.follow();
  }

  get isPresent() { return this.state !== null && this.state.playback !== null; }
  get isPlaying() { return this.isPresent && this.state.playback.activity === 'playing'; }

  async send(action, fields) {
    if (this.isPresent) this.onProblem(await control(action, fields));
  }

  toggle() { return this.send(this.isPlaying ? 'pause' : 'play'); }
  step(steps) { return this.send('step', { value: steps * 0.01 }); }
  jump(seconds) {
    if (!this.isPresent) return;
    this.seek(this.state.seconds + seconds);
  }

  seek(seconds) {
    const last = this.timeline?.seconds || Infinity;
    return this.send('seek', { value: Math.min(Math.max(seconds, 0), last) });
  }

  changeSpeed(by) {
    if (!this.isPresent) return;
    const at = kSpeeds.indexOf(this.state.playback.speed);
    const next = kSpeeds[Math.min(Math.max((at < 0 ? kSpeeds.indexOf(1) : at) + by, 0), kSpeeds.length - 1)];
    this.send('speed', { value: next });
  }

  show(state) {
    this.state = state;
    document.body.classList.toggle('has-playback', this.isPresent);
    if (!this.isPresent) return;
    const { activity, speed, reached_speed: reached } = state.playback;
    byId('play').textContent = this.isPlaying ? '❚❚ pause' : '▶ play';
    if (document.activeElement !== byId('speed')) byId('speed').value = String(speed);
    let text = `${state.seconds.toFixed(3)} s`;
    if (activity === 'seeking' || activity === 'searching') text += ` ${activity} …`;
    else if (activity === 'ended') text += ' end';
    else if (this.isPlaying && reached > 0 && reached < 0.8 * speed) text += ` (${reached.toPrecision(2)} ×)`;
    byId('position').textContent = text;
    byId('timeline').setAttribute('aria-valuenow', state.seconds.toFixed(1));
    byId('timeline').setAttribute('aria-valuemax', this.timeline ? this.timeline.seconds.toFixed(1) : 0);
    this.draw();
  }

  // Until the recording has been counted, and then for the losses.
  async follow() {
    for (;;) {
      if (this.isPresent && !document.hidden) {
        const timeline = await getJson('timeline');
        if (timeline) this.timeline = timeline;
      }
      await pause(this.timeline && this.timeline.complete ? 1000 : 300);
    }
  }

  listenToTimeline() {
    const canvas = byId('timeline');
    const seekTo = (event) => {
      if (!this.timeline || this.timeline.seconds <= 0) return;
      const box = canvas.getBoundingClientRect();
      const share = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1);
      this.seek(share * this.timeline.seconds);
    };
    canvas.onpointerdown = (event) => {
      canvas.setPointerCapture(event.pointerId);
      seekTo(event);
    };
    canvas.onpointermove = (event) => {
      if (canvas.hasPointerCapture(event.pointerId)) seekTo(event);
    };
  }

  draw() {
    const { context, width, height } = prepared(byId('timeline'));
    const { timeline, state } = this;
    if (!timeline || timeline.seconds <= 0) return;
    const colour = colours();
    const x = (seconds) => (seconds / timeline.seconds) * width;
    const bottom = height - 8;
    const most = Math.max(...timeline.events, 1);
    context.fillStyle = colour.quiet;
    timeline.events.forEach((count, i) => {
      const high = (count / most) * (bottom - 4);
      context.fillRect(x(i * timeline.bin_s), bottom - high, Math.max(x(timeline.bin_s), 1), high);
    });
    // Below: what the trackers have seen so far, and where they lost the puck.
    for (const side of [0, 1]) {
      const y = bottom + 1 + side * 4;
      context.fillStyle = side === 0 ? colour.first : colour.second;
      for (const [from, to] of timeline.examined[side]) context.fillRect(x(from), y + 1, x(to) - x(from), 1);
      context.fillStyle = colour.error;
      for (const [from, to] of timeline.losses[side]) {
        context.fillRect(x(from), y - 1, Math.max(x(to) - x(from), 2), 4);
      }
    }
    context.fillStyle = colour.accent;
    context.fillRect(x(state.seconds) - 1, 0, 2, height);
  }
}
