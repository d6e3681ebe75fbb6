"""Figures 1 to 4 and 9: the inhomogeneous problem."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, band, figure, legend_of, save
from ..claims_slab import SHIFT
from ..data import Measurements
from ..slab import BETA, CENTRE, HEIGHT, LENGTH, RESTITUTION, STARTS, TOP, Slabs, Start, reduced
from ..slab_measured import TIMES, ratio_curve
from ..systems import FAST
from .style import LINES, gas_legend

TIME_COLOURS = (*COLOURS, "#d98e04")
PROFILES = {"velocity_x": "u_x / aL", "density": "n / n̄", "temperature": "T / T̄"}
CLOCK = "s (IHS), s'/β (EHS): collisions per particle"


def collisions(slabs: Slabs) -> Figure:
    """Fig. 1: s(t) and s'(t), and their ratio."""
    found, axes = figure(1, 1, 6.8, 4.6)
    ax = axes[0, 0]
    for gas in BETA:
        series = slabs.series("late", gas)
        early = series.isel(sample=(series["time"].values <= 12.0).nonzero()[0])
        band(
            ax,
            early["time"],
            early["collisions"],
            early["collisions_error"],
            color=COLOURS[0],
            linestyle=LINES[gas],
        )
    other = ax.twinx()
    time, ratio, error = ratio_curve(slabs)
    shown = time <= 12.0
    band(other, time[shown], ratio[shown], error[shown], color=COLOURS[1])
    other.axhline(BETA["ehs"], color="0.6", linewidth=0.8)
    other.set(ylim=(0.85, 1.05))
    other.set_ylabel("s'(t)/s(t)", color=COLOURS[1])
    ax.set(xlabel="time t / τ0", xlim=(0, 12), ylim=(0, None))
    ax.set_ylabel("s(t), s'(t)", color=COLOURS[0])
    ax.set_title(f"α = {RESTITUTION}, a τ0 = {FAST:g}, L = {LENGTH} λ0, from (3.5)", fontsize=10)
    ax.legend(handles=gas_legend(bgk=False), fontsize=8, loc="lower right")
    return found


def profiles(slabs: Slabs) -> Figure:
    """Fig. 2: profiles at five times, from both initial states."""
    found, axes = figure(3, 2, 9.6, 9.6, sharex=True, sharey="row")
    for column, (start, equation) in enumerate(STARTS.items()):
        for row, (name, label) in enumerate(PROFILES.items()):
            ax = axes[row, column]
            for colour, time in zip(TIME_COLOURS, TIMES, strict=True):
                for gas in BETA:
                    value, error = slabs.profile(gas, start, time, name)
                    band(ax, HEIGHT, value, error, color=colour, linestyle=LINES[gas])
            axes[row, 0].set_ylabel(label)
        shift = SHIFT if start == "nonequilibrium" else 0.0
        axes[0, column].plot(HEIGHT, HEIGHT + shift, "k:", linewidth=1)
        axes[0, column].set_title(f"from {equation}", fontsize=10)
        axes[2, column].set_xlabel("y / L")
    times = {f"t = {t:g} τ0": {"color": c} for c, t in zip(TIME_COLOURS, TIMES, strict=True)}
    straight = {"uniform shear with the same momentum": {"color": "black", "linestyle": ":"}}
    axes[0, 0].legend(handles=legend_of(times | straight), fontsize=8)
    axes[1, 0].legend(handles=gas_legend(bgk=False), fontsize=8)
    return found


def approach(slabs: Slabs) -> Figure:
    """Fig. 3: flow, density and temperature in the middle and at the top."""
    found, axes = figure(3, 1, 6.8, 8.6, sharex=True)
    for ax, (name, label) in zip(axes[:, 0], PROFILES.items(), strict=True):
        for colour, layers in zip(COLOURS, (CENTRE, TOP), strict=False):
            for gas in BETA:
                series = slabs.series("early", gas)
                curve = reduced(series, name).over(layers)
                clock = series["clock"].values
                band(ax, clock, curve.value, curve.error, color=colour, linestyle=LINES[gas])
            level = np.mean(HEIGHT[layers]) if name == "velocity_x" else 1.0
            ax.axhline(level, color="0.7", linewidth=0.8)
        ax.set_ylabel(label)
    places = {
        "four central layers": {"color": COLOURS[0]},
        "three top layers": {"color": COLOURS[1]},
    }
    axes[1, 0].legend(handles=legend_of(places) + gas_legend(bgk=False), fontsize=8)
    axes[2, 0].set(xlabel=CLOCK, xlim=(0, 5))
    return found


STRESSES = {"shear_stress": "-P_xy/nT", "normal_stress_xy": "(P_xx - P_yy)/nT"}


def transient(slabs: Slabs) -> Figure:
    """Fig. 4: temperature and stresses of the whole slab, IHS and EHS."""
    curves = [(slabs.series("late", gas), "mean_temperature", LINES[gas]) for gas in BETA]
    found = _averages(curves)
    found.axes[1].legend(
        handles=_stress_legend() + gas_legend(bgk=False), fontsize=8, loc="upper right"
    )
    return found


def starts(slabs: Slabs, homogeneous: Measurements) -> Figure:
    """Fig. 9: IHS from the three initial states."""
    lines: dict[Start, str] = {"equilibrium": "--", "nonequilibrium": "-."}
    curves = [(slabs.series("late", "ihs", s), "mean_temperature", lines[s]) for s in STARTS]
    curves.append((homogeneous.series("ihs", RESTITUTION, FAST), "temperature", "-"))
    found = _averages(curves)
    entries = {
        f"slab from {STARTS[start]}": {"color": "0.3", "linestyle": line}
        for start, line in lines.items()
    } | {"homogeneous (3.12)": {"color": "0.3"}}
    found.axes[1].legend(
        handles=_stress_legend() + legend_of(entries), fontsize=8, loc="upper right"
    )
    return found


def _stress_legend():
    pairs = zip(STRESSES.values(), COLOURS[1:], strict=False)
    return legend_of({label: {"color": colour} for label, colour in pairs})


def _averages(curves) -> Figure:
    """T/T0 above the stresses; `curves`: series, name of its temperature, line style."""
    found, axes = figure(2, 1, 6.8, 7.0, sharex=True)
    top, bottom = axes[:, 0]
    for series, temperature, line in curves:
        clock = series["clock"].values
        pairs = [(top, temperature, COLOURS[0])]
        pairs += [(bottom, name, c) for name, c in zip(STRESSES, COLOURS[1:], strict=False)]
        for ax, name, colour in pairs:
            value, error = series[name].values, series[f"{name}_error"].values
            band(ax, clock, value, error, color=colour, linestyle=line)
    top.set(ylabel="T / T0", title=f"α = {RESTITUTION}, a τ0 = {FAST:g}, L = {LENGTH} λ0")
    bottom.set(xlabel=CLOCK, ylabel="reduced stress", xlim=(0, 60), ylim=(0, None))
    return found


DRAW = {
    "fig01_slab_collisions": lambda slabs, _: collisions(slabs),
    "fig02_slab_profiles": lambda slabs, _: profiles(slabs),
    "fig03_slab_approach": lambda slabs, _: approach(slabs),
    "fig04_slab_transient": lambda slabs, _: transient(slabs),
    "fig09_initial_states": starts,
}


def draw_slabs(slabs: Slabs, homogeneous: Measurements, folder: Path) -> list[Path]:
    """Every figure as FOLDER/<name>.png."""
    return [save(draw(slabs, homogeneous), folder / f"{name}.png") for name, draw in DRAW.items()]
