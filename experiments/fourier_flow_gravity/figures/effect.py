"""Figure 7, and all rows of tables 2 to 5 as distances from the paper."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, figure
from .. import effect
from ..data import Measurements
from ..reference import COLUMNS, table
from ..systems import COMBINATIONS

MARKERS = dict(zip(COMBINATIONS, ("s", "D", "o", "^"), strict=True))
TITLES = effect.SYMBOLS | {"mean_free_paths": "$\\mathcal{N}(z_0)$"}
SHADES = dict(zip(COMBINATIONS, COLOURS, strict=True))


def gravity_effect(data: Measurements) -> Figure:
    """Fig. 7: Δκ* against g*, ours with fits, the paper's numbers in grey."""
    found, axes = figure(2, 2, 10.0, 7.6, sharex=True, sharey=True)
    for ax, combination in zip(axes.ravel(), COMBINATIONS, strict=True):
        ours, paper = data.effects[combination], table(combination)
        ax.errorbar(
            paper["reduced_gravity"],
            paper["kappa_star_change"],
            effect.scatter(combination, "kappa_star_change"),
            fmt=MARKERS[combination],
            ms=5,
            color="0.6",
            mfc="none",
            capsize=2,
            label="paper (its scatter)",
        )
        strength = ours["reduced_gravity"].values
        ax.errorbar(
            strength,
            ours["kappa_star_change"].values,
            ours["kappa_star_change_error"].values,
            ours["reduced_gravity_error"].values,
            fmt=MARKERS[combination],
            ms=5,
            color=SHADES[combination],
            capsize=2,
            label="jdsmc (1 s.e.)",
        )
        fit = data.responses[combination]
        gradient = fit["reduced_gradient"].value
        line = np.linspace(-0.11, 0.1, 100)
        slope = fit["B"].value * gradient
        start = fit["kappa_star"].value - float(ours["kappa_star"].sel(gravity=0.0))
        ax.plot(
            line,
            start + slope * line + fit["C"].value * line**2,
            color=SHADES[combination],
            lw=1,
            label=f"fit, B = {fit['B']}",
        )
        ax.axhline(0, color="0.8", lw=0.8, zorder=0)
        ax.axvline(0, color="0.8", lw=0.8, zorder=0)
        ax.set_title(f"{combination.label}, ε0 = {gradient:.2f}", fontsize=10)
        ax.legend(fontsize=8, loc="upper left")
        ax.set(xlim=(-0.115, 0.105), ylim=(-0.1, 0.16), xticks=(-0.1, -0.05, 0, 0.05, 0.1))
    for ax in axes[1]:
        ax.set_xlabel("g*")
    for ax in axes[:, 0]:
        ax.set_ylabel("Δκ*")
    return found


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
