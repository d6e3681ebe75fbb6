"""What all figures share: colours, line styles, bands, points and saving."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from jdsmc import Estimate

DPI = 110

COLOURS = ("#1b4f9c", "#c0392b", "#2e8b57", "#8e44ad", "#d08a00")

OPEN = {"linestyle": "none", "capsize": 2, "markersize": 6, "markerfacecolor": "none"}
"""Open symbols with error bars."""


def figure(rows: int, columns: int, width: float, height: float, **options):
    """A figure and its axes as a two-dimensional array."""
    found, axes = plt.subplots(
        rows, columns, figsize=(width, height), squeeze=False, layout="constrained", **options
    )
    return found, axes


def band(ax, x, found: Estimate, color, linestyle="-", label=None) -> None:
    """A line with a band of one standard error on either side."""
    x, y, error = (np.asarray(part, float) for part in (x, *found))
    ax.plot(x, y, color=color, linestyle=linestyle, linewidth=1.2, label=label)
    ax.fill_between(x, y - error, y + error, color=color, alpha=0.25, linewidth=0)


def points(ax, x, found: Estimate, **look) -> None:
    """Open symbols with error bars."""
    ax.errorbar(x, *found, **{"fmt": "o"} | OPEN | look)


def legend_of(entries: dict[str, dict]) -> list[Line2D]:
    """Handles for a legend: label -> properties of a line."""
    return [Line2D([], [], label=label, **properties) for label, properties in entries.items()]


def save(found: Figure, path: Path) -> Path:
    """Write a PNG and close the figure."""
    found.savefig(path, dpi=DPI)
    plt.close(found)
    return path
