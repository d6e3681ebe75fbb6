"""Steady derivatives with error and truncation, from the samples of a run."""

from itertools import pairwise

import numpy as np

from ..scenarios.base import AbstractScene, weighted_means
from ..scenarios.homogeneous import AbstractHomogeneous
from ..stats import BLOCKS, jackknife, larger_errors
from .controls import controlled
from .observed import State, reported_names, slopes, state_of
from .response import Change, Facts, Generator
from .samples import Samples, leading_last

LOWER = 2
"""Degrees between the trial functions and those of the comparison that tells the truncation."""

AHEAD = 1.0 / 3.0
"""What all higher degrees add, in units of what the last two did: each two degrees add a quarter of
what the two before them did. Seen: 0.32 to 0.60 for a2 and 0 to 0.57 for a* of a sheared gas
(α = 0.6 to 0.9), 0.1 to 0.4 for a2 of a cooling gas, so that as much again is in doubt."""


def steady_derivatives(
    scene: AbstractScene,
    samples: Samples,
    point: int,
    first: int,
    paths: dict[str, str],
    facts: Facts = Facts(),  # noqa: B008 (immutable)
) -> dict[str, np.ndarray] | None:
    """Derivatives of one point measured from record `first` on; None if nothing was sampled there.

    Arguments: the scene of the point; numbers by short name. Returns, by name of the observable and
    with `_error`, `_truncation` and `_left_out` behind it: arrays (numbers, ...) and, of the last,
    (realizations, numbers, ...). The error is the larger one of realizations and of blocks.
    """
    if not isinstance(scene, AbstractHomogeneous) or not samples.has(first):
        return None
    means, weights, _ = samples.point(point, first)
    if facts.stationary:
        means = controlled(scene, samples.sampler, means, weights)

    def extrapolated(averages: dict) -> dict[str, np.ndarray]:
        return _all_slopes(scene, samples, averages, paths, facts, AHEAD)

    own = weighted_means(means, weights)
    value, error, left_out = jackknife(own, extrapolated, axis=0, leading=True)
    whole = {name: np.mean(x, axis=0) for name, x in own.items()}
    added = _all_slopes(scene, samples, whole, paths, facts, 0.0)
    if weights.shape[1] >= BLOCKS:
        blocks = _in_blocks(means, weights)
        _, of_blocks, _ = jackknife(blocks, extrapolated, axis=0, leading=True)
        error, left_out = larger_errors(error, of_blocks, left_out)
    columns = {}
    for name in value:
        columns[name] = value[name]
        columns[f"{name}_error"] = error[name]
        columns[f"{name}_truncation"] = np.abs(value[name] - added[name])
        columns[f"{name}_left_out"] = left_out[name]
    return columns


def _all_slopes(
    scene, samples: Samples, averages: dict, paths: dict[str, str], facts: Facts, ahead: float
) -> dict[str, np.ndarray]:
    """Of every observable: arrays (..., numbers, ...), leading axes those of the averages.

    `ahead`: the changes of the averages go on by this share of what the last two degrees did.
    """
    averages, degree = leading_last(averages), samples.sampler.degree
    higher, lower = (
        Generator(scene, samples.sampler, averages, at, facts) for at in (degree, degree - LOWER)
    )
    moments, cubed, source = state_of(higher)
    state = State(moments, cubed, source[_shared(lower)])
    each = []
    for path in paths.values():
        change = _extrapolated(higher.steady(path), lower.steady(path), _shared(lower), ahead)
        each.append(slopes(scene, samples.sampler, path, state, change))
    axis = cubed.ndim
    return {
        name: np.stack([one[name] for one in each], axis=axis) for name in reported_names(scene)
    }


def _shared(lower: Generator) -> list[int]:
    """Rows of the collisional changes that lower degrees have too; the last counts collisions."""
    return [*range(lower.count), -1]


def _extrapolated(higher: Change, lower: Change, rows: list[int], ahead: float) -> Change:
    def on(a, b):
        return a + ahead * (a - b)

    return Change(
        on(higher.moments, lower.moments),
        on(higher.cubed, lower.cubed),
        on(higher.source[rows], lower.source),
        higher.pure and lower.pure,
    )


def _in_blocks(means: dict[str, np.ndarray], weights: np.ndarray) -> dict[str, np.ndarray]:
    """Averages over each of a few blocks of every realization: (realizations x blocks, ...)."""
    edges = np.linspace(0, weights.shape[1], BLOCKS + 1).astype(int)
    parts = [
        weighted_means({n: x[:, a:b] for n, x in means.items()}, weights[:, a:b])
        for a, b in pairwise(edges)
    ]
    return {name: np.concatenate([part[name] for part in parts]) for name in means}
