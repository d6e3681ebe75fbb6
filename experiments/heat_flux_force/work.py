"""Error of κ' at α = 0.5 against work, for the paper's choice and others: what led to the defaults.

Work is counted in particle-steps, which any machine can do. A method needs W particle-steps to
average N particles over a time T after an approach of `APPROACH_TIME`: W = N (T + approach)/dt. Its
statistical error is A/√(N T) with the constant A measured here; its bias is that of the field and
of the time step, from the fits of this experiment. The picture shows both in quadrature.
"""

from typing import NamedTuple

import numpy as np
from jdsmc.impulse.kicks import COPIES
from jdsmc.impulse.response import GAP, WARM_UP

from .coefficients import coefficient, kick_strengths
from .convergence import scheme
from .data import Measurements
from .limits import CONDUCTIVITY, limit
from .systems import (
    DEFAULT_STEP,
    KICK_STEP,
    PAPER_FIELD,
    PAPER_PARTICLES,
    PAPER_REALIZATIONS,
    PAPER_STEP,
    STUDY_RESTITUTION,
    kick_name,
)

APPROACH_TIME = 10.0
"""Time to the steady state (τ0): the paper's."""

OURS = 8 * 20_000
"""Particles of all realizations at the defaults of `run`."""

PAIR = (0.05, 0.1)
"""Fields of the extrapolation ε* -> 0 with ε*² alone."""


class Method(NamedTuple):
    """A way to κ': relative bias, particles, time step, and relative error times √(N T)."""

    label: str
    bias: float
    particles: int
    step: float
    noise: float

    def error(self, work: np.ndarray) -> np.ndarray:
        """Bias and statistical error in quadrature; NaN before the steady state is reached."""
        measured = work * self.step - self.particles * APPROACH_TIME  # N T
        measured = np.where(measured > 0, measured, np.nan)
        return np.hypot(self.bias, self.noise / np.sqrt(measured))


def noise(data: Measurements, strength: float) -> float:
    """Relative standard error of κ' times √(N T), from a steady run."""
    pool = data.steady(strength)
    value, error = pool.value(CONDUCTIVITY.name, STUDY_RESTITUTION)
    _, measured = pool.duration(STUDY_RESTITUTION)
    return float(error / value * np.sqrt(pool.n_particles * measured))


def methods(data: Measurements) -> list[Method]:
    """The paper's parameters; one field at the default step; two fields extrapolated."""
    fitted = limit(data, CONDUCTIVITY, STUDY_RESTITUTION)
    exact, paper = (scheme(data, name).limit for name in ("exact", "paper"))
    found = [
        Method(
            f"paper: ε* = {PAPER_FIELD:g}, dt = {PAPER_STEP:g} τ, explicit",
            fitted.excess(PAPER_FIELD).value + paper.excess(PAPER_STEP).value,
            PAPER_PARTICLES * PAPER_REALIZATIONS,
            PAPER_STEP,
            noise(data, PAPER_FIELD),
        )
    ]
    for strength in (PAPER_FIELD, *PAIR):
        bias = fitted.excess(strength).value + exact.excess(DEFAULT_STEP).value
        label = f"ε* = {strength:g}, dt = {DEFAULT_STEP:g} τ"
        found.append(Method(label, bias, OURS, DEFAULT_STEP, noise(data, strength)))
    return [*found, extrapolated(data)]


def extrapolated(data: Measurements) -> Method:
    """Both fields of `PAIR`, the time shared so that the limit is known best.

    v = (x2 v1 - x1 v2)/(x2 - x1), x = ε*²: with shares t and 1-t the noise is
    √(p²/t + q²/(1-t)) >= p + q, the noise p, q of either field times its weight. The bias left is
    -d x1 x2 of a term d ε*⁴.
    """
    fitted = limit(data, CONDUCTIVITY, STUDY_RESTITUTION)
    one, two = (strength**2 for strength in PAIR)
    weights = two / (two - one), one / (two - one)
    total = sum(w * noise(data, strength) for w, strength in zip(weights, PAIR, strict=True))
    quartic = fitted.best[2] / fitted.best[0]
    bias = -quartic * one * two + scheme(data, "exact").limit.excess(DEFAULT_STEP).value
    label = f"ε* = {PAIR[0]:g} and {PAIR[1]:g} extrapolated"
    return Method(label, float(bias), 2 * OURS, DEFAULT_STEP, float(total))


class Kicks(NamedTuple):
    """κ' by impulse response at the default kick: particle-steps spent, relative error reached."""

    work: float
    error: float


def kicks(data: Measurements) -> Kicks:
    """Bias of the kick and statistical error in quadrature.

    The work is that of the sample and of its six copies, which give κ, μ and η too.
    """
    strength = kick_strengths(data)[0]
    pool = data[kick_name(strength, KICK_STEP)]
    value, error = pool.value("modified_conductivity", STUDY_RESTITUTION)
    bias = coefficient(data, "modified_conductivity", STUDY_RESTITUTION).excess.value
    options = pool.study.case.options
    time = WARM_UP + options["n_kicks"] * (GAP + COPIES * options["duration"])
    work = pool.n_particles * time / pool.results[0].attrs["time_step"]
    return Kicks(work, float(np.hypot(bias, error) / value))
