"""Figures 2 to 7; the rows of tables 2 to 5; the balance laws, the error budget, eq. (6)."""

import numpy as np

from jdsmc import Estimate
from jdsmc.results.gravity_effect import points as at_equal_gradient

from ..case import estimate
from ..numbers import over_parts
from ..style import COLOURS, OPEN, band
from . import balance as laws
from . import effect, profiles
from .cases import COLDEST, COMBINATIONS, EXAMPLE, EXAMPLE_GRAVITY, FIGURE_6
from .data import PAPER, Fourier, share

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


TOGETHER = 4
"""Layers drawn as one; the error is that of a single one: neighbours are correlated."""


@PAPER.figure("balance", 1, 3, 14.0, 4.2)
def balance(data: Fourier, axes) -> None:
    """What should be uniform by (12) and (13), less its mean over the slab."""
    titles = (laws.momentum, "(12): $P_{zz} + g\\int n\\,dz$"), (laws.energy, "(13): $q_z$")
    for ax, (test, title) in zip(axes[0], titles, strict=False):
        for gravity, colour in GRAVITY_COLOURS.items():
            state = data.realizations(EXAMPLE, gravity)
            result = test(state)
            value, error = result.deviation
            curve = Estimate(_coarse(value), _coarse(error**2) ** 0.5)
            label = f"g = {gravity:g}: probability {result.probability:.2f}"
            band(ax, _coarse(share(state)[-len(value) :]), curve, colour, label=label)
        ax.axhline(0, color="0.5", lw=0.8)
        ax.set(xlabel="z/L", title=f"{title}, less its mean", xlim=(0, 1))
        ax.legend(fontsize=7)
    _thick_layers(axes[0, 2], data)


def _thick_layers(ax, data: Fourier) -> None:
    """q_z carried in layers that are not thin at the cold wall, beside the known cell error."""
    for combination, colour in zip((EXAMPLE, COLDEST), COLOURS, strict=False):
        for gravity, marker in ((0.0, "o"), (max(data.gravity[combination]), "s")):
            state = data.realizations(combination, gravity)
            ratio = state["heat_flux"].values / state["mean_heat_flux"].values[:, None]
            thick = laws.thickness(state)
            shown = thick > 0.25
            look = OPEN | {"fmt": marker, "ms": 4, "color": colour}
            look["label"] = f"{combination.label}, g = {gravity:g}"
            del look["markersize"]
            ax.errorbar(thick[shown] ** 2, *over_parts(ratio)[shown], **look)
    line = np.linspace(0, 1.05 * ax.get_xlim()[1], 50)
    ax.plot(line, 1 / (1 + laws.CELL * line), "k-", lw=1, label="1/(1 + 32/225π (Δz/λ')²)")
    ax.set(xlabel="(Δz/λ')²", title="$q_z$ (24) over its mean: layers at the cold wall")
    ax.legend(fontsize=7)


def _coarse(values: np.ndarray) -> np.ndarray:
    """Means of `TOGETHER` layers, the incomplete group at the cold wall left out."""
    return values[len(values) % TOGETHER :].reshape(-1, TOGETHER).mean(axis=1)


@PAPER.figure("budget", 1, 2, 10.0, 4.4)
def budget(data: Fourier, axes) -> None:
    """κ* and Δκ* with other windows and other numerics."""
    entries = [*profiles.windows(data), *profiles.variants(data)[1:]]
    names, labels = list(entries[0].values), [entry.label for entry in entries]
    for ax, name in zip(axes[0], names, strict=True):
        for k, entry in enumerate(entries):
            colour = COLOURS[1] if entry.changes else COLOURS[0]
            ax.errorbar(k, *entry.values[name], fmt="o", capsize=3, color=colour, mfc="none")
        default = next(e for e in entries if not e.changes).values[name].value
        ax.axhline(default, color="0.8", lw=0.8, zorder=0)
        ax.set_xticks(range(len(labels)), labels, rotation=30, ha="right", fontsize=8)
        ax.set(title=f"{name}, {EXAMPLE.label}")


@PAPER.figure("maxwell_molecules", 1, 2, 11.0, 4.4)
def maxwell_molecules(data: Fourier, axes) -> None:
    """κ* across the slab at g = 0, and Δκ* against g* beside eq. (6)."""
    for (length, result), colour in zip(data.molecules.items(), COLOURS, strict=False):
        band(axes[0, 0], *profiles.molecular_profile(result), colour, label=f"L = {length:g}")
        there = at_equal_gradient(result, profiles.MAXWELL_WINDOW * length)
        strength, gradient = there["reduced_gravity"].value, there["reduced_gradient"].value
        start = float(gradient[int(np.argmin(np.abs(result.steady["gravity"].values)))])
        look = {"fmt": "o", "ms": 5, "capsize": 2, "color": colour}
        look["label"] = f"L = {length:g}, ε0 = {start:.3f}"
        axes[0, 1].errorbar(strength, *there["kappa_star_change"], **look)
        line = np.linspace(1.15 * np.nanmin(strength), 1.15 * np.nanmax(strength), 60)
        axes[0, 1].plot(line, profiles.prediction(start, line) - 1, color=colour, lw=1)
    axes[0, 0].axhline(1, color="k", lw=0.8)
    axes[0, 0].set(xlabel="$\\mathcal{N}(z)/L$: mean free paths from the cold wall")
    axes[0, 0].set(ylabel="κ* at g = 0", ylim=(0.85, 1.15), xlim=(0, 1))
    axes[0, 0].set_title("exact in the bulk: 1")
    axes[0, 0].legend(fontsize=8)
    axes[0, 1].set(xlabel="g*", ylabel="Δκ*", title="lines: eq. (6)")
    axes[0, 1].legend(fontsize=8)
