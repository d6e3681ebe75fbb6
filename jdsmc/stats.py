"""Error bars from independent realizations, and tests for drift."""

from collections.abc import Callable

import numpy as np
from scipy.stats import t as student


def jackknife(means: dict[str, np.ndarray], function: Callable, axis: int):
    """Value and standard error of a function of averages over realizations.

    Arguments:
        means: per-realization averages; realizations along `axis` of every array.
        function: maps a dict of averages (without that axis) to a dict of observables.
    Returns: two dicts, the observables of the overall averages and one standard error each.
    The leave-one-out estimate of the error is right for any smooth function (Efron 1982).
    """
    count = next(iter(means.values())).shape[axis]
    total = {name: np.sum(value, axis=axis) for name, value in means.items()}
    value = function({name: array / count for name, array in total.items()})
    with np.errstate(invalid="ignore"):  # what is infinite has no error: NaN
        left_out = [
            function({n: (total[n] - np.take(means[n], r, axis=axis)) / (count - 1) for n in means})
            for r in range(count)
        ]
        error = {
            name: np.sqrt((count - 1) * np.var([one[name] for one in left_out], axis=0))
            for name in value
        }
    return value, error


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
    return np.asarray(2.0 * student.sf(np.where(spread > 0, score, 0.0), count - 1))


def linear_trend(times: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Least-squares slope of each series over its own times, both (..., records)."""
    centred = times - np.mean(times, axis=-1, keepdims=True)
    return np.sum(centred * values, axis=-1) / np.sum(centred**2, axis=-1)
