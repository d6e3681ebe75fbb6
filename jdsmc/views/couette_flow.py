"""Flow between walls: profiles between them, and the stresses and heat that they tell."""

import numpy as np

from . import common, generic, pictures

PROFILES = ("velocity_x", "temperature", "density", "pressure_xz", "heat_flux")
STRESSES = ("shear_stress_lower_wall", "shear_stress_upper_wall", "shear_stress")
HEAT = ("heat_flux_lower_wall", "heat_flux_upper_wall")
NEEDS = {*PROFILES, *STRESSES, *HEAT, "mean_velocity"}
SIDES = ("at the lower wall", "at the upper wall", "mean over the slab")

page = generic.page


def draw(result):
    """Profiles; stresses against time, or what flows against what was swept."""
    if not result.is_steady:
        return generic.draw(result)
    steady, dims = result.steady, common.dimensions(result)
    x = pictures.across(steady, dims)
    figure, panels = pictures.grid(8 if x else 7, 4, 3.7)
    for panel, name in zip(panels, PROFILES, strict=False):
        pictures.profile(panel, steady, dims, name)
    _walls(panels[0], result, dims, "velocity_x")
    _walls(panels[1], result, dims, "temperature")
    rest = panels[len(PROFILES) :]
    if x:
        names = ("shear_stress", "mean_velocity", "heat_flux_lower_wall")
        for panel, name in zip(rest, names, strict=True):
            pictures.against_sweep(panel, steady, dims, x, name)
    else:
        _against_time(rest[0], result, STRESSES)
        _against_time(rest[1], result, HEAT)
    return pictures.finish(figure, panels, common.title(result, "Flow between walls"))


def _walls(panel, result, dims, name: str) -> None:
    """Crosses at the velocities or the temperatures of the walls."""
    steady = result.steady
    of = "wall_velocity" if name == "velocity_x" else "cold_temperature"
    for number, point in enumerate(pictures.drawn(steady, dims)):
        here = steady.isel(point)
        value = float(common.parameter(result, here, of))
        ends = [-0.5 * value, 0.5 * value] if name == "velocity_x" else [value, 1.0]
        length = float(common.parameter(result, here, "length"))
        if steady["z"].attrs.get("units") == "share of the whole":
            length = 1.0
        color = f"C{number}" if of in dims or "length" in dims else "k"
        style = {"color": color, "ms": 7, "ls": "none", "clip_on": False, "zorder": 5}
        panel.plot([0.0, length], ends, marker="x", label=None if number else "walls", **style)


def _against_time(panel, result, names) -> None:
    """Curves that agree, or mirror each other, once the gas is steady."""
    series = result.series
    for number, (name, text) in enumerate(zip(names, SIDES, strict=False)):
        time, value, error = (np.asarray(series[key]) for key in ("time", name, f"{name}_error"))
        pictures.curve(panel, time, value, error, text, color=f"C{number}", lw=0.9)
    panel.set_xlabel(common.with_unit(series, "time"))
    words = "-P_xz" if names is STRESSES else "q_z"
    panel.set_ylabel(common.with_unit(series, names[0], words))
