"""Observables with error bars from the history of one point of a run."""

import itertools

import numpy as np

from ..errors import FaultError
from ..scenarios.base import AbstractScene
from ..stats import BLOCKS, averages_of_others, jackknife, larger_errors
from .history import History


def takes_leading_axes(scene: AbstractScene) -> bool:
    """True if observables take leading axes: what has a time series of its own need not."""
    return type(scene).evolution is AbstractScene.evolution


def against_time(scene: AbstractScene, averages: dict) -> dict:
    """What a scene reports against time, from averages of records."""
    wanted = [one.name for one in (*scene.reports, *scene.evolves)]
    if takes_leading_axes(scene):
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


def check_leading_axes(scene: AbstractScene, means: dict) -> None:
    """Raise FaultError for observables that give something else with a leading axis than without.

    Error bars would be wrong. Arguments: averages of each realization, (realizations, ...); looked
    at are those of all but one, which errors are made of.
    """
    if not takes_leading_axes(scene):
        return
    others = averages_of_others(means)
    together = reported(scene, others)
    alone = reported(scene, {name: array[0] for name, array in others.items()})
    for name, values in alone.items():
        shape = (len(next(iter(means.values()))), *values.shape)
        found = np.broadcast_to(together[name], shape)
        size = np.max(np.abs(found), initial=0.0, where=np.isfinite(found))
        if not np.allclose(found[0], values, rtol=0.0, atol=1e-9 * size, equal_nan=True):
            raise FaultError(
                f"{type(scene).__name__}.observables must take averages with leading axes of any "
                f"shape: {name} of many realizations differs from that of one."
            )


def averages_to_print(history: History, point: int, first: int) -> tuple[dict, dict | None]:
    """Averages of one point from record `first` on: of each realization, and of blocks of them.

    Arrays (realizations, ...) and (blocks x realizations, ...). None for the blocks of a scene of
    correlations in time, which cuts its own, and of what is too short to cut.
    """
    whole = history.point(point, first, history.length)
    if history.scenes[point].correlated or history.length - first < 2 * BLOCKS:
        return whole, None
    edges = np.linspace(first, history.length, BLOCKS + 1).astype(int)
    parts = [history.point(point, a, b) for a, b in itertools.pairwise(edges)]
    return whole, {name: np.concatenate([part[name] for part in parts]) for name in whole}


def estimates_of(
    scene: AbstractScene, means: dict, blocks: dict | None, names: tuple[str, ...] | None = None
) -> tuple[dict, dict, dict]:
    """Values, standard errors and leave-one-out values of all observables, or some, from averages.

    The error is the larger of two (`stats.larger_errors`), from realizations and from blocks.
    """

    def observables(averages):
        found = reported(scene, averages)
        return found if names is None else {name: found[name] for name in names}

    leading = takes_leading_axes(scene)
    value, error, left_out = jackknife(means, observables, axis=0, leading=leading)
    if blocks is None:
        return value, error, left_out
    _, of_blocks, _ = jackknife(blocks, observables, axis=0, leading=leading)
    return value, *larger_errors(error, of_blocks, left_out)


def printed_estimates(
    history: History, point: int, first: int, names: tuple[str, ...] | None = None
) -> tuple[dict, dict, dict]:
    """What is printed of one point measured from record `first` on; as `estimates_of`."""
    averages = averages_to_print(history, point, first)
    return estimates_of(history.scenes[point], *averages, names)


def realization_estimates(
    history: History, point: int, first: int, names: tuple[str, ...]
) -> tuple[dict, dict, dict]:
    """The same with the error from realizations alone, which is printed or smaller."""
    means = history.point(point, first, history.length)
    return estimates_of(history.scenes[point], means, None, names)


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
    settings = {one.name for one in scene.reports if one.setting}

    def both(averages):
        before, after = (
            reported(scene, {n: averages[w, n] for v, n in averages if v == w}) for w in windows
        )
        with np.errstate(invalid="ignore"):
            change = {("change", n): after[n] - before[n] for n in after if n not in settings}
        return change | {("later", n): value for n, value in after.items()}

    value, error, _ = jackknife(means, both, axis=0, leading=takes_leading_axes(scene))
    names = [name for kind, name in value if kind == "change"]
    return (
        {n: value["change", n] for n in names},
        {n: error["change", n] for n in names},
        {n: error["later", n] for n in names},
    )
