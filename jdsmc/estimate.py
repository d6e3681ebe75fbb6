"""Numbers with one standard error, and arithmetic that propagates it."""

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from . import check

_anonymous = itertools.count()


class Estimate:
    """A number (or an array over the swept dimensions) and one standard error.

    `value, error = estimate` takes it apart. `a - b`, `a / b`, `a ** 2`, `estimate.map(np.log)` and
    `combine(function, a, b)` propagate the error by a jackknife: what stems from one run is
    correlated through its realizations, what stems from different runs is independent.
    `estimate.mean()` and `estimate.sum()`, or NumPy's, are over the elements of an array (Python's
    own `sum` takes the pair apart, and adds value and error).
    `estimate.interval(0.95)` holds the truth with at least this probability (Student's t).
    """

    __array_ufunc__ = None  # array - estimate comes here, too, instead of making an array of them

    def __init__(
        self,
        value,
        error,
        left_out: dict[Any, np.ndarray] | None = None,
        points=None,
        freedom: dict[Any, Any] | None = None,
    ):
        """`left_out`: for every run, the values with one realization left out (R, ...).

        `points`: a number for each element, equal for those measured on the same gas (a profile, a
        correlation in time); by default every element is a gas of its own. `freedom`: the degrees
        of freedom of each run's share of the error, R - 1 if not said; without a run the error
        counts as known.
        """
        if np.any(np.asarray(error) < 0):
            raise ValueError(f"error = {error} is outside the allowed range [0, inf).")
        self.value, self.error = value, error
        shape = np.shape(value)
        self._points = np.arange(np.size(value)).reshape(shape) if points is None else points
        if left_out is None:  # two pseudo-realizations that give just this error
            both = np.stack([np.subtract(value, error), np.add(value, error)])
            left_out = {next(_anonymous): both}
            freedom = dict.fromkeys(left_out, np.inf)
        self._left_out = left_out
        self._freedom = freedom or {run: len(x) - 1.0 for run, x in left_out.items()}

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
        shape = np.shape(self.value)
        freedom = {
            new: np.broadcast_to(self._freedom[run], shape)[index]
            for new, run in zip(left_out, self._left_out, strict=True)
        }
        return Estimate(value, error, left_out, points, freedom)

    def mean(self, axis: int | None = None, dtype=None, out=None) -> "Estimate":
        """Over the elements, or along one axis; points of a sweep are independent."""
        return self._reduced(np.mean, axis)

    def sum(self, axis: int | None = None, dtype=None, out=None) -> "Estimate":
        """Over the elements, or along one axis; points of a sweep are independent."""
        return self._reduced(np.sum, axis)

    def _reduced(self, function: Callable, axis: int | None) -> "Estimate":
        shape = np.shape(self.value)
        if axis is None:
            parts = [self[index] for index in np.ndindex(shape)]
        else:
            before = (slice(None),) * range(len(shape))[axis]
            parts = [self[(*before, k)] for k in range(shape[axis])]
        return combine(lambda *each: function(each, axis=0), *parts)

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

    @property
    def degrees_of_freedom(self) -> float | np.ndarray:
        """Of its error: realizations less one, infinite for an error that was given.

        A run prints the larger of two errors (`docs/method.md`): these are the degrees of freedom
        of the smaller sample, so that an interval holds the truth at least as often as it says.
        Of several runs: Welch (1947) and Satterthwaite (1946), (Σ s²)²/Σ(s⁴/ν).
        """
        shape = np.shape(self.value)
        if len(self._freedom) == 1:
            found = np.broadcast_to(next(iter(self._freedom.values())), shape)
            return found if shape else float(found)
        least = np.full(shape, np.inf)
        total, each = np.zeros(shape), np.zeros(shape)
        for run, values in self._left_out.items():
            freedom = np.broadcast_to(self._freedom[run], shape)
            variance = (len(values) - 1) * np.var(values, axis=0)
            total, each = total + variance, each + variance**2 / freedom
            least = np.minimum(least, freedom)
        with np.errstate(divide="ignore", invalid="ignore"):
            found = np.where(total > 0, np.fmax(total**2 / each, least), least)
        return found if shape else float(found)

    def interval(self, level: float = 0.95) -> tuple:
        """Ends of the interval that holds the truth with probability `level` or more.

        Student's t with `degrees_of_freedom`. Raises ValueError unless 0 < level < 1.
        """
        check.scalar("level", level, 0.0, 1.0, high_included=False)
        from scipy.stats import t as student  # noqa: PLC0415 - slow to import

        reach = student.ppf(0.5 + 0.5 * level, self.degrees_of_freedom) * self.error
        return self.value - reach, self.value + reach

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
    left_out, freedom = {}, {}
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
        left_out[run], freedom[run] = replicas, _least_freedom(run, inputs, np.shape(value))
        variance = variance + (len(replicas) - 1) * np.var(replicas, axis=0)
    error = np.sqrt(variance)
    alike = [x._points for x in inputs if isinstance(x, Estimate)]
    points = next((x for x in alike if np.shape(x) == np.shape(value)), None)
    return Estimate(value, error if np.ndim(error) else float(error), left_out, points, freedom)


def _least_freedom(run, inputs, shape: tuple[int, ...]):
    """Degrees of freedom of a run's share: element by element where shapes allow it."""
    each = [x._freedom[run] for x in inputs if isinstance(x, Estimate) and run in x._freedom]
    return np.min([x if np.shape(x) == shape else np.min(x) for x in each], axis=0)


def format_estimate(value: float, error: float) -> str:
    """Value with its error in units of the last digits, e.g. 0.3325(4).

    An error below 1e-6 of the value is one of rounding, of what is conserved: it is not shown.
    Neither is that of a value that is not there.
    """
    if np.isfinite(value) and not np.isfinite(error):
        return f"{value:.6g}({error:g})"
    if not np.isfinite(value) or error <= 1e-6 * abs(value):
        return f"{value:.6g}"
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    shown = round(error * 10**digits)
    if digits and shown >= 100:  # 0.0999 rounds up to 0.100: one digit fewer
        digits, shown = digits - 1, round(error * 10 ** (digits - 1))
    return f"{value:.{digits}f}({shown})" if digits else f"{value:.0f}({error:.0f})"
