"""High-velocity tails of F(C): is ln F linear in C?"""

from typing import NamedTuple

import numpy as np
from scipy.optimize import curve_fit

from jdsmc import Estimate

from .data import Measurements

TAIL = 3.0
"""Tails begin at this C: three thermal speeds, as R_3 does."""

LARGEST_ERROR = 0.3
"""Bins with a larger relative error are left out: their logarithm is not Gaussian."""


class Tail(NamedTuple):
    """Fits of ln F to A - B C^μ for `first` <= C <= `last`.

    `exponent`: μ when free; `misfit`: χ²/ν of that; `misfit_exponential`, `misfit_gaussian`: of
    μ = 1 and μ = 2; `slopes`: -d ln F/dC in the inner and the outer half of the range.
    """

    exponent: Estimate
    misfit: float
    misfit_exponential: float
    misfit_gaussian: float
    slopes: tuple[Estimate, Estimate]
    first: float
    last: float


def exponent(data: Measurements, gas: str, restitution: float, first: float = TAIL) -> Tail:
    """Fits to the tail of F from `first` on, averaged over the shear rates."""
    c, log, error = log_tail(data, gas, restitution, first)
    start = (log[0] + 2.0 * c[0], 2.0, 1.0)
    bounds = ([-np.inf, 0.0, 0.2], [np.inf, np.inf, 4.0])
    best, covariance = curve_fit(
        _stretched, c, log, start, error, absolute_sigma=True, bounds=bounds, maxfev=20_000
    )
    middle = 0.5 * (c[0] + c[-1])
    return Tail(
        Estimate(float(best[2]), float(np.sqrt(covariance[2, 2]))),
        _misfit(log - _stretched(c, *best), error, 3),
        _line(c, log, error)[1],
        _line(c**2, log, error)[1],
        tuple(_line(c[part], log[part], error[part])[0] for part in (c < middle, c >= middle)),
        float(c[0]),
        float(c[-1]),
    )


def log_tail(data: Measurements, gas: str, restitution: float, first: float):
    """C, ln F and its standard error, up to the first bin that is too uncertain."""
    found = data.mean_distribution(gas, restitution)
    c, density = found["speed_bin"].values, found["speed"].values
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = np.where(density > 0, found["speed_error"].values / density, np.inf)
    uncertain = np.flatnonzero((c > first) & ~(relative < LARGEST_ERROR))
    inside = slice(np.searchsorted(c, first), uncertain[0] if len(uncertain) else len(c))
    floor = np.median(relative[inside])  # a bin whose few realizations agree by chance
    error = np.maximum(relative[inside], 0.1 * floor)
    return c[inside], np.log(density[inside]), error


def _stretched(c, constant, factor, power):
    return constant - factor * c**power


def _line(x, y, error) -> tuple[Estimate, float]:
    """Minus the slope of a weighted straight line, and χ²/ν."""
    coefficients, covariance = np.polyfit(x, y, 1, w=1.0 / error, cov="unscaled")
    misfit = _misfit(y - np.polyval(coefficients, x), error, 2)
    return Estimate(float(-coefficients[0]), float(np.sqrt(covariance[0, 0]))), misfit


def _misfit(residual, error, parameters: int) -> float:
    return float(np.sum((residual / error) ** 2) / max(1, len(residual) - parameters))
