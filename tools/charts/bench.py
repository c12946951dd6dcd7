#!/usr/bin/python3
"""Draws the charts of tests/bench/run.sh into a folder, from its JSON: cost-against-rate.png,
surface-against-k.png and step-against-size.png; none where nothing was measured."""

import os

import chart_style as style

RATES_KEV_S = [100, 300, 1000, 3000, 10000, 20000]
HALF_WIDTHS = range(1, 9)
LARGEST_PX = 100


def draw_chart(title, x, y, curves, path, x_scale="linear"):
    """`curves`: name → points; those without a value are left out."""
    known = {name: [point for point in points if point[1] is not None]
             for name, points in curves.items()}
    if not any(known.values()):
        return
    drawn, axes = style.figure(height_px=520)
    for (name, points), marker in zip(known.items(), "os^Dv<"):
        if points:
            axes.plot(*zip(*points), marker=marker, label=name)
    axes.set_yscale("log")
    style.plain_ticks(axes.yaxis)
    if x_scale == "log":
        axes.set_xscale(x_scale)
        style.plain_ticks(axes.xaxis)
    style.label(axes, title, x, y)
    style.legend(axes)
    style.save(drawn, path)


def draw_rates(figures, folder):
    surface_mev_s = figures.get("eros_k5_mev_s")
    ratio = figures.get("eros_k5_ratio")

    def share(rate_kev_s, times):
        return 100e-3 * rate_kev_s * times / surface_mev_s if surface_mev_s and times else None

    rates = {
        "preset default": lambda kev_s: figures.get(f"load_default_{kev_s}kev_core_percent"),
        "preset correlation":
            lambda kev_s: figures.get(f"load_correlation_{kev_s}kev_core_percent"),
        "surface alone, k = 5": lambda kev_s: share(kev_s, 1),
        "surface alone in OpenCV": lambda kev_s: share(kev_s, ratio),
    }
    curves = {name: [(kev_s * 1e-3, of(kev_s)) for kev_s in RATES_KEV_S]
              for name, of in rates.items()}
    draw_chart("surface and 5000 tracking steps a second, simulated scene",
               "events, Mev/s", "share of a core, %", curves,
               os.path.join(folder, "cost-against-rate.png"), x_scale="log")


def draw_half_widths(figures, folder):
    variants = {
        "ours": "mev_s",
        "OpenCV, 8 bits": "opencv_8u_ratio",
        "OpenCV, double": "opencv_64f_ratio",
        "plain, 8 bits": "plain_8u_ratio",
        "plain, fixed": "plain_8u_fixed_ratio",
        "plain, float": "plain_32f_ratio",
    }

    def rate(k, key):
        ours = figures.get(f"eros_k{k}_mev_s")
        value = figures.get(f"eros_k{k}_{key}")
        return value if key == "mev_s" or not (ours and value) else ours / value

    curves = {name: [(k, rate(k, key)) for k in HALF_WIDTHS] for name, key in variants.items()}
    draw_chart("surface, simulated scene, one core", "half width k, px", "Mev/s", curves,
               os.path.join(folder, "surface-against-k.png"))


def draw_sizes(figures, folder):
    def opencv(name):
        ours, ratio = figures.get(f"step_{name}_us"), figures.get(f"step_{name}_ratio")
        return ours * ratio if ours and ratio else None

    widths_px = {"far": 19, "mid": 41, "near": 65}
    curves = {
        "whole step, round pucks":
            [(px, figures.get(f"step_size_{px}_us")) for px in range(1, LARGEST_PX + 1)],
        "blur to maximum":
            [(px, figures.get(f"step_{name}_us")) for name, px in widths_px.items()],
        "the same in OpenCV": [(px, opencv(name)) for name, px in widths_px.items()],
    }
    draw_chart("a tracking step, reference kernels", "width of the kernel, px", "CPU time, µs",
               curves, os.path.join(folder, "step-against-size.png"))


def draw(json, folder):
    figures = style.read_json(json)
    draw_rates(figures, folder)
    draw_half_widths(figures, folder)
    draw_sizes(figures, folder)


style.run(draw, "FIGURES.json", "DIR")
