"""Checks of user input on the host: one clear sentence naming the parameter and its range."""

import jax
import numpy as np


def physical(value):
    """Turn a number, list or array into a float64 NumPy array; leave JAX values (traced) alone."""
    if isinstance(value, jax.Array):
        return value
    try:
        return np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"expected a number or an array of numbers, got {value!r}") from None


def in_range(name, value, low, high, *, low_included=True, high_included=True):
    """Raise ValueError unless every element of `value` is finite and within the interval.

    Traced values pass: they cannot be inspected, and were checked when they were concrete.
    """
    if isinstance(value, jax.core.Tracer):
        return
    array = np.asarray(value, dtype=float)
    above = array >= low if low_included else array > low
    below = array <= high if high_included else array < high
    good = np.isfinite(array) & above & below
    if not np.all(good):
        bad = np.atleast_1d(array)[~np.atleast_1d(good)][0]
        interval = f"{'[' if low_included else '('}{low:g}, {high:g}{']' if high_included else ')'}"
        raise ValueError(f"{name} = {bad:g} is outside the allowed range {interval}.")
    if array.ndim > 1:
        raise ValueError(
            f"{name} has shape {array.shape}; a physical number is a scalar or, for a sweep, "
            "a one-dimensional array."
        )
    if array.size == 0:
        raise ValueError(f"{name} is an empty array; give at least one value.")


def at_least(name, value, low):
    """Raise unless `value` is an integer (bool excluded) of at least `low`."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise TypeError(f"{name} must be an integer, got {value!r}.")
    if value < low:
        raise ValueError(f"{name} = {value} is outside the allowed range [{low}, inf).")


def one_of(name, value, choices):
    """Raise unless `value` is one of the named choices."""
    if value not in choices:
        raise ValueError(f"{name} = {value!r} is unknown; choose one of {', '.join(choices)}.")
