"""The labelled result of an impulse-response measurement."""

import numpy as np
import xarray as xr

from .. import grid
from ..assemble import provenance
from ..options import Options
from ..result import Result
from ..stats import jackknife
from .integrals import estimates, with_density
from .response import NavierStokes

DESCRIPTIONS = {
    "modified_conductivity": ("modified thermal conductivity κ'/κ0", "1"),
    "conductivity": ("thermal conductivity κ/κ0", "1"),
    "density_coefficient": ("nμ/(Tκ0)", "1"),
    "viscosity": ("shear viscosity η/η0", "1"),
    "a2": ("fourth cumulant of the samples", "1"),
    "modified_heat_flux": ("-q_x/(εTκ0) after the kick for κ'", "1/τ0"),
    "heat_flux": ("-q_x/(εTκ0) after the kick for κ, without F", "1/τ0"),
    "shear_stress": ("-P_xy/(εη0) after the kick for η, without 1/F", "1/τ0"),
    "growth": ("F = exp(ζs/2)", "1"),
}


def labelled(scene: NavierStokes, options: Options, times, means: dict, attrs: dict) -> Result:
    """Steady values with errors at the root, responses and running integrals in `series`.

    Arguments: the scene as the user made it; times (τ0); averages over the kicks, arrays
    (points, realizations, times) and "a2" (points, realizations).
    """
    _, shape = grid.flatten(scene)
    coords = grid.dimensions(scene)
    dims = tuple(coords)
    running = {name: values for name, values in means.items() if name != "a2"}
    groups = {
        "/": _dataset(estimates(means), shape, dims, coords),
        "/series": _dataset(
            jackknife(running, with_density, axis=1),
            shape,
            (*dims, "time"),
            coords | {"time": times},
        ),
    }
    groups["/series"]["time"].attrs = {"long_name": "reduced time s", "units": "τ0"}
    groups["/"].attrs = provenance(scene, options) | attrs
    return Result(xr.DataTree.from_dict(groups))


def _dataset(pair, shape, dims, coords) -> xr.Dataset:
    data = xr.Dataset(coords=coords)
    for suffix, arrays in zip(("", "_error"), pair, strict=True):
        for name, values in arrays.items():
            full = np.reshape(values, shape + values.shape[1:])
            data[name + suffix] = dims, full, _described(name, suffix)
    return data


def _described(name: str, suffix: str) -> dict:
    long, unit = DESCRIPTIONS.get(name.removesuffix("_tail"), (name, "1"))
    long = f"extrapolated part of {long}" if name.endswith("_tail") else long
    return {"long_name": f"standard error of {long}" if suffix else long, "units": unit}
