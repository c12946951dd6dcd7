#!/usr/bin/python3
"""Draws the picture of puck-evaluate --picture FILE.png: the tracked puck at one moment. Sensor
pixels are squares of a whole number of pixels."""

import math

import chart_style as style
import matplotlib.collections
import matplotlib.patches
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D

# Blue and orange differ for every kind of colour blindness; overlays are bright.
BACKGROUND = "#0d1117"
BAR = "#161b22"
WORDS = "#e6edf3"
QUIET = "#96a0ac"
BRIGHTER = "#f0a528"
DARKER = "#468ce6"
ESTIMATE = "#ffffff"
TRAIL = "#5adc96"
TRUTH = "#ff5ac8"

LEAST_WIDTH_PX = 1200
BAR_PX = 48
MARGIN_PX = 16
# The arrow ends at the position predicted this far ahead.
ARROW_S = 0.05
ARROW_HEAD_PX = 9
# Share of the colour that the oldest event and the oldest trail point keep.
OLDEST_EVENT = 0.25
OLDEST_TRAIL = 0.2
# Extent of the close-up, in lengths of the puck's longer axis.
CLOSE_UP_SIZES = 1.35


def mixed(colour, share):
    """From the background, at 0, to a colour, at 1."""
    return np.array(to_rgb(BACKGROUND)) * (1 - share) + np.array(to_rgb(colour)) * share


def image_of(moment):
    width, height = moment["sensor"]
    image = np.full((height, width, 3), to_rgb(BACKGROUND))
    for x, y, polarity, age_us in moment["events"]:
        share = 1 - (1 - OLDEST_EVENT) * age_us / moment["events_us"]
        image[y, x] = mixed(BRIGHTER if polarity else DARKER, share)
    return image


def draw_ellipse(axes, ellipse, colour, width, **options):
    axes.add_patch(matplotlib.patches.Ellipse(
        (ellipse["x"], ellipse["y"]), ellipse["width"], ellipse["height"], fill=False,
        edgecolor=colour, linewidth=width, **options))


def draw_puck(axes, moment):
    if moment["estimate"]:
        draw_ellipse(axes, moment["estimate"], BACKGROUND, 6)
        draw_ellipse(axes, moment["estimate"], ESTIMATE, 2)
    if moment["truth"]:
        draw_ellipse(axes, moment["truth"], TRUTH, 1)


def draw_trail(axes, moment):
    lines = [((x0, y0), (x1, y1)) for x0, y0, x1, y1, _ in moment["trail"]]
    colours = [mixed(TRAIL, 1 - (1 - OLDEST_TRAIL) * row[4] / moment["trail_us"])
               for row in moment["trail"]]
    axes.add_collection(matplotlib.collections.LineCollection(
        lines, colors=colours, linewidths=3))


def draw_arrow(axes, estimate, scale):
    """As long as the puck's way in ARROW_S."""
    step = estimate["vx"] * ARROW_S, estimate["vy"] * ARROW_S
    length = math.hypot(*step)
    head = ARROW_HEAD_PX / scale
    if length < 2 * head:
        return
    along = step[0] / length, step[1] / length
    tip = estimate["x"] + step[0], estimate["y"] + step[1]
    barbs = [(tip[0] - head * (1.6 * along[0] - side * along[1]),
              tip[1] - head * (1.6 * along[1] + side * along[0])) for side in (1, -1)]
    for colour, width in ((BACKGROUND, 6), (ESTIMATE, 2)):
        for points in ([(estimate["x"], estimate["y"]), tip], [barbs[0], tip, barbs[1]]):
            axes.plot(*zip(*points), color=colour, linewidth=width)


def sensor_axes(drawn, place_px, size_px, limits, image):
    """Axes at a place in the figure, from the lower left, that show a part of the sensor."""
    figure_px = drawn.get_size_inches() * drawn.dpi
    axes = drawn.add_axes((*(place_px / figure_px), *(size_px / figure_px)))
    axes.imshow(image, interpolation="nearest", aspect="auto")
    axes.grid(False)
    axes.set(xlim=limits[0], ylim=limits[1], xticks=[], yticks=[], facecolor=BACKGROUND)
    return axes


