"""Error bars from independent realizations, and tests for drift."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import stdtr


def jackknife(
    means: dict[Any, np.ndarray], function: Callable, axis: int, *, leading: bool = False
):
    """Value and standard error of a function of averages over realizations.

    Arguments:
        means: per-realization averages; realizations along `axis` of every array.
        function: maps a dict of averages (without that axis) to a dict of observables.
        leading: True if it takes leading axes of any shape: one call instead of one a realization.
    Returns: three dicts: the observables of the overall averages, one standard error each, and
    their values with one realization left out, stacked along a first axis. The leave-one-out
    estimate of the error is right for any smooth function (Efron 1982).
    """
    count = next(iter(means.values())).shape[axis]
    whole, others = _all_and_others(means, axis)
    value = function(whole)
    with np.errstate(invalid="ignore"):  # what is infinite has no error: NaN
        if leading:
            found = function(others)
            out = {n: np.broadcast_to(found[n], (count, *np.shape(value[n]))) for n in value}
        else:
            each = [function({name: x[r] for name, x in others.items()}) for r in range(count)]
            out = {name: np.stack([np.asarray(one[name]) for one in each]) for name in value}
        error = {
            name: np.sqrt((count - 1) * np.var(values, axis=0)) for name, values in out.items()
        }
    return value, error, out


def _all_and_others(means: dict[Any, np.ndarray], axis: int) -> tuple[dict, dict]:
    """Averages over an axis, and without each of its elements (these along the first axis).

    Real numbers, one a realization, are taken together: calls of NumPy are what a small run pays.
    """
    plain = [n for n, x in means.items() if np.ndim(x) == 1 and np.isrealobj(x)]
    apart = {name: array for name, array in means.items() if name not in plain}
    whole = {name: np.mean(array, axis=axis) for name, array in apart.items()}
    others = {name: _means_of_others(array, axis) for name, array in apart.items()}
    if plain:
        together = np.stack([means[name] for name in plain])
        whole |= dict(zip(plain, np.mean(together, axis=1), strict=True))
        others |= dict(zip(plain, _means_of_others(together, 1).T, strict=True))
    return whole, others


def averages_of_others(means: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Averages over all realizations but one, for each of them: arrays (realizations, ...)."""
    return _all_and_others(means, 0)[1]


def _means_of_others(values: np.ndarray, axis: int) -> np.ndarray:
    """For each element along an axis, moved to the front, the mean of all others.

    Without a subtraction: one element may be 10³⁰ times the others.
    """
    values = np.moveaxis(np.asarray(values), axis, 0)
    none = np.zeros_like(values[:1])
    before = np.concatenate([none, np.cumsum(values[:-1], axis=0)])
    after = np.concatenate([np.cumsum(values[:0:-1], axis=0)[::-1], none])
    return (before + after) / (len(values) - 1)


BLOCKS = 4
"""Blocks of each realization for the second estimate of an error."""


def larger_errors(error: dict, of_blocks: dict, left_out: dict) -> tuple[dict, dict]:
    """The larger of two errors of each observable, and leave-one-out values spread to it.

    Eight realizations know their error to 25%, and once in hundreds of values it is three times too
    small; blocks of them have more degrees of freedom, but may be correlated.
    """
    larger = {name: np.fmax(error[name], of_blocks[name]) for name in error}
    return larger, {n: spread_to(x, error[n], larger[n]) for n, x in left_out.items()}


def spread_to(left_out: np.ndarray, error, wanted) -> np.ndarray:
    """Leave-one-out values (R, ...) of one jackknife error spread about their mean to another."""
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = np.where(error > 0, wanted / error, 1.0)
    middle = np.mean(left_out, axis=0)
    return middle + factor * (left_out - middle)


def drift_significance(early: np.ndarray, late: np.ndarray, axis: int = -1) -> np.ndarray:
    """Probability that realizations without drift differ as much as these do early and late.

    Arguments: averages of an early and a late block, realizations along `axis`. Each realization
    gives one independent difference: Student's t with R - 1 degrees of freedom.
    """
    difference = late - early
    count = difference.shape[axis]
    spread = np.std(difference, axis=axis, ddof=1) / np.sqrt(count)
    with np.errstate(divide="ignore", invalid="ignore"):
        score = np.abs(np.mean(difference, axis=axis)) / spread
    return np.asarray(2.0 * stdtr(count - 1, -np.where(spread > 0, score, 0.0)))


def variogram_ratio(blocks: np.ndarray) -> float:
    """Variogram of block means over a lag of four blocks, relative to that over one.

    Arguments: means of consecutive blocks, (realizations, blocks); what all realizations do alike
    is subtracted. The ratio is 1 for independent blocks, and 11/2 for means of a random walk, which
    shows from its increments whether or not realizations started alike. Constants give 0.
    """
    own = blocks - np.mean(blocks, axis=0)
    near, far = (np.mean((own[:, lag:] - own[:, :-lag]) ** 2) for lag in (1, 4))
    scale = np.mean(blocks**2)
    return float(far / near) if near > 1e-24 * scale else 0.0
