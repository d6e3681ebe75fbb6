"""How far the default time step and particle number are from the limits dt -> 0 and N -> ∞."""

import json
from typing import NamedTuple

import numpy as np
from jdsmc.options import TIME_STEP

from jdsmc import Estimate, Result

from .data import Term, actual_steps, at_point, estimate_in
from .systems import FAST, Case

OBSERVABLES = (
    *("temperature", "shear_stress", "normal_stress_xy", "normal_stress_zy"),
    *("a2", "relative_speed_cubed"),
)

POINTS = (("ihs", 0.5), ("ehs", 0.5), ("ihs", 0.9))

DEFAULT_NUMBER, DEFAULT_STEP = 20_000, TIME_STEP
"""Defaults of `jdsmc.run`."""

TOLERANCE = 0.003
"""The accuracy that the defaults are to have."""


class Run(NamedTuple):
    """One run at one point: N, the step asked for, the step really made (τ), one observable."""

    number: int
    asked: float
    step: float
    estimate: Estimate


class Limit(NamedTuple):
    """Fit v + c dt² + b/N: the limit v, both slopes, and how far the defaults are from v.

    `deviation` is relative to v; `by_step`, `by_number` are its two parts; `misfit` is χ²/ν.
    """

    limit: Estimate
    deviation: Estimate
    by_step: Estimate
    by_number: Estimate
    misfit: float

    def verdict(self) -> str:
        """Whether the defaults are within the tolerance, at two standard errors."""
        near, error = abs(self.deviation.value), 2.0 * self.deviation.error
        if near + error < TOLERANCE:
            return "yes"
        return "no" if near - error > TOLERANCE else "not resolved"


def runs(study: list[tuple[Case, Result]], gas: str, restitution: float, name: str) -> list[Run]:
    """Every run of the study that holds this point."""
    found = []
    for case, result in study:
        if case.gas != gas or restitution not in case.restitution:
            continue
        place = case.restitution.index(restitution)
        steady = at_point(result.to_xarray().to_dataset(), restitution, FAST)
        estimate = estimate_in(steady, Term(gas, restitution, FAST, name))
        options = json.loads(result.attrs["request"])["options"]
        step = float(actual_steps(result)[place, 0])
        found.append(Run(options["n_particles"], options["time_step"], step, estimate))
    return found


def extrapolate(points: list[Run]) -> Limit:
    """Weighted least squares of v + c dt² + b/N over all runs."""
    step = np.array([p.step for p in points])
    inverse = np.array([1.0 / p.number for p in points])
    value, error = (np.array([p.estimate[k] for p in points]) for k in (0, 1))
    # Errors from few realizations scatter; what they have in common is known better.
    error = np.sqrt(0.5 * (error**2 + np.median(error) ** 2))
    default = next(p for p in points if (p.number, p.asked) == (DEFAULT_NUMBER, DEFAULT_STEP))
    scale = np.array([1.0, default.step**2, 1.0 / DEFAULT_NUMBER])
    design = np.stack([np.ones_like(step), step**2, inverse], axis=1) / scale
    covariance = np.linalg.inv((design / error[:, None] ** 2).T @ design)
    best = covariance @ (design.T @ (value / error**2))
    misfit = np.sum(((value - design @ best) / error) ** 2) / max(1, len(points) - 3)

    def relative(weights) -> Estimate:
        weights = np.array(weights)
        spread = np.sqrt(weights @ covariance @ weights)
        return Estimate(float(weights @ best / best[0]), float(abs(spread / best[0])))

    limit = Estimate(float(best[0]), float(np.sqrt(covariance[0, 0])))
    parts = (relative([0, 1, 1]), relative([0, 1, 0]), relative([0, 0, 1]))
    return Limit(limit, *parts, float(misfit))


def all_limits(study: list[tuple[Case, Result]]) -> dict[tuple[str, float, str], Limit]:
    """The extrapolation of every observable at every point."""
    return {
        (gas, restitution, name): extrapolate(runs(study, gas, restitution, name))
        for gas, restitution in POINTS
        for name in OBSERVABLES
    }
