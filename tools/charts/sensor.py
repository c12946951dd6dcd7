#!/usr/bin/python3
"""Draws the charts of puck-simulate --sensor-checks DIR, from curves.csv: rows of
chart,curve,x,y."""

import os

import chart_style as style

# Title, x label, y label, logarithmic x.
CHARTS = {
    "step": ("pixels by number of events after a step to three times the light",
             "events", "share of the pixels", False),
    "contrast": ("events per cycle of a slow sinusoid",
                 "swing of ln(light)", "events per pixel and cycle", False),
    "frequency": ("events per cycle, as a share of those at low frequency",
                  "frequency, Hz", "share of the events", True),
    "latency": ("pixels that have answered a step of 1.5 thresholds",
                "time since the step, µs", "share of the pixels", True),
    "noise_rate": ("noise of a pixel", "illuminance, lux", "noise events, Hz", True),
    "noise_balance": ("ON among noise events",
                      "illuminance, lux", "share of the noise events", True),
    "noise_intervals": ("intervals between noise events of a pixel at 50 Hz",
                        "interval, s", "share of the intervals", False),
    "thresholds": ("S-curve: pixels that have fired again",
                   "growth of ln(light)", "share of the pixels", False),
    "refractory": ("intervals in light that changes too fast",
                   "interval, µs", "share of the intervals", True),
    "saturation": ("readout of 1 Mev/s", "events made, Mev/s",
                   "events read out, Mev/s; share lost", False),
    "burst": ("simultaneous events that have left at 1 Mev/s",
              "time since the first, µs", "share of the events", False),
    "conservation": ("ln(light) and the sum of signed events", "time, s", "ln(light)", False),
}


def draw(folder):
    table = style.read_csv(os.path.join(folder, "curves.csv"))
    charts = {}
    for chart, curve, x, y in zip(*(table[name] for name in ("chart", "curve", "x", "y"))):
        charts.setdefault(chart, {}).setdefault(curve, []).append((x, y))
    for name, curves in charts.items():
        title, x_label, y_label, is_logarithmic = CHARTS[name]
        drawn, axes = style.figure()
        for (curve, points), line in zip(curves.items(), ["-", "--", "-.", ":"] * len(curves)):
            axes.plot(*zip(*points), line, label=curve)
        if is_logarithmic:
            axes.set_xscale("log")
            style.plain_ticks(axes.xaxis)
        else:
            axes.set_xlim(left=0)
        if name != "conservation":
            axes.set_ylim(0, 1.05 * max(y for points in curves.values() for _, y in points))
        style.label(axes, title, x_label, y_label)
        style.legend(axes)
        style.save(drawn, os.path.join(folder, f"{name}.png"))


style.run(draw, "DIR")
