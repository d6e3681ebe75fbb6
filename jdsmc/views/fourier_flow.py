"""Heat conduction under gravity: profiles between the walls, κ* and what gravity does to it."""

import numpy as np
import xarray as xr

from . import common, generic, pictures, velocities
from .page import Page

PROFILES = ("temperature", "density", "kappa_star", "pressure", "heat_flux")
NEEDS = {*PROFILES, "mean_heat_flux", "pressure_zz", "mean_free_paths", "reduced_gradient"}
FLUXES = ("mean_heat_flux", "heat_flux_cold_wall", "heat_flux_hot_wall")
FLUX_NAMES = ("mean over the slab", "at the cold wall", "at the hot wall")


def page(result) -> Page:
    """Fluxes, and the state at the walls and halfway (in mean free paths) between them."""
    if not result.is_steady:
        return generic.page(result)
    steady = result.steady
    if not common.dimensions(result):
        return generic.page(result, middle={"z": halfway(steady)})

    def layer(name, index):
        return lambda here: common.estimate(here, name, index)

    def middle(name):
        return lambda here: common.estimate(here, name, halfway(here))

    columns = generic.of_observables(steady, ["mean_heat_flux"]) | {
        "T cold wall": layer("temperature", 0),
        "T hot wall": layer("temperature", -1),
        "κ* halfway": middle("kappa_star"),
        "ε halfway": middle("reduced_gradient"),
        "g* halfway": middle("reduced_gravity"),
    }
    return generic.page(result, columns=columns)


def halfway(here: xr.Dataset) -> int:
    """The layer halfway in mean free paths."""
    crossed = here["mean_free_paths"].values
    return int(np.searchsorted(crossed, 0.5 * crossed[-1]))


def draw(result):
    """Profiles; fluxes against time, or for a sweep q and κ* against what was swept."""
    steady, dims = result.steady, common.dimensions(result)
    if not result.is_steady:
        figure, panels = pictures.grid(1)
        pictures.against_time(panels[0], result, "mean_heat_flux")
        return pictures.finish(figure, panels, common.title(result, "Fourier flow"))
    x = pictures.across(steady, dims)
    sampled = velocities.sampled(result) is not None
    figure, panels = pictures.grid((7 if x else 6) + sampled, 4, 3.7)
    for panel, name in zip(panels, PROFILES, strict=False):
        pictures.profile(panel, steady, dims, name)
        panel.set_xlabel(f"{common.with_unit(steady, 'z', 'z')}, cold wall at 0")
    pictures.walls(panels[0], result, dims, "cold_temperature", lambda cold: [cold, 1.0])
    pictures.readable_log(panels[1], steady["density"].values)
    pictures.profile(panels[3], steady, dims, "pressure_zz", label=False, ls="--")
    panels[3].set_xlabel(f"{common.with_unit(steady, 'z', 'z')}, cold wall at 0")
    panels[3].autoscale()
    panels[3].plot([], [], "k-", lw=1.2, label="p")
    panels[3].plot([], [], "k--", lw=1.2, label="P_zz")
    panels[3].set_ylabel(common.with_unit(steady, "pressure", "pressures"))
    if x:
        pictures.against_sweep(panels[5], steady, dims, x, "mean_heat_flux")
        _conductivity(panels[6], steady, dims, x)
    else:
        pictures.together(panels[5], result, FLUXES, FLUX_NAMES)
    if sampled:
        velocities.draw(panels[-1], result, "velocity")
    return pictures.finish(figure, panels, common.title(result, "Fourier flow"))


def _conductivity(panel, steady: xr.Dataset, dims, x: str) -> None:
    """κ* halfway (in mean free paths) between the walls."""
    others = [d for d in dims if d != x]
    values = steady[x].values
    for number, point in enumerate(common.points(steady, others)):
        row = [steady.isel(point | {x: k}) for k in range(len(values))]
        value, error = (
            np.array([float(one[key].values[halfway(one)]) for one in row])
            for key in ("kappa_star", "kappa_star_error")
        )
        style = {} if others else {"color": "k"}
        pictures.bars(panel, values, value, error, number, common.label(steady, point), **style)
    panel.set(xlabel=common.with_unit(steady, x), ylabel="κ* halfway, in mean free paths")
