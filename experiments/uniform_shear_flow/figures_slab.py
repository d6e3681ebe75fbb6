"""Figures 1 to 4 and 9: the inhomogeneous problem."""

import numpy as np

from ..case import estimate
from ..style import COLOURS, band, legend_of
from .cases import BOTH, FAST, LENGTH, SLAB_RESTITUTION, STARTS
from .claims_slab import PROFILES, SHIFT, flat
from .data import CENTRE, HEIGHT, PAPER, TOP, Shear, beta, profile
from .figures import CLOCK, LINES, STRESSES, legend
from .slab import TIMES, ratio_curve

SLAB = f"α = {SLAB_RESTITUTION}, a τ0 = {FAST:g}, L = {LENGTH} λ0"


@PAPER.figure("fig01_slab_collisions", 1, 1, 6.8, 4.6)
def collisions(data: Shear, axes) -> None:
    """Fig. 1: s(t) and s'(t), and their ratio."""
    ax = axes[0, 0]
    for gas in BOTH:
        series = data.slab("late", gas)
        early = series.isel(sample=series["time"].values <= 12.0)
        band(ax, early["time"], estimate(early, "collisions"), COLOURS[0], LINES[gas])
    other = ax.twinx()
    time, ratio = ratio_curve(data)
    shown = time <= 12.0
    band(other, time[shown], ratio[shown], COLOURS[1])
    other.axhline(beta("ehs"), color="0.6", linewidth=0.8)
    other.set(ylim=(0.85, 1.05))
    other.set_ylabel("s'(t)/s(t)", color=COLOURS[1])
    ax.set(xlabel="time t / τ0", xlim=(0, 12), ylim=(0, None))
    ax.set_ylabel("s(t), s'(t)", color=COLOURS[0])
    ax.set_title(f"{SLAB}, from (3.5)", fontsize=10)
    legend(ax, {}, loc="lower right")


@PAPER.figure("fig02_slab_profiles", 3, 2, 9.6, 9.6, sharex=True, sharey="row")
def profiles(data: Shear, axes) -> None:
    """Fig. 2: profiles at five times, from both initial states."""
    for column, (start, equation) in enumerate(STARTS.items()):
        for ax, name in zip(axes[:, column], PROFILES, strict=True):
            for gas in BOTH:
                curve = profile(data.slab("early", gas, start), name)
                for colour, time in zip(COLOURS, TIMES, strict=True):
                    band(ax, HEIGHT, curve.at(time), colour, LINES[gas])
        shift = SHIFT if start == "nonequilibrium" else 0.0
        axes[0, column].plot(HEIGHT, HEIGHT + shift, "k:", linewidth=1)
        axes[0, column].set_title(f"from {equation}", fontsize=10)
        axes[2, column].set_xlabel("y / L")
    for ax, label in zip(axes[:, 0], PROFILES.values(), strict=True):
        ax.set_ylabel(label)
    times = {f"t = {t:g} τ0": {"color": c} for c, t in zip(COLOURS, TIMES, strict=True)}
    times["uniform shear with the same momentum"] = {"color": "black", "linestyle": ":"}
    axes[0, 0].legend(handles=legend_of(times), fontsize=8)
    legend(axes[1, 0], {})


@PAPER.figure("fig03_slab_approach", 3, 1, 6.8, 8.6, sharex=True)
def approach(data: Shear, axes) -> None:
    """Fig. 3: flow, density and temperature in the middle and at the top."""
    places = {"four central layers": CENTRE, "three top layers": TOP}
    for ax, (name, label) in zip(axes[:, 0], PROFILES.items(), strict=True):
        for colour, layers in zip(COLOURS, places.values(), strict=False):
            for gas in BOTH:
                series = data.slab("early", gas)
                curve = profile(series, name).over(layers)
                band(ax, series["clock"].values, curve.found, colour, LINES[gas])
            level = np.mean(HEIGHT[layers]) if name == "velocity_x" else 1.0
            ax.axhline(level, color="0.7", linewidth=0.8)
        ax.set_ylabel(label)
    legend(axes[1, 0], {n: {"color": c} for n, c in zip(places, COLOURS, strict=False)})
    axes[2, 0].set(xlabel=CLOCK, xlim=(0, 5))


@PAPER.figure("fig04_slab_transient", 2, 1, 6.8, 7.0, sharex=True)
def transient(data: Shear, axes) -> None:
    """Fig. 4: temperature and stresses of the whole slab, IHS and EHS."""
    curves = [(data.slab("late", gas), "mean_temperature", LINES[gas]) for gas in BOTH]
    legend(axes[1, 0], _averages(axes, curves), loc="upper right")


@PAPER.figure("fig09_initial_states", 2, 1, 6.8, 7.0, sharex=True)
def starts(data: Shear, axes) -> None:
    """Fig. 9: IHS from the three initial states."""
    lines = dict(zip(STARTS, ("--", "-."), strict=True))
    curves = [(data.slab("late", "ihs", s), "mean_temperature", lines[s]) for s in STARTS]
    entries = _averages(axes, [*curves, (flat(data), "temperature", "-")])
    for start, line in lines.items():
        entries[f"slab from {STARTS[start]}"] = {"color": "0.3", "linestyle": line}
    entries["homogeneous (3.12)"] = {"color": "0.3"}
    axes[1, 0].legend(handles=legend_of(entries), fontsize=8, loc="upper right")


def _averages(axes, curves) -> dict[str, dict]:
    """T/T0 above the stresses; `curves`: series, name of its temperature, line style."""
    top, bottom = axes[:, 0]
    for series, temperature, line in curves:
        clock = series["clock"].values
        names = (temperature, *STRESSES)
        for ax, name, colour in zip((top, bottom, bottom), names, COLOURS, strict=False):
            band(ax, clock, estimate(series, name), colour, line)
    top.set(ylabel="T / T0", title=SLAB)
    bottom.set(xlabel=CLOCK, ylabel="reduced stress", xlim=(0, 60), ylim=(0, None))
    colours = zip(STRESSES.values(), COLOURS[1:], strict=False)
    return {label: {"color": colour} for label, colour in colours}
