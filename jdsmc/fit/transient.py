"""Whole transients as targets: least squares over the time series of a swept model.

The exact scaling leaves a transient two numbers more than a steady state, its start and the shear
rate; so the model is swept over its free numbers, each value of its series is a polynomial of
their logarithms at a fixed time, and the sum of squares is minimised by Gauss and Newton.
"""

import itertools
from typing import Any

import numpy as np
import scipy

from ..errors import unbroken
from ..estimate import Estimate, combine
from ..results.result import Result
from ..running.estimates import against_time
from ..running.run import run
from ..scenarios import AbstractScene
from ..stats import jackknife
from .labelled import Match, nothing
from .numbers import replaced, value_of
from .targets import SERIES, Target

WIDTH = 0.25
"""Half the range of the logarithm of each free number in one sweep."""

NODES, DEGREE = 5, 3
"""Values of each free number in a sweep; total degree of the polynomial."""

MOST_SWEEPS = 4


def series_of(result: Result, names: tuple[str, ...], point: int) -> tuple[np.ndarray, list]:
    """Times, and an `Estimate` over them for each name.

    A result that was loaded knows the error at each time and not how they are correlated.
    """
    if result.under_way is None:
        data = result.series
        time, one = data["time"].values, np.zeros(data.sizes["sample"], int)
        known = ((data[n].values, data[f"{n}_error"].values) for n in names)
        return time, [Estimate(*both, points=one) for both in known]
    history = result.under_way.session.history
    time, means = history.on_common_times(point)
    scene = history.scenes[point]
    value, error, left_out = jackknife(means, lambda x: against_time(scene, x), axis=0)
    key = (result.attrs["run"], f"series {point}")
    one = np.zeros(len(time), int)  # all times are of the same gases
    return time, [Estimate(value[n], error[n], {key: left_out[n]}, one) for n in names]


def transient(
    model: AbstractScene, free: tuple[str, ...], fit: Target, reference: Result, options: dict
) -> tuple[Match, Result]:
    """The free numbers whose transients come nearest to those of the reference, and the last sweep.

    Deviations are relative to the root of the mean square of a reference series; all its times
    weigh the same. The misfit is their root of the mean square.
    """
    names = tuple(name.removeprefix(SERIES) for name in fit.names)
    time, wanted = series_of(reference, names, 0)
    middle = np.log([value_of(model, name) for name in free])
    duration = {"duration": float(time[-1]), **options}
    for _ in range(MOST_SWEEPS):
        swept = _Swept(model, free, middle, names, time, duration)
        best = swept.best(fit, wanted)
        if np.all(np.abs(best - middle) <= WIDTH):
            return swept.match(fit, wanted, best), swept.result
        middle = middle + np.clip(best - middle, -2.0 * WIDTH, 2.0 * WIDTH)
    where = ", ".join(f"{n} = {np.exp(x):.3g}" for n, x in zip(free, middle, strict=True))
    return nothing(free, f"no value matches {fit.label}: still improving at {where}"), swept.result


class _Swept:
    """The model swept about the logarithms `middle` of its free numbers."""

    def __init__(self, model, free, middle, names, time, options):
        nodes = WIDTH * np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)
        axes = {name: np.exp(m + nodes) for name, m in zip(free, middle, strict=True)}
        self.free, self.middle = free, middle
        scene = replaced(model, axes)
        self.result = unbroken(run(scene, **options))
        order = self.result.dims
        offsets = np.array(list(itertools.product(nodes, repeat=len(free))))
        offsets = offsets[:, [order.index(name) for name in free]]
        found: list[Any] = [series_of(self.result, names, p) for p in range(len(offsets))]
        last = min(float(times[-1]) for times, _ in found)
        self.within = time <= last
        self.nodes = [
            combine(lambda *v, t=times: _between(t, v)(time[self.within]), *series)
            for times, series in found
        ]
        columns = np.stack([self._row(offset) for offset in offsets])
        self.hat = np.linalg.pinv(columns)
        self.values = np.stack([one.value for one in self.nodes])

    def _row(self, offset) -> np.ndarray:
        scaled = np.asarray(offset) / WIDTH
        powers = itertools.product(range(DEGREE + 1), repeat=len(scaled))
        return np.array([np.prod(scaled**p) for p in map(np.array, powers) if sum(p) <= DEGREE])

    def weights(self, offset) -> np.ndarray:
        """What each node counts for the series at an offset."""
        return self._row(offset) @ self.hat

    def scale(self, fit: Target, wanted: list[Estimate]) -> np.ndarray:
        """Factor of the deviations, (names,)."""
        size = [np.sqrt(np.mean(np.asarray(one.value)[self.within] ** 2)) for one in wanted]
        return np.array(fit.weights) / np.array(size)

    def misses(self, fit: Target, wanted: list[Estimate], offset) -> np.ndarray:
        """Weighted relative deviations, flat."""
        goal = np.stack([np.asarray(one.value)[self.within] for one in wanted], axis=-1)
        model = np.tensordot(self.weights(offset), self.values, 1)
        return (self.scale(fit, wanted) * (model - goal)).ravel()

    def best(self, fit: Target, wanted: list[Estimate]) -> np.ndarray:
        """Logarithms of the free numbers at the least sum of squares, within twice the range."""
        start, bound = np.zeros(len(self.free)), 2.0 * WIDTH
        found = scipy.optimize.least_squares(
            lambda offset: self.misses(fit, wanted, offset), start, bounds=(-bound, bound)
        )
        return self.middle + found.x

    def match(self, fit: Target, wanted: list[Estimate], best: np.ndarray) -> Match:
        """The numbers and the misfit with the errors of both gases."""
        offset, step = best - self.middle, 1e-4
        shifts = step * np.eye(len(offset))
        slopes = np.stack(
            [
                self.misses(fit, wanted, offset + s) - self.misses(fit, wanted, offset - s)
                for s in shifts
            ],
            axis=-1,
        ) / (2.0 * step)
        inverse, weights = np.linalg.pinv(slopes), self.weights(offset)
        scale, middle = self.scale(fit, wanted), self.misses(fit, wanted, offset)
        count = len(wanted)

        def parts(*values):
            goal = np.stack([np.asarray(one)[self.within] for one in values[:count]], axis=-1)
            model = np.tensordot(weights, np.stack(values[count:]), 1)
            miss = (scale * (model - goal)).ravel()
            moved = inverse @ (miss - middle)
            left = miss - slopes @ moved
            return np.append(best - moved, 100.0 * np.sqrt(np.mean(left**2)))

        found = combine(parts, *wanted, *self.nodes)
        numbers = {name: found[k].map(np.exp) for k, name in enumerate(self.free)}
        return Match(numbers, found[len(self.free)])


def _between(times: np.ndarray, values: tuple) -> Any:
    """A cubic spline through values (..., times)."""
    return scipy.interpolate.CubicSpline(times, np.stack(values, -1))
