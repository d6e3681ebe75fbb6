"""Results without simulation: the kinetic model in the place of the elastic gas, with noise."""

import json

import numpy as np
import xarray as xr

from jdsmc import ElasticHardSpheres, Estimate, Result
from jdsmc.fit import elastic_sweep
from jdsmc.running.provenance import specification
from jdsmc.scenarios import UniformShear
from jdsmc.units import COOLING, VISCOSITY_TIME

REALIZATIONS = 8


def kinetic(alpha, beta, drag=1.0) -> dict[str, np.ndarray]:
    """Steady values of the kinetic model of a gas with c = d ζ0 and ν = β/τ_η: closed forms.

    The moment equations of `jdsmc.theory.bgk_shear_flow` at rest, z = ζ/ν.
    """
    z = drag * COOLING * (1.0 - np.asarray(alpha) ** 2) * VISCOSITY_TIME / beta
    root = np.sqrt(1.5 * z)
    return {
        "shear_stress": root / (1.0 + z),
        "reduced_shear_rate": beta * root * (1.0 + z),
        "reduced_viscosity": 1.0 / (beta * (1.0 + z) ** 2),
        "normal_stress_xy": 3.0 * z / (1.0 + z),
    }


def measured(values: dict[str, np.ndarray], noise: float, rng) -> dict[str, np.ndarray]:
    """Realizations (R, points) that scatter by a relative error `noise` of their mean.

    Stress and shear rate scatter in opposite ways, as their product is the cooling.
    """
    size = noise * np.sqrt(REALIZATIONS)
    common = rng.standard_normal((REALIZATIONS, *np.shape(values["shear_stress"])))
    signs = {"reduced_shear_rate": -1.0}
    found = {}
    for name, value in values.items():
        own = 0.3 * rng.standard_normal(common.shape)
        found[name] = value * (1.0 + size * (signs.get(name, 1.0) * common + own))
    return found


def estimates(realizations: dict[str, np.ndarray], run: str) -> dict[str, Estimate]:
    """Means with errors that know the realizations, as a run gives them."""
    found = {}
    for name, values in realizations.items():
        count = len(values)
        left_out = (np.sum(values, axis=0) - values) / (count - 1)
        error = np.sqrt((count - 1) * np.var(left_out, axis=0))
        found[name] = Estimate(np.mean(values, axis=0), error, {(run, ""): left_out})
    return found


def sweep(alpha, noise: float, rng, drag: str = "local") -> Result:
    """What `jdsmc.run(elastic_sweep(model, alpha))` would be if the gas were the kinetic model."""
    scene = elastic_sweep(UniformShear(ElasticHardSpheres(alpha, drag=drag), 4.0))
    gas = scene.gas
    truth = kinetic(gas.restitution, gas.rate_factor, gas.drag_factor)
    data = xr.Dataset(coords={"drag_factor": gas.drag_factor})
    left = xr.Dataset(coords=data.coords)
    for name, one in estimates(measured(truth, noise, rng), "sweep").items():
        (out,) = one._left_out.values()
        data[name], data[f"{name}_error"] = (("drag_factor", x) for x in one)
        left[name] = ("realization", "drag_factor"), out
    data.attrs = {
        "specification": json.dumps(specification(scene)),
        "run": "sweep",
        "jdsmc_version": "0",
        "swept": "drag_factor",
        "stopped": "nothing was run",
    }
    return Result(xr.DataTree.from_dict({"/": data, "/left_out": left, "/series": xr.Dataset()}))
