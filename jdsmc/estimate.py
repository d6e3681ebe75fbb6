"""Numbers with one standard error, and arithmetic that propagates it."""

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

_anonymous = itertools.count()


class Estimate:
    """A number (or an array over the swept dimensions) and one standard error.

    `value, error = estimate` takes it apart. `a - b`, `a / b`, `a ** 2`, `estimate.map(np.log)` and
    `combine(function, a, b)` propagate the error by a jackknife: what stems from one run is
    correlated through its realizations, what stems from different runs is independent.
    """

    __array_ufunc__ = None  # array - estimate comes here, too, instead of making an array of them

    def __init__(self, value, error, left_out: dict[Any, np.ndarray] | None = None, points=None):
        """`left_out`: for every run, the values with one realization left out (R, ...).

        `points`: a number for each element, equal for those measured on the same gas (a profile, a
        correlation in time); by default every element is a gas of its own.
        """
        self.value, self.error = value, error
        shape = np.shape(value)
        self._points = np.arange(np.size(value)).reshape(shape) if points is None else points
        if left_out is None:  # two pseudo-realizations that give just this error
            both = np.stack([np.subtract(value, error), np.add(value, error)])
            left_out = {next(_anonymous): both}
        self._left_out = left_out

    def __iter__(self) -> Iterator:
        return iter((self.value, self.error))

    def __getitem__(self, index) -> "Estimate":
        """One element of an array, or some of them; points of a sweep are independent."""
        points = np.asarray(self._points)[index]
        chosen, all_of_them = (tuple(np.unique(x).tolist()) for x in (points, self._points))
        part = () if chosen == all_of_them else (chosen,)
        left_out = {
            (run, *part) if part else run: x[(slice(None), *np.index_exp[index])]
            for run, x in self._left_out.items()
        }
        value, error = (np.asarray(x)[index] for x in (self.value, self.error))
        return Estimate(value, error, left_out, points)

    def map(self, function: Callable) -> "Estimate":
        """A smooth function of it, element by element."""
        return combine(function, self)

    def __add__(self, other) -> "Estimate":
        return combine(np.add, self, other)

    def __radd__(self, other) -> "Estimate":
        return combine(np.add, other, self)

    def __sub__(self, other) -> "Estimate":
        return combine(np.subtract, self, other)

    def __rsub__(self, other) -> "Estimate":
        return combine(np.subtract, other, self)

    def __mul__(self, other) -> "Estimate":
        return combine(np.multiply, self, other)

    def __rmul__(self, other) -> "Estimate":
        return combine(np.multiply, other, self)

    def __truediv__(self, other) -> "Estimate":
        return combine(np.divide, self, other)

    def __rtruediv__(self, other) -> "Estimate":
        return combine(np.divide, other, self)

    def __pow__(self, power) -> "Estimate":
        return combine(np.power, self, power)

    def __neg__(self) -> "Estimate":
        return combine(np.negative, self)

    def __abs__(self) -> "Estimate":
        return combine(np.abs, self)

    def __float__(self) -> float:
        return float(self.value)

    def distance(self, truth) -> float | np.ndarray:
        """How many standard errors it lies above a number, or above another estimate."""
        value, error = self - truth
        return value / error

    def __repr__(self) -> str:
        return f"Estimate({self})"

    def __str__(self) -> str:
        if np.ndim(self.value):
            rows = zip(np.ravel(self.value), np.ravel(self.error), strict=True)
            return "\n".join(format_estimate(float(v), float(e)) for v, e in rows)
        return format_estimate(float(self.value), float(self.error))


def combine(function: Callable, *inputs) -> Estimate:
    """A smooth function of estimates and plain numbers, with its error.

    Each run in turn leaves out its realizations while the other inputs keep their values.
    """
    values = [x.value if isinstance(x, Estimate) else x for x in inputs]
    value = function(*values)
    runs = {run for x in inputs if isinstance(x, Estimate) for run in x._left_out}
    left_out = {}
    variance = np.zeros(np.shape(value))
    for run in runs:
        changed = [
            x._left_out[run] if isinstance(x, Estimate) and run in x._left_out else None
            for x in inputs
        ]
        counts = {len(x) for x in changed if x is not None}
        if len(counts) > 1:
            raise ValueError("these estimates stem from different windows of one run.")
        replicas = np.stack(
            [
                np.asarray(
                    function(
                        *(v if c is None else c[r] for v, c in zip(values, changed, strict=True))
                    )
                )
                for r in range(counts.pop())
            ]
        )
        left_out[run] = replicas
        variance = variance + (len(replicas) - 1) * np.var(replicas, axis=0)
    error = np.sqrt(variance)
    alike = [x._points for x in inputs if isinstance(x, Estimate)]
    points = next((x for x in alike if np.shape(x) == np.shape(value)), None)
    return Estimate(value, error if np.ndim(error) else float(error), left_out, points)


def format_estimate(value: float, error: float) -> str:
    """Value with its error in units of the last digits, e.g. 0.3325(4)."""
    if not np.isfinite(error) or error <= 0:
        return f"{value:.6g}"
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    shown = round(error * 10**digits)
    if digits and shown >= 100:  # 0.0999 rounds up to 0.100: one digit fewer
        digits, shown = digits - 1, round(error * 10 ** (digits - 1))
    return f"{value:.{digits}f}({shown})" if digits else f"{value:.0f}({error:.0f})"
