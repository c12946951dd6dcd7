#!/usr/bin/python3
"""Draws rate.png and pixels.png of puck-info into a folder, from its JSON with the counts of all
pixels: info.py JSON DIR."""

import os

import chart_style as style
import numpy as np
from matplotlib.colors import LogNorm


def draw_rate(survey, path):
    bin_s = survey["rates"]["bin_us"] * 1e-6
    kev_s = np.array(survey["rates"]["events"]) * 1e-3 / bin_s
    figure, axes = style.figure()
    axes.plot((np.arange(len(kev_s)) + 0.5) * bin_s, kev_s, linewidth=0.8)
    style.label(
        axes,
        f"rate, in steps of {bin_s * 1e3:g} ms",
        "time since the first event, s",
        "events, kev/s",
    )
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    style.save(figure, path)


def draw_pixels(survey, path):
    counts = np.array(survey["pixel_counts"]).reshape(survey["height"], survey["width"])
    figure, axes = style.figure(height_px=700)
    picture = axes.imshow(
        np.ma.masked_equal(counts, 0),
        cmap="viridis",
        norm=LogNorm(1, max(2, counts.max())),
        interpolation="nearest",
    )
    axes.grid(False)
    axes.set_facecolor("black")
    style.label(axes, "events of each pixel; black: none", "x, px", "y, px")
    figure.colorbar(picture, shrink=0.8)
    style.save(figure, path)


def draw(json_file, folder):
    survey = style.read_json(json_file)
    draw_rate(survey, os.path.join(folder, "rate.png"))
    draw_pixels(survey, os.path.join(folder, "pixels.png"))


style.run(draw, "JSON", "DIR")
