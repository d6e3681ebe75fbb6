"""Our checks: linearity in the field, time steps, the cooling state."""

import numpy as np
from matplotlib.figure import Figure

from jdsmc.theory import homogeneous_cooling

from ...style import COLOURS, figure
from ..convergence import TOLERANCE, scheme
from ..data import Measurements
from ..limits import CONDUCTIVITY, FITS, SONINE, limit
from ..systems import PAPER_FIELD, STUDY_FIELD, STUDY_RESTITUTION

POINTS = {"fmt": "o", "markersize": 5, "capsize": 2, "markerfacecolor": "none"}


def linearity(data: Measurements) -> Figure:
    """Every quantity against ε*², with the fits; dotted: the paper's field."""
    found, axes = figure(2, 2, 9.5, 7.5, sharex=True)
    for ax, quantity in zip(axes.ravel(), (CONDUCTIVITY, *SONINE), strict=True):
        chosen = FITS[quantity.order]
        for alpha, colour in zip((0.3, 0.5, 1.0), COLOURS, strict=False):
            value, error = data.against_field(quantity.name, alpha, quantity.order)
            strengths = np.array(data.fields)
            used = strengths <= chosen.strongest + 1e-12
            fitted = limit(data, quantity, alpha)
            scale = abs(fitted.best[0]) if quantity is CONDUCTIVITY else 1.0
            shift = fitted.best[0] if quantity is CONDUCTIVITY else 0.0
            ax.errorbar(
                strengths[used] ** 2,
                (value[used] - shift) / scale,
                error[used] / scale,
                color=colour,
                label=f"α = {alpha:g}",
                **POINTS,
            )
            line = np.linspace(0, chosen.strongest, 60)
            curve = np.array([fitted.at(float(x)).value for x in line])
            ax.plot(line**2, (curve - shift) / scale, color=colour, lw=1)
        ax.axvline(PAPER_FIELD**2, color="black", linestyle=":", linewidth=1)
        relative = "relative change of " if quantity is CONDUCTIVITY else ""
        ax.set(ylabel=f"{relative}{quantity.label}")
    axes[0, 0].legend(fontsize=8, title="error bars: 1 s.e.", title_fontsize=8)
    for ax in axes[1]:
        ax.set_xlabel("ε*²")
    return found


def time_step(data: Measurements) -> Figure:
    """κ' against the time step: exact flow and symmetric splitting, and the paper's step."""
    found, axes = figure(1, 1, 6.4, 4.4)
    ax = axes[0, 0]
    limit_of = scheme(data, "exact").limit.value.value
    for name, label, colour in (
        ("exact", "exact flow, symmetric (dt²)", COLOURS[0]),
        ("paper", "paper's step (4.1) (dt)", COLOURS[1]),
    ):
        run = scheme(data, name)
        value, error = (100 * x / limit_of for x in run.values)
        ax.errorbar(run.made, value - 100, error, color=colour, label=label, **POINTS)
        line = np.linspace(0, run.made.max(), 50)
        fitted = np.array([run.limit.at(float(x)).value for x in line])
        ax.plot(line, 100 * (fitted / limit_of - 1), color=colour, lw=1)
    span = 100 * TOLERANCE
    ax.axhspan(-span, span, color="0.9", zorder=0, label=f"±{span:g}%")
    ax.set(xlabel="time step dt/τ", ylabel="κ' over its limit dt → 0, in %: minus 100")
    title = f"α = {STUDY_RESTITUTION:g}, ε* = {STUDY_FIELD:g}; error bars: 1 s.e.; lines: fits"
    ax.set_title(title, fontsize=10)
    ax.legend(fontsize=8)
    return found


def cooling(data: Measurements) -> Figure:
    """a2, a3 and ζ of the cooling state against α, with (2.16) and (2.14)."""
    found, axes = figure(3, 1, 6.4, 8.5, sharex=True)
    alpha, fine = np.array(data.restitutions), np.linspace(0.29, 1, 100)
    a2 = homogeneous_cooling.kurtosis(fine)
    lines = {"a2": ("(2.16)", a2), "a3": (None, None)}
    lines["relative_speed_cubed"] = ("(2.14)", 1 + 3 / 16 * a2)
    for ax, (name, (label, line)) in zip(axes[:, 0], lines.items(), strict=True):
        pairs = [data["cooling"].value(name, a) for a in alpha]
        value, error = (np.array(column) for column in zip(*pairs, strict=True))
        ax.errorbar(alpha, value, error, color=COLOURS[0], label="jdsmc (1 s.e.)", **POINTS)
        if line is not None:
            ax.plot(fine, line, "k:", lw=1.2, label=label)
        ax.set_ylabel({"relative_speed_cubed": "ζ/ζ of a Maxwellian"}.get(name, name))
        ax.legend(fontsize=8)
    axes[-1, 0].set_xlabel("coefficient of restitution α")
    return found
