"""The balance laws, the error budget, and Maxwell molecules."""

import numpy as np

from jdsmc import Estimate
from jdsmc.results.gravity_effect import points as at_equal_gradient

from ...numbers import over_parts
from ...style import COLOURS, OPEN, band
from .. import balance as laws
from .. import profiles
from ..cases import COLDEST, EXAMPLE
from ..data import PAPER, Fourier, share
from .paper import GRAVITY_COLOURS

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
