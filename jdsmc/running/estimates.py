"""Observables with error bars from the history of one point of a run."""

import itertools

import numpy as np

from ..errors import FaultError
from ..scenarios.base import AbstractScene
from ..stats import BLOCKS, jackknife, larger_errors
from .history import History


def against_time(scene: AbstractScene, averages: dict) -> dict:
    """What a scene reports against time, from averages of records."""
    wanted = [one.name for one in (*scene.reports, *scene.evolves)]
    if type(scene).evolution is AbstractScene.evolution:
        return _complete(scene, scene.observables(averages), wanted)
    found = scene.evolution(averages)
    return {name: np.asarray(found[name], dtype=float) for name in wanted if name in found}


def reported(scene: AbstractScene, averages: dict) -> dict:
    """What a scene reports, from averages; FaultError for a scene that forgets some of it."""
    return _complete(scene, scene.observables(averages), [one.name for one in scene.reports])


def _complete(scene: AbstractScene, found: dict, wanted: list[str]) -> dict:
    missing = [name for name in wanted if name not in found]
    if missing:
        raise FaultError(
            f"{type(scene).__name__}.observables lacks {', '.join(missing)}, which it reports."
        )
    return {name: np.asarray(found[name], dtype=float) for name in wanted}


def steady_estimates(history: History, point: int, edges) -> tuple[dict, dict, dict]:
    """Values, standard errors and leave-one-out values of all observables of one point.

    `edges` is the record to start from, or an array of them: each block between two of them then
    counts as a realization.
    """
    edges = [edges, history.length] if np.ndim(edges) == 0 else edges
    blocks = [history.point(point, a, b) for a, b in itertools.pairwise(edges)]
    means = {name: np.concatenate([b[name] for b in blocks]) for name in blocks[0]}
    scene = history.scenes[point]
    return jackknife(means, lambda averages: reported(scene, averages), axis=0)


def printed_estimates(history: History, point: int, first: int) -> tuple[dict, dict, dict]:
    """What is printed of one point measured from record `first` on; as `steady_estimates`.

    The error is the larger of two (`stats.larger_errors`), from realizations and from blocks of
    them. A scene of correlations in time cuts blocks of its own.
    """
    value, error, left_out = steady_estimates(history, point, first)
    if history.scenes[point].correlated or history.length - first < 2 * BLOCKS:
        return value, error, left_out
    edges = np.linspace(first, history.length, BLOCKS + 1).astype(int)
    _, of_blocks, _ = steady_estimates(history, point, edges)
    return value, *larger_errors(error, of_blocks, left_out)


def steady_changes(history: History, point: int, early: int, start: int) -> tuple[dict, dict, dict]:
    """What became of the observables of one point between two windows of records.

    Returns: their values from record `start` on less those in [`early`, `start`), one standard
    error of this change, in which realizations are paired, and one of the later values.
    """
    windows = {
        0: history.point(point, early, start),
        1: history.point(point, start, history.length),
    }
    means = {(w, name): array for w, m in windows.items() for name, array in m.items()}
    scene = history.scenes[point]

    def both(averages):
        before, after = (
            reported(scene, {n: averages[w, n] for v, n in averages if v == w}) for w in windows
        )
        with np.errstate(invalid="ignore"):
            change = {("change", n): after[n] - before[n] for n in after}
        return change | {("later", n): value for n, value in after.items()}

    value, error, _ = jackknife(means, both, axis=0)
    names = [name for kind, name in value if kind == "change"]
    return (
        {n: value["change", n] for n in names},
        {n: error["change", n] for n in names},
        {n: error["later", n] for n in names},
    )
