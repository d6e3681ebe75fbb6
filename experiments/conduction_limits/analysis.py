"""Conductivity and temperature jump from the bulk of a slab.

In the bulk T^{1+ω} is a straight line in z (κ ∝ T^ω, heat flux uniform). Its slope gives the
conductivity over the first Sonine approximation; its values at the walls give the jumps. The jump
coefficient is (T - T_wall)/(λ dT/dn), λ = 1/(√2 π n σ²) with the density that the bulk has, carried
on to the wall; corrections of first order in the gradient have opposite signs at the two walls and
drop out of their mean.
"""

import numpy as np

from jdsmc import conduction
from jdsmc.stats import jackknife

BULK = (0.25, 0.75)
"""The part of the slab taken as bulk: five mean free paths off both walls at L = 20."""


def coefficients(result) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Value and error of each coefficient, over the swept wall temperatures."""
    data = result.to_xarray()["realizations"].to_dataset()
    cold, attrs = data["cold_temperature"].values, result.attrs
    length, exponent = attrs["parameter_length"], attrs["viscosity_exponent"]
    share = data["z"].values / length
    bulk = (share > BULK[0]) & (share < BULK[1])
    names = ("density", "pressure", "pressure_zz", "heat_flux", "mean_heat_flux")
    names = (*names, "heat_flux_cold_wall", "heat_flux_hot_wall")
    means = {
        name: data[name].transpose("cold_temperature", "realization", ...).values for name in names
    }

    def of(averages):
        profile = conduction.profiles(averages)
        power = profile["temperature"][:, bulk] ** (1.0 + exponent)
        pressure = np.mean(profile["pressure"][:, bulk], axis=-1)
        slope, level = np.polyfit(share[bulk] - 0.5, power.T, 1)
        flux = np.mean([profile[n] for n in names[4:]], axis=0)
        ratio = -flux * (1.0 + exponent) * length / (conduction.CONDUCTIVITY * slope)
        jumps = [
            _jump(level + side * slope / 2, slope / length, wall, side, exponent, pressure)
            for side, wall in ((-1, cold), (1, np.ones_like(cold)))
        ]
        return {
            "conductivity": ratio,
            "jump_cold": jumps[0],
            "jump_hot": jumps[1],
            "jump": np.mean(jumps, axis=0),
            "mean_gradient": slope / length / (1.0 + exponent) / level,
        }

    value, error = jackknife(means, of, axis=1)
    return {name: (value[name], error[name]) for name in value}


def _jump(power, slope, wall, side: int, exponent: float, pressure):
    """(T - T_wall)/(λ dT/dn), n pointing into the gas; `power` is T^{1+ω} carried to the wall."""
    temperature = power ** (1.0 / (1.0 + exponent))
    gradient = slope / (1.0 + exponent) / temperature**exponent
    density = 2.0 * pressure / temperature
    return -side * (temperature - wall) * density / gradient


def small_gradient_limit(gradient, value, error) -> tuple[float, float]:
    """Value and error at ε = 0 of two independent values, taken as linear in ε²."""
    first, second = gradient**2
    weight = np.array([-second, first]) / (first - second)
    return float(weight @ value), float(np.hypot(*(weight * error)))


def discretization(density, temperature, width: float, step: float):
    """Relative error of κ: (32/225π)(Δz/λ)² + (64/675π)(v0 dt/λ)², λ and v0 those of n and T.

    Alexander, Garcia and Alder (1998) for layers, Hadjiconstantinou (2000) for time steps.
    """
    layers = 32.0 / (225.0 * np.pi) * (width * density) ** 2
    return layers + 64.0 / (675.0 * np.pi) * temperature * (step * density) ** 2
