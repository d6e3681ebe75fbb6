"""Figures 5 to 8 and 10 to 18: evolution, steady states, distributions; the convergence study."""

from functools import partial

import numpy as np

from jdsmc import Estimate
from jdsmc.scenarios.options import TIME_STEP
from jdsmc.theory import bgk_shear_flow

from ..case import estimate
from ..numbers import stack
from ..style import COLOURS, OPEN, band, legend_of
from .cases import BOTH, FAST, LABELS, POINTS, SLOW
from .checks import OBSERVABLES, Runs
from .claims_distribution import bgk, equilibrium
from .data import PAPER, Shear
from .measured import HYDRODYNAMIC

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


LOOKS = {
    ("ihs", FAST): {"marker": "o", "color": COLOURS[0], "label": "IHS, a τ0 = 4"},
    ("ihs", SLOW): {"marker": "^", "color": COLOURS[0], "label": "IHS, a τ0 = 0.1"},
    ("ehs", FAST): {"marker": "s", "color": COLOURS[1], "label": "EHS, a τ0 = 4"},
    ("ehs", SLOW): {"marker": "v", "color": COLOURS[1], "label": "EHS, a τ0 = 0.1"},
    ("ehs_measured", FAST): {"marker": "D", "color": COLOURS[2], "label": "EHS, measured drag"},
}
FINE = np.linspace(0.48, 0.97, 99)


def _panels(data: Shear, axes, labels: dict[str, str], modelled, x_name: str = "") -> None:
    """Steady values against α, or against another of them; BGK dotted where it is modelled."""
    axes, model = axes[:, 0], bgk_shear_flow.steady_state(FINE)
    for ax, (name, label) in zip(axes, labels.items(), strict=True):
        sign = -1.0 if label == "-a3" else 1.0
        for (gas, rate), look in LOOKS.items():
            alpha = data.restitutions(gas)
            x = data.against(gas, x_name, rate) if x_name else Estimate(alpha, 0.0 * alpha)
            y = sign * data.against(gas, name, rate)
            ax.errorbar(x.value, *y, x.error if x_name else None, **OPEN | look)
        if name in modelled:
            x_model = getattr(model, x_name) if x_name else FINE
            ax.plot(x_model, sign * getattr(model, name), **BGK, label="BGK")
        ax.set_ylabel(label)
    axes[-1].set_xlabel("coefficient of restitution α")
    axes[0].legend(fontsize=8, title="error bars: 1 s.e.")


@PAPER.figure("fig14_steady_stresses", 4, 1, 6.4, 11.5, sharex=True)
def stresses(data: Shear, axes) -> None:
    """Fig. 14: shear rate, shear stress, normal stress differences against α, BGK dotted."""
    labels = {"reduced_shear_rate": "a* = a τ_η", **STRESSES}
    labels["normal_stress_zy"] = "(P_zz - P_yy)/nT"
    _panels(data, axes, labels, labels)


@PAPER.figure("fig15_viscometric", 3, 1, 6.4, 9, sharex=True)
def viscometric(data: Shear, axes) -> None:
    """Fig. 15: viscosity and viscometric functions against the steady shear rate, BGK dotted."""
    labels = {"reduced_viscosity": "η*", "first_viscometric": "-Ψ1", "second_viscometric": "Ψ2"}
    _panels(data, axes, labels, labels, "reduced_shear_rate")
    axes[-1, 0].set_xlabel("steady reduced shear rate a*_s = a τ_η")


@PAPER.figure("fig16_steady_cumulants", 3, 1, 6.4, 9, sharex=True)
def cumulants(data: Shear, axes) -> None:
    """Fig. 16: relative speeds and cumulants against α; BGK dotted but in the first panel."""
    labels = {"relative_speed_cubed": "⟨V12³⟩/⟨V12³⟩0", "a2": "a2", "a3": "-a3"}
    _panels(data, axes, labels, ("a2", "a3"))
    axes[1, 0].legend(handles=legend_of({"BGK": BGK}), fontsize=8)


DISTRIBUTIONS = {
    "marginal_x": ("velocity", "C_x = V_x/v0(T)", "g_x⁽⁺⁾(C_x)"),
    "marginal_y": ("velocity", "C_y = V_y/v0(T)", "g_y⁽⁺⁾(C_y)"),
    "speed": ("speed_bin", "C = V/v0(T)", "F(C)"),
}

