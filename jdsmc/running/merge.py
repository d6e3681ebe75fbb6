"""Several runs as one: more realizations of one scene, or the points of a sweep made in pieces."""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..results.result import Result
from .merge_pieces import as_one_sweep
from .merge_realizations import more_realizations

SAME = ("n_particles", "time_step", "steps_per_record", "splitting", "dtype")
"""Options that all runs must share."""


def merge(results: Sequence[Result], classes: tuple[type, ...] = ()) -> Result:
    """One result of several runs of the same scene with the same options.

    Arguments: results, loaded or not; the classes of scene and gas if they are your own and not
    imported yet.

    Different seeds: realizations count together, each the same, and errors are those of them all.
    Observables are made anew from the averages of all; of a scene of correlations in time (cooling
    disks) the estimates are averaged. Different values of one number: the points of a sweep, to the
    bit as each run gave them.

    Raises TypeError for what is no result; ValueError for fewer than two, for scenes or options
    that differ, for the same seed or the same point twice, for parts of a sweep, and where some
    runs were steady and others not.
    """
    if isinstance(results, Result):
        raise TypeError("merge takes results as a list: merge([first, second]).")
    results = list(results)
    for one in results:
        if not isinstance(one, Result):
            raise TypeError(f"merge needs results, as `run` or `load` give them, got {one!r}.")
    if len(results) < 2:
        raise ValueError("merge needs at least two results.")
    _check_same(results)
    paths = _differing(results)
    if len(paths) > 1:
        raise ValueError(
            f"these runs differ in {', '.join(paths)}; pieces of a sweep differ in one number."
        )
    if paths:
        return as_one_sweep(results, paths[0], classes)
    return more_realizations(results, classes)


def _check_same(results: list[Result]) -> None:
    """ValueError if the runs had different options, or a result is only a part of one."""
    for one in results:
        if "specification" not in one.attrs:
            raise ValueError("a part of a sweep, or gases side by side, cannot be merged.")
        for name in SAME:
            here, there = one.attrs[name], results[0].attrs[name]
            if here != there:
                raise ValueError(
                    f"{name} is {there} in one run and {here} in another; merge runs of the same "
                    "options."
                )


def _differing(results: list[Result]) -> list[str]:
    """Paths of the numbers in which scenes differ; ValueError if they differ in anything else."""
    first, *others = (_numbers(json.loads(one.attrs["specification"])) for one in results)
    found: dict[str, None] = {}
    for other in others:
        for path in first | other:
            mine, its = first.get(path), other.get(path)
            if mine == its:
                continue
            if not (_is_number(mine) and _is_number(its)):
                raise ValueError(
                    f"these runs are of different scenes: {path} is {mine} in one and {its} in "
                    "another."
                )
            found[path] = None
    return list(found)


def _numbers(text: Any, path: str = "") -> dict[str, Any]:
    """What a specification says, by path."""
    if isinstance(text, dict) and set(text) == {"class", "fields"}:
        found = {f"{path}.class".lstrip("."): text["class"]}
        for name, value in text["fields"].items():
            found |= _numbers(value, f"{path}.{name}".lstrip("."))
        return found
    return {path: text}


def _is_number(value: Any) -> bool:
    return np.asarray(value).dtype.kind in "fiu"
