"""Estimates of several simulations together: means, arrays, fits; values that hang on a rule."""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np

from jdsmc import Estimate, combine
from jdsmc.stats import jackknife


class Span(NamedTuple):
    """A number that depends on a criterion: at the middle one, and the range from loose to strict.

    `label` tells the criteria.
    """

    value: float
    low: float
    high: float
    label: str

    def __str__(self) -> str:
        return f"{self.value:.3g} ({self.low:.3g} to {self.high:.3g})"


def mean(parts: Sequence[Estimate]) -> Estimate:
    """Of estimates that all weigh the same."""
    return combine(lambda *values: np.mean(values, axis=0), *parts)


def stack(estimates: Iterable[Estimate]) -> Estimate:
    """Numbers as one array."""
    return combine(lambda *values: np.array(values), *estimates)


def total(found: Estimate, axis: int = -1) -> Estimate:
    """Sum over an axis whose entries have independent errors."""
    value, error = found
    return Estimate(np.sum(value, axis), np.sqrt(np.sum(np.square(error), axis)))


def each(found: Estimate) -> list[Estimate]:
    """The entries of an array."""
    return [found[k] for k in range(len(found.value))]


def over_parts(values: np.ndarray, function: Callable = lambda mean: mean) -> Estimate:
    """A function of the mean over equal parts, the first axis; the error from leaving out each."""
    found = jackknife({"": values}, lambda averages: {"": function(averages[""])}, axis=0)
    value, error, left_out = (part[""] for part in found)
    return Estimate(value, error, {object(): left_out})


class Fit:
    """Weighted least squares.

    Arguments: `columns`, what each number depends on linearly, (numbers, terms); the numbers, of
    which NaN (states that had not settled) is left out.
    Attributes: `terms`, the coefficients; `misfit`, χ²/ν (NaN without freedom).
    """

    def __init__(self, columns, numbers: Sequence[Estimate]):
        value, error = np.array([[float(one.value), float(one.error)] for one in numbers]).T
        there = np.isfinite(value + error)
        columns, value, error = np.asarray(columns, float)[there], value[there], error[there]
        numbers = [one for one, known in zip(numbers, there, strict=True) if known]
        inverse = np.linalg.pinv(columns / error[:, None]) / error
        self.terms = [
            combine(lambda *values, row=row: row @ np.array(values), *numbers) for row in inverse
        ]
        best = inverse @ value
        freedom = len(value) - len(best)
        score = np.sum(((value - columns @ best) / error) ** 2)
        self.misfit = float(score / freedom) if freedom else float("nan")

    def at(self, weights) -> Estimate:
        """The fit for a row of columns."""
        return combine(lambda *terms: np.dot(weights, terms), *self.terms)


class Even(Fit):
    """v + c x^2p + ...: what is left of a number at x -> 0. `powers`: p of each term but v."""

    def __init__(self, x, numbers: Sequence[Estimate], powers: tuple[float, ...]):
        self.exponents = 2.0 * np.array((0, *powers))
        super().__init__(np.asarray(x, float)[:, None] ** self.exponents, numbers)

    @property
    def limit(self) -> Estimate:
        """v."""
        return self.terms[0]

    def value(self, x: float) -> Estimate:
        """The fit at x."""
        return self.at(x**self.exponents)

    def excess(self, x: float) -> Estimate:
        """The fit at x over the limit, minus 1."""
        return (self.value(x) - self.limit) / abs(self.limit)


def within(deviation: Estimate, tolerance: float) -> str:
    """Whether a number is as near to 0 as asked, at two standard errors."""
    near, error = abs(float(deviation.value)), 2.0 * float(deviation.error)
    if near + error < tolerance:
        return "yes"
    return "no" if near - error > tolerance else "not resolved"
