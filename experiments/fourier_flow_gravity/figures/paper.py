"""Figures 2 to 6: profiles between the walls; figure 7, and all rows of tables 2 to 5."""

import numpy as np

from ...case import estimate
from ...style import COLOURS, band
from .. import effect
from ..cases import COMBINATIONS, EXAMPLE, EXAMPLE_GRAVITY, FIGURE_6
from ..data import PAPER, Fourier, share

GRAVITY_COLOURS = dict(zip(EXAMPLE_GRAVITY, COLOURS, strict=True))
MARKERS = dict(zip(COMBINATIONS, ("s", "D", "o", "^"), strict=True))
SHADES = dict(zip(COMBINATIONS, COLOURS, strict=False))
FINE = np.linspace(-0.11, 0.1, 100)


def _profiles(data: Fourier, ax, name: str, label: str, power: float = 1.0, **place) -> None:
    """A profile at every g of Figs. 2 to 5; `place`: of the legend."""
    for gravity, colour in GRAVITY_COLOURS.items():
        state = data.state(EXAMPLE, gravity)
        curve = estimate(state, name) ** power
        band(ax, share(state), curve, colour, label=f"g = {gravity:g}")
    title = f"{EXAMPLE.label}\nbands: 1 s.e."
    ax.legend(fontsize=8, title=title, title_fontsize=8, **place)
    ax.set(xlabel="z/L (cold wall at 0, hot wall at 1)", ylabel=label, xlim=(0, 1))


@PAPER.figure("fig2_temperature", 1, 1, 6.4, 4.8)
def temperature(data: Fourier, axes) -> None:
    """Fig. 2: T^(3/2)."""
    _profiles(data, axes[0, 0], "temperature", "$T^{3/2}$", power=1.5)
    axes[0, 0].set_ylim(0, 1)


@PAPER.figure("fig3_heat_flux", 1, 1, 6.4, 4.8)
def heat_flux(data: Fourier, axes) -> None:
    """Fig. 3: q_z, with its mean and the two wall fluxes as marks at the ends."""
    ax = axes[0, 0]
    _profiles(data, ax, "heat_flux", "$q_z$", loc="center left", bbox_to_anchor=(1.0, 0.5))
    for gravity, colour in GRAVITY_COLOURS.items():
        state = data.state(EXAMPLE, gravity)
        for side, x in (("cold", 0.0), ("hot", 1.0)):
            flux = estimate(state, f"heat_flux_{side}_wall")
            ax.errorbar(x, *flux, fmt="o", ms=4, capsize=2, color=colour, clip_on=False)
        ax.axhline(float(state["mean_heat_flux"]), color=colour, lw=0.8, ls=":", zorder=0)
    ax.set_title("circles: energy exchanged at the walls; dotted: mean", fontsize=9)


@PAPER.figure("fig4_pressures", 1, 1, 6.4, 4.8)
def pressures(data: Fourier, axes) -> None:
    """Fig. 4: p and P_zz."""
    _profiles(data, axes[0, 0], "pressure", "$p$ (full), $P_{zz}$ (dashed)")
    for gravity, colour in GRAVITY_COLOURS.items():
        state = data.state(EXAMPLE, gravity)
        band(axes[0, 0], share(state), estimate(state, "pressure_zz"), colour, "--")


@PAPER.figure("fig5_density", 1, 1, 6.4, 4.8)
def density(data: Fourier, axes) -> None:
    """Fig. 5: n, logarithmic."""
    _profiles(data, axes[0, 0], "density", "$n$")
    ticks = (0.3, 0.5, 1, 2, 4, 8)
    axes[0, 0].set_yscale("log")
    axes[0, 0].set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axes[0, 0].minorticks_off()


