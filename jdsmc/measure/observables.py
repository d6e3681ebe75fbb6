"""Observables of homogeneous gases from averages, on the host in float64, of one gas.

Averages are over particles, realizations and time first; ratios come last. A moment of order k is
divided by the average of T^{k/2}, so that slow common fluctuations of the temperature cancel.
Definitions: Astillero and Santos (2005), sections III and V. Averages may have leading axes (the
records of a time series).
"""

import math

import numpy as np
from scipy.special import erf, gamma

from ..units import INITIAL_TEMPERATURE, VISCOSITY_TIME
from .moments import temperature
from .observable import Observable

TEMPERATURE = Observable("temperature", "temperature T/T0", symbol="T/T0")
REDUCED = (
    Observable("a2", "fourth cumulant a2", symbol="a2"),
    Observable("a3", "sixth cumulant a3", symbol="a3"),
    Observable(
        "relative_speed_cubed",
        "relative speed ⟨V12³⟩/⟨V12³⟩0 from random pairs",
        symbol="⟨V12³⟩/⟨V12³⟩0",
    ),
    Observable(
        "relative_speed_cubed_collisional",
        "cooling rate ζ/ζ0 from the energy lost, for constant restitution ⟨V12³⟩/⟨V12³⟩0",
        symbol="ζ/ζ0",
    ),
    Observable("collision_rate_ratio", "collision rate over its local-equilibrium value"),
    Observable("time_step", "mean time step over τ(T)", setting=True),
    Observable(
        "speed_ratio",
        "R_l, share of particles in a speed class over the Maxwellian one",
        dims=("speed_class",),
    ),
)
"""What the reduced velocity distribution of any homogeneous gas has."""

RHEOLOGY = (
    Observable("reduced_shear_rate", "reduced shear rate a* = a τ_η", symbol="a*"),
    Observable("shear_stress", "shear stress -P_xy/nT", symbol="-Pxy/nT"),
    Observable("normal_stress_xy", "normal stress (P_xx-P_yy)/nT", symbol="(Pxx-Pyy)/nT"),
    Observable("normal_stress_zy", "normal stress (P_zz-P_yy)/nT", symbol="(Pzz-Pyy)/nT"),
    Observable("reduced_viscosity", "reduced viscosity η* = (-P_xy/nT)/a*", symbol="η*"),
    Observable(
        "first_viscometric", "viscometric function -Ψ1 = (P_xx-P_yy)/(nT a*²)", symbol="-Ψ1"
    ),
    Observable("second_viscometric", "viscometric function Ψ2 = (P_zz-P_yy)/(nT a*²)", symbol="Ψ2"),
)
PRESSURES = tuple(
    Observable(f"pressure_{ij}", f"P_{ij}/nT", symbol=f"P{ij}/nT") for ij in ("xx", "yy", "zz")
)


def maxwell_cubed(dimension: int) -> float:
    """⟨V12³⟩0 / (T/m)^{3/2}: 32/√π in three dimensions, eq. (2.15)."""
    return 8.0 * gamma(0.5 * (dimension + 3)) / gamma(0.5 * dimension)


def maxwell_speed_classes(dimension: int = 3) -> np.ndarray:
    """Fractions of a Maxwellian with C in [0,1), [1,2), [2,3), [3,∞): eq. (4.19)."""
    c = np.array([0.0, 1.0, 2.0, 3.0])
    if dimension == 2:
        return np.diff([*(1.0 - np.exp(-(c**2))), 1.0])
    below = erf(c) - 2.0 * c * np.exp(-(c**2)) / np.sqrt(np.pi)
    return np.diff([*below, 1.0])


def moment_averages(m) -> dict[str, np.ndarray]:
    """Moments (units of v0) with the powers of T that normalize them."""
    heat = temperature(m)
    powers = {f"T{k}": heat ** (k / 2.0) for k in (1, 3, 4, 6)}
    seconds = {"xx": m.xx, "yy": m.yy, "zz": m.zz, "xy": m.xy}
    direct = {name: values for name, values in seconds.items() if values is not None}
    for name, power in (("cubed", 3), ("fourth", 4), ("sixth", 6)):
        direct[name] = getattr(m, name) * 2.0 ** (power / 2.0) * powers[f"T{power}"]
    return {"temperature": heat, **powers, **direct, "classes": m.classes}


def isotropic(means: dict, dimension: int = 3) -> dict:
    """Temperature, cumulants, relative speeds and speed classes of any homogeneous gas."""
    fourth = dimension * (dimension + 2.0)
    sixth = fourth * (dimension + 4.0)
    a2 = means["fourth"] / (fourth * means["T4"]) - 1.0
    return {
        "temperature": means["temperature"] / INITIAL_TEMPERATURE,
        "relative_speed_cubed": means["cubed"] / (maxwell_cubed(dimension) * means["T3"]),
        "a2": a2,
        "a3": -means["sixth"] / (sixth * means["T6"]) + 1.0 + 3.0 * a2,
        "speed_ratio": means["classes"] / maxwell_speed_classes(dimension),
    }


def collisional(means: dict) -> dict:
    """What the steps know: their length over τ(T), the rate of collisions, the rate of cooling.

    The last is NaN where no energy is lost in collisions. With constant restitution it is
    ⟨V12³⟩/⟨V12³⟩0, eqs. (2.10) and (2.16).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        cooling = means["energy_lost"] / means["local_loss"]
        return {
            "time_step": means["time_step"] * math.sqrt(2.0) * means["T1"],
            "collision_rate_ratio": means["accepted"] / means["local_rate"],
            "relative_speed_cubed_collisional": np.where(means["local_loss"] > 0, cooling, np.nan),
        }


def rheology(means: dict, shear_rate, exponent: float | None) -> dict:
    """Pressure tensor over nT and the viscometric functions of a sheared gas (section V C).

    With a pair rate ∝ g^γ, τ_η ∝ T^{-γ/2}; it is that of hard spheres at T0. What needs τ_η is NaN
    for a gas without such a law (`exponent` None), or without shear.
    """
    heat = means["temperature"]
    xx, yy, zz, xy = (means[name] / heat for name in ("xx", "yy", "zz", "xy"))
    if exponent is None:
        reduced = np.full_like(heat, np.nan)
    else:
        with np.errstate(invalid="ignore"):  # a fit to few records may have T < 0: unknown
            reduced = shear_rate * VISCOSITY_TIME / np.sqrt(2.0 * heat) ** exponent
    with np.errstate(divide="ignore", invalid="ignore"):
        sheared = np.where(reduced > 0, reduced, np.nan)
        viscosity, first, second = -xy / sheared, (xx - yy) / sheared**2, (zz - yy) / sheared**2
    return {
        "pressure_xx": xx,
        "pressure_yy": yy,
        "pressure_zz": zz,
        "shear_stress": -xy,
        "normal_stress_xy": xx - yy,
        "normal_stress_zy": zz - yy,
        "reduced_shear_rate": reduced,
        "reduced_viscosity": viscosity,
        "first_viscometric": first,
        "second_viscometric": second,
    }