LARGEST_ERROR = 0.7
"""Bins with a larger relative error are not drawn."""


@PAPER.figure("fig17_distributions", 3, 2, 10, 10.5)
def linear(data: Shear, axes) -> None:
    """Fig. 17: thermal velocities, linear scale."""
    _distributions(data, axes, 3.0, ylim=(0, None))


@PAPER.figure("fig18_distributions_log", 3, 2, 10, 10.5)
def logarithmic(data: Shear, axes) -> None:
    """Fig. 18: tails, logarithmic scale, averaged over both shear rates."""
    _distributions(data, axes, 7.0, yscale="log", ylim=(1e-7, 2))


def _distributions(data: Shear, axes, reach: float, **options) -> None:
    for column, alpha in enumerate((0.9, 0.5)):
        for row, (name, (axis, xlabel, ylabel)) in enumerate(DISTRIBUTIONS.items()):
            ax, first = axes[row, column], 0.0 if name == "speed" else -reach
            for gas, colour in SHADES.items():
                curve = data.distribution(gas, alpha)
                c, (value, error) = curve[axis].values, estimate(curve, name)
                seen = (c > first) & (c < reach) & (error < LARGEST_ERROR * value)
                value = np.where(seen, value, np.nan)  # a gap, where few particles were seen
                band(ax, c, Estimate(value, error), colour, LINES[gas])
            c = np.linspace(first + 1e-3, reach, 241)
            ax.plot(c, bgk(name, alpha, c), color="black", linestyle="-.", linewidth=1)
            ax.plot(c, equilibrium(name, c), color="0.5", linestyle=":", linewidth=1.3)
            ax.set(xlabel=xlabel, ylabel=ylabel, xlim=(first, reach), title=f"α = {alpha}")
            ax.set(**options)
    models = {"BGK": {"color": "black", "linestyle": "-."}}
    models["local equilibrium"] = {"color": "0.5", "linestyle": ":"}
    legend(axes[2, 0], models, coloured=True)


@PAPER.figure("convergence", 6, 2, 10, 14.4, sharex="col")
def convergence(data: Shear, axes) -> None:
    """Deviation from the limit in percent, against dt² (left) and 1/N (right); fits as lines."""
    for place, (gas, alpha) in enumerate(POINTS):
        runs = Runs(data, gas, alpha)
        look = {"fmt": "o", "ms": 4, "capsize": 2, "color": COLOURS[place]}
        look["label"] = f"{LABELS[gas]}, α = {alpha}"
        for (left, right), name in zip(axes, OBSERVABLES, strict=True):
            _deviations(left, right, runs, name, place, look)
    for (left, right), label in zip(axes, OBSERVABLES.values(), strict=True):
        left.set_ylabel(f"{label}: deviation / %")
        for ax in (left, right):
            ax.axhspan(-0.3, 0.3, color="0.9", zorder=0, label="±0.3%")
    axes[-1, 0].set_xlabel("(dt/τ)², dt as really made")
    axes[-1, 1].set(xlabel="1/N", xscale="log")
    axes[0, 0].set_title(f"N = {runs.usual}")
    axes[0, 1].set_title(f"time step asked: {TIME_STEP} (default)")
    axes[0, 0].legend(fontsize=7, ncols=2, title="error bars: 1 s.e.; lines: fit", title_fontsize=7)


def _deviations(left, right, runs: Runs, name: str, place: int, look: dict) -> None:
    limit = runs.limit(name)
    best, *parts = (float(x) for x in (limit.terms[0], limit.by_step, limit.by_number))
    by_step, by_number = (100 * part for part in parts)
    value, error = (100 / best * x for x in stack(runs.values(name)))
    x, chosen = runs.step**2, runs.number == runs.usual
    left.errorbar(x[chosen] + 2e-5 * place, value[chosen] - 100, error[chosen], **look)
    line = np.linspace(0, x[chosen].max(), 20)
    fit = by_number + by_step * line / runs.default**2
    left.plot(line, fit, color=look["color"], linewidth=1)
    x, chosen = 1.0 / runs.number, runs.asked == TIME_STEP
    shifted = x[chosen] * (1 + 0.06 * (place - 1))
    right.errorbar(shifted, value[chosen] - 100, error[chosen], **look)
    line = np.geomspace(x[chosen].min(), x[chosen].max(), 60)
    fit = by_step + by_number * line * runs.usual
    right.plot(line, fit, color=look["color"], linewidth=1)
