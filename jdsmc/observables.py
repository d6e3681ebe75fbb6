"""Observables of homogeneous gases from averages, on the host in float64.

Averages are over particles, realizations and time first; ratios come last. A moment of order k is
divided by the average of T^{k/2}, so that slow common fluctuations of the temperature cancel.
Definitions: Astillero and Santos (2005), sections III and V; names: docs/observables.md.
"""

import math

import numpy as np
from scipy.special import erf

from .gas import INITIAL_TEMPERATURE

MAXWELL_CUBED = 32.0 / math.sqrt(math.pi)
"""⟨V12³⟩0 / (T/m)^{3/2}, eq. (2.15)."""

VISCOSITY_TIME = 1.016 * 5.0 * math.sqrt(math.pi) / 8.0
"""τ_η/τ, eq. (2.18)."""


def maxwell_speed_classes() -> np.ndarray:
    """Fractions of a Maxwellian with C in [0,1), [1,2), [2,3), [3,∞): eq. (4.19)."""
    c = np.array([0.0, 1.0, 2.0, 3.0])
    below = erf(c) - 2.0 * c * np.exp(-(c**2)) / np.sqrt(np.pi)
    return np.diff([*below, 1.0])


def particle_means(record) -> dict[str, np.ndarray]:
    """Per-realization averages at each record, and the scale of the velocities."""
    rates = rate_averages(record.moments, record.slowing)
    return moment_averages(record.moments) | rates | {"scale": record.scale}


def rate_averages(m, slowing) -> dict[str, np.ndarray]:
    """√T and T^{3/2} averaged over the steps of a record: what collision rates go with."""
    temperature = (m.xx + m.yy + m.zz) / 3.0
    return {
        "T1_steps": np.sqrt(temperature) * slowing[..., 0],
        "T3_steps": temperature**1.5 * slowing[..., 1],
    }


def moment_averages(m) -> dict[str, np.ndarray]:
    """Moments with the powers of T that normalize them."""
    temperature = (m.xx + m.yy + m.zz) / 3.0
    powers = {f"T{k}": temperature ** (k / 2.0) for k in (1, 3, 4, 6)}
    direct = {
        name: getattr(m, name)
        for name in ("xx", "yy", "zz", "xy", "fourth", "sixth", "cubed", "classes")
    }
    return {"temperature": temperature, **powers, **direct}


def isotropic(means: dict) -> dict:
    """Temperature, cumulants, relative speeds and speed classes of any homogeneous gas."""
    a2 = means["fourth"] / (15.0 * means["T4"]) - 1.0
    return {
        "temperature": means["temperature"] / INITIAL_TEMPERATURE,
        "relative_speed_cubed": means["cubed"] / (MAXWELL_CUBED * means["T3"]),
        "a2": a2,
        "a3": -means["sixth"] / (105.0 * means["T6"]) + 1.0 + 3.0 * a2,
        "speed_ratio": means["classes"] / maxwell_speed_classes(),
    }


def rheology(means: dict, shear_rate) -> dict:
    """Pressure tensor over nT and the viscometric functions of a sheared gas (section V C)."""
    temperature = means["temperature"]
    xx, yy, zz, xy = (means[name] / temperature for name in ("xx", "yy", "zz", "xy"))
    reduced = shear_rate * VISCOSITY_TIME / np.sqrt(2.0 * temperature)
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


def collisional(means: dict, restitution, rate_factor) -> dict:
    """What the steps know: their length over τ(T), the rate of collisions, their ⟨V12³⟩.

    ⟨V12³⟩ comes from the energy lost: ζ = (2/3T) loss per particle and time; divided by ζ0, it is
    ⟨V12³⟩/⟨V12³⟩0, eqs. (2.10) and (2.16). Undefined (NaN) where no energy is lost.
    """
    local = rate_factor * np.sqrt(2.0 / np.pi) * means["T1_steps"]
    inelastic = (1.0 - restitution**2) * np.sqrt(2.0) / np.sqrt(np.pi) * means["T3_steps"]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(means["energy_lost"] > 0, means["energy_lost"] / inelastic, np.nan)
    return {
        "time_step": means["time_step"] * np.sqrt(2.0) * means["T1"],
        "collision_rate_ratio": means["accepted"] / local,
        "relative_speed_cubed_collisional": ratio,
    }
