"""Runs of one scene with different seeds as one run with more realizations."""

import numpy as np
import xarray as xr

from .. import sweep
from ..results.join import name_of
from ..results.result import FREEDOM, Result
from .estimates import estimates_of

LINEAR = ("series", "distribution", "sensitivity", "sensitivity_series")
"""Groups that are averaged as they are."""

ALONG = {"averages": "realization", "blocks": "part", "realizations": "realization"}
"""Groups whose rows are put one below the other."""


def more_realizations(results: list[Result], classes: tuple[type, ...]) -> Result:
    """All of them together; ValueError for a seed that comes twice, and if only some are steady or
    have derivatives."""
    seeds = [int(seed) for one in results for seed in np.atleast_1d(one.attrs["seed"])]
    if len(set(seeds)) < len(seeds):
        twice = next(seed for seed in seeds if seeds.count(seed) > 1)
        raise ValueError(
            f"seed = {twice} was used twice: the same run counts once. Merge runs of other seeds."
        )
    if len({one.is_steady for one in results}) > 1:
        raise ValueError("some of these runs were steady and others not; merge the steady ones.")
    if len({"sensitivity" in one.to_xarray().children for one in results}) > 1:
        raise ValueError("some of these runs have derivatives and others not; merge their like.")
    counts = np.array([int(one.attrs["n_realizations"]) for one in results])
    trees = [_in_order(one.to_xarray(), results[0].to_xarray()) for one in results]
    shared = set.intersection(*(set(tree.children) for tree in trees))

    def of(name: str) -> list[xr.Dataset]:
        return [tree[name].to_dataset() for tree in trees]

    groups = {f"/{name}": weighted(of(name), counts) for name in LINEAR if name in shared}
    root = weighted([one.steady for one in results], counts)
    if "left_out" in shared:
        groups["/left_out"] = weighted_rows(of("left_out"), counts)
    if "averages" in shared:
        rows = {name: along for name, along in ALONG.items() if name in shared}
        groups |= {f"/{n}": xr.concat(of(n), along) for n, along in rows.items()}
        made, groups["/left_out"] = pooled(results[0].scene(*classes), root, groups)
        root = root.assign(made)
    if FREEDOM in root:  # what the runs differ by counts where they are pooled
        between = len(results) - 1 if "averages" in shared else 0
        own = np.sum([one.steady[FREEDOM].values for one in results], axis=0)
        root[FREEDOM] = root[FREEDOM].copy(data=own + between)
    root.attrs = results[0].attrs | {
        "seed": seeds,
        "n_realizations": int(np.sum(counts)),
        "stopped": f"{len(results)} runs were merged; of the first, {results[0].attrs['stopped']}",
        "run": name_of(results),
    }
    return Result(xr.DataTree.from_dict({"/": root, **groups}))


def _in_order(tree: xr.DataTree, first: xr.DataTree) -> xr.DataTree:
    """Derivatives in the order of the first run; ValueError if they are with respect to others."""
    if "sensitivity" not in tree.children:
        return tree
    wanted, here = (
        [str(name) for name in one["sensitivity"].to_dataset()["parameter"].values]
        for one in (first, tree)
    )
    if sorted(wanted) != sorted(here):
        raise ValueError(
            f"one run has derivatives with respect to {', '.join(wanted)}, another to "
            f"{', '.join(here)}; merge runs of the same."
        )
    return xr.DataTree.from_dict(
        {
            path: data.sel(parameter=wanted) if "parameter" in data.dims else data
            for path, data in tree.to_dict().items()
        }
    )


def weighted(parts: list[xr.Dataset], counts: np.ndarray) -> xr.Dataset:
    """Averages of several runs, each with the weight of its realizations, and their errors.

    Along `sample` as far as the shortest; their clocks differ by less than the errors of the
    series.
    """
    shortest = min(part.sizes.get("sample", 0) for part in parts)
    if shortest:
        parts = [part.isel(sample=slice(shortest)) for part in parts]
    shares = counts / np.sum(counts)
    first = parts[0]
    mean = first.copy(deep=True)
    for name in [*first.data_vars, *(n for n in first.coords if n == "time")]:
        each = np.stack([part[name].values for part in parts])
        share = shares.reshape(-1, *(1,) * (each.ndim - 1))
        is_error = str(name).endswith("_error")
        found = (
            np.sqrt(np.sum((share * each) ** 2, axis=0)) if is_error else np.sum(share * each, 0)
        )
        mean[name] = first[name].copy(data=found)
    return mean


def weighted_rows(parts: list[xr.Dataset], counts: np.ndarray) -> xr.Dataset:
    """Leave-one-out values of the weighted mean of estimates.

    Their scatter gives the weighted errors by the jackknife of all realizations together: with
    e_k² = (R_k - 1)/R_k Σ d² of run k, Σ w_k² e_k² = (R - 1)/R Σ D² with
    D = w_k d √((R_k - 1) R/(R_k (R - 1))).
    """
    rows = np.array([part.sizes["realization"] for part in parts])
    shares, every = counts / np.sum(counts), int(np.sum(rows))
    means = [part.mean("realization") for part in parts]
    middle = sum(share * mean for share, mean in zip(shares, means, strict=True))
    spread = [
        middle + (part - mean) * (share * np.sqrt((own - 1) * every / (own * (every - 1))))
        for part, mean, share, own in zip(parts, means, shares, rows, strict=True)
    ]
    return xr.concat(spread, "realization").transpose(..., *_own_dims(parts[0]))


def pooled(scene, root: xr.Dataset, groups: dict) -> tuple[dict, xr.Dataset]:
    """Observables of the averages of all realizations at every point, as `run` makes them.

    Returns: values and errors by name, and leave-one-out values.
    """
    points, shape = sweep.points(scene)
    tables = {
        name: _by_point(groups[f"/{name}"], ALONG[name], shape)
        for name in ("averages", "blocks")
        if f"/{name}" in groups
    }
    rows = groups["/left_out"]
    found = [
        estimates_of(
            point.prepared(),
            {name: values[p] for name, values in tables["averages"].items()},
            {name: values[p] for name, values in tables["blocks"].items()}
            if "blocks" in tables
            else None,
        )
        for p, point in enumerate(points)
    ]
    made, left_out = {}, {}
    for name in found[0][0]:
        for kind, suffix in enumerate(("", "_error")):
            values = np.stack([np.asarray(one[kind][name]) for one in found])
            old = root[f"{name}{suffix}"]
            made[f"{name}{suffix}"] = old.copy(data=values.reshape(old.shape))
        out = np.stack([one[2][name] for one in found])
        left_out[name] = rows[name].copy(data=out.reshape(rows[name].shape))
    return made, rows.assign(left_out)


def _by_point(data: xr.Dataset, along: str, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
    """Arrays (points, rows, ...) of a group."""
    count = data.sizes[along]
    return {
        str(name): values.values.reshape(-1, count, *values.shape[len(shape) + 1 :])
        for name, values in data.data_vars.items()
    }


def _own_dims(data: xr.Dataset) -> list:
    """Dimensions in the order of the first variable that has most of them."""
    longest = max(data.data_vars.values(), key=lambda values: values.ndim)
    return list(longest.dims)
