"""Figures 2 to 6: profiles between the walls, with bands of one standard error."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, band, figure, legend_of
from ..data import Measurements
from ..systems import EXAMPLE, EXAMPLE_GRAVITY, FIGURE_6, Combination

GRAVITY_COLOURS = dict(zip(EXAMPLE_GRAVITY, (*COLOURS, "#d08a00"), strict=True))
COLDEST = {Combination(0.01, "maxwell"): "--", Combination(0.01, "bgk"): "-"}


def temperature(data: Measurements) -> Figure:
    """Fig. 2: T^(3/2)."""
    return _profiles(data, "temperature", "$T^{3/2}$", power=1.5, top=1.0)


def heat_flux(data: Measurements) -> Figure:
    """Fig. 3: q_z, with its mean and the two wall fluxes as marks at the ends."""
    found = _profiles(data, "heat_flux", "$q_z$", loc="center left", bbox_to_anchor=(1.0, 0.5))
    ax = found.axes[0]
    for gravity, colour in GRAVITY_COLOURS.items():
        state = data.state(EXAMPLE, gravity)
        for side, x in (("cold", 0.0), ("hot", 1.0)):
            name = f"heat_flux_{side}_wall"
            value, error = float(state[name]), float(state[f"{name}_error"])
            ax.errorbar(x, value, error, fmt="o", ms=4, capsize=2, color=colour, clip_on=False)
        ax.axhline(float(state["mean_heat_flux"]), color=colour, lw=0.8, ls=":", zorder=0)
    ax.set_title("circles: energy exchanged at the walls; dotted: mean", fontsize=9)
    return found


def pressures(data: Measurements) -> Figure:
    """Fig. 4: p and P_zz."""
    found = _profiles(data, "pressure", "$p$ (full), $P_{zz}$ (dashed)")
    for gravity, colour in GRAVITY_COLOURS.items():
        _draw(found.axes[0], data, EXAMPLE, gravity, "pressure_zz", colour, "--")
    return found


def density(data: Measurements) -> Figure:
    """Fig. 5: n, logarithmic."""
    found = _profiles(data, "density", "$n$")
    found.axes[0].set_yscale("log")
    ticks = (0.3, 0.5, 1, 2, 4, 8)
    found.axes[0].set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    found.axes[0].minorticks_off()
    return found


def kinds_of_wall(data: Measurements) -> Figure:
    """Fig. 6: T^(3/2) with walls of type I and II, T_- = 0.01."""
    found, axes = figure(1, 2, 10.0, 4.4, sharey=True)
    for ax, gravity, part in zip(axes[0], FIGURE_6, "ab", strict=True):
        for (combination, style), colour in zip(COLDEST.items(), COLOURS, strict=False):
            _draw(ax, data, combination, gravity, "temperature", colour, style, 1.5)
        ax.set(xlabel="z/L", xlim=(0, 1), ylim=(0, 1), title=f"({part}) g = {gravity:g}")
    lines = {
        f"type {name}": {"color": colour, "linestyle": style}
        for name, style, colour in zip(("I", "II"), COLDEST.values(), COLOURS, strict=False)
    }
    axes[0, 0].legend(handles=legend_of(lines), fontsize=9, title="$T_-$ = 0.01")
    axes[0, 0].set_ylabel("$T^{3/2}$")
    return found


def _profiles(
    data: Measurements,
    name: str,
    label: str,
    power: float = 1.0,
    top: float | None = None,
    **place,
) -> Figure:
    """A profile at every g of Figs. 2 to 5; `place`: of the legend."""
    found, axes = figure(1, 1, 6.4, 4.8)
    ax = axes[0, 0]
    for gravity, colour in GRAVITY_COLOURS.items():
        _draw(ax, data, EXAMPLE, gravity, name, colour, power=power)
    entries = {f"g = {g:g}": {"color": colour} for g, colour in GRAVITY_COLOURS.items()}
    title = f"{EXAMPLE.label}\nbands: 1 s.e."
    ax.legend(handles=legend_of(entries), fontsize=8, title=title, title_fontsize=8, **place)
    ax.set(xlabel="z/L (cold wall at 0, hot wall at 1)", ylabel=label, xlim=(0, 1))
    if top:
        ax.set_ylim(0, top)
    return found


def _draw(
    ax,
    data: Measurements,
    combination: Combination,
    gravity: float,
    name: str,
    colour: str,
    style: str = "-",
    power: float = 1.0,
) -> None:
    state = data.state(combination, gravity)
    z = state["z"].values
    value, error = state[name].values, state[f"{name}_error"].values
    error = np.abs(power * value ** (power - 1.0)) * error
    band(ax, z / (z[-1] + z[0]), value**power, error, color=colour, linestyle=style)
