"""The numbers of a calibrated gas against restitution, a curve a target."""

import numpy as np

from ..gases.hard_spheres import RATE_FACTORS
from . import common, generic, pictures
from .page import Page

NEEDS: set[str] = {"rate_factor"}
CHOICES = {"(1+α)/2": ("linear", "k:"), "(1+α)(2+α)/6": ("viscosity", "k--")}
"""β of Astillero and Santos (2005), by their names in `RATE_FACTORS`."""


def page(result) -> Page:
    """One row for each restitution and target."""
    return generic.page(result)


def draw(result):
    """β beside what the paper takes, the drag factor and the misfit if there are any."""
    steady, dims = result.steady, common.dimensions(result)
    if "restitution" not in dims:
        return generic.draw(result)
    names = [n for n in common.names(steady) if n != "misfit" or np.nanmax(steady[n].values) > 0]
    figure, panels = pictures.grid(len(names))
    for panel, name in zip(panels, names, strict=True):
        pictures.against_sweep(panel, steady, dims, "restitution", name)
    alpha = steady["restitution"].values
    fine = np.linspace(np.min(alpha), np.max(alpha), 100)
    for label, (name, look) in CHOICES.items():
        panel = panels[names.index("rate_factor")]
        panel.plot(fine, RATE_FACTORS[name](fine), look, lw=1.2, label=label)
    return pictures.finish(figure, panels, common.title(result))
