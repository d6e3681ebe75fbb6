"""Figures 1 to 7 of the paper, and our checks: linearity, steps, cooling state, kicks, work."""

import numpy as np

from jdsmc.theory import homogeneous_cooling, sonine_elastic
from jdsmc.theory.transport import elastic_sonine_coefficient, first_sonine, modified_first_sonine
from jdsmc.units import CONVERGED_ORDER

from ..numbers import mean, stack
from ..style import COLOURS, band, legend_of, points
from .cases import PAPER_FIELD, STUDY_FIELD, STUDY_RESTITUTION
from .coefficients import NAMES, coefficient
from .data import PAPER, Heat
from .distribution import HEAT_FLUX_LIMIT, odd_part, phi, share, truncated
from .limits import CONDUCTIVITY, MARGINAL, SONINE, at_field, limit, limits, used
from .numerics import TOLERANCE, kicks, methods, scheme

FINE = np.linspace(0.29, 1.0, 100)
STEADY = {"color": "black", "linestyle": ":", "linewidth": 1.0}
BANDS = {"title": "bands: 1 s.e.", "title_fontsize": 8}
BARS = {"title": "error bars: 1 s.e.", "title_fontsize": 8}

LARGEST = 10.0
"""c_x² up to which φ is drawn; thermal velocities, as the paper says."""

SERIES = ((":", COLOURS[1]), ("-.", COLOURS[2]), ("--", COLOURS[3]))


@PAPER.figure("fig1_transient_conductivity", 1, 1, 6.4, 4.2)
def transient_conductivity(data: Heat, axes) -> None:
    """Fig. 1: κ'(t)/κ0 at α = 0.3 for two fields; dotted: the steady value at the weaker one."""
    ax = axes[0, 0]
    for strength, line, colour in ((0.05, "--", COLOURS[1]), (PAPER_FIELD, "-", COLOURS[0])):
        time, parts = data.transient(0.3, strength).each_series(0.3, CONDUCTIVITY.name)
        band(ax, time, mean(parts), colour, line, f"ε* = {strength:g}")
    steady = at_field(data, CONDUCTIVITY, 0.3, PAPER_FIELD)
    ax.axhline(steady.value, label=f"steady, ε* = {PAPER_FIELD:g}", **STEADY)
    ax.legend(fontsize=8, **BANDS)
    ax.set(xlabel="t/τ", ylabel="κ'(t)/κ0", title="α = 0.3", ylim=(0, None))


@PAPER.figure("fig2_transient_sonine", 2, 1, 6.4, 7.5, sharex=True)
def transient_sonine(data: Heat, axes) -> None:
    """Fig. 2: b'_k(t) from (3.10) solid and from (3.12) dashed, at ε* = 0.025; dotted: steady."""
    for ax, alpha in zip(axes[:, 0], (1.0, 0.3), strict=True):
        pool = data.transient(alpha, PAPER_FIELD)
        for colour, *both in zip(COLOURS, SONINE, MARGINAL, strict=False):
            for quantity, line in zip(both, ("-", "--"), strict=True):
                time, parts = pool.each_series(alpha, quantity.name, quantity.order)
                band(ax, time, mean(parts), colour, line)
            ax.axhline(at_field(data, both[0], alpha, PAPER_FIELD).value, **STEADY)
        ax.set(ylabel="b'_k(t)", title=f"α = {alpha:g}, ε* = {PAPER_FIELD:g}")
    entries = {q.label: {"color": c} for q, c in zip(SONINE, COLOURS, strict=False)}
    entries |= {"(3.10)": {"color": "0.3"}, "(3.12)": {"color": "0.3", "linestyle": "--"}}
    axes[1, 0].set_xlabel("t/τ")
    handles = legend_of(entries | {"steady": STEADY})
    axes[0, 0].legend(handles=handles, fontsize=8, ncols=2, **BANDS)


@PAPER.figure("fig3_conductivity", 1, 1, 6.4, 4.8)
def conductivity(data: Heat, axes) -> None:
    """Fig. 3: κ'/κ0 by the force and by kicks, both Sonine approximations, the elastic value."""
    ax, alpha = axes[0, 0], np.array(data.restitutions)
    paper = data.over_restitutions(lambda a: at_field(data, CONDUCTIVITY, a, PAPER_FIELD))
    ax.plot(alpha, paper.value, "x", color="0.5", label=f"force, ε* = {PAPER_FIELD:g}")
    points(ax, alpha, limits(data, CONDUCTIVITY), color=COLOURS[0], label="force, ε* → 0")
    kicks = data.over_restitutions(lambda a: coefficient(data, CONDUCTIVITY.name, a).limit)
    points(ax, alpha, kicks, fmt="^", color=COLOURS[1], label="kicks, ε → 0")
    ax.plot(FINE, first_sonine(FINE).modified_conductivity, "k-", lw=1, label="first Sonine")
    modified = modified_first_sonine(FINE).modified_conductivity
    ax.plot(FINE, modified, "k--", lw=1, label="modified first Sonine")
    exact = sonine_elastic.converged("conductivity")
    ax.annotate(f"{exact:.6f}", (1.0, exact), (0.8, 0.975), arrowprops={"arrowstyle": "->"})
    ax.set(xlabel="coefficient of restitution α", ylabel="κ'/κ0", ylim=(0.95, 1.65))
    ax.legend(fontsize=8, **BARS)


