"""κ' against the time step, for both schemes, and against the particle number."""

from typing import NamedTuple

import numpy as np

from jdsmc import Estimate

from .data import Measurements
from .limits import CONDUCTIVITY, Limit, fit
from .systems import DEFAULT_STEP, STUDY_RESTITUTION, number_name, step_name

TOLERANCE = 0.002
"""The accuracy of κ' that the default step is to have."""

POWERS = {"exact": 1.0, "paper": 0.5}
"""Leading error of each scheme: this power of dt²."""


class Scheme(NamedTuple):
    """A scheme at all its time steps: asked for and made (τ), κ'/κ0, and the limit dt -> 0."""

    asked: tuple[float, ...]
    made: np.ndarray
    values: Estimate
    limit: Limit


def scheme(data: Measurements, name: str) -> Scheme:
    """What was measured with a scheme."""
    asked = tuple(sorted(step for kind, step in data.size.steps if kind == name))
    pools = [data[step_name(name, step)] for step in asked]
    made = np.array([pool.value("time_step", STUDY_RESTITUTION).value for pool in pools])
    pairs = [pool.value(CONDUCTIVITY.name, STUDY_RESTITUTION) for pool in pools]
    values = Estimate(*(np.array(column) for column in zip(*pairs, strict=True)))
    return Scheme(asked, made, values, fit(made, *values, (POWERS[name],)))


def deviation(found: Scheme, step: float) -> Estimate:
    """κ' at a step asked for over its limit, minus 1, from the fit."""
    return found.limit.excess(found.made[found.asked.index(step)])


class Number(NamedTuple):
    """κ'/κ0 with few particles, and what follows for the number of the other runs.

    `implied`: how far that number is from N -> ∞, relative, if the distance goes as 1/N.
    """

    n_particles: int
    value: Estimate
    implied: Estimate


def numbers(data: Measurements) -> list[Number]:
    """All particle numbers, compared with the usual one at the default step."""
    usual = data.size.gas["n_particles"]
    value, error = data[step_name("exact", DEFAULT_STEP)].value(
        CONDUCTIVITY.name, STUDY_RESTITUTION
    )
    found = []
    for number in data.size.numbers:
        few = data[number_name(number)].value(CONDUCTIVITY.name, STUDY_RESTITUTION)
        scale = 1.0 / (usual / number - 1.0) / value
        implied = Estimate(scale * (few.value - value), scale * float(np.hypot(few.error, error)))
        found.append(Number(number, few, implied))
    return found


def verdict(found: Scheme, step: float = DEFAULT_STEP) -> str:
    """Whether a step is within the tolerance, at two standard errors."""
    value, error = deviation(found, step)
    if abs(value) + 2 * error < TOLERANCE:
        return "yes"
    return "no" if abs(value) - 2 * error > TOLERANCE else "not resolved"


def agreement(one: Scheme, other: Scheme) -> float:
    """Difference of the two limits in standard errors."""
    (a, da), (b, db) = one.limit.value, other.limit.value
    return float((a - b) / np.hypot(da, db))
