"""A picture a scene, error against cost with the default marked, and the table of the defaults."""

from pathlib import Path
from textwrap import wrap

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from ..timing import machine
from .measure import DEFAULT, QUICK, REFERENCE
from .scenes import SCENES, Studied

WIDTH, HEIGHT, LETTERS = 4.6, 3.8, 56
"""Of a panel: inches, and letters of the title that fit."""

NEARER = "a longer run nearer to the limit"
FAR = 3.0
"""A bias is seen if it is so many standard errors."""


def draw(scene: Studied, rows: list[dict], folder: Path) -> Path:
    """Error (bias and one standard error, in quadrature) against CPU time, both relative axes."""
    mpl.use("agg")
    count, usual = len(scene.observables), {}
    figure = Figure((WIDTH * count, HEIGHT), layout="constrained")
    for axes, name in zip(np.ravel(figure.subplots(1, count)), scene.observables, strict=True):
        own = [r for r in rows if (r["scene"], r["observable"]) == (scene.name, name)]
        default = {r["value"] for r in own if r["knob"] == DEFAULT}
        for marker, knob in zip("osD^v", scene.knobs, strict=False):
            points = sorted(
                ((float(r["cost_cpu_seconds"]), relative(r), r["setting"], r["value"]) for r in own
                 if r["knob"] == knob), key=lambda point: point[0],
            )  # fmt: skip
            if not points:
                continue
            label = knob.replace("_", " ")
            (line,) = axes.plot(*zip(*[p[:2] for p in points], strict=True), marker, ms=5,
                                ls="-", lw=0.6, label=label)  # fmt: skip
            for cost, error, setting, value in points:
                if value in default:  # the same run again: below the star there is no room
                    usual[label] = setting
                    continue
                axes.annotate(setting, (cost, error), xytext=(3, 3), fontsize=6,
                              textcoords="offset points", color=line.get_color())  # fmt: skip
        for row in own:
            if row["knob"] == DEFAULT:
                axes.plot(float(row["cost_cpu_seconds"]), relative(row), "k*", ms=13,
                          label="default", zorder=5)  # fmt: skip
        axes.set(xscale="log", yscale="log", xlabel="CPU time (s)",
                 ylabel=f"relative error of {name.replace('_', ' ')}")  # fmt: skip
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.margins(0.15)
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2 * count, frameon=False)
    title = f"{scene.name}: error (bias and noise) against cost"
    told = "star: the default, " + ", ".join(f"{label} {one}" for label, one in usual.items())
    lines = [title, *(wrap(told, LETTERS * count) if usual else [])]
    figure.suptitle("\n".join(lines), fontsize=10)
    path = folder / f"work_precision_{scene.name}.png"
    figure.savefig(path, dpi=130)
    return path


def relative(row: dict) -> float:
    """The error of a row in units of the true value."""
    return float(row["error"]) / abs(float(row["value"]) - float(row["bias"]))


def defaults(rows: list[dict], *, quick: bool) -> str:
    """A page: what is off at the defaults, and where the truth comes from."""
    lines = [
        "# Error against cost",
        "",
        "Made by `python -m benchmarks.work_precision" + (" --quick" if quick else "") + "`; do "
        f"not edit. {machine()['processor']}, jax {machine()['jaxlib']}."
        + (f" Rows of {QUICK:g} of the usual length." if quick else ""),
        "",
        "Differences from the truth at the defaults, in percent of it. The error of a row is the "
        "difference and one standard error in quadrature; a difference below some standard errors "
        "is noise, and says only that the bias is not larger.",
        "",
        "| scene | observable | truth by | value | difference (%) | standard error (%) | seen |",
        "|---|---|---|---|---|---|---|",
    ]
    truth_by = {one.name: one.truth_by for one in SCENES}
    truth_by |= {r["scene"]: NEARER for r in rows if r["knob"] == REFERENCE}
    for row in rows:
        if row["knob"] != DEFAULT:
            continue
        value, bias, error = (float(row[name]) for name in ("value", "bias", "error"))
        spread = np.sqrt(max(error**2 - bias**2, 0.0))
        scale = 100 / abs(value - bias)
        seen = "yes" if abs(bias) > FAR * spread else "no"
        lines.append(
            f"| {row['scene']} | {row['observable'].replace('_', ' ')} | "
            f"{truth_by[row['scene']]} | {value:.5g} | "
            f"{scale * bias:+.2f} | {scale * spread:.2f} | {seen} |"
        )
    return "\n".join(lines) + "\n"
