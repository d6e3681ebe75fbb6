"""The picture of the convergence study: what was measured against each numerical parameter."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

BOUND = 0.3
"""Percent of the heat flux that the defaults may be off."""

SHIFT = 4e-4
"""Of time steps, so that error bars do not cover each other."""


def relative(one: tuple[float, float], reference: float) -> tuple[float, float]:
    """Difference from the reference in percent, and its error (that of `one`)."""
    return 100 * (one[0] / reference - 1), 100 * abs(one[1] / reference)


def draw(found: list, length: float) -> Figure:
    """Three panels: against dt, layer width, and particles per layer; `found`: all `Measured`."""
    figure, panels = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
    reference = found[0].walls[0]
    _against_time_step(panels[0], found, reference)
    layers = _of(found, "layers")
    width = np.array([length / one.setting.layers for one in layers])
    _points(panels[1], width, layers, "walls", reference, fmt="s", mfc="none", label="walls")
    order = np.argsort(width)
    law = 100 * (np.array([one.law for one in layers]) - layers[0].law)
    panels[1].plot(width[order], law[order], "k-", lw=1, label="(32/225π)⟨(Δz/λ)²⟩")
    crowd = _of(found, "particles")
    number = np.array([one.setting.particles / one.setting.layers for one in crowd])
    _points(panels[2], number, crowd, "walls", reference, fmt="s", mfc="none", label="walls")
    panels[2].set_xscale("log")
    for panel, label in zip(panels, ("dt/τ0", "Δz/λ0", "particles per layer"), strict=True):
        panel.axhspan(-BOUND, BOUND, color="0.9", zorder=0)
        panel.axhline(0, color="0.6", lw=0.8)
        panel.set_xlabel(label)
        panel.legend(fontsize=8, frameon=False)
    panels[0].set_ylabel("heat flux, % off the default (walls)")
    return figure


def _of(found: list, study: str, splitting: str = "strang") -> list:
    """The settings of a study, the defaults among them."""
    wanted = ("defaults", study)
    return [
        one for one in found if one.setting.study in wanted and one.setting.splitting == splitting
    ]


def _against_time_step(panel, found: list, reference: float) -> None:
    """Both splittings; a line through what first order leaves in the sampled heat flux."""
    for splitting, colours, side in (("strang", ("C0", "C2"), -1), ("lie", ("C1", "C3"), 1)):
        chosen = _of(found, "time step", splitting)
        step = np.array([one.step for one in chosen])
        for values, marker, colour in zip(("walls", "sampled"), "so", colours, strict=True):
            style = {"fmt": marker, "color": colour, "label": f"{splitting.title()}, {values}"}
            style["mfc"] = None if splitting == "strang" else "none"
            off = _points(panel, step + side * SHIFT, chosen, values, reference, **style)
    slope = np.sum(step * off) / np.sum(step**2)  # of the last: Lie, sampled
    panel.plot([0.0, step.max()], [0.0, slope * step.max()], "C3:", lw=1, label="first order")
    panel.set_xlim(left=0)


def _points(panel, x: np.ndarray, chosen: list, values: str, reference: float, **style):
    """Points with error bars; returns the values drawn, in percent."""
    y, error = np.array([relative(getattr(one, values), reference) for one in chosen]).T
    panel.errorbar(x, y, error, capsize=2, ms=5, **style)
    return y
