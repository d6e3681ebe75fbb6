"""The response of averages to a number of a gas or scene: the linearised generator, solved.

With trial functions φ_l the perturbed distribution is f (1 + Σ_l c_l (φ_l - μ_l)), so that
δμ = G c; G is the covariance of the φ, B_kl that of the collisional change of φ_k with φ_l(1) +
φ_l(2), and the flow changes μ_k by `moment_drift` of the scene. A steady state answers to a number
θ with L c = -s_θ, L = B + drift linearised, s_θ the derivative of the whole change at fixed
distribution. docs/sensitivities.md has all formulas.
"""

from typing import Any, NamedTuple

import numpy as np

from ..measure.polynomials import Averages
from ..scenarios.homogeneous import AbstractHomogeneous
from .numbers import shifted, slope
from .sampling import Sampler

RELATIVE_STEP = 1e-3
"""Of numerical derivatives of closed expressions in float64: they are exact to 1e-11."""

PURE = 1e-8
"""Largest share of a source that is not the scaling mode's, where it is the mode up to rounding."""


class Facts(NamedTuple):
    """Exact statements that take noise out of a steady response; tests switch them off.

    `mode`: the image of a change of temperature under L is known where the gas has no speed of its
    own; `stationary`: collisions undo what the flow does.
    """

    mode: bool = True
    stationary: bool = True


class Change(NamedTuple):
    """What becomes of averages per unit of a number; other axes come behind those given here.

    `moments` (rows, ...), `cubed` ⟨V12³⟩ (...), `source` (trial + 1, ...): the collisional changes
    of the trial functions, and the number of collisions; `pure`: True if only the scale of speed
    changes.
    """

    moments: Any
    cubed: Any
    source: Any
    pure: bool = False


