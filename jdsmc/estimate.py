"""Numbers with one standard error, and arithmetic that propagates it."""

import uuid
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from . import check


class Point(NamedTuple):
    """One point of the sweep that a run made: what stems from it alone."""

    run: Any
    number: int


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

        `points`: a number for each element, that of its point in the sweep which a run made, equal
        for what was measured on the same gas (a profile, a correlation in time); by default every
        element is a gas of its own. Of several runs, a dict. `freedom`: the degrees of freedom of
        each run's share of the error, R - 1 if not said; without a run the error counts as known.
        """
        if np.any(np.asarray(error) < 0):
            raise ValueError(f"error = {error} is outside the allowed range [0, inf).")
        self.value, self.error = value, error
        if left_out is None:  # two pseudo-realizations that give just this error
            both = np.stack([np.subtract(value, error), np.add(value, error)])
            left_out = {uuid.uuid4().hex: both}
            freedom = dict.fromkeys(left_out, np.inf)
        self._left_out = left_out
        self._freedom = freedom or {run: len(x) - 1.0 for run, x in left_out.items()}
        if not isinstance(points, dict):
            if points is None:
                points = np.arange(np.size(value)).reshape(np.shape(value))
            points = {run: points for run in left_out if not isinstance(run, Point)}
        self._points: dict[Any, Any] = points

    def __iter__(self) -> Iterator:
        return iter((self.value, self.error))

    def __getitem__(self, index) -> "Estimate":
        """One element of an array, or some of them; points of a sweep are independent."""
        left_out, freedom, points = {}, {}, {}
        value, error = (np.asarray(x)[index] for x in (self.value, self.error))
        for key, replicas in self._left_out.items():
            new, there = key, self._points.get(key)
            if there is not None:
                there = np.asarray(there)[index]
                if len(numbers := np.unique(there)) == 1:
                    new = Point(key, int(numbers[0]))
                else:
                    points[key] = there
            left_out[new] = replicas[(slice(None), *np.index_exp[index])]
            freedom[new] = np.broadcast_to(self._freedom[key], np.shape(self.value))[index]
        return Estimate(value, error, left_out, points, freedom)

    def _runs(self) -> list:
        """The runs that it stems from."""
        return [key.run if isinstance(key, Point) else key for key in self._left_out]

    def _numbers(self, run) -> set[int]:
        """The points of a run that it stems from."""
        if run in self._points:
            return set(np.unique(self._points[run]).tolist())
        return {k.number for k in self._left_out if isinstance(k, Point) and k.run == run}

    def _share(self, key) -> tuple[Any, Any] | None:
        """Values with one realization left out of a run, or of one point of it; their freedom.

        None if it does not stem from there.
        """
        if key in self._left_out:
            return self._left_out[key], self._freedom[key]
        if not isinstance(key, Point) or key.run not in self._points:
            return None
        here = np.asarray(self._points[key.run]) == key.number
        if not np.any(here):
            return None
        freedom = np.broadcast_to(self._freedom[key.run], np.shape(self.value))[here]
        return np.where(here, self._left_out[key.run], self.value), np.min(freedom)

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

    def __rpow__(self, base) -> "Estimate":
        return combine(np.power, base, self)

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
        """How many standard errors it lies above a number, or above another estimate; none above
        itself."""
        value, error = self - truth
        return value / np.where(value == 0, 1.0, error)[()]

    def __repr__(self) -> str:
        return f"Estimate({self})"

    def __format__(self, form: str) -> str:
        """As `str`; by a format of numbers, `f"{estimate:.3f}"`, value ± error in that format."""
        if not form or not np.ndim(self.value):
            return f"{self.value:{form}} ± {self.error:{form}}" if form else str(self)
        rows = zip(np.ravel(self.value), np.ravel(self.error), strict=True)
        return "\n".join(f"{value:{form}} ± {error:{form}}" for value, error in rows)

    def __str__(self) -> str:
        if np.ndim(self.value):
            rows = zip(np.ravel(self.value), np.ravel(self.error), strict=True)
            return "\n".join(format_estimate(float(v), float(e)) for v, e in rows)
        return format_estimate(float(self.value), float(self.error))


def combine(function: Callable, *inputs) -> Estimate:
    """A smooth function of estimates and plain numbers, with its error.

    Each run in turn leaves out its realizations while the other inputs keep their values; and
    where inputs stem from different points of its sweep, or the function mixes points, one point
    after the other does.
    """
    values = [x.value if isinstance(x, Estimate) else x for x in inputs]
    value = function(*values)
    left_out, freedom, points = {}, {}, {}
    variance = np.zeros(np.shape(value))
    estimates = [x for x in inputs if isinstance(x, Estimate)]
    for run in dict.fromkeys(run for x in estimates for run in x._runs()):
        alike = _common_points(run, estimates)
        if alike is not None and np.shape(alike) == np.shape(value):
            keys, points[run] = [run], alike
        else:
            keys = [
                Point(run, k) for k in sorted(set().union(*(x._numbers(run) for x in estimates)))
            ]
        for key in keys:
            shares = [x._share(key) if isinstance(x, Estimate) else None for x in inputs]
            left_out[key] = _replicas(function, values, shares)
            freedom[key] = _least_freedom([x[1] for x in shares if x], np.shape(value))
            variance = variance + (len(left_out[key]) - 1) * np.var(left_out[key], axis=0)
    error = np.sqrt(variance)
    return Estimate(value, error if np.ndim(error) else float(error), left_out, points, freedom)


def _common_points(run, estimates: list[Estimate]):
    """Points of the elements, if all that stem from a run have the same; else None."""
    involved = [x for x in estimates if run in x._runs()]
    known = [x._points.get(run) for x in involved]
    first = known[0]
    if first is None or not all(x is not None and np.array_equal(x, first) for x in known):
        return None
    return first


def _replicas(function: Callable, values: list, shares: list) -> np.ndarray:
    """The function with each realization left out: (realizations, ...)."""
    counts = {len(x[0]) for x in shares if x is not None}
    if len(counts) > 1:
        raise ValueError(
            "these estimates stem from different windows of one run, or from different numbers of "
            "its realizations; take another seed for one of them."
        )
    return np.stack(
        [
            np.asarray(
                function(
                    *(v if x is None else x[0][r] for v, x in zip(values, shares, strict=True))
                )
            )
            for r in range(counts.pop())
        ]
    )


def _least_freedom(each: list, shape: tuple[int, ...]):
    """Degrees of freedom of a share: element by element where shapes allow it."""
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
