"""Checks of user input on the host: one clear sentence naming the parameter and its range."""

import os
from pathlib import Path

import jax
import jax.core
import numpy as np

MOST = 2**31
"""Larger sizes fit no array here."""


def physical(value):
    """Turn a number, list or array into a float64 NumPy array; leave JAX values (traced) alone.

    What is no number is left alone too, for `in_range` to refuse with the name of the parameter.
    """
    numbers = None if isinstance(value, jax.Array) else _numbers(value)
    return value if numbers is None else numbers


def _numbers(value) -> np.ndarray | None:
    """As a float64 array; None for text, truth values, ragged lists and other objects."""
    if np.ma.is_masked(value):
        return None
    try:
        array = np.asarray(value)
    except ValueError:
        return None
    return array.astype(float) if array.dtype.kind in "iuf" else None


def in_range(name, value, low, high, *, low_included=True, high_included=True, axes=0):
    """Raise unless `value` is a number, or an array of them, finite and within the interval.

    `axes` are those of the number itself; a sweep may add one. Traced values pass: they cannot be
    inspected, and were checked when they were concrete.
    """
    if isinstance(value, jax.core.Tracer):
        return
    interval = f"{'[' if low_included else '('}{low:g}, {high:g}{']' if high_included else ')'}"
    array = _numbers(value)
    if array is None:
        raise TypeError(f"{name} = {value!r} is not a number in the allowed range {interval}.")
    above = array >= low if low_included else array > low
    below = array <= high if high_included else array < high
    good = np.isfinite(array) & above & below
    if not np.all(good):
        bad = float(np.atleast_1d(array)[~np.atleast_1d(good)][0])
        rounded = float(f"{bad:g}") in (low, high) and bad not in (low, high)  # 1.0000001, not 1
        shown = repr(bad) if rounded else f"{bad:g}"
        raise ValueError(f"{name} = {shown} is outside the allowed range {interval}.")
    if not axes <= array.ndim <= axes + 1:
        kind = "a scalar" if axes == 0 else f"an array of {axes} axes"
        raise ValueError(
            f"{name} has shape {array.shape}; this physical number is {kind} or, for a sweep, has "
            "one axis more (a one-dimensional array of scalars)."
        )
    if array.size == 0:
        raise ValueError(f"{name} is an empty array; give at least one value.")


def scalar(name, value, low, high, *, high_included=True):
    """Raise unless `value` is one number above `low` and within `high`."""
    if np.ndim(value) > 0:
        raise TypeError(f"{name} = {value!r} must be one number; only physical numbers are swept.")
    in_range(name, value, low, high, low_included=False, high_included=high_included)


def whole(name, value, low) -> int:
    """The value as an integer of at least `low`: 1e4 and NumPy's integers too, but not True."""
    if isinstance(value, bool | np.bool_) or not isinstance(value, int | float | np.number):
        raise TypeError(f"{name} must be an integer, got {value!r}.")
    if not isinstance(value, int) and not (np.isfinite(value) and value == int(value)):
        raise TypeError(f"{name} must be an integer, got {value!r}.")
    if value < low:
        raise ValueError(f"{name} = {value} is outside the allowed range [{low}, inf).")
    return int(value)


def path(name, value) -> Path:
    """The value as a path; TypeError for what names no file."""
    if not isinstance(value, str | os.PathLike):
        raise TypeError(f"{name} must be the path of a file, got {value!r}.")
    return Path(value)


def counted(value):
    """An int for what is whole (20.0, NumPy's integers); the rest is left for `at_least`."""
    numeric = isinstance(value, float | np.number) and np.isfinite(value)
    return int(value) if numeric and value == int(value) else value


def at_least(name, value, low) -> None:
    """Raise unless `value` is an integer (bool excluded) of at least `low`."""
    whole(name, value, low)


def size(name, value, low, most=MOST) -> int:
    """As `whole`, of a value below `most`, a power of two: by default what arrays can hold."""
    found = whole(name, value, low)
    if found >= most:
        power = int(most).bit_length() - 1
        raise ValueError(f"{name} = {value} is outside the allowed range [{low}, 2^{power}).")
    return found


def untraced(name, values) -> None:
    """Raise TypeError if any of the values of what is to be run is traced."""
    if any(isinstance(value, jax.core.Tracer) for value in values):
        raise TypeError(
            f"{name} cannot be run within jax.jit, grad or vmap: give arrays of numbers for a "
            "sweep, and ask for derivatives by sensitivity."
        )


def one_of(name, value, choices):
    """Raise unless `value` is one of the named choices."""
    if not isinstance(value, str) or value not in choices:
        raise ValueError(f"{name} = {value!r} is unknown; choose one of {', '.join(choices)}.")
