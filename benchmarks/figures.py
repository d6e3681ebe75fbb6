"""Pictures from the measured numbers: work against precision, and scaling."""

from pathlib import Path

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt

SIGNIFICANT = 2.0  # a bias below so many standard errors is drawn as none


def draw(data: dict, folder: Path, name: str) -> list[Path]:
    """Draw what was measured; returns the files."""
    drawings = {"precision": _precision, "scaling": _scaling}
    files = []
    for part, picture in drawings.items():
        if part in data:
            files.append(folder / f"{name}_{part}.png")
            figure = picture(data[part])
            figure.savefig(files[-1], dpi=130)
            plt.close(figure)
    return files


def _precision(part: dict):
    """Total error against wall time, each method on one core.

    The lines are sqrt(bias² + cost / (t - warm-up)); the dots are where the statistical error is
    the target. Numbers that are known to be biased flatten.
    """
    figure, axes = plt.subplots(figsize=(8.5, 5.2), layout="constrained")
    for number, method in enumerate(sorted(part["methods"], key=_order)):
        warm_up, cost, end = (method[n] for n in ("warm_up_seconds", "cost", "seconds_to_target"))
        measuring = np.geomspace(1e-2, 1e2, 200) * (end - warm_up)
        significant = abs(method["bias"]) > SIGNIFICANT * method["bias_error"]
        bias = abs(method["bias"]) if significant else 0.0
        style = {"jdsmc": "-", "peer": "--"}[method["code"]]
        label = f"{method['code']} {method['splitting']}, dt = {method['time_step']:g} τ"
        error = 100 * np.hypot(bias, np.sqrt(cost / measuring))
        (line,) = axes.loglog(
            warm_up + measuring, error, style, label=label, color=plt.cm.tab20(number)
        )
        at_target = 100 * np.hypot(bias, part["target"])
        axes.plot(end, at_target, "o", color=line.get_color())
    axes.axhline(100 * part["target"], color="grey", linewidth=0.8)
    axes.set(
        xlabel="wall time on one core (s), without compiling",
        ylabel="error of -P_xy/nT (%): bias and statistical, in quadrature",
        title="Sheared gas, α = 0.7, a τ0 = 4, 8 realizations (biases below 2 σ drawn as none)",
    )
    axes.title.set_fontsize(10)
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    axes.grid(alpha=0.3, which="both")
    return figure


def _order(method: dict) -> tuple:
    return method["code"], method["splitting"], method["time_step"]


def _scaling(part: dict):
    """Time of a chunk against the number of particles, and against the points of a sweep."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
    labels = {"particles": "N grows, 4 realizations", "realizations": "realizations of N = 1000"}
    for name, label in labels.items():
        rows = part[name]
        particles = np.array([row["particles"] for row in rows])
        median, least, largest = (
            np.array([row["seconds_per_chunk"][n] for row in rows])
            for n in ("median", "least", "largest")
        )
        left.errorbar(particles, median, [median - least, largest - median], fmt="o-", label=label)
        left.plot(particles, median[-1] * particles / particles[-1], ":", color="grey")
    left.set(
        xscale="log",
        yscale="log",
        xlabel="particles of all gases",
        ylabel="s per chunk of 64 steps, all cores",
        title="dotted: proportional",
    )
    left.legend(fontsize=8)
    rows = part["sweep"][:-1]
    points = [row["points"] for row in rows]
    right.plot(points, [row["compile_seconds"] for row in rows], "o-", label="compiling (s)")
    times = [100 * row["seconds_per_chunk"]["median"] for row in rows]
    right.plot(points, times, "s-", label="100 chunks (s)")
    right.set(xlabel="points of a sweep of α", ylabel="s", title="4 realizations of N = 1000 each")
    right.set_ylim(bottom=0)
    right.legend(fontsize=8)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    return figure
