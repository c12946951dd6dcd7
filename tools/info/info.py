#!/usr/bin/python3
"""Draws rate.png and pixels.png of puck-info into a folder, from its JSON with the counts of all
pixels: info.py JSON DIR."""

import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm


def draw_rate(survey, path):
    bin_s = survey["rates"]["bin_us"] * 1e-6
    kev_s = np.array(survey["rates"]["events"]) * 1e-3 / bin_s
    figure, axes = plt.subplots(figsize=(10, 4.8), constrained_layout=True)
    axes.plot((np.arange(len(kev_s)) + 0.5) * bin_s, kev_s, linewidth=0.8)
    axes.set_title(f"rate, in steps of {bin_s * 1e3:g} ms", loc="left")
    axes.set_xlabel("time since the first event, s")
    axes.set_ylabel("events, kev/s")
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    figure.savefig(path)


def draw_pixels(survey, path):
    counts = np.array(survey["pixel_counts"]).reshape(survey["height"], survey["width"])
    figure, axes = plt.subplots(figsize=(10, 7), constrained_layout=True)
    shown = np.ma.masked_equal(counts, 0)
    picture = axes.imshow(shown, cmap="viridis", norm=LogNorm(1, max(2, counts.max())),
                          interpolation="nearest")
    axes.set_facecolor("black")
    axes.set_title("events of each pixel; black: none", loc="left")
    axes.set_xlabel("x, px")
    axes.set_ylabel("y, px")
    figure.colorbar(picture, shrink=0.8)
    figure.savefig(path)


with open(sys.argv[1], encoding="utf-8") as file:
    its = json.load(file)
draw_rate(its, os.path.join(sys.argv[2], "rate.png"))
draw_pixels(its, os.path.join(sys.argv[2], "pixels.png"))
