"""Derivatives at fixed time along a run that starts from a given state.

dδμ/dt = L G⁻¹ δμ + s with δμ(0) = 0: the same linearised generator, of the distribution as it is at
every record. No exact fact is used: they belong to steady states.
"""

from collections.abc import Callable

import numpy as np
import scipy

from ..scenarios.base import AbstractScene
from ..scenarios.homogeneous import AbstractHomogeneous
from ..stats import jackknife
from .observed import reported_names, slopes, state_of
from .response import Facts, Generator, solved, times_vector
from .samples import Samples, leading_last

DEGREE, HIGHER = 4, 6
"""Of the trial functions, and of those that tell the truncation: one record is too few particles
for error bars at degree 6."""

TOGETHER = 8
"""Realizations left out that are solved at once: all of a long series would take gigabytes."""

GAIN = 4.0
"""What a spline through twice as many blocks is at least better by: 16 where it converges."""

SUBSTEPS = 8
"""Steps between two records: modes of a rate 1/τ are resolved to a part in a thousand."""


def transient_derivatives(
    scene: AbstractScene, samples: Samples, point: int, time: np.ndarray, paths: dict[str, str]
) -> dict[str, np.ndarray] | None:
    """Derivatives of one point at every record; None where temperature is held (time is scaled).

    Arguments: as of `steady_derivatives`; `time` (records,). Returns `time` (blocks,)
    and, by name and with `_error` and `_truncation` behind it, arrays (numbers, blocks, ...).
    """
    if not isinstance(scene, AbstractHomogeneous) or samples.sampler.held:
        return None
    means, _, first = samples.point(point, 0)
    times = _middle(time, first)

    def found(averages: dict, degree: int, every: int = 1) -> dict[str, np.ndarray]:
        return _along(scene, samples, averages, times, degree, paths, every)

    def of_others(averages: dict) -> dict[str, np.ndarray]:
        if np.ndim(averages["cubed"]) == 1:
            return found(averages, DEGREE)
        firsts = range(0, len(averages["cubed"]), TOGETHER)
        parts = [{n: x[k : k + TOGETHER] for n, x in averages.items()} for k in firsts]
        each = [found(part, DEGREE) for part in parts]
        return {name: np.concatenate([one[name] for one in each]) for name in each[0]}

    value, error, _ = jackknife(means, of_others, axis=0, leading=True)
    whole = {name: np.mean(x, axis=0) for name, x in means.items()}
    higher, coarser = found(whole, HIGHER), found(whole, DEGREE, every=2)
    columns = {"time": times}
    for name in value:
        columns[name] = value[name]
        columns[f"{name}_error"] = error[name]
        between = np.abs(coarser[name] - value[name]) / GAIN
        columns[f"{name}_truncation"] = np.abs(higher[name] - value[name]) + between
    return columns


def _middle(time: np.ndarray, first: np.ndarray) -> np.ndarray:
    """Mean of the times at which the records of each block start: they are sampled there."""
    parts = np.split(time, first[1:])
    return np.array([np.mean(part) for part in parts])


def _along(scene, samples: Samples, averages: dict, times, degree: int, paths, every: int) -> dict:
    """Of every observable: arrays (..., numbers, blocks, ...), leading axes of the averages.

    `every`: 2 if only every second block is to tell what lies between.
    """
    none = Facts(mode=False, stationary=False)
    generator = Generator(scene, samples.sampler, leading_last(averages), degree, none)
    inverse = _inverse(generator)
    operator = np.einsum("kl...,lm...->km...", generator.operator, inverse)
    state, found = state_of(generator), []
    for path in paths.values():
        moved = _moved(operator, generator.rates(path), times, generator.scale, every)
        change = generator.change(path, times_vector(inverse, moved))
        found.append(slopes(scene, samples.sampler, path, state, change))
    axis = generator.cubed.ndim - 1
    return {
        name: np.stack([one[name] for one in found], axis=axis) for name in reported_names(scene)
    }


def _inverse(one: Generator) -> np.ndarray:
    """G⁻¹ of the trial functions; inverted in powers of the thermal speed, for its condition."""
    scale = one.scale[: one.count]
    units = scale[:, None] * scale
    last = np.moveaxis(one.covariance[: one.count] / units, (0, 1), (-2, -1))
    return np.moveaxis(np.linalg.inv(last), (-2, -1), (0, 1)) / units


def _moved(operator: np.ndarray, source: np.ndarray, times, scale, every: int) -> np.ndarray:
    """δμ at every block, the last axis, by Crank and Nicolson's rule between them.

    Operator and source in between are those of a cubic spline: along straight lines the source of
    a gas that heats up would be 5% too large where it is sampled every 0.4 τ0.
    """
    change, found, before = np.zeros_like(source[..., 0]), [], 0.0
    both = np.concatenate([operator, source[:, None]], axis=1)
    blocks = len(times)
    used = np.arange(blocks)
    if every > 1:  # of two, the first alone
        used = np.unique([*range(0, blocks, every), blocks - 1]) if blocks > 2 else used[:1]
    at = _smooth(times[used], both[..., used])
    here = at(before)
    for k, time in enumerate(times):
        step = (time - before) / SUBSTEPS
        for part in range(SUBSTEPS if step > 0 else 0):
            there = at(before + (part + 1) * step)
            change = _crank_nicolson(change, here, there, step, scale[: len(source), ..., k])
            here = there
        before = time
        found.append(change)
    return np.stack(found, axis=-1)


def _smooth(times, values: np.ndarray) -> Callable:
    """Values (..., blocks) at any time, by a cubic spline if there are two blocks or more."""
    if len(times) == 1:
        return lambda time: values[..., 0]
    return scipy.interpolate.CubicSpline(times, np.moveaxis(values, -1, 0))


def _crank_nicolson(change, before, after, step: float, scale: np.ndarray) -> np.ndarray:
    """One step of dx/dt = A x + s, A and s side by side; in units of `scale`, for its condition."""
    (a, now), (b, then) = ((both[:, :-1], both[:, -1]) for both in (before, after))
    right = change + 0.5 * step * (times_vector(a, change) + now + then)
    one = np.eye(len(change)).reshape(*b.shape[:2], *(1,) * (change.ndim - 1))
    return scale * solved(one - 0.5 * step * b * scale / scale[:, None], right / scale)
