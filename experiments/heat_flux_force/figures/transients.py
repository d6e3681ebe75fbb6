"""Figures 1 and 2: the approach to the steady state."""

from matplotlib.figure import Figure

from ...style import COLOURS, band, figure, legend_of
from ..data import Measurements
from ..limits import CONDUCTIVITY, MARGINAL, SONINE
from ..systems import PAPER_FIELD

STEADY = {"color": "black", "linestyle": ":", "linewidth": 1.0}


def conductivity(data: Measurements) -> Figure:
    """Fig. 1: κ'(t)/κ0 at α = 0.3 for two fields; dotted: the steady value at the weaker one."""
    found, axes = figure(1, 1, 6.4, 4.2)
    ax = axes[0, 0]
    for strength, line, colour in ((0.05, "--", COLOURS[1]), (PAPER_FIELD, "-", COLOURS[0])):
        time, values = data.transient(0.3, strength).series(0.3, CONDUCTIVITY.name)
        band(ax, time, *values, color=colour, linestyle=line)
    ax.axhline(data.steady(PAPER_FIELD).value(CONDUCTIVITY.name, 0.3).value, **STEADY)
    handles = legend_of(
        {
            "ε* = 0.05": {"color": COLOURS[1], "linestyle": "--"},
            f"ε* = {PAPER_FIELD:g}": {"color": COLOURS[0], "linestyle": "-"},
            f"steady, ε* = {PAPER_FIELD:g}": STEADY,
        }
    )
    ax.legend(handles=handles, fontsize=8, title="bands: 1 s.e.", title_fontsize=8)
    ax.set(xlabel="t/τ", ylabel="κ'(t)/κ0", title="α = 0.3", ylim=(0, None))
    return found


def sonine(data: Measurements) -> Figure:
    """Fig. 2: b'_k(t) from (3.10) solid and from (3.12) dashed, at ε* = 0.025; dotted: steady."""
    found, axes = figure(2, 1, 6.4, 7.5, sharex=True)
    for ax, alpha in zip(axes[:, 0], (1.0, 0.3), strict=True):
        pool, steady = data.transient(alpha, PAPER_FIELD), data.steady(PAPER_FIELD)
        for colour, *both in zip(COLOURS, SONINE, MARGINAL, strict=False):
            for quantity, line in zip(both, ("-", "--"), strict=True):
                time, values = pool.series(alpha, quantity.name, quantity.order)
                band(ax, time, *values, color=colour, linestyle=line)
            ax.axhline(steady.value("sonine", alpha, both[0].order).value, **STEADY)
        ax.set(ylabel="b'_k(t)", title=f"α = {alpha:g}, ε* = {PAPER_FIELD:g}")
    entries = {q.label: {"color": c} for q, c in zip(SONINE, COLOURS, strict=False)}
    entries |= {"(3.10)": {"color": "0.3"}, "(3.12)": {"color": "0.3", "linestyle": "--"}}
    handles = legend_of(entries | {"steady": STEADY})
    axes[1, 0].set_xlabel("t/τ")
    axes[0, 0].legend(handles=handles, fontsize=8, ncols=2, title="bands: 1 s.e.", title_fontsize=8)
    return found
