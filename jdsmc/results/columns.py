"""A result as columns of equal length: for data frames and CSV files."""

import csv
from typing import Any

import numpy as np
import xarray as xr

FEW = 8
"""An axis of at most so many places becomes columns, one a place; a longer one is a profile."""

GROUPS = ("", "series", "distribution")


def columns(tree: xr.DataTree, dims: tuple[str, ...], along: str = "") -> dict[str, np.ndarray]:
    """Columns by name: swept numbers first, then each value beside its error.

    Arguments: a tree as of `Result.to_xarray`; the swept dimensions; `along`, "" for steady values,
    one row for each point of the sweep, or the name of a dimension, one row for each point and
    place along it ("sample" for time series).
    Raises KeyError for a dimension that is not there, and for steady values of a run without any.
    """
    data = _group(tree, dims, along)
    rows = (*dims, along) if along else dims
    out = {name: _column(data[name], rows, data) for name in rows if name in data.coords}
    for name, values in data.coords.items():
        if name not in out and along in values.dims:  # the time of a sample
            out[str(name)] = _column(values, rows, data)
    for name in (str(name) for name in data.data_vars if not str(name).endswith("_error")):
        both = [data[one] for one in (name, f"{name}_error") if one in data]
        own = [d for d in both[0].dims if d not in rows]
        if (along and along not in both[0].dims) or len(own) > 1:
            continue
        if not own:
            out |= {str(one.name): _column(one, rows, data) for one in both}
        elif data.sizes[own[0]] <= FEW:
            for k in range(data.sizes[own[0]]):
                for one, suffix in zip(both, ("", "_error"), strict=False):
                    place = one.isel({own[0]: k})
                    out[f"{name}_{k + 1}{suffix}"] = _column(place, rows, data)
    return out


def _group(tree: xr.DataTree, dims: tuple[str, ...], along: str) -> xr.Dataset:
    """The group that has a dimension; the root for steady values."""
    found = {
        name: tree[f"/{name}"].to_dataset() for name in GROUPS if not name or name in tree.children
    }
    if not along and not found[""].data_vars:
        raise KeyError(
            f"no steady values: {tree.attrs.get('stopped', 'the run was not steady')}. "
            'Give "sample" for time series.'
        )
    if not along:
        return found[""]
    there = {str(d): data for data in reversed(found.values()) for d in data.dims if d not in dims}
    if along not in there:
        raise KeyError(f"nothing lies along {along!r}; there are {', '.join(there) or 'no axes'}.")
    return there[along]


def _column(values: xr.DataArray, rows: tuple[str, ...], data: xr.Dataset) -> np.ndarray:
    """Values at every row; of a swept vector, of which there are several numbers, its text."""
    if values.dims and values.dims[-1] not in rows:
        texts = ["(" + ", ".join(f"{x:g}" for x in one) + ")" for one in values.values]
        values = xr.DataArray(texts, dims=values.dims[:-1])
    sizes = {name: data.sizes[name] for name in rows}
    return (
        values.expand_dims({n: s for n, s in sizes.items() if n not in values.dims})
        .transpose(*rows)
        .values.ravel()
    )


def write_csv(table: dict[str, np.ndarray], file: Any) -> None:
    """To a text file: names, then a line for each row, numbers with all their digits."""
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(table)
    writer.writerows(zip(*(column.tolist() for column in table.values()), strict=True))
