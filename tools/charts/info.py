#!/usr/bin/python3
"""Draws rate.png and pixels.png of puck-info into a folder, from its JSON with the counts of all
pixels: info.py JSON DIR."""

import json
import os
import sys

import chart_style
import numpy as np
from matplotlib.colors import LogNorm


def draw_rate(survey, path):
    bin_s = survey["rates"]["bin_us"] * 1e-6
    kev_s = np.array(survey["rates"]["events"]) * 1e-3 / bin_s
    figure, axes = chart_style.figure()
    axes.plot((np.arange(len(kev_s)) + 0.5) * bin_s, kev_s, linewidth=0.8)
    chart_style.label(axes, f"rate, in steps of {bin_s * 1e3:g} ms", "time since the first event, s",
                      "events, kev/s")
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    figure.savefig(path)


def draw_pixels(survey, path):
    counts = np.array(survey["pixel_counts"]).reshape(survey["height"], survey["width"])
    figure, axes = chart_style.figure(height_px=700)
    shown = np.ma.masked_equal(counts, 0)
    picture = axes.imshow(shown, cmap="viridis", norm=LogNorm(1, max(2, counts.max())),
                          interpolation="nearest")
    axes.grid(False)
    axes.set_facecolor("black")
    chart_style.label(axes, "events of each pixel; black: none", "x, px", "y, px")
    figure.colorbar(picture, shrink=0.8)
    figure.savefig(path)


with open(sys.argv[1], encoding="utf-8") as file:
    its = json.load(file)
draw_rate(its, os.path.join(sys.argv[2], "rate.png"))
draw_pixels(its, os.path.join(sys.argv[2], "pixels.png"))
