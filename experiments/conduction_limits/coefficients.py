"""Conductivity and temperature jump from the bulk of a slab, at two gradients and none.

In the bulk T^{1+ω} is a straight line in z (κ ∝ T^ω, heat flux uniform). Its slope gives the
conductivity over the first Sonine approximation; its values at the walls give the jumps. The jump
coefficient is (T - T_wall)/(λ dT/dn), λ = 1/(√2 π n σ²) with the density that the bulk has, carried
on to the wall; corrections of first order in the gradient have opposite signs at the two walls and
drop out of their mean.

Hard spheres: κ over its first Sonine approximation is 1.025218, and the jump at a Maxwell wall is
2.4001 (√π/2) λ dT/dn (Sone, Ohwada and Aoki 1989, k = (√π/2) λ), or 1.89 μ v0/p dT/dn. Maxwell
molecules, whose conductivity is known exactly: 1.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np

from jdsmc import Estimate, InelasticHardSpheres, MaxwellMolecules, Result
from jdsmc.measure import conduction
from jdsmc.scenarios import FourierFlow
from jdsmc.stats import jackknife
from jdsmc.theory import sonine_elastic
from jdsmc.units import CONVERGED_ORDER

from ..case import Case, Measurements
from ..markdown import grid
from ..paper import Paper

JUMP = 2.4001 * math.sqrt(math.pi) / 2.0
CONDUCTIVITY = sonine_elastic.conductivity_ratio(CONVERGED_ORDER)
GASES = {
    "hard spheres": (InelasticHardSpheres(1.0), CONDUCTIVITY, f"{JUMP:.3f}"),
    "Maxwell molecules": (MaxwellMolecules(), 1.0, ""),
}
"""Gas, its conductivity and its jump at a wall."""

COLD, LENGTH = np.array([0.25, 0.5]), 20.0
"""Layers of λ0/8: their error of κ, (32/225π)(Δz/λ)² (Alexander, Garcia and Alder 1998), is 0.07%
at the mean density; it is taken off, as is that of the time step (Hadjiconstantinou 2000)."""

BULK = (0.25, 0.75)
"""The part of the slab taken as bulk: five mean free paths off both walls at L = 20."""

COLUMNS = {
    "conductivity": "κ/κ0",
    "jump_cold": "jump, cold",
    "jump_hot": "jump, hot",
    "jump": "mean jump",
}


def measure(size, folder: Path, fresh: bool) -> Measurements:
    """Each gas between walls at each of the temperatures `COLD`."""
    cases, layers = [], round(size.per_length * LENGTH)
    for name, (gas, *_) in GASES.items():
        scene = FourierFlow(gas=gas, cold_temperature=COLD, length=LENGTH, layers=layers)
        cases.append(Case(name.replace(" ", "_"), scene, {"steps_per_record": 8, **size.options}))
    return Measurements(size, cases, folder, fresh)


PAPER = Paper("conduction_limits", measure)


def coefficients(result: Result) -> dict[str, Estimate]:
    """Every coefficient and the mean ln T gradient, arrays over the wall temperatures."""
    data = result.to_xarray()["realizations"].to_dataset()
    scene: Any = result.scene()
    exponent = 1.0 - 0.5 * scene.gas.speed_exponent()
    share = data["z"].values / LENGTH
    bulk = (share > BULK[0]) & (share < BULK[1])
    walls = ("mean_heat_flux", "heat_flux_cold_wall", "heat_flux_hot_wall")
    names = ("density", "pressure", "pressure_zz", "heat_flux", *walls)
    means = {n: data[n].transpose("cold_temperature", "realization", ...).values for n in names}

    def of(averages):
        profile = conduction.profiles(averages)
        power = profile["temperature"][:, bulk] ** (1.0 + exponent)
        pressure = np.mean(profile["pressure"][:, bulk], axis=-1)
        slope, level = np.polyfit(share[bulk] - 0.5, power.T, 1)
        flux = np.mean([profile[n] for n in walls], axis=0)

        def jump(side: int, wall):
            """(T - T_wall)/(λ dT/dn), n pointing into the gas; T^{1+ω} is carried to the wall."""
            temperature = (level + side * slope / 2) ** (1.0 / (1.0 + exponent))
            gradient = slope / LENGTH / (1.0 + exponent) / temperature**exponent
            return -side * (temperature - wall) * 2.0 * pressure / temperature / gradient

        cold, hot = jump(-1, COLD), jump(1, np.ones_like(COLD))
        return {
            "conductivity": -flux * (1.0 + exponent) * LENGTH / (conduction.CONDUCTIVITY * slope),
            "jump_cold": cold,
            "jump_hot": hot,
            "jump": 0.5 * (cold + hot),
            "mean_gradient": slope / LENGTH / (1.0 + exponent) / level,
        }

    value, error, _ = jackknife(means, of, axis=1)
    return {name: Estimate(value[name], error[name]) for name in value}


def small_gradient_limit(gradient, found: Estimate) -> Estimate:
    """The value at ε = 0 of two independent values, taken as linear in ε²."""
    first, second = np.asarray(gradient) ** 2
    return (first * found[1] - second * found[0]) / (first - second)


def discretization(density, temperature, width: float, step: float):
    """Relative error of κ: (32/225π)(Δz/λ)² + (64/675π)(v0 dt/λ)², λ and v0 those of n and T.

    Alexander, Garcia and Alder (1998) for layers, Hadjiconstantinou (2000) for time steps.
    """
    layers = 32.0 / (225.0 * np.pi) * (width * density) ** 2
    return layers + 64.0 / (675.0 * np.pi) * temperature * (step * density) ** 2


def _correction(result: Result) -> np.ndarray:
    """1 + the relative error of κ, in the middle of the slab."""
    layers = result.steady.sizes["z"]
    middle = result.steady.isel(z=layers // 2)
    state = middle["density"].values, middle["temperature"].values
    return 1.0 + discretization(*state, LENGTH / layers, result.attrs["time_step"])


def rows(data: Measurements) -> list[str]:
    """One row a wall temperature, and the limit of both."""
    rows = []
    for (name, (_, expected, jump)), result in zip(
        GASES.items(), data.results.values(), strict=True
    ):
        found = coefficients(result)
        if name == "hard spheres":
            found["conductivity"] = found["conductivity"] / _correction(result)
        gradient = 0.94 * found["mean_gradient"].value
        points = [(f"{c:g}", f"{g:.3f}") for c, g in zip(COLD, gradient, strict=True)]
        values = [{n: found[n][k] for n in COLUMNS} for k in range(len(COLD))]
        values.append({n: small_gradient_limit(gradient, found[n]) for n in COLUMNS})
        for point, (ratio, *jumps) in zip(
            [*points, ("", "0")], (v.values() for v in values), strict=True
        ):
            rows.append([name, *point, ratio, f"{expected:.6f}", *jumps, jump])
    first, *others = COLUMNS.values()
    return grid(["gas", "T_-/T_+", "ε", first, "expected", *others, "expected"], rows)


PAPER.tables["rows"] = rows
