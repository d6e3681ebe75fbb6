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
    """What becomes of averages per unit of a number, arrays (..., ) along leading axes.

    `moments` (rows,), `cubed` ⟨V12³⟩, `source` (trial + 1,): the collisional changes of the trial
    functions, and the number of collisions; `pure`: True if only the scale of speed changes.
    """

    moments: Any
    cubed: Any
    source: Any
    pure: bool = False


class Generator:
    """The linearised generator of one gas at one degree of the trial functions.

    Arguments: the scene of one point; what was sampled; averages of the samples (no leading axes);
    the degree; the exact facts to use.
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
        self.degrees = np.array([symmetry.degree(powers) for powers in sampler.rows], dtype=float)
        self.moments, self.cubed = means["moments"], means["cubed"]
        exponent = scene.gas.speed_exponent()
        self.mode = facts.mode and exponent is not None
        self.exponent = 0.0 if exponent is None else exponent
        self.squares = [sampler.rows.index(powers) for powers in symmetry.squares]
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
        self.covariance = m["second"][:, :n] - np.multiply.outer(self.moments, mu)
        self.cubed_response = m["cubed_response"][:n] - 2.0 * mu * self.cubed
        own = [*range(n), -1]
        self.response = m["response"][own, :n] - 2.0 * np.multiply.outer(m["source"][own], mu)
        self.source = m["source"][own]
        if self.mode:
            first = self.squares[0]
            changed = np.array([*self.degrees[:n], 0.0])
            self.covariance[:, first] = 0.5 * self.degrees * self.moments
            self.cubed_response[first] = 1.5 * self.cubed
            self.response[:, first] = 0.5 * (changed + self.exponent) * self.source
        self.flow = self._along(self.covariance, self.cubed_response)

    def _along(self, moments: np.ndarray, cubed: np.ndarray) -> np.ndarray:
        """The drift linearised, along changes of the averages: (trial, changes)."""
        size = np.sqrt(self.trace(self.moments) / self.scene.gas.dimension)
        scale = size ** self.degrees[:, None]
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
        """What holds the temperature added to a change of dμ/dt, of moments that change too."""
        mu, degrees = self.moments[: self.count], self.degrees[: self.count]
        pace = -0.5 * (self.trace(whole) + 2.0 * self.pace * self.trace(moments))
        extra = np.multiply.outer(degrees * mu, pace / self.trace(mu))
        return whole + self.pace * (degrees * moments.T).T + extra

    def collisional(self, path: str) -> np.ndarray:
        """∂/∂θ of the collisional changes at fixed distribution: (trial + 1,).

        A change of all rates by one factor is taken out and put back for balanced collisions.
        """
        own = [*range(self.count), -1]
        name = path.removeprefix("gas.")
        if name == path:
            return np.zeros(self.count + 1)
        found = self.means["tangents"][self.sampler.paths.index(name)][own]
        factor = found[-1] / self.source[-1]
        return found + factor * (self.balanced - self.source)

    def explicit(self, path: str) -> np.ndarray:
        """∂/∂θ of the drift at fixed distribution: (trial,)."""
        value = float(value_at(self.scene, path))
        step = RELATIVE_STEP * (abs(value) or 1.0)
        return slope(
            lambda h: self.drift(shifted(self.scene, path, h), self.moments, self.cubed), step
        )

    def rates(self, path: str) -> np.ndarray:
        """∂/∂θ of dμ/dt at fixed distribution, the temperature held if it is: (trial,)."""
        whole = self.collisional(path)[: self.count] + self.explicit(path)
        return self._held(whole, np.zeros_like(whole)) if self.sampler.held else whole

    def steady(self, path: str) -> Change:
        """The response of the steady state to one number."""
        n = self.count
        matrix, right = self.operator.copy(), -self.rates(path)
        first = self.squares[0]
        size = np.sqrt(self.trace(self.moments) / self.scene.gas.dimension)
        scale = size ** self.degrees[:n]
        if self.mode and not self.sampler.held:
            image, asked = matrix[:, first] / scale, right / scale
            share = np.dot(image, asked) / np.dot(image, image)
            if np.max(np.abs(asked - share * image)) <= PURE * np.max(np.abs(asked)):
                return self.change(path, share * np.eye(n)[first], pure=True)
        fixed = [first] if self.sampler.held else []
        fixed += [k for k in range(n) if self.degrees[k] == 1]  # momentum
        for row in fixed:
            of_trace = self.trace(self.covariance) if row == first else self.covariance[row]
            matrix[row], right[row] = of_trace, 0.0
        rows = np.max(np.abs(matrix) / scale, axis=1)
        solved = np.linalg.solve(matrix / rows[:, None] / scale, right / rows)
        return self.change(path, solved / scale)

    def change(self, path: str, coefficients: np.ndarray, pure: bool = False) -> Change:
        """What becomes of the averages with these coefficients of the trial functions."""
        return Change(
            self.covariance @ coefficients,
            self.cubed_response @ coefficients,
            self.response @ coefficients + self.collisional(path),
            pure,
        )


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
