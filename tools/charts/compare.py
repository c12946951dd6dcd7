#!/usr/bin/python3
"""Draws the charts of puck-compare into its output folder, from comparison.json and results/
there: the paper's figures errors-SET.png, within-SET.png, trajectories-SET.png and latency.png;
and hard.png, covariance.png and score.png."""

import itertools
import math
import os

import chart_style as style
from score_curve import ScoreCurve

# Errors are cut at these limits.
SMALLEST_PX = 0.01
LARGEST_PX = 100
WITHIN_SHOWN_PX = 10
SHOWN_S = 4
MOTION_PX = 5
CONSISTENT_PERCENT = 95


class Comparison:
    def __init__(self, folder):
        self.folder = folder
        report = style.read_json(os.path.join(folder, "comparison.json"))
        self.sets = report["sets"]
        self.latency = report["latency"]
        self.colours = dict(zip(self.latency, itertools.cycle(style.COLOURS)))

    def runs(self, name, contestant):
        """A contestant's runs on a set that have scored ticks."""
        of_set = self.sets[name]["contestants"].get(contestant, {"runs": []})
        return [run for run in of_set["runs"] if run["estimates"]]

    def table(self, result, file):
        return style.read_csv(os.path.join(self.folder, "results", result, file))

    def save(self, drawn, name):
        style.save(drawn, os.path.join(self.folder, name))


def place_in_group(group, number, count):
    """Of a box or bar among `count` of a group that is 0.8 wide and begins at `group` + 0.1."""
    return group + 0.1 + 0.8 * (number + 0.5) / count


def group_axis(axes, names):
    axes.set_xticks([group + 0.5 for group in range(len(names))], names)
    axes.set_xlim(0, len(names))
    axes.grid(False, axis="x")
    for edge in range(1, len(names)):
        axes.axvline(edge, color="#e2e2e2", linewidth=0.8)


def draw_errors(comparison, name):
    its = comparison.sets[name]
    count = len(comparison.colours)
    seeds = sorted({run["seed"] for contestant in comparison.colours
                    for run in comparison.runs(name, contestant)})
    if not seeds:
        return
    drawn, axes = style.figure(width_px=min(max(300 + 150 * len(seeds), 1000), 1800),
                               height_px=520)
    for number, (contestant, colour) in enumerate(comparison.colours.items()):
        for run in comparison.runs(name, contestant):
            box = {"whislo": run["p5_px"], "q1": run["p25_px"], "med": run["median_px"],
                   "q3": run["p75_px"], "whishi": run["p95_px"]}
            box = {key: min(max(px, SMALLEST_PX), LARGEST_PX) for key, px in box.items()}
            axes.bxp([box], positions=[place_in_group(seeds.index(run["seed"]), number, count)],
                     widths=0.64 / count, showfliers=False, patch_artist=True,
                     manage_ticks=False, boxprops={"facecolor": colour + "66", "edgecolor": colour},
                     medianprops={"color": style.BLACK}, whiskerprops={"color": colour},
                     capprops={"color": colour})
        if comparison.runs(name, contestant):
            axes.bar(0, 0, color=colour + "66", edgecolor=colour, label=contestant)
    group_axis(axes, [f"seed {seed}" for seed in seeds])
    axes.set_yscale("log")
    axes.set_ylim(SMALLEST_PX, LARGEST_PX)
    style.plain_ticks(axes.yaxis)
    style.label(axes, f"error of each sequence, {its['title']}: quartiles and median; whiskers "
                "from 5 to 95 %", "sequence", "error, px")
    style.legend(axes)
    comparison.save(drawn, f"errors-{name}.png")


