"""Heat conduction across a slab: profiles, and their reduced form. On the host, float64.

Tahiri, Tij and Santos (2000), with their units: T in T_+, lengths in λ0, p and P_zz in n̄ (2kT_+),
q in n̄ (2kT_+)^{3/2} m^{-1/2}; z points from the cold to the hot wall and gravity along -z.
"""

import numpy as np

from ..units import CONDUCTIVITY as _IN_V0
from .observable import Observable

CONDUCTIVITY = 0.5 * _IN_V0
"""-q_z/(∂T/∂z) of hard spheres at T_+, T in units of T_+, first approximation: eq. (30)."""

ALONG = ("z",)
OBSERVABLES = (
    Observable("mean_heat_flux", "heat flux averaged over the slab", "n̄ m v0³", symbol="q"),
    Observable(
        "heat_flux_cold_wall", "heat flux from the energy exchanged at the cold wall", "n̄ m v0³"
    ),
    Observable(
        "heat_flux_hot_wall", "heat flux from the energy exchanged at the hot wall", "n̄ m v0³"
    ),
    Observable("temperature", "temperature T/T_+", dims=ALONG, symbol="T/T_+"),
    Observable("density", "density n/n̄", dims=ALONG, symbol="n/n̄"),
    Observable("pressure", "pressure p", "n̄ m v0²", ALONG, "p"),
    Observable("pressure_zz", "pressure P_zz", "n̄ m v0²", ALONG, "P_zz"),
    Observable("heat_flux", "heat flux q_z", "n̄ m v0³", ALONG, "q_z"),
    Observable("kappa_star", "κ* = q/q_NS", dims=ALONG, symbol="κ*"),
    Observable("reduced_gradient", "ε = λ |∂ ln T/∂z|, λ of eq. (5)", dims=ALONG, symbol="ε"),
    Observable("reduced_gravity", "g* = λ g/(2T/m), λ of eq. (5)", dims=ALONG, symbol="g*"),
    Observable("mean_free_paths", "mean free paths from the cold wall", dims=ALONG),
)

WINDOW = 1.0
"""Default width (λ0) of the window in which the slope of T is fitted."""


def profiles(means: dict) -> dict:
    """Observables from averages that add up: density, pressures and fluxes of each layer."""
    with np.errstate(divide="ignore", invalid="ignore"):
        temperature = 2.0 * means["pressure"] / means["density"]
    return {
        **{name: means[name] for name in ("density", "pressure", "pressure_zz", "heat_flux")},
        "temperature": temperature,
        "mean_heat_flux": means["mean_heat_flux"],
        "heat_flux_cold_wall": means["heat_flux_cold_wall"],
        "heat_flux_hot_wall": means["heat_flux_hot_wall"],
    }


def reduced(profile: dict, gravity, length, exponent: float, window: float = WINDOW) -> dict:
    """κ*, ε and g* of every layer: eqs. (2), (28), (29), and 𝒩(z) of eq. (32).

    Arguments: what `profiles` returns, z along the last axis; `gravity`, a number or an array over
    the other axes; `length`, a number; `exponent`, ω in κ ∝ T^ω (1/2 for hard spheres, as in the
    paper); `window`, the width (λ0) over which T^{1+ω} is fitted with a straight line.
    """
    layers = np.shape(profile["temperature"])[-1]
    gravity = np.asarray(gravity, dtype=float)[..., None]
    width = float(length) / layers
    power = profile["temperature"] ** (1.0 + exponent)
    half = max(1, round(window / width / 2.0))
    slope = local_slope(power, half) / width / (1.0 + exponent)  # T^ω dT/dz
    law = -CONDUCTIVITY * slope
    pressure = profile["pressure"]
    with np.errstate(divide="ignore", invalid="ignore"):
        path = 0.8 * CONDUCTIVITY * profile["temperature"] ** (exponent - 0.5) / pressure
        gradient = 0.8 * CONDUCTIVITY * np.abs(slope) / np.sqrt(profile["temperature"]) / pressure
        ratio = np.asarray(profile["mean_heat_flux"])[..., None] / law
    density = profile["density"]
    crossed = (np.cumsum(density, axis=-1) - 0.5 * density) * width
    return {
        "kappa_star": ratio,
        "reduced_gradient": gradient,
        "reduced_gravity": path * gravity,
        "mean_free_paths": crossed,
    }


def local_slope(values: np.ndarray, half: int) -> np.ndarray:
    """Slope per layer of a straight line fitted to 2 half + 1 layers, fewer near the walls."""
    layers = values.shape[-1]
    slope = np.empty_like(values)
    for k in range(layers):
        first, last = max(0, k - half), min(layers, k + half + 1)
        offset = np.arange(first, last) - 0.5 * (first + last - 1)
        slope[..., k] = np.sum(offset * values[..., first:last], axis=-1) / np.sum(offset**2)
    return slope
