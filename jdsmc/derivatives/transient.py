"""Derivatives at fixed time along a run that starts from a given state.

dδμ/dt = L G⁻¹ δμ + s with δμ(0) = 0: the same linearised generator, of the distribution as it is at
every record. No exact fact is used: they belong to steady states.
"""

import numpy as np

from ..scenarios.base import AbstractScene
from ..scenarios.homogeneous import AbstractHomogeneous
from ..stats import jackknife
from .observed import reported_names, slopes, state_of
from .response import Facts, Generator, solved, times_vector
from .samples import Samples, leading_last

DEGREE, HIGHER = 4, 6
"""Of the trial functions, and of those that tell the truncation: one record is too few particles
for error bars at degree 6."""

SUBSTEPS = 4
"""Steps between two records: the operator is interpolated, modes of a rate 1/τ are resolved."""


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
    times = time[first]

    def found(averages: dict, degree: int) -> dict[str, np.ndarray]:
        return _along(scene, samples, averages, times, degree, paths)

    value, error, _ = jackknife(
        means, lambda averages: found(averages, DEGREE), axis=0, leading=True
    )
    higher = found({name: np.mean(x, axis=0) for name, x in means.items()}, HIGHER)
    columns = {"time": times}
    for name in value:
        columns[name] = value[name]
        columns[f"{name}_error"] = error[name]
        columns[f"{name}_truncation"] = np.abs(higher[name] - value[name])
    return columns


def _along(scene, samples: Samples, averages: dict, times, degree: int, paths) -> dict:
    """Of every observable: arrays (..., numbers, blocks, ...), leading axes of the averages."""
    none = Facts(mode=False, stationary=False)
    generator = Generator(scene, samples.sampler, leading_last(averages), degree, none)
    inverse = _inverse(generator)
    operator = np.einsum("kl...,lm...->km...", generator.operator, inverse)
    state, found = state_of(generator), []
    for path in paths.values():
        moved = _moved(operator, generator.rates(path), times, generator.scale)
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


def _moved(operator: np.ndarray, source: np.ndarray, times, scale: np.ndarray) -> np.ndarray:
    """δμ at every block, the last axis, by Crank and Nicolson's rule between them."""
    change, found, before = np.zeros_like(source[..., 0]), [], 0.0
    for k, time in enumerate(times):
        earlier = max(k - 1, 0)
        step = (time - before) / SUBSTEPS
        for part in range(SUBSTEPS if step > 0 else 0):
            a, b = (
                [(1.0 - share) * x[..., earlier] + share * x[..., k] for x in (operator, source)]
                for share in (part / SUBSTEPS, (part + 1) / SUBSTEPS)
            )
            change = _crank_nicolson(change, a, b, step, scale[: len(source), ..., k])
        found.append(change)
        before = time
    return np.stack(found, axis=-1)


def _crank_nicolson(change, before, after, step: float, scale: np.ndarray) -> np.ndarray:
    """One step of dx/dt = A x + s; in units of `scale`, for the condition of the system."""
    right = change + 0.5 * step * (times_vector(before[0], change) + before[1] + after[1])
    one = np.eye(len(change)).reshape(*after[0].shape[:2], *(1,) * (change.ndim - 1))
    return scale * solved(one - 0.5 * step * after[0] * scale / scale[:, None], right / scale)