@PAPER.figure("fig4_sonine", 1, 1, 6.4, 4.8)
def sonine(data: Heat, axes) -> None:
    """Fig. 4: b'_k for ε* → 0 and at the paper's field; stars: exact elastic values."""
    ax, alpha = axes[0, 0], np.array(data.restitutions)
    exact = sonine_elastic.sonine_coefficients(CONVERGED_ORDER)
    for q, marker, colour, star in zip(SONINE, "os^", COLOURS, exact, strict=False):
        paper = data.over_restitutions(lambda a, q=q: at_field(data, q, a, PAPER_FIELD))
        look = {"fmt": marker, "color": colour}
        label = f"{q.label}, ε* = {PAPER_FIELD:g}"
        points(ax, alpha, paper, linestyle=":", lw=1, label=label, **look)
        label = f"{q.label}, ε* → 0"
        points(ax, alpha, limits(data, q), markerfacecolor=colour, label=label, **look)
        ax.plot(1.0, star, "k*", markersize=11, markerfacecolor="none")
    first = elastic_sonine_coefficient() * first_sonine(FINE).modified_conductivity
    ax.plot(FINE, first, "k-", lw=1, label="b'_1, first Sonine")
    ax.plot([], [], "k*", markersize=11, markerfacecolor="none", label="elastic, exact")
    ax.axhline(0, color="0.8", lw=0.8, zorder=0)
    ax.set(xlabel="coefficient of restitution α", ylabel="b'_k")
    ax.legend(fontsize=7, ncols=2, **BARS)


@PAPER.figure("fig5_distribution_weak", 2, 1, 6.4, 6.8, sharex=True)
def weak(data: Heat, axes) -> None:
    """Fig. 5: φ(c_x²) and the truncated series φ_1, φ_2, φ_3 for α = 1 and 0.9."""
    _distributions(data, axes, (1.0, 0.9))


@PAPER.figure("fig6_distribution_strong", 3, 1, 6.4, 10.2, sharex=True)
def strong(data: Heat, axes) -> None:
    """Fig. 6: the same for α = 0.7, 0.5, 0.3."""
    _distributions(data, axes, (0.7, 0.5, 0.3))


def _distributions(data: Heat, axes, restitutions) -> None:
    squared = np.linspace(0, LARGEST, 200)
    for ax, alpha in zip(axes[:, 0], restitutions, strict=True):
        odd = odd_part(data, alpha, PAPER_FIELD)
        shown = odd.centres**2 < LARGEST
        curve = phi(odd)[shown]
        band(ax, odd.centres[shown] ** 2, curve, COLOURS[0], label="φ (band: 1 s.e.)")
        b = [at_field(data, q, alpha, PAPER_FIELD).value for q in SONINE]
        for p, (line, colour) in enumerate(SERIES, start=1):
            series = truncated(b[:p], squared)
            ax.plot(squared, series, linestyle=line, color=colour, lw=1.3, label=f"φ_{p}")
        ax.axhline(0, color="0.8", lw=0.8, zorder=0)
        low = min(np.min(curve.value - curve.error), np.min(truncated(b[:1], squared)))
        ax.set(ylabel="φ(c_x²)", ylim=(1.15 * low, 6.0))
        ax.set_title(f"α = {alpha:g}, ε* = {PAPER_FIELD:g}", fontsize=10)
    axes[0, 0].legend(fontsize=8)
    axes[-1, 0].set_xlabel("c_x²")


@PAPER.figure("fig7_share", 1, 1, 6.4, 4.6)
def shares(data: Heat, axes) -> None:
    """Fig. 7: β1(c_x²)/b'_1 for five restitutions; dotted line: c_x² = 6."""
    ax = axes[0, 0]
    for alpha, colour in zip((1.0, 0.9, 0.7, 0.5, 0.3), COLOURS, strict=True):
        odd = odd_part(data, alpha, PAPER_FIELD)
        squared = odd.edges[1:] ** 2
        shown = squared < 20
        band(ax, squared[shown], share(odd)[shown], colour, label=f"α = {alpha:g}")
    ax.axvline(HEAT_FLUX_LIMIT, color="black", linestyle=":", linewidth=1)
    ax.axhline(1.0, color="0.8", lw=0.8, zorder=0)
    ax.set(xlabel="c_x²", ylabel="β1(c_x²)/b'_1", xlim=(0, 20))
    ax.set_title(f"ε* = {PAPER_FIELD:g}; bands: 1 s.e.", fontsize=10)
    ax.legend(fontsize=8)


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
        ax.plot(
            1.0,
            sonine_elastic.converged(name),
            "k*",
            markersize=11,
            markerfacecolor="none",
            label="exact",
        )
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
