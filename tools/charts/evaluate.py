#!/usr/bin/python3
"""Draws the charts of puck-evaluate --plots DIR: error.png, within.png and score.png from the CSV
files of these names."""

import os

import chart_style as style
from score_curve import ScoreCurve

SHOWN_PX = 10


def draw_error(folder):
    table = style.read_csv(os.path.join(folder, "error.csv"))
    drawn, axes = style.figure()
    axes.plot([t_us * 1e-6 for t_us in table["t_us"]], table["error_px"],
              color=style.COLOURS[4], linewidth=0.8)
    axes.set_ylim(0, SHOWN_PX)
    axes.margins(x=0)
    style.label(axes, f"error over time (cut at {SHOWN_PX} px)", "sensor time, s", "error, px")
    style.save(drawn, os.path.join(folder, "error.png"))


def draw_within(folder):
    table = style.read_csv(os.path.join(folder, "within.csv"))
    drawn, axes = style.figure()
    axes.plot(table["limit_px"], table["percent"], color=style.COLOURS[4])
    axes.set(xlim=(0, SHOWN_PX), ylim=(0, 101))
    style.label(axes, "ticks within an error", "error, px", "ticks, %")
    style.save(drawn, os.path.join(folder, "within.png"))


def draw_score(folder):
    table = style.read_csv(os.path.join(folder, "score.csv"))
    curve = ScoreCurve(table["threshold"], table["believed"], table["right"])
    drawn, axes = style.figure()
    curve.draw(axes, style.COLOURS[4:6])
    style.label(axes, "precision and recall by threshold on the score; "
                f"best F1 at {curve.best():.3f}, area {curve.area():.4f}",
                "threshold on the score", "ticks, %")
    style.legend(axes)
    style.save(drawn, os.path.join(folder, "score.png"))


def draw(folder):
    draw_error(folder)
    draw_within(folder)
    draw_score(folder)


style.run(draw, "DIR")
