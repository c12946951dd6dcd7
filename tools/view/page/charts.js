// The last 10 s of x, y, error, event rate and latency, one below the other.

import { colours, inMicroseconds, prepared, short } from './canvas.js';

const kSpan_us = 10e6;
const kMargin = { left: 8, right: 8, top: 18, bottom: 4 };
const kGap_us = 60e3; // Points further apart are not joined.

function range(columns, least) {
  let low = Infinity;
  let high = -Infinity;
  for (const column of columns) {
    for (const value of column) {
      if (value === null) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (low > high) return null;
  const more = Math.max(least - (high - low), 0) / 2;
  return [low - more, high + more];
}

// A high share of the values is at most this; null without values.
function most(columns, share) {
  const values = columns.flat().filter((value) => value !== null).sort((a, b) => a - b);
  return values.length ? values[Math.floor((values.length - 1) * share)] : null;
}

// The text, cut to a width.
function fitted(context, text, width) {
  let fitting = text;
  while (fitting.length > 1 && context.measureText(fitting).width > width) {
    fitting = `${fitting.slice(0, -2)}…`;
  }
  return fitting;
}

class Plot {
  constructor(context, box, span, values) {
    this.context = context;
    this.box = box;
    this.span = span;
    this.values = values;
  }

  x(time) {
    const [from, to] = this.span;
    return this.box.x + ((time - from) / (to - from)) * this.box.width;
  }

  y(value) {
    const [low, high] = this.values;
    return this.box.y + this.box.height * (1 - (value - low) / (high - low || 1));
  }

  // Doubtful parts are dotted.
  line(times, column, colour, { dash = [], doubtful = [], gap = kGap_us } = {}) {
    const { context } = this;
    context.strokeStyle = colour;
    for (const doubt of [0, 1]) {
      context.lineWidth = doubt ? 1 : 1.5;
      context.setLineDash(doubt ? [1, 3] : dash);
      context.beginPath();
      let before = null;
      for (let i = 0; i < times.length; ++i) {
        if (column[i] === null || (doubtful[i] || 0) !== doubt) {
          before = null;
          continue;
        }
        const joined = before !== null && times[i] - before < gap;
        const x = this.x(times[i]);
        const y = this.y(column[i]);
        if (joined) context.lineTo(x, y);
        else context.moveTo(x, y);
        before = times[i];
      }
      context.stroke();
    }
    context.setLineDash([]);
  }
}

function frame(context, box, colour, name, parts) {
  let right = box.x + box.width;
  context.textAlign = 'right';
  for (const [text, ink] of [...parts].reverse()) {
    context.fillStyle = ink;
    context.fillText(text, right, box.y - 5);
    right -= context.measureText(text).width + 10;
  }
  context.fillStyle = colour.quiet;
  context.textAlign = 'left';
  context.fillText(fitted(context, name, right - box.x), box.x, box.y - 5);
  context.strokeStyle = colour.border;
  context.lineWidth = 1;
  context.strokeRect(box.x + 0.5, box.y + 0.5, box.width - 1, box.height - 1);
}

// The highest and the lowest value, legible on top of the lines.
function limits(context, box, colour, values, text) {
  context.textAlign = 'left';
  for (const [value, y] of [[values[1], box.y + 11], [values[0], box.y + box.height - 3]]) {
    const words = text(value);
    context.fillStyle = colour.background;
    context.fillRect(box.x + 1, y - 9, context.measureText(words).width + 4, 11);
    context.fillStyle = colour.quiet;
    context.fillText(words, box.x + 3, y);
  }
}

const newest = (column) => (column.length ? column.at(-1) : null);
const hasAny = (column) => column.some((value) => value !== null);

export function drawCharts(canvas, state, feed) {
  const { context, width, height } = prepared(canvas);
  const colour = colours();
  const { samples } = feed;
  const now = newest(samples.time_us) ?? 0;
  const span = [now - kSpan_us, now];
  context.font = '11px system-ui, sans-serif';

  const sides = [0, 1].filter((side) => hasAny(samples.x[side]));
  const inks = [colour.first, colour.second];
  const px = (value) => `${short(value)}`;
  const charts = [];
  for (const axis of ['x', 'y']) {
    const truth = samples[`truth_${axis}`];
    charts.push({
      name: axis === 'x' ? 'x [px], last 10 s' : 'y [px]',
      values: range([truth, ...samples[axis]], 4),
      text: px,
      parts: [
        ...sides.map((side) => [short(newest(samples[axis][side])), inks[side]]),
        ...(hasAny(truth) ? [[`truth ${short(newest(truth))}`, colour.truth]] : []),
      ],
      draw(plot) {
        plot.line(samples.time_us, truth, colour.truth, { dash: [4, 3] });
        for (const side of sides) {
          plot.line(samples.time_us, samples[axis][side], inks[side],
            { doubtful: samples.doubtful[side] });
        }
      },
    });
  }
  if (samples.error.some(hasAny)) {
    // A short loss does not hide the errors of a good track: higher values are cut.
    const highest = Math.max(1.5 * most(samples.error, 0.95), 1);
    charts.push({
      name: 'error [px]',
      values: [0, highest],
      text: px,
      parts: sides.map((side) => [short(newest(samples.error[side])), inks[side]]),
      draw(plot) {
        for (const side of sides) {
          const cut = samples.error[side].map((e) => (e === null ? null : Math.min(e, highest)));
          plot.line(samples.time_us, cut, inks[side], { doubtful: samples.doubtful[side] });
        }
      },
    });
  }
  const rates = range([samples.events_per_s], 1);
  charts.push({
    name: 'events per second',
    values: rates && [0, rates[1]],
    text: short,
    parts: [[short(state.events_per_s), colour.words]],
    draw(plot) { plot.line(samples.time_us, samples.events_per_s, colour.words); },
  });
  const latency = latencyChart(feed, colour, width > 300);
  if (latency) charts.push(latency);

  const each = height / charts.length;
  charts.forEach((chart, i) => {
    const box = {
      x: kMargin.left,
      y: i * each + kMargin.top,
      width: width - kMargin.left - kMargin.right,
      height: each - kMargin.top - kMargin.bottom,
    };
    frame(context, box, colour, chart.name, chart.parts);
    if (!chart.values) return;
    context.save();
    context.beginPath();
    context.rect(box.x, box.y, box.width, box.height);
    context.clip();
    chart.draw(new Plot(context, box, chart.span || span, chart.values));
    context.restore();
    limits(context, box, colour, chart.values, chart.text);
  });
}

// The first latency that was measured, by the wall clock.
function latencyChart(feed, colour, isWide) {
  const { latencies } = feed;
  const last = latencies.at(-1);
  const at = last ? last.rows.findIndex((row) => row.p50_us !== null) : -1;
  if (at < 0) return null;
  const row = last.rows[at];
  const times = latencies.map((one) => one.at);
  // From a few µs to a second: logarithmic.
  const column = (key) => latencies.map((one) => {
    const value = one.rows[at]?.[key] ?? null;
    return value === null ? null : Math.log10(Math.max(value, 1));
  });
  const [lowest, highest] = range([column('p99_us'), column('p50_us')], 0);
  return {
    name: row.name,
    span: [last.at - kSpan_us / 1e3, last.at],
    values: [Math.floor(lowest), Math.max(Math.ceil(highest), Math.floor(lowest) + 1)],
    text: (value) => inMicroseconds(Math.round(10 ** value)),
    parts: [[(isWide ? 'median ' : '') + inMicroseconds(row.p50_us), colour.words],
      ...(row.p99_us === null ? []
        : [[(isWide ? '99 % ' : '') + inMicroseconds(row.p99_us), colour.accent]])],
    draw(plot) {
      plot.line(times, column('p99_us'), colour.accent, { dash: [4, 3], gap: 2000 });
      plot.line(times, column('p50_us'), colour.words, { gap: 2000 });
    },
  };
}