def draw_within(comparison, name):
    drawn, axes = style.figure()
    for contestant, colour in comparison.colours.items():
        runs = comparison.runs(name, contestant)
        if not runs:
            continue
        tables = [comparison.table(run["folder"], "within.csv") for run in runs]
        ticks = [run["estimates"] for run in runs]
        # Over all ticks of the runs.
        percents = [sum(p * n for p, n in zip(row, ticks)) / sum(ticks)
                    for row in zip(*(table["percent"] for table in tables))]
        axes.plot(tables[0]["limit_px"], percents, color=colour, label=contestant)
    axes.set(xlim=(0, WITHIN_SHOWN_PX), ylim=(0, 101))
    style.label(axes, f"valid positions, {comparison.sets[name]['title']}", "threshold, px",
                "positions within it, %")
    if axes.lines:
        style.legend(axes)
    comparison.save(drawn, f"within-{name}.png")


def read_track(table):
    """Time, s, x and y, px; NaN where the puck is unknown or hidden."""
    seen = [v >= 0.5 for v in table.get("visible", [1] * len(table["t_us"]))]
    hidden = float("nan")
    return ([t_us * 1e-6 for t_us in table["t_us"]],
            [x if s else hidden for x, s in zip(table["x"], seen)],
            [y if s else hidden for y, s in zip(table["y"], seen)])


def begin_of(times, xs, ys):
    """Shortly before the puck first moves."""
    for time, x, y in zip(times, xs, ys):
        if math.hypot(x - xs[0], y - ys[0]) > MOTION_PX:
            return max(time - 0.1, times[0])
    return times[0]


def draw_trajectories(comparison, name):
    shown = comparison.sets[name]["shown"]
    truth = read_track(comparison.table(shown["folder"], "truth.csv"))
    begin = begin_of(*truth)
    end = begin + min(SHOWN_S, shown["seconds"])
    drawn, (x_axes, y_axes, image) = style.figure(
        1400, 1300, charts=3, gridspec_kw={"height_ratios": [1, 1, 2]})
    tracks = [("truth", truth, "#cdcdcd", 6)]
    for contestant, colour in comparison.colours.items():
        for run in comparison.runs(name, contestant):
            if run["seed"] == shown["seed"]:
                track = read_track(comparison.table(run["folder"], "ticks.csv"))
                tracks.append((contestant, track, colour, 1.2))
    limits = None
    for title, track, colour, width in tracks:
        rows = [row for row in zip(*track) if begin <= row[0] <= end]
        if not rows:
            continue
        times, xs, ys = zip(*rows)
        look = {"color": colour, "linewidth": width, "label": title}
        x_axes.plot(times, xs, **look)
        y_axes.plot(times, ys, **look)
        image.plot(xs, ys, **look)
        # Those of the truth: a wrong estimate may lie anywhere.
        if limits is None:
            limits = x_axes.get_ylim(), y_axes.get_ylim()
    if limits:
        x_axes.set_ylim(limits[0])
        y_axes.set_ylim(limits[1])
        # Image rows grow downwards.
        image.set(xlim=limits[0], ylim=reversed(limits[1]))
    which = f"{comparison.sets[name]['title']}, seed {shown['seed']}"
    for axes, axis in ((x_axes, "x"), (y_axes, "y")):
        axes.set_xlim(begin, end)
        style.label(axes, f"{axis} over time, {which}", "sensor time, s", f"{axis}, px")
    style.label(image, f"in the image, {which}", "x, px", "y, px")
    style.legend(x_axes)
    comparison.save(drawn, f"trajectories-{name}.png")


def draw_bars(axes, comparison, title, y, key, smallest=0):
    count = len(comparison.colours)
    for number, (contestant, colour) in enumerate(comparison.colours.items()):
        bars = []
        for group, its in enumerate(comparison.sets.values()):
            value = its["contestants"].get(contestant, {}).get(key)
            if value is not None:
                bars.append((place_in_group(group, number, count), max(value, smallest)))
        if bars:
            axes.bar(*zip(*bars), width=0.7 / count, color=colour, label=contestant)
    group_axis(axes, ["\n".join(name.rsplit("-", 1)) for name in comparison.sets])
    style.label(axes, title, "", y)


