"""From fluxes to coefficients, on the host. Means are over kicks; errors over realizations.

Arrays are (points, realizations, times); every dictionary has the names of `SERIES`. Equations:
docs/impulse_response.md.
"""

import numpy as np

from ..gas import INITIAL_TEMPERATURE
from ..stats import jackknife
from ..theory.transport import elastic_conductivity, elastic_viscosity
from .kicks import FIELDS
from .response import Responses

FLUXES = ("modified_heat_flux", "heat_flux", "shear_stress")
"""The flux that follows each field of `FIELDS`, as -q_x/(ε T κ0) or -P_xy/(ε η0), in 1/τ0."""

GROWTH_POWER = (0.0, 1.0, -1.0)
"""The power of F = exp(ζs/2) under the integral of each field."""

WINDOWS = (0.2, 0.6, 1.0)
"""Shares of the duration between which two windows of the integral tell its tail."""


def odd_and_even(moments: Responses, kick: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Half the difference and half the sum of the fluxes at +ε and -ε, over ε.

    Arguments: arrays (points, realizations, 1, times, copies) as the engine gives them, kick
    (points,). Returns two arrays (points, realizations, times, fields).
    """
    flux = np.asarray(moments.flux)[:, :, 0]
    plus, minus = flux[..., 0::2], flux[..., 1::2]
    double = 2.0 * kick[:, None, None, None]
    return (plus - minus) / double, (plus + minus) / double


def kick_series(moments: Responses, kick: np.ndarray, times: np.ndarray) -> dict[str, np.ndarray]:
    """Responses, F and running integrals of one kick at common times."""
    response, _ = odd_and_even(moments, np.asarray(kick, dtype=float))
    clocks = (moments.time, moments.log_growth)
    clock, log_growth = (_pair_mean(np.asarray(x)[:, :, 0]) for x in clocks)
    units = (-1.0 / (INITIAL_TEMPERATURE * elastic_conductivity()),) * 2
    units += (-1.0 / elastic_viscosity(),)
    columns = {"growth": np.exp(log_growth[..., 0])}
    for number, name in enumerate(FIELDS):
        flux = units[number] * response[..., number]
        integrand = flux * np.exp(GROWTH_POWER[number] * log_growth[..., number])
        columns[FLUXES[number]] = flux
        columns[name] = _running_integral(clock[..., number], integrand)
    own_clock = {name: FLUXES.index(name) for name in FLUXES} | {
        name: FIELDS.index(name) for name in FIELDS
    }
    return {
        name: _at(times, clock[..., own_clock.get(name, 0)], values)
        for name, values in columns.items()
    }


def with_density(means: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Adds nμ/(Tκ0) = 2(κ - κ')/κ0, eq. (2.38), to the running integrals."""
    difference = means["conductivity"] - means["modified_conductivity"]
    return means | {"density_coefficient": 2.0 * difference}


def coefficients(means: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The coefficients over their elastic first Sonine values: integrals and their tails.

    The integral from the duration on is taken from two windows of equal length before it, as that
    of one exponential. `_tail` is this part of the value; it is zero where noise hides it.
    """
    values = {}
    for name in FIELDS:
        early, middle, end = (
            means[name][..., round(share * (means[name].shape[-1] - 1))] for share in WINDOWS
        )
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.nan_to_num((end - middle) / (middle - early), posinf=0.0, neginf=0.0)
        ratio = np.clip(ratio, 0.0, 0.7)
        tail = (end - middle) * ratio / (1.0 - ratio)
        values |= {name: end + tail, f"{name}_tail": tail}
    values = with_density(values)
    if "a2" in means:
        values["a2"] = means["a2"]
    return values


def estimates(means: dict[str, np.ndarray]) -> tuple[dict, dict]:
    """Coefficients and their standard errors, arrays (points,), from realizations."""
    return jackknife(means, coefficients, axis=1)


def fourth_cumulant(moments: Responses) -> np.ndarray:
    """a2 of the samples, (points, realizations): ⟨V⁴⟩ = 15 T0² (1 + a2)."""
    return np.asarray(moments.fourth)[:, :, 0] / (15.0 * INITIAL_TEMPERATURE**2) - 1.0


def _pair_mean(values: np.ndarray) -> np.ndarray:
    """Mean of the copies with +ε and -ε: (..., copies) to (..., fields)."""
    return 0.5 * (values[..., 0::2] + values[..., 1::2])


def _running_integral(clock: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Trapezoidal rule; for a rate r and steps h its relative error is (r h)²/12 < 3e-4."""
    pieces = 0.5 * (values[..., 1:] + values[..., :-1]) * np.diff(clock, axis=-1)
    return np.concatenate([np.zeros_like(values[..., :1]), np.cumsum(pieces, axis=-1)], axis=-1)


def _at(times: np.ndarray, clock: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Linear interpolation of every realization from its own clock."""
    out = np.empty((*values.shape[:2], len(times)))
    for index in np.ndindex(values.shape[:2]):
        out[index] = np.interp(times, clock[index], values[index])
    return out
