"""Figures 5 to 8 and 10 to 13: evolution toward the steady state."""

from functools import partial

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import bgk_shear_flow

from ...case import estimate
from ...style import COLOURS, band
from ..cases import BOTH, FAST, SLOW
from ..data import PAPER, Shear
from ..measured import HYDRODYNAMIC
from .common import BGK, CLOCK, LINES, RATES, SHADES, STRESSES, legend


def _model(restitution: float, shear_rate: float, last: float):
    """BGK from early times to `last`, densely at first."""
    return bgk_shear_flow.transient(restitution, shear_rate, np.geomspace(last / 1e4, last, 800))


@PAPER.figure("fig05_collisions", 1, 2, 10, 4.4)
def collisions(data: Shear, axes) -> None:
    """Fig. 5: s(t) and s'(t)/β, BGK dotted."""
    colours = dict(zip((0.5, 0.7, 0.9), COLOURS, strict=False))
    for ax, rate, last in zip(axes[0], (FAST, SLOW), (10.0, 200.0), strict=True):
        for alpha, colour in colours.items():
            for gas in BOTH:
                series = data.series(gas, alpha, rate)
                series = series.isel(sample=series["time"].values <= last)
                clock, scale = series["clock"].values, series["collisions"][-1]
                error = series["collisions_error"].values * float(series["clock"][-1] / scale)
                band(ax, series["time"], Estimate(clock, error), colour, LINES[gas])
            model = _model(alpha, rate, last)
            ax.plot(model.time, model.collisions, **BGK)
        ax.set(xlabel="time t / τ0", ylabel="s(t), s'(t)/β", title=f"a τ0 = {rate:g}")
        ax.set(xlim=(0, last), ylim=(0, None))
    legend(axes[0, 0], {f"α = {a}": {"color": c} for a, c in colours.items()}, bgk=True)


def _curves(ax, data: Shear, alpha: float, name: str, sign: float = 1.0) -> None:
    """An observable against s, both gases and shear rates."""
    for colour, rate in zip(COLOURS, (FAST, SLOW), strict=False):
        for gas in BOTH:
            series = data.series(gas, alpha, rate).isel(sample=slice(1, None))
            curve = sign * estimate(series, name)
            band(ax, series["clock"].values, curve, colour, LINES[gas])


@PAPER.figure("fig06_collision_ratio", 1, 2, 10, 4.2, sharey=True)
def collision_ratio(data: Shear, axes) -> None:
    """Fig. 6: collisions over their local-equilibrium number."""
    for ax, alpha in zip(axes[0], (0.9, 0.5), strict=True):
        _curves(ax, data, alpha, "collision_ratio")
        ax.axhline(1.0, color="0.7", linewidth=0.8)
        ax.set(xlabel=CLOCK, title=f"α = {alpha}", xlim=(0, 60), ylim=(0.93, 1.03))
    axes[0, 0].set_ylabel("s/s0 (IHS), s'/s'0 (EHS)")
    legend(axes[0, 1], RATES)


def _evolution(data: Shear, axes, alpha: float, names: dict[str, str]) -> None:
    """Panels under each other: observables against s, both gases and shear rates."""
    for ax, (name, label) in zip(axes, names.items(), strict=True):
        _curves(ax, data, alpha, name, -1.0 if label == "-a3" else 1.0)
        ax.set(ylabel=label, xlim=(0, 50))
    axes[0].set_title(f"α = {alpha}")
    axes[-1].set_xlabel(CLOCK)


def _transient(alpha: float, data: Shear, axes) -> None:
    """Temperature and stresses, BGK dotted."""
    names = {"temperature": "T/T0"} | STRESSES
    axes = axes[:, 0]
    _evolution(data, axes, alpha, names)
    for rate, last in ((FAST, 40.0), (SLOW, 800.0)):
        curve = _model(alpha, rate, last)
        for ax, name in zip(axes, names, strict=True):
            ax.plot(curve.collisions, getattr(curve, name), **BGK)
    axes[0].set_yscale("log")
    legend(axes[0], RATES, bgk=True, ncols=2)


def _cumulants(alpha: float, data: Shear, axes) -> None:
    """Relative speeds and cumulants."""
    names = {"relative_speed_cubed": "⟨V12³⟩/⟨V12³⟩0", "a2": "a2", "a3": "-a3"}
    axes = axes[:, 0]
    _evolution(data, axes, alpha, names)
    legend(axes[0], RATES, ncols=2)


for _alpha, _numbers in ((0.9, ("07", "11")), (0.5, ("08", "12"))):
    for _kind, _draw, _number in zip(
        ("transient", "cumulants"), (_transient, _cumulants), _numbers, strict=True
    ):
        _tall = PAPER.figure(f"fig{_number}_{_kind}_{_alpha}", 3, 1, 7, 8.7, sharex=True)
        _tall(partial(_draw, _alpha))


@PAPER.figure("fig10_viscosity", 1, 1, 6.6, 4.8)
def viscosity(data: Shear, axes) -> None:
    """Fig. 10: reduced viscosity against reduced shear rate, α = 0.5, BGK dotted."""
    ax, names = axes[0, 0], ("reduced_shear_rate", "reduced_viscosity")
    entries = {}
    for gas, marker in zip(BOTH, "os", strict=True):
        for rate in (FAST, SLOW):
            series = data.series(gas, 0.5, rate)
            late = series.isel(sample=series["clock"].values > HYDRODYNAMIC)
            band(ax, late[names[0]], estimate(late, names[1]), SHADES[gas], LINES[gas])
        x, y = (data.steady(gas, 0.5, FAST, name) for name in names)
        look = entries[f"steady state, {gas.upper()}"] = _symbol(marker, SHADES[gas])
        ax.errorbar(x.value, *y, x.error, **look)
    for rate, last in ((FAST, 20.0), (SLOW, 400.0)):
        curve = _model(0.5, rate, last)
        late = curve.collisions > HYDRODYNAMIC
        ax.plot(curve.reduced_shear_rate[late], curve.reduced_viscosity[late], **BGK)
    point = bgk_shear_flow.steady_state(0.5)
    look = entries["steady state, BGK"] = _symbol("D", "black")
    ax.plot(point.reduced_shear_rate, point.reduced_viscosity, **look)
    legend(ax, entries, bgk=True, coloured=True)
    ax.set(xlabel="a* = a τ_η", ylabel="η* = η/η0", title="α = 0.5, s > 2")


def _symbol(marker: str, colour: str) -> dict:
    return {"marker": marker, "color": colour, "markerfacecolor": "white", "linestyle": "none"}


@PAPER.figure("fig13_speed_ratios", 2, 2, 9, 6.4, sharex=True)
def speed_ratios(data: Shear, axes) -> None:
    """Fig. 13: R_0 to R_3 at α = 0.5, a τ0 = 4."""
    for place, ax in enumerate(axes.ravel()):
        for gas, colour in SHADES.items():
            series = data.series(gas, 0.5, FAST).isel(speed_class=place)
            clock = series["clock"].values
            band(ax, clock, estimate(series, "speed_ratio"), colour, LINES[gas])
        ax.set(ylabel=f"R_{place}", xlim=(0, 25))
    for ax in axes[1]:
        ax.set_xlabel("s (IHS), s'/β (EHS)")
    legend(axes[0, 0], {}, coloured=True)
    axes[0, 0].figure.suptitle("α = 0.5, a τ0 = 4")
