#!/usr/bin/python3
"""Draws the charts of puck-play --plots DIR, each from the file of its name: shots.png from CSV;
prediction.png and saves_SWEEP.png from JSON."""

import os

import chart_style as style

# Distance between the points of two curves, as a share of the axis, so that intervals stay apart.
APART = 0.003


def draw_shots(folder):
    table = style.read_csv(os.path.join(folder, "shots.csv"))
    drawn, axes = style.figure(height_px=560)
    fates = {
        "saved": (style.COLOURS[4], "o"),
        "goal": (style.COLOURS[1], "X"),
        "unreachable goal": (style.BLACK, "x"),
        "not judged": (style.GREY, "."),
    }
    for fate, (colour, marker) in fates.items():
        points = [(speed, y) for speed, y, its in
                  zip(table["speed_m_s"], table["crossing_y_m"], table["fate"]) if its == fate]
        if points:
            axes.scatter(*zip(*points), color=colour, marker=marker, label=fate)
    axes.set_xlim(left=0)
    style.label(axes, "outcome of the shots", "speed after the hit, m/s",
                "crosses the robot's line at, m")
    style.legend(axes)
    style.save(drawn, os.path.join(folder, "shots.png"))


def draw_predictions(folder):
    drawn, axes = style.figure()
    kinds = style.read_json(os.path.join(folder, "prediction.json"))
    for (name, bins), colour in zip(kinds.items(), style.COLOURS[4:]):
        times = [(bin["from_s"] + bin["to_s"]) / 2 for bin in bins]
        axes.plot(times, [bin["median_mm"] for bin in bins], color=colour, marker="o",
                  label=f"{name}, median")
        axes.plot(times, [bin["p90_mm"] for bin in bins], color=colour, linestyle="--",
                  label=f"{name}, 90 %")
    axes.set_xlim(0, 1)
    axes.set_ylim(bottom=0)
    style.label(axes, "error of the predicted crossing", "time to go, s", "error, mm")
    style.legend(axes)
    style.save(drawn, os.path.join(folder, "prediction.png"))


def draw_sweep(folder, name):
    sweep = style.read_json(os.path.join(folder, name))
    curves = {}
    for point in sweep["points"]:
        curves.setdefault(point["curve"], []).append(point)
    drawn, axes = style.figure(width_px=1200, height_px=560)
    if sweep["logarithmic"]:
        axes.set_xscale("log")
        style.plain_ticks(axes.xaxis)
    first = next(iter(curves.values()))
    values = [point["value"] for point in first]
    for key, label, line in [("bound_percent", "best arm", "-"),
                             ("waiting_percent", "waits in the middle", ":")]:
        axes.plot(values, [point[key] for point in first], line, color=style.BLACK, linewidth=1,
                  label=label)
    span = max(values) / min(values) if sweep["logarithmic"] else max(values) - min(values)
    markers = "os^Dv<>P"
    for i, (curve, points) in enumerate(curves.items()):
        shift = APART * (i - len(curves) / 2)
        x = [point["value"] * span**shift if sweep["logarithmic"] else
             point["value"] + shift * span for point in points]
        y = [point["save_percent"] for point in points]
        below = [max(0, s - point["save_ci_low"]) for s, point in zip(y, points)]
        above = [max(0, point["save_ci_high"] - s) for s, point in zip(y, points)]
        axes.errorbar(x, y, yerr=[below, above], elinewidth=1, label=curve, markersize=5,
                      color=style.COLOURS[i % len(style.COLOURS)], marker=markers[i % len(markers)])
    axes.set_ylim(0, 105)
    style.label(axes, "shots saved, with 95 % intervals", sweep["axis"], "saved, %")
    style.legend(axes)
    style.save(drawn, os.path.join(folder, name.replace(".json", ".png")))


def draw(folder, name):
    if name == "shots.csv":
        draw_shots(folder)
    elif name == "prediction.json":
        draw_predictions(folder)
    else:
        draw_sweep(folder, name)


style.run(draw, "DIR", "FILE")
