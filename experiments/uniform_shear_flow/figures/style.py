"""Lines of the figures: solid, dashed and dotted as in the paper."""

from matplotlib.lines import Line2D

from ...style import legend_of

LINES = {"ihs": "-", "ehs": "--"}
"""Solid for IHS and dashed for EHS, as in the paper; dotted for BGK."""

BGK = {"color": "black", "linestyle": ":", "linewidth": 1.3}


def gas_legend(*, bgk: bool, band_note: bool = True) -> list[Line2D]:
    """Handles that tell the line styles."""
    note = " (band: 1 s.e.)" if band_note else ""
    entries = {
        f"IHS{note}": {"color": "0.3", "linestyle": "-"},
        f"EHS{note}": {"color": "0.3", "linestyle": "--"},
    }
    return legend_of(entries | ({"BGK": BGK} if bgk else {}))
