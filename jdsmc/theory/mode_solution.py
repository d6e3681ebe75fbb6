"""Stationary transverse mode of a gas of disks at one wave number, and what the cut-offs leave.

Two cut-offs: the `degree` of the moments and the Sonine `order` of the cooling state. The first
converges at every restitution where the second does; both are only asymptotic when the gas is so
inelastic that its exponential tail is felt (restitution below about 0.7), because an expansion
about a Gaussian does not hold it: beyond a degree that falls with the restitution the drag makes
spurious moments grow. `levels` stays below that degree, and the errors grow accordingly.

Units of this module: n sigma = 1 and sqrt(2 T / m) = 1.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy
from numpy.typing import NDArray
from scipy.linalg import solve_continuous_lyapunov

from jdsmc.theory.disk_moments import moments

Floats = NDArray[np.float64]
LOWEST_RESTITUTION = 0.4
LEVELS = (  # smallest restitution, three degrees, the Sonine order used and the one compared
    (0.775, (24, 32, 40), (8, 6)),
    (0.745, (16, 24, 32), (8, 6)),
    (0.69, (16, 20, 24), (8, 6)),
    (0.64, (12, 16, 20), (6, 4)),
    (0.59, (8, 12, 16), (6, 4)),
    (0.49, (8, 10, 12), (5, 4)),
    (LOWEST_RESTITUTION, (6, 8, 10), (4, 3)),
)
NEGLIGIBLE = 1e-13  # amplitude of a mode, relative to the largest, that is rounding
ROUNDING = 1e-10  # relative, of eigenvalues and of the Lyapunov equation at these sizes


@dataclass(frozen=True)
class Solution:
    """C(s) = sum_j Re(weights_j exp(-rates_j s)), sorted by falling size of the weights.

    `amplitude` is C(0). The first mode is the hydrodynamic one.
    """

    amplitude: float
    rates: NDArray[np.complex128]
    weights: NDArray[np.complex128]

    @property
    def primary(self) -> Floats:
        """C(0), the rate of the hydrodynamic mode and its weight; shape (3,)."""
        return np.array([self.amplitude, self.rates[0].real, self.weights[0].real])

    def autocorrelation(self, time: Floats) -> Floats:
        """C(s) at each time >= 0, of the shape of `time`."""
        return (np.exp(-np.multiply.outer(time, self.rates)) @ self.weights).real


def levels(restitution: float, degree: int | None) -> tuple[tuple[int, ...], tuple[int, int]]:
    """Three degrees, the last the best, and two Sonine orders, the first the better one."""
    degrees, orders = next(entry[1:] for entry in LEVELS if restitution >= entry[0])
    if degree is None:
        return degrees, orders
    step = max(min(4, degrees[1] - degrees[0]), 2 * (degree // 8))
    return (degree - 2 * step, degree - step, degree), orders


@lru_cache(maxsize=64)
def solve(restitution: float, wave_number: float, degree: int, order: int) -> Solution:
    """Lyapunov equation and spectrum, a growing mode of hydrodynamics included.

    ValueError if no mode of one decay rate leads, or if another one grows.
    """
    equations = moments(restitution, degree, order)
    matrix = equations.local + wave_number * equations.streaming
    covariance = equations.single + solve_continuous_lyapunov(matrix, -equations.source)
    values, vectors = np.linalg.eig(matrix)
    weights = vectors[0] * np.linalg.solve(vectors, covariance[:, 0])
    falling = np.argsort(-np.abs(weights))
    kept = falling[np.abs(weights[falling]) > NEGLIGIBLE * np.max(np.abs(weights))]
    solution = Solution(float(covariance[0, 0]), -values[kept], weights[kept])
    if np.any(solution.rates[1:].real <= 0):
        raise ValueError(
            f"degree {degree} is too high at restitution {restitution:g}: moments grow that must "
            f"not; at most {levels(restitution, None)[0][-1]} is safe."
        )
    if solution.rates[0].imag != 0:
        number = (2 * np.pi / wave_number) ** 2
        raise ValueError(
            f"reduced_number = {number:g} is too small at restitution {restitution:g}: the mode "
            "does not end in one exponential, so there is no viscosity; about 8 or more is safe."
        )
    return solution


def marginal_wave_number(restitution: float, degree: int, order: int, guess: float) -> float:
    """The k at which the slowest rate passes zero; `guess` within a factor 2.5 of it.

    An eigenvalue is zero where the Schur complement of the mode itself, 1 / (A^-1)_xx, is.
    """
    equations = moments(restitution, degree, order)
    first = np.zeros(len(equations.local))
    first[0] = 1.0

    def complement(wave_number: float) -> float:
        matrix = equations.local + wave_number * equations.streaming
        return float(1 / np.linalg.solve(matrix, first)[0])

    return float(
        scipy.optimize.brentq(complement, guess / 2.5, guess * 2.5, xtol=1e-13, rtol=1e-12)
    )


def extrapolate(values: Floats) -> tuple[Floats, Floats]:
    """Limit of three equally spaced degrees by Aitken's rule, and how far it is from the last.

    `values` has the degrees on its first axis. Where the differences do not shrink there is
    nothing to extrapolate: the last value, and the larger of the two differences.
    """
    first, second = values[1] - values[0], values[2] - values[1]
    shrinks = np.abs(second) < np.abs(first)
    ratio = np.where(shrinks, second / np.where(shrinks, first, 1.0), 0.0)
    ratio = np.clip(ratio, -0.7, 0.7)
    rest = second * ratio / (1 - ratio)
    larger = np.maximum(np.abs(first), np.abs(second))
    # the parts of the differences: `second` may be small by chance, where the error changes sign
    error = np.abs(rest) + 0.2 * np.abs(second) + 0.1 * np.abs(first)
    return values[2] + rest, np.where(shrinks, error, larger)
