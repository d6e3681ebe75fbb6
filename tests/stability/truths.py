"""What must come out, in closed form or as a limit, whatever the numbers of a scene."""

import numpy as np

from jdsmc.measure.conduction import CONDUCTIVITY
from jdsmc.theory import boltzmann, homogeneous_cooling
from jdsmc.theory.bgk_shear_flow import steady_state
from jdsmc.units import COOLING, VISCOSITY_TIME

from .judge import Truth

STRESS_07 = 0.50449
"""-P_xy/nT of inelastic spheres at α = 0.7, ± 0.00002: a long run at N = 5120. Hard spheres have no
scale of time, so it is one for all shear rates and for hot and cold starts."""


def balance(result, restitution: float, tolerance: float = 0.01) -> Truth:
    """A steady sheared gas loses in collisions what the shear supplies: (2/3) a Π = ζ.

    In units of τ: a τ = a*/1.016(5√π/8), ζτ = 2(1-α²)/3√π times ζ/ζ0. Its ratio is 1; the error is
    that of the stress, times 2 for what it has in common with a*.
    """
    stress, error = result["shear_stress"]
    supplied = (2 / 3) * stress * result["reduced_shear_rate"].value / VISCOSITY_TIME
    lost = COOLING * (1 - restitution**2) * result["relative_speed_cubed_collisional"].value
    return Truth("heating over cooling", supplied / lost, 2 * error / stress, 1.0, tolerance)


def chaos(result, tolerance: float = 0.02) -> Truth:
    """⟨V12³⟩ of colliding pairs is that of random pairs."""
    lost, error = result["relative_speed_cubed_collisional"]
    pairs, other = result["relative_speed_cubed"]
    noise = np.hypot(error, other) / pairs
    return Truth("cooling by pairs", lost / pairs, noise, 1.0, tolerance)


def stress(result, tolerance: float = 0.005) -> Truth:
    """At α = 0.7."""
    return Truth("shear_stress", *result["shear_stress"], STRESS_07, tolerance)


def kinetic_stress(result, restitution: float) -> Truth:
    """The kinetic model's, whose error is of the order of 1-α."""
    known = float(steady_state(restitution).shear_stress)
    return Truth("shear_stress", *result["shear_stress"], known, 0.02 + 0.3 * (1 - restitution))


def cooling(result, restitution: float) -> list[Truth]:
    """Haff's law in logarithms at the end, and the cooling rate of the Boltzmann equation.

    With z = ζ/2 steady, ln T/T0 = -2 ln(1 + z t). The first collisions, in which ζ changes by a few
    percent, make 0.02 of it, or 1% of what it is early: these stand for an error.
    """
    last = result.series.isel(sample=-1)
    half = 0.5 * float(homogeneous_cooling.cooling_rate(restitution))
    law = -2 * np.logaddexp(0.0, np.log(half) + float(last["log_time"]))
    start = 0.01 * min(2.0, abs(float(law)))
    truths = [Truth("ln T/T0 at the end", float(last["log_temperature"]), start, law, 0.01)]
    if restitution >= 0.3:
        known = boltzmann.cooling_state(restitution)
        rate = known.cooling_rate / (COOLING * (1 - restitution**2))
        rates = result.series["reduced_time"][-1] * known.cooling_rate
        truths.append(
            Truth("reduced time", float(rates), start, -float(last["log_temperature"]), 0.01)
        )
        if result.is_steady:
            truths.append(Truth("ζ/ζ0", *result["relative_speed_cubed_collisional"], rate, 0.005))
    return truths


def conductivity(result, restitution: float) -> Truth:
    """κ' of the Boltzmann equation, for a weak field."""
    known = boltzmann.navier_stokes(restitution).modified_conductivity
    return Truth("κ'/κ0", *result["modified_conductivity"], known, 0.03)


def fluxes(result, tolerance: float = 0.01) -> list[Truth]:
    """The energy that enters at one wall passes every layer and leaves at the other."""
    cold, error = result["heat_flux_cold_wall"]
    named = ("mean_heat_flux", "heat_flux_hot_wall")
    return [
        Truth(name, result[name].value, np.hypot(error, result[name].error), cold, tolerance)
        for name in named
    ]


def free_molecular(result, cold: float, tolerance: float) -> Truth:
    """Two streams that do not collide: q = -(1-T_-) √T_-/((1+√T_-)√π), n̄ m v0³."""
    root = np.sqrt(cold)
    known = -(1 - cold) * root / ((1 + root) * np.sqrt(np.pi))
    return Truth("free-molecular flux", *result["heat_flux_cold_wall"], known, tolerance)


def fourier(result, cold: float, length: float, tolerance: float) -> Truth:
    """Chapman and Enskog, and two temperature jumps of 2.127 λ: q = -κ ΔT^{3/2} (2/3)/(L + ...)."""
    root = np.sqrt(cold)
    pressure = (1 + root + cold) / 3
    # a jump of 2.127 λ at temperature T, λ = T/p, is one of 2.127 √T λ in T^{3/2}/√T
    thick = length + 2.127 * (cold + 1.0) / pressure
    known = -1.025218 * CONDUCTIVITY * (2 / 3) * (1 - cold**1.5) / thick
    return Truth("heat flux", *result["heat_flux_cold_wall"], known, tolerance)


def at_rest(result, name: str, expected: float, tolerance: float) -> Truth:
    """The mean of a series over its later half; at most eight blocks of it tell the error."""
    values = result.series[name].values
    half = values[len(values) // 2 :]
    half = half.reshape(len(half), -1).mean(axis=1)
    count = min(8, len(half))
    blocks = half[: len(half) // count * count].reshape(count, -1).mean(axis=1)
    error = float(np.std(blocks, ddof=1) / np.sqrt(count))
    return Truth(name, float(np.mean(blocks)), error, expected, tolerance)