@PAPER.figure("fig6_kinds_of_wall", 1, 2, 10.0, 4.4, sharey=True)
def kinds_of_wall(data: Fourier, axes) -> None:
    """Fig. 6: T^(3/2) with walls of type I and II, T_- = 0.01."""
    looks = zip(COMBINATIONS[2:], COLOURS, ("--", "-"), ("type I", "type II"), strict=False)
    for combination, *look in looks:
        for ax, gravity in zip(axes[0], FIGURE_6, strict=True):
            state = data.state(combination, gravity)
            band(ax, share(state), estimate(state, "temperature") ** 1.5, *look)
    for ax, gravity, part in zip(axes[0], FIGURE_6, "ab", strict=True):
        ax.set(xlabel="z/L", xlim=(0, 1), ylim=(0, 1), title=f"({part}) g = {gravity:g}")
    axes[0, 0].legend(fontsize=9, title="$T_-$ = 0.01")
    axes[0, 0].set_ylabel("$T^{3/2}$")


@PAPER.figure("fig7_gravity_effect", 2, 2, 10.0, 7.6, sharex=True, sharey=True)
def gravity_effect(data: Fourier, axes) -> None:
    """Fig. 7: the change of κ* with g*, ours and the paper's numbers with parabolas.

    Drawn from the value of the parabola at g* = 0: Δκ* as in the tables has the error of the one
    state g = 0 in all points.
    """
    for ax, combination in zip(axes.ravel(), COMBINATIONS, strict=True):
        ours, paper = data.effects[combination], effect.table(combination)
        fit, other = data.responses[combination], effect.paper_response(combination)
        look = {"fmt": MARKERS[combination], "ms": 5, "capsize": 2}
        value = paper["kappa_star"] - other["kappa_star"].value
        error, label = effect.scatter(combination, "kappa_star"), "paper (scatter)"
        ax.errorbar(
            paper["reduced_gravity"], value, error, color="0.6", mfc="none", label=label, **look
        )
        value = ours["kappa_star"].value - fit["kappa_star"].value
        strength, error = ours["reduced_gravity"].value, ours["kappa_star"].error
        shade = {"color": SHADES[combination], "label": "jdsmc (1 s.e.)"}
        ax.errorbar(strength, value, error, **look, **shade)
        gradient = float(fit["reduced_gradient"])
        for one, colour, whose in ((fit, SHADES[combination], ""), (other, "0.6", "paper's ")):
            line = float(one["B"]) * gradient * FINE + float(one["C"]) * FINE**2
            ax.plot(FINE, line, color=colour, lw=1, label=f"{whose}B = {one['B']}")
        ax.axhline(0, color="0.8", lw=0.8, zorder=0)
        ax.axvline(0, color="0.8", lw=0.8, zorder=0)
        ax.set_title(f"{combination.label}, ε0 = {gradient:.2f}", fontsize=10)
        ax.legend(fontsize=8, loc="upper left")
        ax.set(xlim=(-0.115, 0.105), ylim=(-0.1, 0.16), xticks=(-0.1, -0.05, 0, 0.05, 0.1))
    for ax in axes[1]:
        ax.set_xlabel("g*")
    for ax in axes[:, 0]:
        ax.set_ylabel("κ* - κ*(g = 0) of the parabola")


@PAPER.figure("rows", 1, 5, 13.0, 4.2, sharey=True)
def rows(data: Fourier, axes) -> None:
    """Ours minus the paper's in combined errors, every number of tables 2 to 5."""
    titles = effect.SYMBOLS | {"mean_free_paths": "$\\mathcal{N}(z_0)$"}
    for ax, (name, title) in zip(axes[0], titles.items(), strict=True):
        for c in COMBINATIONS:
            cells = [(row.gravity, row.cells[name].distance) for row in effect.rows(data, c)]
            known = np.array([cell for cell in cells if cell[1] is not None], float)
            look = {"color": SHADES[c], "marker": MARKERS[c], "ms": 5, "label": c.label}
            ax.plot(*known.T, linestyle="none", mfc="none", **look)
        ax.axhspan(-effect.AGREEMENT, effect.AGREEMENT, color="0.93", zorder=0)
        ax.set(xlabel="g", title=title)
    axes[0, 0].set_ylabel("(ours - paper) / combined error")
    axes[0, 0].legend(fontsize=7)
