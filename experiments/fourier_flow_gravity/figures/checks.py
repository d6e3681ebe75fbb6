"""The balance laws, the error budget, and Maxwell molecules."""

import numpy as np
from matplotlib.figure import Figure

from ...style import COLOURS, band, figure
from .. import balance as laws
from .. import budget as study
from .. import molecules
from ..data import Measurements
from ..systems import COLDEST, EXAMPLE, EXAMPLE_GRAVITY
from .profiles import GRAVITY_COLOURS


def balance(data: Measurements) -> Figure:
    """What should be uniform by (12) and (13), less its mean over the slab."""
    found, axes = figure(1, 3, 14.0, 4.2)
    titles = (laws.momentum, "(12): $P_{zz} + g\\int n\\,dz$"), (laws.energy, "(13): $q_z$")
    for ax, (test, title) in zip(axes[0], titles, strict=False):
        for gravity in EXAMPLE_GRAVITY:
            state = data.realizations(EXAMPLE, gravity)
            result = test(state)
            share = _share(state)[-len(result.deviation) :]
            value, error = _coarse(result.deviation), _coarse(result.error**2) ** 0.5
            band(ax, _coarse(share), value, error, color=GRAVITY_COLOURS[gravity])
            label = f"g = {gravity:g}: probability {result.probability:.2f}"
            ax.plot([], [], color=GRAVITY_COLOURS[gravity], label=label)
        ax.axhline(0, color="0.5", lw=0.8)
        ax.set(xlabel="z/L", title=f"{title}, less its mean", xlim=(0, 1))
        ax.legend(fontsize=7)
    _thick_layers(axes[0, 2], data)
    return found


def _thick_layers(ax, data: Measurements) -> None:
    """q_z carried in layers that are not thin at the cold wall, beside the known cell error."""
    for combination, colour in zip((EXAMPLE, COLDEST), COLOURS, strict=False):
        for gravity, marker in ((0.0, "o"), (max(data.size.gravity[combination]), "s")):
            state = data.realizations(combination, gravity)
            flux = state["heat_flux"].transpose("realization", "z").values
            ratio = flux / state["mean_heat_flux"].values[:, None]
            thick = laws.thickness(state)
            shown = thick > 0.25
            value = np.mean(ratio, axis=0)[shown]
            error = (np.std(ratio, axis=0, ddof=1) / np.sqrt(len(ratio)))[shown]
            style = {"fmt": marker, "ms": 4, "capsize": 2, "mfc": "none", "color": colour}
            label = f"{combination.label}, g = {gravity:g}"
            ax.errorbar(thick[shown] ** 2, value, error, label=label, **style)
    line = np.linspace(0, 1.05 * ax.get_xlim()[1], 50)
    ax.plot(line, 1 / (1 + laws.CELL * line), "k-", lw=1, label="1/(1 + 32/225π (Δz/λ')²)")
    ax.set(xlabel="(Δz/λ')²", title="$q_z$ (24) over its mean: layers at the cold wall")
    ax.legend(fontsize=7)


def _coarse(values: np.ndarray) -> np.ndarray:
    """Means of `TOGETHER` layers, the incomplete group at the cold wall left out."""
    return values[len(values) % TOGETHER :].reshape(-1, TOGETHER).mean(axis=1)


TOGETHER = 4
"""Layers drawn as one; the error is that of a single one: neighbours are correlated."""


def _share(state) -> np.ndarray:
    """z/L of the layers."""
    z = state["z"].values
    return z / (z[-1] + z[0])


def budget(data: Measurements) -> Figure:
    """κ* and Δκ* with other windows and other numerics."""
    found, axes = figure(1, len(study.QUANTITIES), 10.0, 4.4)
    entries = [*study.windows(data), *study.variants(data)[1:]]
    for ax, name in zip(axes[0], study.QUANTITIES, strict=True):
        for k, entry in enumerate(entries):
            value, error = entry.values[name]
            colour = COLOURS[0] if entry.changes is None else COLOURS[1]
            ax.errorbar(k, value, error, fmt="o", capsize=3, color=colour, mfc="none")
        default = next(e for e in entries if e.changes is None).values[name].value
        ax.axhline(default, color="0.8", lw=0.8, zorder=0)
        labels = [e.label for e in entries]
        ax.set_xticks(range(len(labels)), labels, rotation=30, ha="right", fontsize=8)
        ax.set(title=f"{name}, {EXAMPLE.label}")
    return found


def maxwell_molecules(data: Measurements) -> Figure:
    """κ* across the slab at g = 0, and Δκ* against g* beside eq. (6)."""
    found, axes = figure(1, 2, 11.0, 4.4)
    for (length, result), colour in zip(data.molecules.items(), COLOURS, strict=False):
        crossed, ratio = molecules.profile(result)
        band(axes[0, 0], crossed, *ratio, color=colour)
        axes[0, 0].plot([], [], color=colour, label=f"L = {length:g}")
        gradient, strength, change = molecules.points(result)
        label = f"L = {length:g}, ε0 = {gradient:.3f}"
        axes[0, 1].errorbar(strength, *change, fmt="o", ms=5, capsize=2, color=colour, label=label)
        line = np.linspace(1.15 * strength.min(), 1.15 * strength.max(), 60)
        axes[0, 1].plot(line, molecules.prediction(gradient, line) - 1, color=colour, lw=1)
    axes[0, 0].axhline(1, color="k", lw=0.8)
    axes[0, 0].set(
        xlabel="$\\mathcal{N}(z)/L$: mean free paths from the cold wall", ylabel="κ* at g = 0"
    )
    axes[0, 0].set(ylim=(0.85, 1.15), xlim=(0, 1), title="exact in the bulk: 1")
    axes[0, 0].legend(fontsize=8)
    axes[0, 1].set(xlabel="g*", ylabel="Δκ*", title="lines: eq. (6)")
    axes[0, 1].legend(fontsize=8)
    return found
