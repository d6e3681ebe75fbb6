"""The first-order marginal distribution: φ(c_x²), its truncated series, and β1(c_x²)/b'_1.

And how long a coefficient takes to its steady value.
"""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares
from scipy.special import eval_genlaguerre

from jdsmc import Estimate
from jdsmc.measure.distributions import BIN_WIDTH

from ..numbers import Even, Span, over_parts
from .data import Heat
from .limits import Quantity, at_field

HEAT_FLUX_LIMIT = 6.0
"""c_x² up to which the paper counts the share of the heat flux."""

SHARE_FIELD = 0.05
"""The strongest field of the extrapolation of shares: at 0.1 terms beyond ε*² are seen."""


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


def odd_part(data: Heat, restitution: float, strength: float) -> Odd:
    """Half the difference of the density at c_x and -c_x, eq. (3.15), over ε*."""
    centres, density = data.steady(strength).marginal(restitution)
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
    return over_parts(running, lambda mean: mean / mean[-1])


def share_below(odd: Odd, squared: float = HEAT_FLUX_LIMIT) -> Estimate:
    """The share of the heat flux from particles with c_x² below a limit (between edges: cubic)."""
    edges, at = odd.edges[1:], np.sqrt(squared)
    found = share(odd)
    value = CubicSpline(edges, found.value)(at)
    return Estimate(float(value), float(np.interp(at, edges, found.error)))


def share_limit(data: Heat, restitution: float) -> Even:
    """The share of c_x² <= 6 in the heat flux against the field, extrapolated with ε*²."""
    strengths = [f for f in data.fields if f <= SHARE_FIELD]
    found = [share_below(odd_part(data, restitution, f)) for f in strengths]
    return Even(strengths, found, (1,))


START = 2.0
"""Time from which the approach is taken as one exponential (τ0): b'_3 starts with no slope."""

BOUNDS = (0.1, 0.05), (20.0, 5.0)
"""Of the amplitude and the rate (1/τ0): wide; noise alone must not end the fit."""


class Approach(NamedTuple):
    """v(t) = v (1 - A exp(-t/τ)): the time τ (τ0), and when v(t) is within 2% of v, [5% to 1%]."""

    time: Estimate
    within: Span


def approach(data: Heat, quantity: Quantity, restitution: float, strength: float) -> Approach:
    """A least-squares fit to the mean of all parts; errors from leaving out each (jackknife)."""
    pool = data.transient(restitution, strength)
    final = at_field(data, quantity, restitution, strength).value
    time, parts = pool.each_series(restitution, quantity.name, quantity.order)
    late = time >= START
    time, values = time[late], np.array([part.value[late] for part in parts]) / final

    def fitted(mean) -> np.ndarray:
        def apart(parameters):
            amplitude, rate = parameters
            return mean - 1.0 + amplitude * np.exp(-rate * time)

        amplitude, rate = least_squares(apart, (1.0, 0.4), bounds=BOUNDS).x
        reach = np.log(amplitude / np.array([0.02, 0.05, 0.01])) / rate
        return np.array([1.0 / rate, *reach])

    found = over_parts(values, fitted)
    return Approach(found[0], Span(*map(float, found.value[1:]), label="within 2% [5% to 1%]"))
