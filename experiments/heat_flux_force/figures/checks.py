"""Our checks: linearity in the field, time steps, the cooling state, kicks, work to precision."""

import numpy as np

from jdsmc.theory import homogeneous_cooling
from jdsmc.theory.transport import first_sonine, modified_first_sonine

from ...numbers import stack
from ...style import COLOURS, points
from ..cases import PAPER_FIELD, STUDY_FIELD, STUDY_RESTITUTION
from ..coefficients import NAMES, coefficient, elastic
from ..data import PAPER, Heat
from ..limits import CONDUCTIVITY, SONINE, at_field, limit, limits, used
from ..numerics import TOLERANCE, kicks, methods, scheme
from .paper import BARS, FINE


@PAPER.figure("linearity", 2, 2, 9.5, 7.5, sharex=True)
def linearity(data: Heat, axes) -> None:
    """Every quantity against ε*², with the fits; dotted: the paper's field."""
    for ax, quantity in zip(axes.ravel(), (CONDUCTIVITY, *SONINE), strict=True):
        fields = np.array(used(data, quantity))
        for alpha, colour in zip((0.3, 0.5, 1.0), COLOURS, strict=False):
            values = stack(at_field(data, quantity, alpha, f) for f in fields)
            fitted = limit(data, quantity, alpha)
            line = np.linspace(0, fields[-1], 60)
            curve = np.array([float(fitted.value(float(x))) for x in line])
            if quantity is CONDUCTIVITY:
                best = float(fitted.limit)
                values, curve = values / best - 1.0, curve / best - 1.0
            points(ax, fields**2, values, color=colour, label=f"α = {alpha:g}", markersize=5)
            ax.plot(line**2, curve, color=colour, lw=1)
        ax.axvline(PAPER_FIELD**2, color="black", linestyle=":", linewidth=1)
        relative = "relative change of " if quantity is CONDUCTIVITY else ""
        ax.set(ylabel=f"{relative}{quantity.label}")
    axes[0, 0].legend(fontsize=8, **BARS)
    for ax in axes[1]:
        ax.set_xlabel("ε*²")


@PAPER.figure("time_step", 1, 1, 6.4, 4.4)
def time_step(data: Heat, axes) -> None:
    """κ' against the time step: exact flow and symmetric splitting, and the paper's step."""
    ax = axes[0, 0]
    best = float(scheme(data, "exact").fit.limit)
    for name, label, colour in (
        ("exact", "exact flow, symmetric (dt²)", COLOURS[0]),
        ("paper", "paper's step (4.1) (dt)", COLOURS[1]),
    ):
        run = scheme(data, name)
        values = 100.0 * (stack(run.values) / best - 1.0)
        points(ax, run.made, values, color=colour, label=label, markersize=5)
        line = np.linspace(0, max(run.made), 50)
        fitted = np.array([float(run.fit.value(float(x))) for x in line])
        ax.plot(line, 100 * (fitted / best - 1), color=colour, lw=1)
    span = 100 * TOLERANCE
    ax.axhspan(-span, span, color="0.9", zorder=0, label=f"±{span:g}%")
    ax.set(xlabel="time step dt/τ", ylabel="κ' over its limit dt → 0, in %: minus 100")
    title = f"α = {STUDY_RESTITUTION:g}, ε* = {STUDY_FIELD:g}; error bars: 1 s.e.; lines: fits"
    ax.set_title(title, fontsize=10)
    ax.legend(fontsize=8)


@PAPER.figure("cooling_state", 3, 1, 6.4, 8.5, sharex=True)
def cooling(data: Heat, axes) -> None:
    """a2, a3 and ζ of the cooling state against α, with (2.16) and (2.14)."""
    a2 = homogeneous_cooling.kurtosis(FINE)
    lines = {"a2": ("(2.16)", a2), "a3": (None, None)}
    lines["relative_speed_cubed"] = ("(2.14)", 1 + 3 / 16 * a2)
    for ax, (name, (label, line)) in zip(axes[:, 0], lines.items(), strict=True):
        values = data.over_restitutions(lambda a, name=name: data["cooling"].value(name, a))
        points(ax, data.restitutions, values, color=COLOURS[0], label="jdsmc (1 s.e.)")
        if line is not None:
            ax.plot(FINE, line, "k:", lw=1.2, label=label)
        ax.set_ylabel({"relative_speed_cubed": "ζ/ζ of a Maxwellian"}.get(name, name))
        ax.legend(fontsize=8)
    axes[-1, 0].set_xlabel("coefficient of restitution α")


@PAPER.figure("navier_stokes", 2, 2, 9.5, 7, sharex=True)
def navier_stokes(data: Heat, axes) -> None:
    """κ', κ, nμ/Tκ0, η by kicks (ε → 0) beside both Sonine approximations and elastic values."""
    for ax, (name, label) in zip(axes.ravel(), NAMES.items(), strict=True):
        values = data.over_restitutions(lambda a, name=name: coefficient(data, name, a).limit)
        look = {"fmt": "^", "color": COLOURS[1], "label": "kicks, ε → 0"}
        points(ax, data.restitutions, values, **look)
        ax.plot(FINE, getattr(first_sonine(FINE), name), "k-", lw=1, label="first Sonine")
        modified = getattr(modified_first_sonine(FINE), name)
        ax.plot(FINE, modified, "k--", lw=1, label="modified first Sonine")
        ax.plot(1.0, elastic(name), "k*", markersize=11, markerfacecolor="none", label="exact")
        ax.set_ylabel(label)
    force = limits(data, CONDUCTIVITY)
    points(axes[0, 0], data.restitutions, force, color=COLOURS[0], label="force, ε* → 0")
    axes[0, 0].legend(fontsize=8, **BARS)
    for ax in axes[1]:
        ax.set_xlabel("coefficient of restitution α")


STYLES = (
    *(("black", "-"), (COLOURS[1], "--"), (COLOURS[2], "--")),
    *((COLOURS[3], "--"), (COLOURS[0], "-")),
)


@PAPER.figure("work_precision", 1, 1, 7.4, 5)
def work_precision(data: Heat, axes) -> None:
    """Bias and statistical error in quadrature against particle-steps, at α = 0.5."""
    ax, effort = axes[0, 0], np.geomspace(1e8, 1e13, 400)
    for method, (colour, line) in zip(methods(data), STYLES, strict=True):
        error = 100 * method.error(effort)
        ax.loglog(effort, error, color=colour, linestyle=line, lw=1.5, label=method.label)
    work, error = kicks(data)
    label = "kicks, ε = 0.2 (κ, μ, η too)"
    ax.loglog(work, 100 * error, "^", color=COLOURS[1], mfc="none", label=label)
    ax.axhline(0.3, color="0.6", linewidth=0.8)
    ax.set(xlabel="particle-steps, the approach included", ylabel="error of κ' (%)")
    ax.set_ylim(0.05, 10)
    ax.set_title("α = 0.5: bias and one standard error, in quadrature", fontsize=10)
    ax.grid(alpha=0.3, which="both")
    ax.legend(fontsize=8)
