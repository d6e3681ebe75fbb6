"""The balance laws (12) and (13), layer by layer and at the walls.

Neighbouring layers hold some of the same particles at different times: their errors are correlated
over many layers. A profile that should be uniform is therefore tested with Q, the mean over the
layers of (deviation from its mean / standard error)², against its distribution if the sign of the
deviations of every realization is drawn at random: a deviation that all realizations share makes Q
larger than that. This is exact whatever the correlations, as realizations are independent.

Partners of a collision may be Δz apart, and what they exchange crosses the layer without flight.
The fluxes (23) and (24) do not see this part. Of the heat flux it is (32/225π)(Δz/λ')² of what they
see, the known cell error of κ to leading order. At the cold wall λ' = 1/n is as short as the
paper's Δz, or shorter; such layers are left out.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

from jdsmc import Estimate

from ..numbers import over_parts

CELL = 32.0 / (225.0 * np.pi)
"""Heat that is exchanged across a layer of thickness λ', over the heat that is carried."""

THIN = 0.5
"""Δz/λ' of the thickest layers that are tested."""

FLIPS = 4096
"""Random signs: all of them for up to 13 realizations."""


class Uniformity(NamedTuple):
    """Test of a profile that should be uniform.

    `statistic`: Q, `expected`: its mean if it is uniform; `probability`: of a Q as large;
    `deviation` from the mean over the layers.
    """

    statistic: float
    expected: float
    probability: float
    deviation: Estimate


def uniformity(profile: np.ndarray) -> Uniformity:
    """Test a profile (realizations, layers)."""
    from_mean = profile - np.mean(profile, axis=1, keepdims=True)
    flipped = np.array([_statistic(s[:, None] * from_mean) for s in _signs(len(profile))])
    observed = _statistic(from_mean)
    probability = float(np.mean(flipped >= observed * (1 - 1e-9)))
    return Uniformity(observed, float(np.mean(flipped)), probability, over_parts(from_mean))


def _statistic(deviations: np.ndarray) -> float:
    error = np.std(deviations, axis=0, ddof=1) / np.sqrt(len(deviations))
    return float(np.mean((np.mean(deviations, axis=0) / error) ** 2))


def _signs(count: int) -> np.ndarray:
    """All choices of signs up to a common one, or `FLIPS` random ones with the trivial one."""
    if 2 ** (count - 1) <= FLIPS:
        bits = np.arange(2 ** (count - 1))[:, None] >> np.arange(count)
        return 1.0 - 2.0 * (bits & 1)
    signs = np.random.default_rng(1).choice([-1.0, 1.0], (FLIPS, count))
    signs[0] = 1.0
    return signs


def energy(realizations: xr.Dataset, thin: bool = True) -> Uniformity:
    """(13): the heat flux is uniform. In `thin` layers with what is exchanged across them, or in
    all layers as it is carried."""
    flux = realizations["heat_flux"].values
    if not thin:
        return uniformity(flux)
    thick = thickness(realizations)
    return uniformity((flux * (1.0 + CELL * thick**2))[:, thick <= THIN])


def thickness(realizations: xr.Dataset) -> np.ndarray:
    """Δz/λ' of each layer."""
    z = realizations["z"].values
    return np.mean(realizations["density"].values, axis=0) * (z[1] - z[0])


def momentum(realizations: xr.Dataset, thin: bool = True) -> Uniformity:
    """(12), integrated: P_zz + g ∫n dz is uniform (n̄ m v0²), in all layers or the `thin` ones."""
    density, z = realizations["density"].values, realizations["z"].values
    below = (np.cumsum(density, axis=1) - 0.5 * density) * (z[1] - z[0])
    both = realizations["pressure_zz"].values + float(realizations["gravity"]) * below
    return uniformity(both[:, thickness(realizations) <= THIN] if thin else both)


def slope(realizations: xr.Dataset) -> Estimate:
    """Σ ΔP_zz/Δz over -g Σ n between neighbouring thin layers, weighted with n: (12) says 1."""
    gravity, z = float(realizations["gravity"]), realizations["z"].values
    thin = thickness(realizations) <= THIN
    density, stress = (realizations[n].values[:, thin] for n in ("density", "pressure_zz"))
    between = 0.5 * (density[:, 1:] + density[:, :-1])
    weight = np.mean(between, axis=0)
    gain = np.diff(stress, axis=1) / (z[1] - z[0])
    return over_parts(
        np.sum(weight * gain, axis=1) / (-gravity * np.sum(weight * np.mean(between, axis=0)))
    )


def walls(realizations: xr.Dataset) -> dict[str, Estimate]:
    """Heat flux through the gas, and at each wall minus that: realization by realization."""
    gas = realizations["mean_heat_flux"].values
    sides = {side: realizations[f"heat_flux_{side}_wall"].values for side in ("cold", "hot")}
    return {"gas": over_parts(gas)} | {s: over_parts(flux - gas) for s, flux in sides.items()}
