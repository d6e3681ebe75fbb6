"""Figure 7, and all rows of tables 2 to 5 as distances from the paper."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, figure
from .. import effect
from ..data import Measurements, plain
from ..reference import COLUMNS, table
from ..systems import COMBINATIONS

MARKERS = dict(zip(COMBINATIONS, ("s", "D", "o", "^"), strict=True))
FINE = np.linspace(-0.11, 0.1, 100)

TITLES = effect.SYMBOLS | {"mean_free_paths": "$\\mathcal{N}(z_0)$"}
SHADES = dict(zip(COMBINATIONS, COLOURS, strict=True))


def gravity_effect(data: Measurements) -> Figure:
    """Fig. 7: the change of κ* with g*, ours and the paper's numbers with parabolas.

    Drawn from the value of the parabola at g* = 0: Δκ* as in the tables has the error of the one
    state g = 0 in all points.
    """
    found, axes = figure(2, 2, 10.0, 7.6, sharex=True, sharey=True)
    for ax, combination in zip(axes.ravel(), COMBINATIONS, strict=True):
        ours, paper = data.effects[combination], table(combination)
        fit, other = data.responses[combination], effect.paper_response(combination)
        _points(
            ax,
            (paper["reduced_gravity"], paper["kappa_star"] - plain(other["kappa_star"])[0]),
            effect.scatter(combination, "kappa_star"),
            {
                "fmt": MARKERS[combination],
                "color": "0.6",
                "mfc": "none",
                "label": "paper (scatter)",
            },
        )
        value = ours["kappa_star"].values - plain(fit["kappa_star"])[0]
        _points(
            ax,
            (ours["reduced_gravity"].values, value),
            ours["kappa_star_error"].values,
            {"fmt": MARKERS[combination], "color": SHADES[combination], "label": "jdsmc (1 s.e.)"},
        )
        gradient = plain(fit["reduced_gradient"])[0]
        for one, colour, whose in ((fit, SHADES[combination], ""), (other, "0.6", "paper's ")):
            (slope, _), (bend, _) = plain(one["B"]), plain(one["C"])
            line = slope * gradient * FINE + bend * FINE**2
            ax.plot(FINE, line, color=colour, lw=1, label=f"{whose}B = {one['B']}")
        ax.axhline(0, color="0.8", lw=0.8, zorder=0)
        ax.axvline(0, color="0.8", lw=0.8, zorder=0)
        ax.set_title(f"{combination.label}, ε0 = {gradient:.2f}", fontsize=10)
        ax.legend(fontsize=8, loc="upper left")
        ax.set(xlim=(-0.115, 0.105), ylim=(-0.1, 0.16), xticks=(-0.1, -0.05, 0, 0.05, 0.1))
    for ax in axes[1]:
        ax.set_xlabel("g*")
    for ax in axes[:, 0]:
        ax.set_ylabel("κ* - κ*(g = 0) of the parabola")
    return found


def _points(ax, points: tuple, error, style: dict) -> None:
    ax.errorbar(*points, error, ms=5, capsize=2, **style)


def rows(data: Measurements) -> Figure:
    """Ours minus the paper's in combined errors, every number of tables 2 to 5."""
    found, axes = figure(1, len(COLUMNS), 13.0, 4.2, sharey=True)
    for ax, name in zip(axes[0], COLUMNS, strict=True):
        for combination in COMBINATIONS:
            cells = [
                (row.gravity, row.cells[name].distance) for row in effect.rows(data, combination)
            ]
            points = np.array([c for c in cells if c[1] is not None], float)
            style = {"color": SHADES[combination], "marker": MARKERS[combination], "ms": 5}
            ax.plot(*points.T, linestyle="none", mfc="none", label=combination.label, **style)
        ax.axhspan(-effect.AGREEMENT, effect.AGREEMENT, color="0.93", zorder=0)
        ax.set(xlabel="g", title=TITLES[name])
    axes[0, 0].set_ylabel("(ours - paper) / combined error")
    axes[0, 0].legend(fontsize=7)
    return found
