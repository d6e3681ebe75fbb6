"""Figures 14 to 18: steady states and velocity distributions; the convergence study."""

import numpy as np

from jdsmc import Estimate
from jdsmc.scenarios.options import TIME_STEP
from jdsmc.theory import bgk_shear_flow

from ...case import estimate
from ...numbers import stack
from ...style import COLOURS, OPEN, band, legend_of
from ..cases import FAST, LABELS, POINTS, SLOW
from ..checks import OBSERVABLES, Runs
from ..claims_distribution import bgk, equilibrium
from ..data import PAPER, Shear
from .common import BGK, LINES, SHADES, STRESSES, legend

LOOKS = {
    ("ihs", FAST): {"marker": "o", "color": COLOURS[0], "label": "IHS, a τ0 = 4"},
    ("ihs", SLOW): {"marker": "^", "color": COLOURS[0], "label": "IHS, a τ0 = 0.1"},
    ("ehs", FAST): {"marker": "s", "color": COLOURS[1], "label": "EHS, a τ0 = 4"},
    ("ehs", SLOW): {"marker": "v", "color": COLOURS[1], "label": "EHS, a τ0 = 0.1"},
    ("ehs_measured", FAST): {
        "marker": "D",
        "color": COLOURS[2],
        "markerfacecolor": COLOURS[2],
        "label": "EHS, measured drag, a τ0 = 4",
    },
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
