"""The first-order marginal distribution: φ(c_x²), its truncated series, and β1(c_x²)/b'_1."""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import eval_genlaguerre

from jdsmc import Estimate
from jdsmc.measure import BIN_WIDTH

from .data import Pool

HEAT_FLUX_LIMIT = 6.0
"""c_x² up to which the paper counts the share of the heat flux."""


class Odd(NamedTuple):
    """The odd part of the density of c_x in bins with c_x > 0, divided by ε*: (parts, bins).

    `edges` are the limits of the bins, one more than bins.
    """

    edges: np.ndarray
    density: np.ndarray

    @property
    def centres(self) -> np.ndarray:
        """Centres of the bins."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])


def odd_part(pool: Pool, restitution: float, strength: float) -> Odd:
    """Half the difference of the density at c_x and -c_x, eq. (3.15), over ε*."""
    centres, density = pool.marginal(restitution)
    half = len(centres) // 2
    odd = 0.5 * (density[:, half:] - density[:, :half][:, ::-1]) / strength
    return Odd(np.arange(half + 1) * BIN_WIDTH, odd)


def phi(odd: Odd) -> Estimate:
    """φ(c_x²) in every bin: eq. (4.3) with the mean of c exp(-c²)/√π over the bin."""
    weight = -0.5 * np.diff(np.exp(-(odd.edges**2))) / np.sqrt(np.pi) / BIN_WIDTH
    return over_parts(odd.density / weight)


def truncated(coefficients, squared) -> np.ndarray:
    """φ_p(c_x²) of eq. (4.5), p the number of coefficients b'_1, b'_2, ..."""
    terms = [b * eval_genlaguerre(k + 1, 0.5, squared) for k, b in enumerate(coefficients)]
    return np.sum(terms, axis=0)


def share(odd: Odd) -> Estimate:
    """β1(c_x²)/b'_1 at the upper edge of every bin, eq. (4.6) and its limit.

    Within a bin φ is taken as constant; c² (3/2 - c²) exp(-c²) is the derivative of ½ c³ exp(-c²).
    """
    c = odd.edges
    weight = np.diff(c**3 * np.exp(-(c**2))) / -np.diff(np.exp(-(c**2)))
    running = np.cumsum(odd.density * weight, axis=1)
    mean = np.mean(running, axis=0)
    return Estimate(mean / mean[-1], _ratio_error(running))


def share_below(odd: Odd, squared: float = HEAT_FLUX_LIMIT) -> Estimate:
    """The share of the heat flux from particles with c_x² below a limit (between edges: cubic)."""
    value, error = share(odd)
    edges = odd.edges[1:]
    between = CubicSpline(edges, value)(np.sqrt(squared))
    return Estimate(float(between), float(np.interp(np.sqrt(squared), edges, error)))


def over_parts(values: np.ndarray) -> Estimate:
    """Mean and standard error over the parts, the first axis."""
    return Estimate(np.mean(values, axis=0), _jackknife(values, lambda mean: mean))


def _ratio_error(running: np.ndarray) -> np.ndarray:
    """Standard error of the mean over parts, divided by its own last value."""
    return _jackknife(running, lambda mean: mean / mean[-1])


def _jackknife(values: np.ndarray, function) -> np.ndarray:
    """Standard error of a function of the mean over parts, from leaving out each."""
    count = len(values)
    if count < 2:
        return np.full(np.shape(function(values[0])), np.nan)
    left_out = [function((np.sum(values, axis=0) - one) / (count - 1)) for one in values]
    return np.sqrt((count - 1) * np.var(left_out, axis=0))
