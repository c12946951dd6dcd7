"""What all charts have in common: colours, size, files, and the run of a script."""

import csv
import json
import shlex
import sys

try:
    import matplotlib
except ImportError:
    sys.exit(
        "charts need matplotlib: apt-get install python3-matplotlib, then run: "
        + shlex.join(sys.argv)
    )

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker

# Colours that colour-blind readers can tell apart (Okabe and Ito's, and a brown).
COLOURS = ["#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#0072b2", "#d55e00", "#6e503c"]
BLACK = "#1e1e1e"
GREY = "#969696"

plt.rcParams.update(
    {
        "axes.axisbelow": True,
        "axes.edgecolor": "#787878",
        "axes.grid": True,
        "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
        "axes.titlelocation": "left",
        "axes.titlesize": 12,
        "figure.constrained_layout.use": True,
        "figure.dpi": 100,
        "font.size": 10,
        "grid.color": "#e2e2e2",
        "legend.frameon": False,
        "lines.linewidth": 1.8,
    }
)


def figure(width_px=1000, height_px=480, charts=1, **options):
    """A figure of charts one below the other, and its axes."""
    return plt.subplots(charts, 1, figsize=(width_px / 100, height_px / 100), **options)


def label(axes, title, x, y):
    axes.set_title(title)
    axes.set_xlabel(x)
    axes.set_ylabel(y)


def legend(axes, **options):
    """Outside, to the right: it hides no data. `options` are those of Axes.legend."""
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1), **options)


def plain_ticks(axis):
    """Numbers on a logarithmic axis as 0.1, 1, 10 instead of powers."""
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(matplotlib.ticker.LogFormatter())


def save(drawn, path):
    drawn.savefig(path)
    plt.close(drawn)


def read_csv(path):
    """The columns of a CSV file by name: numbers, NaN for empty fields, or texts."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"{path}: has no rows")
    return {name: _numbers([row[name] for row in rows]) for name in rows[0]}


def _numbers(texts):
    try:
        return [float(text) if text else float("nan") for text in texts]
    except ValueError:
        return texts


def read_json(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def run(draw, *names):
    """Calls `draw` with the script's arguments; ends with one line on stderr when it fails."""
    if len(sys.argv) != 1 + len(names):
        sys.exit(f"usage: {sys.argv[0]} {' '.join(names)}")
    try:
        draw(*sys.argv[1:])
    except (OSError, ValueError) as error:
        sys.exit(f"{sys.argv[0]}: {error}")
    except KeyError as error:
        sys.exit(f"{sys.argv[0]}: the data has no {error}")
