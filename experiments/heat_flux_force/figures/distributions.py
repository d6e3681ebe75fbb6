"""Figures 5 to 7: the first-order marginal distribution."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, band, figure, legend_of
from ..data import Measurements
from ..distribution import HEAT_FLUX_LIMIT, odd_part, phi, share, truncated
from ..systems import PAPER_FIELD

LARGEST = 10.0
"""c_x² up to which φ is drawn; thermal velocities, as the paper says."""

SERIES = ((":", COLOURS[1]), ("-.", COLOURS[2]), ("--", COLOURS[3]))


def weak(data: Measurements) -> Figure:
    """Fig. 5: φ(c_x²) and the truncated series φ_1, φ_2, φ_3 for α = 1 and 0.9."""
    return _distributions(data, (1.0, 0.9))


def strong(data: Measurements) -> Figure:
    """Fig. 6: the same for α = 0.7, 0.5, 0.3."""
    return _distributions(data, (0.7, 0.5, 0.3))


def _distributions(data: Measurements, restitutions) -> Figure:
    found, axes = figure(len(restitutions), 1, 6.4, 3.4 * len(restitutions), sharex=True)
    pool, squared = data.steady(PAPER_FIELD), np.linspace(0, LARGEST, 200)
    for ax, alpha in zip(axes[:, 0], restitutions, strict=True):
        odd = odd_part(pool, alpha, PAPER_FIELD)
        shown = odd.centres**2 < LARGEST
        value, error = (x[shown] for x in phi(odd))
        band(ax, odd.centres[shown] ** 2, value, error, color=COLOURS[0])
        b = [pool.value("sonine", alpha, k).value for k in (1, 2, 3)]
        for p, (line, colour) in enumerate(SERIES, start=1):
            ax.plot(squared, truncated(b[:p], squared), linestyle=line, color=colour, lw=1.3)
        ax.axhline(0, color="0.8", lw=0.8, zorder=0)
        low = min(np.min(value - error), np.min(truncated(b[:1], squared)))
        ax.set(ylabel="φ(c_x²)", ylim=(1.15 * low, 6.0))
        ax.set_title(f"α = {alpha:g}, ε* = {PAPER_FIELD:g}", fontsize=10)
    entries = {"φ (band: 1 s.e.)": {"color": COLOURS[0]}}
    for p, (line, colour) in enumerate(SERIES, start=1):
        entries[f"φ_{p}"] = {"color": colour, "linestyle": line}
    axes[0, 0].legend(handles=legend_of(entries), fontsize=8)
    axes[-1, 0].set_xlabel("c_x²")
    return found


def shares(data: Measurements) -> Figure:
    """Fig. 7: β1(c_x²)/b'_1 for five restitutions; dotted line: c_x² = 6."""
    found, axes = figure(1, 1, 6.4, 4.6)
    ax, pool = axes[0, 0], data.steady(PAPER_FIELD)
    colours = (*COLOURS, "#7f6000")
    for alpha, colour in zip((1.0, 0.9, 0.7, 0.5, 0.3), colours, strict=True):
        odd = odd_part(pool, alpha, PAPER_FIELD)
        squared = odd.edges[1:] ** 2
        shown = squared < 20
        value, error = share(odd)
        band(ax, squared[shown], value[shown], error[shown], color=colour)
        ax.plot([], [], color=colour, label=f"α = {alpha:g}")
    ax.axvline(HEAT_FLUX_LIMIT, color="black", linestyle=":", linewidth=1)
    ax.axhline(1.0, color="0.8", lw=0.8, zorder=0)
    ax.set(xlabel="c_x²", ylabel="β1(c_x²)/b'_1", xlim=(0, 20))
    ax.set_title(f"ε* = {PAPER_FIELD:g}; bands: 1 s.e.", fontsize=10)
    ax.legend(fontsize=8)
    return found
