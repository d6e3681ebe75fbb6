"""All Navier-Stokes coefficients from kicks: kick -> 0, half the time step, theory beside them."""

from typing import NamedTuple

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import sonine_elastic
from jdsmc.theory.transport import first_sonine, modified_first_sonine

from .data import Measurements
from .limits import CONDUCTIVITY, fit, limit
from .systems import KICK_STEP, kick_name

NAMES = {
    "modified_conductivity": "κ'/κ0",
    "conductivity": "κ/κ0",
    "density_coefficient": "nμ/(Tκ0)",
    "viscosity": "η/η0",
}

ELASTIC_ORDER = 10
"""Sonine polynomials of the elastic values: converged to all digits shown."""


class Coefficient(NamedTuple):
    """A coefficient at one restitution.

    `kicks`: at every kick, in the order of `kick_strengths`; `limit`: kick -> 0, with ε²;
    `excess`: the default kick's distance from it; `by_step`: at the default step minus at the short
    one; `tail`: the part of the integral that is extrapolated in time, at the default kick.
    """

    name: str
    restitution: float
    kicks: list[Estimate]
    limit: Estimate
    excess: Estimate
    by_step: Estimate
    tail: float
    theory: tuple[float, float]


def kick_strengths(data: Measurements) -> list[float]:
    """Kicks that were run at the default time step; the first is the default kick."""
    return sorted(kick for kick, step in data.size.kicks if step == KICK_STEP)


def short_step(data: Measurements) -> float | None:
    """The other time step, if there is one."""
    step = min(step for _, step in data.size.kicks)
    return None if step == KICK_STEP else step


def coefficient(data: Measurements, name: str, restitution: float) -> Coefficient:
    """One coefficient with its checks."""
    strengths = kick_strengths(data)
    pools = [data[kick_name(kick, KICK_STEP)] for kick in strengths]
    kicks = [pool.value(name, restitution) for pool in pools]
    fitted = fit(strengths, *(np.array(x) for x in zip(*kicks, strict=True)), (1,))
    by_step, step = Estimate(np.nan, np.nan), short_step(data)
    if step is not None:
        short = data[kick_name(strengths[0], step)].value(name, restitution)
        by_step = _difference(kicks[0], short)
    tail = 0.0
    if name != "density_coefficient":
        tail = pools[0].value(f"{name}_tail", restitution).value
    first, modified = (
        float(getattr(model(restitution), name)) for model in (first_sonine, modified_first_sonine)
    )
    at_default = fitted.at(strengths[0]).value - fitted.value.value
    slope_error = float(np.sqrt(fitted.covariance[1, 1])) * strengths[0] ** 2
    return Coefficient(
        name,
        restitution,
        kicks,
        fitted.value,
        Estimate(at_default, slope_error),
        by_step,
        tail,
        (first, modified),
    )


def both_routes(data: Measurements, restitution: float) -> tuple[Estimate, Estimate, float]:
    """κ' by impulse response and by the force, both extrapolated, and their difference over σ."""
    impulse = coefficient(data, "modified_conductivity", restitution).limit
    force = limit(data, CONDUCTIVITY, restitution).value
    difference = _difference(impulse, force)
    return impulse, force, difference.value / difference.error


def elastic(name: str) -> float:
    """The elastic value, from ten Sonine polynomials."""
    if name == "density_coefficient":
        return 0.0
    if name == "viscosity":
        return sonine_elastic.viscosity_ratio(ELASTIC_ORDER)
    return sonine_elastic.conductivity_ratio(ELASTIC_ORDER)


def _difference(one: Estimate, other: Estimate) -> Estimate:
    return Estimate(one.value - other.value, float(np.hypot(one.error, other.error)))
