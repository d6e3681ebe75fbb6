"""κ' against the time step, for both schemes, and against the particle number; work to precision.

Work is counted in particle-steps, which any machine can do. A method needs W particle-steps to
average N particles over a time T after an approach of `APPROACH_TIME`: W = N (T + approach)/dt. Its
statistical error is A/√(N T) with the constant A measured here; its bias is that of the field and
of the time step, from the fits of this experiment. The picture shows both in quadrature.
"""

from typing import NamedTuple

import numpy as np

from jdsmc import Estimate
from jdsmc.measure.kicks import COPIES
from jdsmc.scenarios.navier_stokes import GAP, WARM_UP

from ..numbers import Even
from .cases import (
    DEFAULT_STEP,
    PAPER_FIELD,
    PAPER_PARTICLES,
    PAPER_REALIZATIONS,
    PAPER_STEP,
    STUDY_RESTITUTION,
)
from .coefficients import coefficient, kick_strengths, kicked
from .data import Heat, Pool
from .limits import CONDUCTIVITY, limit

TOLERANCE = 0.002
"""The accuracy of κ' that the default step is to have."""

POWERS = {"exact": 1.0, "paper": 0.5}
"""Leading error of each scheme: this power of dt²."""

APPROACH_TIME = 10.0
"""Time to the steady state (τ0): the paper's."""

OURS = 8 * 20_000
"""Particles of all realizations at the defaults of `run`."""

PAIR = (0.05, 0.1)
"""Fields of the extrapolation ε* -> 0 with ε*² alone."""


def studied(pool: Pool, name: str = CONDUCTIVITY.name) -> Estimate:
    """κ' where time steps are compared."""
    return pool.value(name, STUDY_RESTITUTION)


class Scheme(NamedTuple):
    """A scheme at all its time steps: asked for and made (τ), κ'/κ0, and the limit dt -> 0."""

    asked: tuple[float, ...]
    made: list[float]
    values: list[Estimate]
    fit: Even

    def deviation(self, step: float) -> Estimate:
        """κ' at a step asked for over its limit, minus 1, from the fit."""
        return self.fit.excess(self.made[self.asked.index(step)])


def scheme(data: Heat, name: str) -> Scheme:
    """What was measured with a scheme."""
    asked = tuple(sorted(step for kind, step, _ in data.size.steps if kind == name))
    pools = [data[f"step_{name}_{step:g}"] for step in asked]
    made = [float(studied(pool, "time_step").value) for pool in pools]
    values = [studied(pool) for pool in pools]
    return Scheme(asked, made, values, Even(made, values, (POWERS[name],)))


def numbers(data: Heat) -> list[tuple[int, Estimate, Estimate]]:
    """κ'/κ0 with few particles, and what follows for the number of the other runs.

    The last is how far that number is from N -> ∞, relative, if the distance goes as 1/N.
    """
    usual = data.size.gas["n_particles"]
    value, found = studied(data[f"step_exact_{DEFAULT_STEP:g}"]), []
    for number in data.size.numbers:
        few = studied(data[f"number_{number}"])
        found.append((number, few, (few / value - 1.0) / (usual / number - 1.0)))
    return found


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


def noise(data: Heat, strength: float) -> float:
    """Relative standard error of κ' times √(N T), from a steady run."""
    pool = data.steady(strength)
    value, error = studied(pool)
    return float(error / value * np.sqrt(pool.n_particles * pool.measured_time(STUDY_RESTITUTION)))


def methods(data: Heat) -> list[Method]:
    """The paper's parameters; one field at the default step; two fields extrapolated."""
    fitted = limit(data, CONDUCTIVITY, STUDY_RESTITUTION)
    of_step = float(scheme(data, "exact").deviation(DEFAULT_STEP).value)
    of_field = {f: float(fitted.excess(f).value) for f in (PAPER_FIELD, *PAIR)}
    paper = of_field[PAPER_FIELD] + float(scheme(data, "paper").fit.excess(PAPER_STEP).value)
    label = f"paper: ε* = {PAPER_FIELD:g}, dt = {PAPER_STEP:g} τ, explicit"
    particles = PAPER_PARTICLES * PAPER_REALIZATIONS
    found = [Method(label, paper, particles, PAPER_STEP, noise(data, PAPER_FIELD))]
    for strength, bias in of_field.items():
        label = f"ε* = {strength:g}, dt = {DEFAULT_STEP:g} τ"
        found.append(Method(label, bias + of_step, OURS, DEFAULT_STEP, noise(data, strength)))
    return [*found, extrapolated(data, of_step)]


def extrapolated(data: Heat, of_step: float) -> Method:
    """Both fields of `PAIR`, the time shared so that the limit is known best.

    v = (x2 v1 - x1 v2)/(x2 - x1), x = ε*²: with shares t and 1-t the noise is
    √(p²/t + q²/(1-t)) >= p + q, the noise p, q of either field times its weight. The bias left is
    -d x1 x2 of a term d ε*⁴.
    """
    one, two = (strength**2 for strength in PAIR)
    weights = two / (two - one), one / (two - one)
    total = sum(w * noise(data, strength) for w, strength in zip(weights, PAIR, strict=True))
    terms = limit(data, CONDUCTIVITY, STUDY_RESTITUTION).terms
    bias = of_step - float((terms[2] / terms[0]).value) * one * two
    label = f"ε* = {PAIR[0]:g} and {PAIR[1]:g} extrapolated"
    return Method(label, bias, 2 * OURS, DEFAULT_STEP, float(total))


def kicks(data: Heat) -> tuple[float, float]:
    """κ' by impulse response at the default kick: particle-steps spent, relative error reached.

    Bias of the kick and statistical error in quadrature. The work is that of the sample and of its
    six copies, which give κ, μ and η too.
    """
    pool = kicked(data, kick_strengths(data)[0])
    value, error = studied(pool)
    bias = coefficient(data, CONDUCTIVITY.name, STUDY_RESTITUTION).excess.value
    time = WARM_UP + data.size.kick_options["n_kicks"] * (GAP + COPIES * data.size.followed)
    work = pool.n_particles * time / pool.results[0].attrs["time_step"]
    return float(work), float(np.hypot(bias, error) / value)
