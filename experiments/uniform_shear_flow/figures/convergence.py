"""The convergence study: observables against time step and particle number."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, figure
from ..convergence import DEFAULT_NUMBER, DEFAULT_STEP, OBSERVABLES, POINTS, extrapolate, runs
from ..systems import LABELS

NAMES = {
    "temperature": "T_s",
    "shear_stress": "-P_xy/nT",
    "normal_stress_xy": "(P_xx-P_yy)/nT",
    "normal_stress_zy": "(P_zz-P_yy)/nT",
    "a2": "a2",
    "relative_speed_cubed": "⟨V12³⟩",
}


def convergence(study: list) -> Figure:
    """Deviation from the limit in percent, against dt² (left) and 1/N (right); fits as lines."""
    found, axes = figure(len(OBSERVABLES), 2, 10, 2.4 * len(OBSERVABLES), sharex="col")
    for row, name in enumerate(OBSERVABLES):
        for place, (gas, alpha) in enumerate(POINTS):
            points = runs(study, gas, alpha, name)
            limit = extrapolate(points)
            look = {"color": COLOURS[place], "label": f"{LABELS[gas]}, α = {alpha}"}
            _by_step(axes[row, 0], points, limit, look, place)
            _by_number(axes[row, 1], points, limit, look, place)
        axes[row, 0].set_ylabel(f"{NAMES[name]}: deviation / %")
        for ax in axes[row]:
            ax.axhspan(-0.3, 0.3, color="0.9", zorder=0, label="±0.3%")
    axes[-1, 0].set_xlabel("(dt/τ)², dt as really made")
    axes[-1, 1].set(xlabel="1/N", xscale="symlog")
    axes[-1, 1].set_xscale("log")
    axes[0, 0].set_title(f"N = {DEFAULT_NUMBER}")
    axes[0, 1].set_title(f"time step asked: {DEFAULT_STEP} (default)")
    axes[0, 0].legend(fontsize=7, ncols=2, title="error bars: 1 s.e.; lines: fit", title_fontsize=7)
    return found


def _percent(points, limit):
    value, error = (np.array([p.estimate[k] for p in points]) for k in (0, 1))
    return 100 * (value / limit.limit.value - 1), 100 * error / abs(limit.limit.value)


def _by_step(ax, points, limit, look, place: int) -> None:
    chosen = [p for p in points if p.number == DEFAULT_NUMBER]
    value, error = _percent(chosen, limit)
    x = np.array([p.step**2 for p in chosen])
    default = next(p.step**2 for p in chosen if p.asked == DEFAULT_STEP)
    ax.errorbar(x + 2e-5 * place, value, error, fmt="o", markersize=4, capsize=2, **look)
    line = np.linspace(0, x.max(), 20)
    fit = 100 * (limit.by_number.value + limit.by_step.value * line / default)
    ax.plot(line, fit, color=look["color"], linewidth=1)


def _by_number(ax, points, limit, look, place: int) -> None:
    chosen = [p for p in points if p.asked == DEFAULT_STEP]
    value, error = _percent(chosen, limit)
    x = np.array([1 / p.number for p in chosen])
    shifted = x * (1 + 0.06 * (place - 1))
    ax.errorbar(shifted, value, error, fmt="o", markersize=4, capsize=2, **look)
    line = np.geomspace(x.min(), x.max(), 60)
    fit = 100 * (limit.by_step.value + limit.by_number.value * line * DEFAULT_NUMBER)
    ax.plot(line, fit, color=look["color"], linewidth=1)
