"""How long the approach to the steady state takes."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from jdsmc import Estimate

from ..compare import Span
from .data import Measurements
from .limits import Quantity

START = 2.0
"""Time from which the approach is taken as one exponential (τ0): b'_3 starts with no slope."""


BOUNDS = (0.1, 0.05), (20.0, 5.0)
"""Of the amplitude and the rate (1/τ0): wide; noise alone must not end the fit."""


class Approach(NamedTuple):
    """v(t) = v (1 - A exp(-t/τ)): the time τ (τ0), and when v(t) is within 2% of v, [5% to 1%]."""

    time: Estimate
    within: Span


def approach(
    data: Measurements, quantity: Quantity, restitution: float, strength: float
) -> Approach:
    """A least-squares fit to the mean of all parts; errors from leaving out each (jackknife)."""
    pool = data.transient(restitution, strength)
    steady = data.steady(strength).value(quantity.name, restitution, quantity.order).value
    time, values = pool.each_series(restitution, quantity.name, quantity.order)
    late = time >= START
    time, values = time[late], values[:, late] / steady

    def fitted(mean) -> np.ndarray:
        def apart(parameters):
            amplitude, rate = parameters
            return mean - 1.0 + amplitude * np.exp(-rate * time)

        amplitude, rate = least_squares(apart, (1.0, 0.4), bounds=BOUNDS).x
        reach = np.log(amplitude / np.array([0.02, 0.05, 0.01])) / rate
        return np.array([1.0 / rate, *reach])

    best = fitted(np.mean(values, axis=0))
    count = len(values)
    left_out = [fitted((np.sum(values, axis=0) - one) / (count - 1)) for one in values]
    error = np.sqrt((count - 1) * np.var(left_out, axis=0)) if count > 1 else np.full(4, np.nan)
    reach = (float(x) for x in best[1:])
    return Approach(
        Estimate(float(best[0]), float(error[0])), Span(*reach, label="within 2% [5% to 1%]")
    )