def draw_close_up(drawn, moment, scale, image):
    """In the corner that is furthest from the puck."""
    estimate = moment["estimate"]
    width, height = moment["sensor"]
    longest = max(estimate["width"], estimate["height"], 1)
    side_px = min(width, height) * scale * 3 // 10
    zoom = int(side_px / (CLOSE_UP_SIZES * longest))
    if zoom < 2 * scale:
        return
    shown = side_px // zoom
    size_px = np.array([shown * zoom] * 2)
    place_px = np.array([MARGIN_PX, BAR_PX + MARGIN_PX])
    if estimate["x"] < width / 2:
        place_px[0] = width * scale - size_px[0] - MARGIN_PX
    if estimate["y"] > height / 2:
        place_px[1] = BAR_PX + height * scale - size_px[1] - MARGIN_PX
    left = round(estimate["x"]) - shown // 2 - 0.5
    top = round(estimate["y"]) - shown // 2 - 0.5
    axes = sensor_axes(drawn, place_px, size_px, ((left, left + shown), (top + shown, top)), image)
    axes.patch.set_visible(True)
    draw_puck(axes, moment)
    for spine in axes.spines.values():
        spine.set_color(QUIET)


def write_facts(drawn, moment, y):
    facts = [f"time  {moment['time_s']:.3f} s", f"state  {moment['state']}"]
    estimate, truth = moment["estimate"], moment["truth"]
    if estimate:
        facts.append(f"speed  {math.hypot(estimate['vx'], estimate['vy']):.0f} px/s")
    if estimate and truth:
        error = math.hypot(estimate["x"] - truth["x"], estimate["y"] - truth["y"])
        facts.append(f"error  {error:.2f} px")
    drawn.text(0.013, y, "      ".join(facts), color=WORDS, fontsize=15, va="center")


def ring(colour, width):
    return Line2D([], [], marker="o", markerfacecolor="none", markeredgecolor=colour,
                  markeredgewidth=width, linestyle="none", markersize=12)


def draw_legend(drawn, moment, y):
    square = {"marker": "s", "linestyle": "none", "markersize": 9}
    entries = {
        f"events of the last {moment['events_us'] / 1e3:.0f} ms: brighter":
            Line2D([], [], color=BRIGHTER, **square),
        "darker": Line2D([], [], color=DARKER, **square),
        "estimate": ring(ESTIMATE, 1.5),
    }
    if moment["truth"]:
        entries["truth"] = ring(TRUTH, 0.8)
    entries[f"trail, {moment['trail_us'] / 1e6:g} s"] = Line2D([], [], color=TRAIL, linewidth=2.2)
    entries[f"velocity ({ARROW_S * 1e3:.0f} ms)"] = Line2D(
        [0], [0], color=ESTIMATE, marker=">", linewidth=1.5, markevery=[-1])
    drawn.legend(entries.values(), entries.keys(), loc="center left", bbox_to_anchor=(0.005, y),
                 ncol=len(entries), labelcolor=QUIET, fontsize=12, columnspacing=1.6)


def draw(data, path):
    moment = style.read_json(data)
    width, height = moment["sensor"]
    scale = -(-LEAST_WIDTH_PX // width)
    size_px = np.array([width * scale, height * scale + 2 * BAR_PX])
    drawn = style.plt.figure(figsize=size_px / 100, facecolor=BAR, layout="none")
    image = image_of(moment)
    axes = sensor_axes(drawn, np.array([0, BAR_PX]), np.array([width * scale, height * scale]),
                       ((-0.5, width - 0.5), (height - 0.5, -0.5)), image)
    for spine in axes.spines.values():
        spine.set_visible(False)
    draw_trail(axes, moment)
    draw_puck(axes, moment)
    if moment["estimate"]:
        draw_arrow(axes, moment["estimate"], scale)
        draw_close_up(drawn, moment, scale, image)
    write_facts(drawn, moment, 1 - BAR_PX / 2 / size_px[1])
    draw_legend(drawn, moment, BAR_PX / 2 / size_px[1])
    style.save(drawn, path)


style.run(draw, "MOMENT.json", "FILE.png")