def draw_hard(comparison):
    drawn, (errors, losses) = style.figure(1800, 920, charts=2)
    draw_bars(errors, comparison, "mean error of every set", "error, px", "mean_px")
    draw_bars(losses, comparison, "lost: more than 20 px off or not tracking", "lost, %",
              "lost_percent", smallest=0.01)
    for axes, limits in ((errors, (SMALLEST_PX, LARGEST_PX)), (losses, (0.01, 100))):
        axes.set_yscale("log")
        axes.set_ylim(limits)
        style.plain_ticks(axes.yaxis)
    style.legend(errors)
    comparison.save(drawn, "hard.png")


def draw_covariance(comparison):
    drawn, axes = style.figure(1800, 460)
    axes.axhline(CONSISTENT_PERCENT, color=style.BLACK, linewidth=1, label="consistent")
    draw_bars(axes, comparison, "consistency of the covariance: tracked positions within its 95 % "
              "bound", "ticks, %", "nees_within_95_percent")
    axes.set_ylim(0, 100)
    style.legend(axes)
    comparison.save(drawn, "covariance.png")


def pooled_score(comparison, contestant):
    """Without the second puck's set: both pucks deserve a score, but the truth holds one."""
    tables = [comparison.table(run["folder"], "score.csv") for name in comparison.sets
              if name != "second-puck" for run in comparison.runs(name, contestant)]
    if not tables:
        return None
    believed, right = ([sum(row) for row in zip(*(table[key] for table in tables))]
                       for key in ("believed", "right"))
    return ScoreCurve(tables[0]["threshold"], believed, right)


def draw_score(comparison):
    drawn, (precision, choice) = style.figure(1000, 960, charts=2)
    for contestant, colour in comparison.colours.items():
        curve = pooled_score(comparison, contestant)
        if curve:
            precision.plot(curve.recall, curve.precision, color=colour, label=contestant)
        if curve and contestant == "default":
            curve.draw(choice, style.COLOURS[4:6])
            style.label(choice, f"default: best F1 with a threshold of {curve.best():.3f}, area "
                        f"{curve.area():.4f}", "threshold on the score", "ticks, %")
            style.legend(choice)
    precision.set(xlim=(0, 102), ylim=(40, 102))
    style.label(precision, "precision and recall by threshold on the score, all sets but the "
                "second puck's", "recall: positions within 4 px that are believed, %",
                "precision: within 4 px, %")
    if precision.lines:
        style.legend(precision)
    comparison.save(drawn, "score.png")


def draw_latency(comparison):
    medians = {contestant: runs[0]["latency_p50_us"]
               for contestant, runs in comparison.latency.items() if runs}
    medians = {contestant: max(us, 1) for contestant, us in medians.items() if us is not None}
    drawn, axes = style.figure()
    bars = axes.bar(list(medians), list(medians.values()), width=0.6,
                    color=[comparison.colours[contestant] for contestant in medians])
    axes.bar_label(bars, [f"{us:.0f} µs" for us in medians.values()])
    axes.set_yscale("log")
    if medians:
        axes.set_ylim(min(medians.values()) / 2, max(medians.values()) * 2)
    style.plain_ticks(axes.yaxis)
    axes.grid(False, axis="x")
    style.label(axes, "latency in real time: from a packet to the estimate with its last event, "
                "median", "", "latency, µs")
    comparison.save(drawn, "latency.png")


def draw(folder):
    comparison = Comparison(folder)
    for name, its in comparison.sets.items():
        if not its["hard"]:
            draw_errors(comparison, name)
            draw_within(comparison, name)
        if "shown" in its:
            draw_trajectories(comparison, name)
    draw_hard(comparison)
    draw_covariance(comparison)
    draw_score(comparison)
    draw_latency(comparison)


style.run(draw, "DIR")
