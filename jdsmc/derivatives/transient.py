"""Derivatives at fixed time along a run that starts from a given state.

dδμ/dt = L G⁻¹ δμ + s with δμ(0) = 0: the same linearised generator, of the distribution as it is at
every record. No exact fact is used: they belong to steady states.
"""

import numpy as np

from ..scenarios.base import AbstractScene
from ..scenarios.homogeneous import AbstractHomogeneous
from ..stats import jackknife
from .observed import State, reported_names, slopes, state_of
from .response import Change, Facts, Generator
from .samples import Samples

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

    value, error, _ = jackknife(means, lambda averages: found(averages, DEGREE), axis=0)
    higher = found({name: np.mean(x, axis=0) for name, x in means.items()}, HIGHER)
    columns = {"time": times}
    for name in value:
        columns[name] = value[name]
        columns[f"{name}_error"] = error[name]
        columns[f"{name}_truncation"] = np.abs(higher[name] - value[name])
    return columns


def _along(scene, samples: Samples, averages: dict, times, degree: int, paths) -> dict:
    """Of every observable: arrays (numbers, blocks, ...)."""
    none = Facts(mode=False, stationary=False)
    each = [
        Generator(scene, samples.sampler, {n: x[k] for n, x in averages.items()}, degree, none)
        for k in range(len(times))
    ]
    inverses = [_solved(one) for one in each]
    state = State(*(_stacked(part) for part in zip(*map(state_of, each), strict=True)))
    found = []
    for path in paths.values():
        coefficients = _coefficients(each, inverses, times, path)
        changes = [one.change(path, c) for one, c in zip(each, coefficients, strict=True)]
        moments, cubed, source, _ = zip(*changes, strict=True)
        whole = Change(_stacked(moments), _stacked(cubed), _stacked(source))
        found.append(slopes(scene, samples.sampler, path, state, whole))
    return {name: np.stack([one[name] for one in found]) for name in reported_names(scene)}


def _stacked(values) -> np.ndarray:
    """Blocks along the last axis."""
    return np.stack(list(values), axis=-1)


def _scale(one: Generator) -> np.ndarray:
    """Powers of the thermal speed of the trial functions."""
    size = np.sqrt(one.trace(one.moments) / one.scene.gas.dimension)
    return size ** one.degrees[: one.count]


def _solved(one: Generator) -> np.ndarray:
    """G⁻¹ of the trial functions."""
    scale, n = _scale(one), one.count
    inverse = np.linalg.inv(one.covariance[:n] / np.multiply.outer(scale, scale))
    return inverse / np.multiply.outer(scale, scale)


def _coefficients(each: list[Generator], inverses: list, times, path: str) -> list[np.ndarray]:
    """G⁻¹ δμ at every block, by Crank and Nicolson's rule between them."""
    operators = [one.operator @ inverse for one, inverse in zip(each, inverses, strict=True)]
    sources = [one.rates(path) for one in each]
    change, out, before = np.zeros(each[0].count), [], 0.0
    for k, time in enumerate(times):
        earlier = max(k - 1, 0)
        step = (time - before) / SUBSTEPS
        for part in range(SUBSTEPS if step > 0 else 0):
            a, b = (
                [(1.0 - share) * x[earlier] + share * x[k] for x in (operators, sources)]
                for share in (part / SUBSTEPS, (part + 1) / SUBSTEPS)
            )
            change = _crank_nicolson(change, a, b, step, _scale(each[k]))
        out.append(inverses[k] @ change)
        before = time
    return out


def _crank_nicolson(change, before, after, step: float, scale: np.ndarray) -> np.ndarray:
    """One step of dx/dt = A x + s; in units of `scale`, for the condition of the system."""
    right = change + 0.5 * step * (before[0] @ change + before[1] + after[1])
    matrix = np.eye(len(scale)) - 0.5 * step * after[0] * scale / scale[:, None]
    return scale * np.linalg.solve(matrix, right / scale)
