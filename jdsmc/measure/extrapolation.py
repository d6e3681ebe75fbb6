"""Continuation of a quantity in 1/N to an infinite system, by weighted least squares."""

from dataclasses import dataclass

import numpy as np

from ..check import whole


@dataclass(frozen=True)
class Extrapolation:
    """A polynomial in 1/N.

    coefficients: (order + 1,) of 1, 1/N, 1/N²; covariance: theirs.
    chi_squared, freedom: Σ ((value - fit)/error)² and its expectation, points - order - 1. Values
        of chi_squared far above `freedom` say that the order is too low.
    """

    coefficients: np.ndarray
    covariance: np.ndarray
    chi_squared: float
    freedom: int

    @property
    def limit(self) -> float:
        """The value at N → ∞."""
        return float(self.coefficients[0])

    @property
    def error(self) -> float:
        """One standard error of the limit, from those of the values; none for a wrong order."""
        return float(np.sqrt(self.covariance[0, 0]))

    def __call__(self, numbers):
        """The polynomial at these N; at inf its limit."""
        return np.polynomial.polynomial.polyval(1.0 / np.asarray(numbers, float), self.coefficients)


def extrapolate(numbers, values, errors, order: int = 1) -> Extrapolation:
    """Fit values(N) = c0 + c1/N (order 1, as Costantini & Puglisi) or + c2/N² (order 2).

    Arguments:
        numbers: N or N n σ², at least order + 1 different ones.
        values, errors: of the same shape; independent, one standard error each.
        order: of the polynomial in 1/N.
    The errors are taken as they are: the error of the limit is not scaled by chi squared.
    """
    order = whole("order", order, 0)
    numbers, values, errors = (np.asarray(x, dtype=float) for x in (numbers, values, errors))
    if numbers.ndim != 1 or numbers.shape != values.shape or numbers.shape != errors.shape:
        raise ValueError("numbers, values and errors must be lists of the same length.")
    if not (np.all(np.isfinite(values)) and np.all(numbers > 0) and np.all(errors > 0)):
        raise ValueError("numbers and errors must be positive, and values finite.")
    if np.unique(numbers).size <= order:
        raise ValueError(f"numbers must hold at least {order + 1} different N for order {order}.")
    unit = np.min(numbers)  # powers of unit/N are of order one
    design = np.vander(unit / numbers, order + 1, increasing=True) / errors[:, None]
    inverse = np.linalg.inv(design.T @ design)
    scale = unit ** np.arange(order + 1)
    scaled = inverse @ design.T @ (values / errors)
    return Extrapolation(
        coefficients=scaled * scale,
        covariance=inverse * np.outer(scale, scale),
        chi_squared=float(np.sum((design @ scaled - values / errors) ** 2)),
        freedom=values.size - order - 1,
    )
