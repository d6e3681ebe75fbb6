"""Lines of the figures: solid, dashed and dotted as in the paper; symbols of the steady states."""

from ...style import COLOURS, legend_of
from ..cases import FAST, SLOW

LINES = {"ihs": "-", "ehs": "--"}
"""Solid for IHS and dashed for EHS, as in the paper; dotted for BGK."""

SHADES = dict(zip(LINES, COLOURS, strict=False))
"""Where gases are told by colour, too."""

BGK = {"color": "black", "linestyle": ":", "linewidth": 1.3}
CLOCK = "s (IHS), s'/β (EHS): collisions per particle"
RATES = {f"a τ0 = {r:g}": {"color": c} for r, c in zip((FAST, SLOW), COLOURS, strict=False)}
STRESSES = {"shear_stress": "-P_xy/nT", "normal_stress_xy": "(P_xx - P_yy)/nT"}


def legend(ax, entries: dict[str, dict], bgk: bool = False, coloured: bool = False, **more) -> None:
    """A legend of some lines, of both gases, and of BGK."""
    gases = {
        f"{gas.upper()} (band: 1 s.e.)": {
            "color": SHADES[gas] if coloured else "0.3",
            "linestyle": line,
        }
        for gas, line in LINES.items()
    }
    handles = legend_of(entries | gases | ({"BGK": BGK} if bgk else {}))
    ax.legend(handles=handles, **{"fontsize": 8} | more)
