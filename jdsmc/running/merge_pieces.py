"""Runs at different values of one number as one sweep over it."""

import json
from typing import Any

import numpy as np
import xarray as xr

from .. import sweep
from ..results.join import name_of
from ..results.rebuild import rebuilt
from ..results.result import Result


def as_one_sweep(results: list[Result], path: str, classes: tuple[type, ...]) -> Result:
    """Points side by side along the number at a path of the scene, in order.

    Raises ValueError for a point that comes twice, and for runs whose realizations differ in
    number or that differ in what they hold (one was steady, another not).
    """
    counts = sorted({int(one.attrs["n_realizations"]) for one in results})
    if len(counts) > 1:
        raise ValueError(f"n_realizations must be the same at every point, got {counts}.")
    held = {tuple(sorted(one.to_xarray().children)) for one in results}
    if len(held) > 1:
        raise ValueError("some of these runs were steady and others not; merge the steady ones.")
    pieces = [values_of(one, path) for one in results]
    every = np.concatenate(pieces)
    order = np.argsort(every, kind="stable")
    text = with_values(results[0], path, every[order])
    scene = rebuilt(text, classes)
    name, dims = sweep.labels(scene)[path], list(sweep.dimensions(scene))
    twice = every[order][1:][np.diff(every[order]) == 0]
    if len(twice):
        raise ValueError(f"{name} = {twice[0]:g} is there twice; merge other seeds of it first.")
    groups = {}
    for group in ("/", *(f"/{child}" for child in results[0].to_xarray().children)):
        parts = [one.to_xarray()[group].to_dataset() for one in results]
        whole = side_by_side(parts, name, pieces).isel({name: order})
        groups[group] = whole.transpose(*dims, ...)
    stopped = dict.fromkeys(str(one.attrs["stopped"]) for one in results)
    groups["/"].attrs = results[0].attrs | {
        "specification": json.dumps(text),
        f"parameter_{name}": every[order],
        "swept": " ".join(dims),
        "stopped": "; ".join(stopped),
        "seed": seeds_of(results),
        "run": name_of(results),
    }
    return Result(xr.DataTree.from_dict(groups))


def seeds_of(results: list[Result]) -> Any:
    """The seed of all runs, or all seeds of any of them: no other run of these may be added."""
    first, *others = ([int(seed) for seed in np.atleast_1d(one.attrs["seed"])] for one in results)
    if all(other == first for other in others):
        return results[0].attrs["seed"]
    return sorted({*first}.union(*others))


def values_of(result: Result, path: str) -> np.ndarray:
    """The values of a number in one run, (points,)."""
    found = json.loads(result.attrs["specification"])
    for step in path.split("."):
        found = found["fields"][step]
    return np.atleast_1d(np.asarray(found, dtype=float))


def with_values(result: Result, path: str, values: np.ndarray) -> dict:
    """The specification of the scene of a run with other values of a number."""
    text = json.loads(result.attrs["specification"])
    *above, last = path.split(".")
    place = text
    for step in above:
        place = place["fields"][step]
    place["fields"][last] = values.tolist()
    return text


def side_by_side(parts: list[xr.Dataset], name: str, pieces: list[np.ndarray]) -> xr.Dataset:
    """Datasets along a dimension that those of single points do not have yet.

    Along `sample` as far as the shortest.
    """
    if any("sample" in part.dims for part in parts):
        shortest = min(part.sizes["sample"] for part in parts)
        parts = [part.isel(sample=slice(shortest)) for part in parts]
    along: list[Any] = []
    for part, values in zip(parts, pieces, strict=True):
        clocks = [coord for coord in ("time",) if coord in part.coords]
        one = part.reset_coords(clocks)
        along.append(one if name in part.dims else one.expand_dims({name: values}))
    how: dict[str, Any] = {"data_vars": "all", "coords": "minimal", "join": "exact"}
    how |= {"compat": "override", "combine_attrs": "override"}
    whole = xr.concat(along, name, **how)
    return whole.set_coords([coord for coord in ("time",) if coord in whole.data_vars])