class Generator:
    """The linearised generator of one gas at one degree of the trial functions.

    Arguments: the scene of one point; what was sampled; averages of the samples, each with the
    same further axes behind its own (realizations left out, blocks, ...): as many generators at
    once; the degree; the exact facts to use.
    """

    def __init__(
        self,
        scene: AbstractHomogeneous,
        sampler: Sampler,
        means: dict[str, np.ndarray],
        degree: int,
        facts: Facts,
    ):
        self.scene, self.sampler, self.means = scene, sampler, means
        symmetry = sampler.symmetry
        self.count = len(symmetry.basis(degree))
        self.moments, self.cubed = means["moments"], means["cubed"]
        degrees = np.array([symmetry.degree(powers) for powers in sampler.rows], dtype=float)
        self.degrees = degrees.reshape(-1, *(1,) * np.ndim(self.cubed))
        exponent = scene.gas.speed_exponent()
        self.mode = facts.mode and exponent is not None
        self.exponent = 0.0 if exponent is None else exponent
        self.squares = [sampler.rows.index(powers) for powers in symmetry.squares]
        self.scale = np.sqrt(self.trace(self.moments) / scene.gas.dimension) ** self.degrees
        self._drift = self.drift(scene, self.moments, self.cubed)
        self._linearise()
        self._stationary(facts)

    def drift(self, scene, moments: np.ndarray, cubed) -> np.ndarray:
        """d⟨φ_k⟩/dt of the trial functions by all but collisions: (trial, ...)."""
        return drift_of(scene, self.sampler, self.count, moments, cubed)

    def _linearise(self) -> None:
        """G, B and L; the scaling mode in place of the first square."""
        m, n = self.means, self.count
        mu = self.moments[:n]
        self.covariance = m["second"][:, :n] - _outer(self.moments, mu)
        self.cubed_response = m["cubed_response"][:n] - 2.0 * mu * self.cubed
        own = [*range(n), -1]
        self.source = m["source"][own]
        self.response = m["response"][own, :n] - 2.0 * _outer(self.source, mu)
        if self.mode:
            first = self.squares[0]
            changed = np.concatenate([self.degrees[:n], 0.0 * self.degrees[:1]])
            self.covariance[:, first] = 0.5 * self.degrees * self.moments
            self.cubed_response[first] = 1.5 * self.cubed
            self.response[:, first] = 0.5 * (changed + self.exponent) * self.source
        self.flow = self._along(self.covariance, self.cubed_response)

    def _along(self, moments: np.ndarray, cubed: np.ndarray) -> np.ndarray:
        """The drift linearised, along changes of the averages: (trial, changes, ...)."""
        scale = self.scale[:, None]
        size = self.scale[self.squares[0]] ** 0.5
        largest = np.max(np.abs(moments / scale), axis=0) + np.abs(cubed) / size**3
        unit = RELATIVE_STEP / np.where(largest > 0, largest, 1.0)
        base = self.moments[:, None]
        change = slope(
            lambda h: self.drift(
                self.scene, base + h * unit * moments, self.cubed + h * unit * cubed
            ),
            1.0,
        )
        return change / unit

    def trace(self, values: np.ndarray) -> Any:
        """Of ⟨V²⟩, from rows of anything."""
        return np.sum(values[self.squares], axis=0)

    def _stationary(self, facts: Facts) -> None:
        """Collisions that undo the flow exactly, and the image of the mode that follows."""
        n, degrees = self.count, self.degrees[: self.count]
        mu, held = self.moments[:n], self.sampler.held
        self.pace = 0.0  # d ln V/dt that holds the temperature
        if held:
            whole = self.source[:n] + self._drift
            self.pace = -0.5 * self.trace(whole) / self.trace(mu)
        self.balanced = self.source.copy()
        if facts.stationary:
            self.balanced[:n] = -self._drift - self.pace * degrees * mu
        if self.mode:
            first = self.squares[0]
            self.response[:n, first] = 0.5 * (degrees + self.exponent) * self.balanced[:n]
        self.operator = self.response[:n] + self.flow
        if held:
            self.operator = self._held(self.operator, self.covariance[:n])

    def _held(self, whole: np.ndarray, moments: np.ndarray) -> np.ndarray:
        """What holds the temperature added to changes of dμ/dt, of moments that change too.

        Arguments: (trial, changes, ...) both.
        """
        mu, degrees = self.moments[: self.count], self.degrees[: self.count]
        pace = -0.5 * (self.trace(whole) + 2.0 * self.pace * self.trace(moments))
        extra = _outer(degrees * mu, pace / self.trace(mu))
        return whole + self.pace * degrees[:, None] * moments + extra

    def collisional(self, path: str) -> np.ndarray:
        """∂/∂θ of the collisional changes at fixed distribution: (trial + 1, ...).

        A change of all rates by one factor is taken out and put back for balanced collisions.
        """
        own = [*range(self.count), -1]
        name = path.removeprefix("gas.")
        if name == path:
            return np.zeros_like(self.source)
        found = self.means["tangents"][self.sampler.paths.index(name)][own]
        factor = found[-1] / self.source[-1]
        return found + factor * (self.balanced - self.source)

    def explicit(self, path: str) -> np.ndarray:
        """∂/∂θ of the drift at fixed distribution: (trial, ...)."""
        value = float(value_at(self.scene, path))
        step = RELATIVE_STEP * (abs(value) or 1.0)
        return slope(
            lambda h: self.drift(shifted(self.scene, path, h), self.moments, self.cubed), step
        )

    def rates(self, path: str) -> np.ndarray:
        """∂/∂θ of dμ/dt at fixed distribution, the temperature held if it is: (trial, ...)."""
        whole = self.collisional(path)[: self.count] + self.explicit(path)
        if not self.sampler.held:
            return whole
        return self._held(whole[:, None], np.zeros_like(whole[:, None]))[:, 0]

    def steady(self, path: str) -> Change:
        """The response of the steady state to one number."""
        n, first = self.count, self.squares[0]
        matrix, right = self.operator.copy(), -self.rates(path)
        scale = self.scale[:n]
        if self.mode and not self.sampler.held:
            image, asked = matrix[:, first] / scale, right / scale
            share = np.sum(image * asked, axis=0) / np.sum(image * image, axis=0)
            rest = np.max(np.abs(asked - share * image), axis=0)
            if np.all(rest <= PURE * np.max(np.abs(asked), axis=0)):
                coefficients = np.zeros_like(right)
                coefficients[first] = share
                return self.change(path, coefficients, pure=True)
        fixed = [first] if self.sampler.held else []
        fixed += list(np.flatnonzero(self.degrees[:n] == 1))  # momentum
        for row in fixed:
            of_trace = self.trace(self.covariance) if row == first else self.covariance[row]
            matrix[row], right[row] = of_trace, 0.0
        rows = np.max(np.abs(matrix) / scale, axis=1)
        return self.change(path, solved(matrix / rows[:, None] / scale, right / rows) / scale)

    def change(self, path: str, coefficients: np.ndarray, pure: bool = False) -> Change:
        """What becomes of the averages with these coefficients (trial, ...)."""
        return Change(
            times_vector(self.covariance, coefficients),
            np.sum(self.cubed_response * coefficients, axis=0),
            times_vector(self.response, coefficients) + self.collisional(path),
            pure,
        )


def _outer(rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """(rows, columns, ...) of arrays (rows, ...) and (columns, ...)."""
    return rows[:, None] * columns


def times_vector(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """(rows, ...) of a matrix (rows, columns, ...) and a vector (columns, ...)."""
    return np.einsum("kl...,l...->k...", matrix, vector)


def solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """x of A x = b: (rows, ...) of arrays (rows, rows, ...) and (rows, ...)."""
    last = np.moveaxis(matrix, (0, 1), (-2, -1)), np.moveaxis(right, 0, -1)[..., None]
    return np.moveaxis(np.linalg.solve(*last)[..., 0], -1, 0)


def drift_of(scene, sampler: Sampler, count: int, moments: np.ndarray, cubed) -> np.ndarray:
    """d⟨φ_k⟩/dt of the first `count` rows by all but collisions: (count, ...)."""
    mean = Averages(sampler.rows, moments, {"cubed": cubed})
    shape = np.shape(moments)[1:]
    drift = scene.moment_drift  # a bound method of a module takes time to make
    found = [np.broadcast_to(drift(powers, mean), shape) for powers in sampler.rows[:count]]
    return np.stack(found).astype(float)


def value_at(scene, path: str) -> Any:
    """The number of a scene at a path."""
    here = scene
    for step in path.split("."):
        if isinstance(here, tuple | list):
            here = here[int(step)]
        else:
            here = here[step] if isinstance(here, dict) else vars(here)[step]
    return here
