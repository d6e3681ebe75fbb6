"""Figures 17 and 18: steady velocity distributions."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, band, figure, legend_of
from ..claims_distribution import bgk, equilibrium
from ..data import Measurements

PANELS = {
    "marginal_x": ("velocity", "C_x = V_x/v0(T)", "g_x⁽⁺⁾(C_x)"),
    "marginal_y": ("velocity", "C_y = V_y/v0(T)", "g_y⁽⁺⁾(C_y)"),
    "speed": ("speed_bin", "C = V/v0(T)", "F(C)"),
}

LARGEST_ERROR = 0.7
"""Bins with a larger relative error are not drawn."""


def linear(data: Measurements) -> Figure:
    """Fig. 17: thermal velocities, linear scale."""
    found, axes = _panels(data, 3.0)
    for ax in axes.ravel():
        ax.set_ylim(bottom=0)
    return found


def logarithmic(data: Measurements) -> Figure:
    """Fig. 18: tails, logarithmic scale, averaged over both shear rates."""
    found, axes = _panels(data, 7.0)
    for ax in axes.ravel():
        ax.set(yscale="log", ylim=(1e-7, 2))
    return found


def _panels(data: Measurements, reach: float):
    found, axes = figure(3, 2, 10, 10.5)
    for column, alpha in enumerate((0.9, 0.5)):
        for row, (name, (axis, xlabel, ylabel)) in enumerate(PANELS.items()):
            ax = axes[row, column]
            first = 0.0 if name == "speed" else -reach
            for gas, colour, style in zip(("ihs", "ehs"), COLOURS, ("-", "--"), strict=False):
                curve = data.mean_distribution(gas, alpha)
                c = curve[axis].values
                values, errors = (curve[name + end].values for end in ("", "_error"))
                seen = (c > first) & (c < reach) & (errors < LARGEST_ERROR * values)
                values = np.where(seen, values, np.nan)  # a gap, where few particles were seen
                band(ax, c, values, errors, color=colour, linestyle=style)
            c = np.linspace(first + 1e-3, reach, 241)
            ax.plot(c, bgk(name, alpha, c), color="black", linestyle="-.", linewidth=1)
            ax.plot(c, equilibrium(name, c), color="0.5", linestyle=":", linewidth=1.3)
            ax.set(xlabel=xlabel, ylabel=ylabel, xlim=(first, reach), title=f"α = {alpha}")
    entries = {
        "IHS (band: 1 s.e.)": {"color": COLOURS[0]},
        "EHS (band: 1 s.e.)": {"color": COLOURS[1], "linestyle": "--"},
        "BGK": {"color": "black", "linestyle": "-."},
        "local equilibrium": {"color": "0.5", "linestyle": ":"},
    }
    axes[2, 0].legend(handles=legend_of(entries), fontsize=8)
    return found, axes
