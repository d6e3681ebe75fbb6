"""Figures 3 and 4, and all Navier-Stokes coefficients: against restitution."""

import numpy as np
from matplotlib.figure import Figure

from jdsmc.theory import sonine_elastic
from jdsmc.theory.transport import elastic_sonine_coefficient, first_sonine, modified_first_sonine

from ...style import COLOURS, figure
from ..coefficients import ELASTIC_ORDER, NAMES, coefficient, elastic
from ..data import Measurements
from ..limits import CONDUCTIVITY, SONINE, limits
from ..systems import PAPER_FIELD

FINE = np.linspace(0.29, 1.0, 100)
POINTS = {"linestyle": "none", "capsize": 2, "markersize": 6}
OPEN = POINTS | {"markerfacecolor": "none"}


def conductivity(data: Measurements) -> Figure:
    """Fig. 3: κ'/κ0 by the force and by kicks, both Sonine approximations, the elastic value."""
    found, axes = figure(1, 1, 6.4, 4.8)
    ax, alpha = axes[0, 0], np.array(data.restitutions)
    at_field = [data.steady(PAPER_FIELD).value(CONDUCTIVITY.name, a).value for a in alpha]
    ax.plot(alpha, at_field, "x", color="0.5", label=f"force, ε* = {PAPER_FIELD:g}")
    by_force = limits(data, CONDUCTIVITY)
    ax.errorbar(alpha, *by_force, fmt="o", color=COLOURS[0], label="force, ε* → 0", **OPEN)
    by_kicks = [coefficient(data, "modified_conductivity", a).limit for a in alpha]
    value, error = (np.array(column) for column in zip(*by_kicks, strict=True))
    ax.errorbar(alpha, value, error, fmt="^", color=COLOURS[1], label="kicks, ε → 0", **OPEN)
    ax.plot(FINE, first_sonine(FINE).modified_conductivity, "k-", lw=1, label="first Sonine")
    modified = modified_first_sonine(FINE).modified_conductivity
    ax.plot(FINE, modified, "k--", lw=1, label="modified first Sonine")
    exact = sonine_elastic.conductivity_ratio(ELASTIC_ORDER)
    ax.annotate(f"{exact:.6f}", (1.0, exact), (0.8, 0.975), arrowprops={"arrowstyle": "->"})
    ax.set(xlabel="coefficient of restitution α", ylabel="κ'/κ0", ylim=(0.95, 1.65))
    ax.legend(fontsize=8, title="error bars: 1 s.e.", title_fontsize=8)
    return found


def sonine(data: Measurements) -> Figure:
    """Fig. 4: b'_k for ε* → 0 and at the paper's field; stars: exact elastic values."""
    found, axes = figure(1, 1, 6.4, 4.8)
    ax, alpha = axes[0, 0], np.array(data.restitutions)
    exact = sonine_elastic.sonine_coefficients(ELASTIC_ORDER)
    for quantity, marker, colour, star in zip(SONINE, "os^", COLOURS, exact, strict=False):
        at_field = [data.steady(PAPER_FIELD).value("sonine", a, quantity.order) for a in alpha]
        value, error = (np.array(column) for column in zip(*at_field, strict=True))
        label = f"{quantity.label}, ε* = {PAPER_FIELD:g}"
        ax.errorbar(
            alpha, value, error, fmt=marker, color=colour, label=label, ls=":", lw=1, **_LINES
        )
        label = f"{quantity.label}, ε* → 0"
        best = limits(data, quantity)
        ax.errorbar(alpha, *best, fmt=marker, color=colour, label=label, **POINTS)
        ax.plot(1.0, star, "k*", markersize=11, markerfacecolor="none")
    first = elastic_sonine_coefficient() * first_sonine(FINE).modified_conductivity
    ax.plot(FINE, first, "k-", lw=1, label="b'_1, first Sonine")
    ax.plot([], [], "k*", markersize=11, markerfacecolor="none", label="elastic, exact")
    ax.axhline(0, color="0.8", lw=0.8, zorder=0)
    ax.set(xlabel="coefficient of restitution α", ylabel="b'_k")
    ax.legend(fontsize=7, ncols=2, title="error bars: 1 s.e.", title_fontsize=8)
    return found


_LINES = {"capsize": 2, "markersize": 6, "markerfacecolor": "none"}


def navier_stokes(data: Measurements) -> Figure:
    """κ', κ, nμ/Tκ0, η by kicks (ε → 0) beside both Sonine approximations and elastic values."""
    found, axes = figure(2, 2, 9.5, 7, sharex=True)
    alpha = np.array(data.restitutions)
    for ax, (name, label) in zip(axes.ravel(), NAMES.items(), strict=True):
        best = [coefficient(data, name, a).limit for a in alpha]
        value, error = (np.array(column) for column in zip(*best, strict=True))
        ax.errorbar(alpha, value, error, fmt="^", color=COLOURS[1], label="kicks, ε → 0", **OPEN)
        ax.plot(FINE, getattr(first_sonine(FINE), name), "k-", lw=1, label="first Sonine")
        modified = getattr(modified_first_sonine(FINE), name)
        ax.plot(FINE, modified, "k--", lw=1, label="modified first Sonine")
        ax.plot(1.0, elastic(name), "k*", markersize=11, markerfacecolor="none", label="exact")
        ax.set_ylabel(label)
    by_force = limits(data, CONDUCTIVITY)
    axes[0, 0].errorbar(alpha, *by_force, fmt="o", color=COLOURS[0], label="force, ε* → 0", **OPEN)
    axes[0, 0].legend(fontsize=8, title="error bars: 1 s.e.", title_fontsize=8)
    for ax in axes[1]:
        ax.set_xlabel("coefficient of restitution α")
    return found
