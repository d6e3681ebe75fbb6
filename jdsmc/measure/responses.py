"""From the fluxes after a kick to coefficients, on the host. Errors are over realizations.

Arrays are (realizations, records, times) or, averaged, (..., times). Equations:
docs/impulse_response.md.
"""

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float

from ..theory.transport import elastic_conductivity, elastic_viscosity
from ..types import Scalar
from ..units import INITIAL_TEMPERATURE
from .kicks import FIELDS
from .observable import Observable

FLUXES = ("response_modified_heat_flux", "response_heat_flux", "response_shear_stress")
"""The flux that follows each field of `FIELDS`, as -q_x/(ε T κ0) or -P_xy/(ε η0), in 1/τ0."""

GROWTH_POWER = (0.0, 1.0, -1.0)
"""The power of F = exp(ζs/2) under the integral of each field."""

WINDOWS = (0.2, 0.6, 1.0)
"""Shares of the duration between which two windows of the integral tell its tail."""

LAG = ("lag",)
COEFFICIENTS = (
    Observable("modified_conductivity", "modified thermal conductivity κ'/κ0", symbol="κ'/κ0"),
    Observable("conductivity", "thermal conductivity κ/κ0", symbol="κ/κ0"),
    Observable("density_coefficient", "density coefficient nμ/(Tκ0)", symbol="nμ/(Tκ0)"),
    Observable("viscosity", "shear viscosity η/η0", symbol="η/η0"),
)
OBSERVABLES = (
    *COEFFICIENTS,
    Observable("a2", "fourth cumulant a2 of the samples", symbol="a2"),
    *(
        one._replace(name=f"{one.name}_tail", meaning=f"extrapolated part of {one.meaning}")
        for one in COEFFICIENTS
    ),
    *(
        one._replace(
            name=f"running_{one.name}", meaning=f"running integral: {one.meaning}", dims=LAG
        )
        for one in COEFFICIENTS
    ),
    Observable(FLUXES[0], "-q_x/(εTκ0) after the kick for κ'", "1/τ0", LAG),
    Observable(FLUXES[1], "-q_x/(εTκ0) after the kick for κ, without F", "1/τ0", LAG),
    Observable(FLUXES[2], "-P_xy/(εη0) after the kick for η, without 1/F", "1/τ0", LAG),
    Observable("growth", "F = exp(ζs/2)", dims=LAG),
)


class Responses(eqx.Module):
    """One kick, at time zero and after every step; the last axis is that of the copies.

    `flux`: q_x/n of the first four copies, P_xy/n of the last two (units of v0), the copy held at
    its temperature after the kick; `time`: reduced time s (τ of the copy); `log_growth`: ln F.
    `fourth`: ⟨V⁴⟩ of the sample at T0, before the kick.
    """

    flux: Float[Array, "times copies"]
    time: Float[Array, "times copies"]
    log_growth: Float[Array, "times copies"]
    fourth: Scalar


def odd_and_even(flux: np.ndarray, kick: float) -> tuple[np.ndarray, np.ndarray]:
    """Half the difference and half the sum of the fluxes at +ε and -ε, over ε.

    Arguments: array (..., copies). Returns two arrays (..., fields).
    """
    plus, minus = flux[..., 0::2], flux[..., 1::2]
    return (plus - minus) / (2.0 * kick), (plus + minus) / (2.0 * kick)


def kick_series(moments: Responses, kick: float, times: np.ndarray) -> dict[str, np.ndarray]:
    """Responses, F and running integrals of every kick at common times; and a2."""
    response, _ = odd_and_even(np.asarray(moments.flux), kick)
    clock, log_growth = (_pair_mean(np.asarray(x)) for x in (moments.time, moments.log_growth))
    units = (-1.0 / (INITIAL_TEMPERATURE * elastic_conductivity()),) * 2
    units += (-1.0 / elastic_viscosity(),)
    columns = {"growth": (clock[..., 0], np.exp(log_growth[..., 0]))}
    for number, name in enumerate(FIELDS):
        flux = units[number] * response[..., number]
        integrand = flux * np.exp(GROWTH_POWER[number] * log_growth[..., number])
        here = clock[..., number]
        columns[FLUXES[number]] = here, flux
        columns[f"running_{name}"] = here, _running_integral(here, integrand)
    series = {name: _at(times, *column) for name, column in columns.items()}
    # ⟨V⁴⟩ = 15 T0² (1 + a2)
    return series | {"a2": np.asarray(moments.fourth) / (15.0 * INITIAL_TEMPERATURE**2) - 1.0}


def coefficients(means: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The coefficients over their elastic first Sonine values: integrals and their tails.

    The integral from the duration on is taken from two windows of equal length before it, as that
    of one exponential. `_tail` is this part of the value; it is zero where noise hides it.
    """
    values = {name: means[name] for name in (*FLUXES, "growth", "a2")}
    for name in FIELDS:
        running = means[f"running_{name}"]
        last = running.shape[-1] - 1
        early, middle, end = (running[..., round(share * last)] for share in WINDOWS)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.nan_to_num((end - middle) / (middle - early), posinf=0.0, neginf=0.0)
        ratio = np.clip(ratio, 0.0, 0.7)
        tail = (end - middle) * ratio / (1.0 - ratio)
        values |= {name: end + tail, f"{name}_tail": tail, f"running_{name}": running}
    for form in ("{}", "{}_tail", "running_{}"):  # nμ/(Tκ0) = 2(κ - κ')/κ0, eq. (2.38)
        full, modified = (values[form.format(n)] for n in ("conductivity", "modified_conductivity"))
        values[form.format("density_coefficient")] = 2.0 * (full - modified)
    return values


def _pair_mean(values: np.ndarray) -> np.ndarray:
    """Mean of the copies with +ε and -ε: (..., copies) to (..., fields)."""
    return 0.5 * (values[..., 0::2] + values[..., 1::2])


def _running_integral(clock: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Trapezoidal rule; for a rate r and steps h its relative error is (r h)²/12 < 3e-4."""
    pieces = 0.5 * (values[..., 1:] + values[..., :-1]) * np.diff(clock, axis=-1)
    return np.concatenate([np.zeros_like(values[..., :1]), np.cumsum(pieces, axis=-1)], axis=-1)


def _at(times: np.ndarray, clock: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Linear interpolation of every kick from its own clock."""
    out = np.empty((*values.shape[:-1], len(times)))
    for index in np.ndindex(values.shape[:-1]):
        out[index] = np.interp(times, clock[index], values[index])
    return out
