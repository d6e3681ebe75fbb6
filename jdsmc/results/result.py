"""Labelled results: steady values, time series and velocity distributions, with error bars."""

import json
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from .. import check, views
from ..estimate import Estimate
from ..files.writable import check_writable
from . import stored
from .columns import columns, write_csv
from .rebuild import rebuilt
from .sensitivity import Sensitivity

FREEDOM = "degrees_of_freedom"
"""Of the printed errors of each point: realizations less one (blocks, of correlations in time)."""

PLACES = "points_of_sweep"
"""Of a part of a sweep: which points these are."""


class Result:
    """What a run measured.

    `result["shear_stress"]` is the steady mean and its standard error; `result.series` and
    `result.distribution` are xarray Datasets; `result.to_xarray()` is everything in one tree, as
    in the file that `result.save(path)` writes. Names and units: docs/observables.md.
    """

    def __init__(self, tree: xr.DataTree):
        self._tree = tree
        self._sensitivity: Sensitivity | None = None
        self.under_way: Any = None
        """The run that made it, for `jdsmc.resume`; None if loaded, joined, cut or copied."""

    def __getstate__(self) -> dict:
        """What is pickled and copied (multiprocessing, joblib): all but the gas itself."""
        return vars(self) | {"under_way": None, "_sensitivity": None}

    def __getitem__(self, name: str) -> Estimate:
        """Steady mean and error of an observable; KeyError names what there is."""
        steady = self.steady
        if name not in self:
            if not self.is_steady:
                raise KeyError(
                    f"no steady values: {self.attrs.get('stopped', 'the run was not steady')}. "
                    "Time series are in result.series."
                )
            raise KeyError(f"no observable {name!r}; there are {', '.join(self)}.")
        value, error = steady[name].values, steady[f"{name}_error"].values
        left_out, freedom = None, None
        if "left_out" in self._tree.children:
            values = self._tree["left_out"].to_dataset()[name].transpose("realization", ...).values
            left_out = {self.attrs["run"]: values}
        points = self.points_of(steady[name].dims, value.shape)
        value, error = (x if x.ndim else float(x) for x in (value, error))
        if left_out is not None and FREEDOM in steady:
            known = steady[FREEDOM].values
            known = known.reshape(known.shape + (1,) * (np.ndim(value) - known.ndim))
            freedom = dict.fromkeys(left_out, np.broadcast_to(known, np.shape(value)))
        return Estimate(value, error, left_out, points, freedom)

    def points_of(self, dims, shape: tuple[int, ...]) -> np.ndarray:
        """For each element of an array over these dimensions its point in the sweep of the run."""
        swept = [n for n, d in zip(shape, dims, strict=True) if d in self.dims]
        places = np.reshape(self._places(), swept + [1] * (len(shape) - len(swept)))
        return np.broadcast_to(places, shape)

    def _places(self) -> np.ndarray:
        """Numbers of the points in the sweep of the run, of which these may be some."""
        sizes = [self.steady.sizes[name] for name in self.dims]
        places = np.atleast_1d(self._tree.attrs.get(PLACES, np.arange(np.prod(sizes, dtype=int))))
        return places.reshape(sizes)

    def __contains__(self, name: object) -> bool:
        steady = self.steady
        return name in steady.data_vars and f"{name}_error" in steady.data_vars

    def __iter__(self) -> Iterator[str]:
        """Names of what has a steady value."""
        return (str(name) for name in self.steady.data_vars if name in self)

    def __bool__(self) -> bool:
        """A result is one, with steady values or without."""
        return True

    def __len__(self) -> int:
        return sum(1 for _ in self)

    @property
    def steady(self) -> xr.Dataset:
        """Steady values and errors."""
        return self._tree.to_dataset()

    @property
    def is_steady(self) -> bool:
        """True if there are steady values."""
        return len(self) > 0

    @property
    def interrupted(self) -> bool:
        """True if a signal (Ctrl-C, SIGTERM) ended the run, or one of several that were put
        together, before what was asked."""
        ends = str(self.attrs.get("stopped", "")).split("; ")
        return any(end.startswith("interrupted") for end in ends)

    @property
    def attrs(self) -> dict:
        """Parameters, options, seed, versions and how the run ended."""
        return dict(self._tree.attrs)

    @property
    def dims(self) -> tuple[str, ...]:
        """The swept dimensions."""
        return tuple(str(name) for name in self._tree.attrs.get("swept", "").split() if name)

    @property
    def series(self) -> xr.Dataset:
        """Observables against time, averaged over realizations."""
        return self._tree["series"].to_dataset()

    @property
    def distribution(self) -> xr.Dataset:
        """Steady velocity distributions against C = V/√(2T/m)."""
        if "distribution" not in self._tree.children:
            why = "the run ended before it was steady" if not self.is_steady else "none was sampled"
            raise KeyError(f"no velocity distributions: {why}.")
        return self._tree["distribution"].to_dataset()

    @property
    def sensitivity(self) -> Sensitivity:
        """Derivatives with respect to physical numbers; KeyError if none were asked for."""
        if "sensitivity" not in self._tree.children:
            raise KeyError(
                "no derivatives: run with sensitivity=True (or names), or call jdsmc.sensitivity."
            )
        if self._sensitivity is None:
            self._sensitivity = Sensitivity(self)
        return self._sensitivity

    def at(self, **point) -> "Result":
        """The result at one value of swept numbers, e.g. `result.at(restitution=0.7)`.

        Raises KeyError for a number that is not swept or a value that was not run.
        """
        chosen = {name: self._index(name, value) for name, value in point.items()}
        groups = {}
        for path in ("/", *(f"/{name}" for name in self._tree.children)):
            data = self._tree[path].to_dataset()
            groups[path] = data.isel({n: k for n, k in chosen.items() if n in data.dims})
            groups[path] = groups[path].drop_vars([n for n in chosen if n in groups[path].coords])
        attrs = self.attrs
        for name, index in chosen.items():
            values = self.steady[name].values
            label = f"{name}={values[index]}"
            attrs["point"] = " ".join(filter(None, [attrs.get("point", ""), label]))
            if f"parameter_{name}" in attrs:
                attrs[f"parameter_{name}"] = float(values[index])
        if "gas" in chosen:  # of gases side by side
            one = str(self.steady["gas"].values[chosen["gas"]])
            for name in ("gas_model", "stopped"):
                attrs[name] = attrs.get(f"{name}_{one}", attrs.get(name))
                for other in self.steady["gas"].values:
                    attrs.pop(f"{name}_{other}", None)
            groups["/series"] = groups["/series"].dropna("sample", how="all", subset=["time"])
        attrs["swept"] = " ".join(name for name in self.dims if name not in chosen)
        picked = tuple(chosen.get(name, slice(None)) for name in self.dims)
        attrs[PLACES] = np.ravel(self._places()[picked])
        attrs.pop("specification", None)  # that of the whole sweep
        groups["/"].attrs = attrs
        return Result(xr.DataTree.from_dict(groups))

    def _index(self, name: str, value) -> int:
        if name not in self.dims:
            swept = ", ".join(self.dims) or "nothing"
            raise KeyError(f"{name} was not swept; swept: {swept}.")
        values = self.steady[name].values
        if isinstance(value, xr.DataArray) and not value.ndim:
            value = value.item()
        if np.ndim(value) or (values.dtype.kind == "f") != isinstance(
            check.physical(value), np.ndarray
        ):
            raise KeyError(f"{name} = {value!r} is not one of the values run, {self._run(values)}.")
        if values.dtype.kind == "f":
            nearest = int(np.argmin(np.abs(values - value)))
            found = [nearest] if np.isclose(values[nearest], value, rtol=1e-6, atol=0.0) else []
        else:
            found = np.flatnonzero(values == value)
        if not len(found):
            raise KeyError(f"{name} = {value} was not run; there are {self._run(values)}.")
        return int(found[0])

    @staticmethod
    def _run(values: np.ndarray) -> str:
        return ", ".join(f"{x:.9g}" if values.dtype.kind == "f" else str(x) for x in values)

    def to_xarray(self) -> xr.DataTree:
        """Everything: steady values at the root, groups `series`, `distribution`, ..."""
        return self._tree

    def to_dataframe(self, along: str = "") -> pd.DataFrame:
        """A pandas DataFrame: swept numbers, then each value beside its `<name>_error`.

        `along` is "" for steady values, one row for each point of the sweep; or a dimension, one
        row for each point and place on it: "sample" for time series, "z", "velocity", ... Raises
        KeyError for one that is not there, and for steady values of a run that was not steady.
        """
        return pd.DataFrame(columns(self._tree, self.dims, along))

    def to_csv(self, path: str | Path, along: str = "", overwrite: bool = False) -> Path:
        """Write the columns of `to_dataframe`; FileExistsError rather than replace a file."""
        table = columns(self._tree, self.dims, along)
        path = check_writable(path, overwrite)
        with path.open("w", encoding="utf-8", newline="") as file:
            write_csv(table, file)
        return path

    def scene(self, *classes: type):
        """The scene that made this result, built again.

        Its classes must have been imported, or be passed in: a file never causes an import. Raises
        ValueError if one of them is not there.
        """
        if "specification" not in self._tree.attrs:
            raise ValueError("only the whole of a sweep knows its scene; this is a part or a join.")
        return rebuilt(json.loads(self._tree.attrs["specification"]), classes)

    def save(self, path: str | Path, overwrite: bool = False) -> Path:
        """Write a NetCDF4 (HDF5) file, whole or not at all; returns its path.

        Raises FileExistsError rather than replace a file, and OSError. A seal at its end, which
        readers of HDF5 pass over, shows to `jdsmc.load` whether the file was changed.
        """
        return stored.write(self._tree, path, overwrite)

    def plot(self, path: str | Path | None = None):
        """Draw the result; returns the matplotlib figure, saved to `path` if given."""
        figure = views.draw(self)
        if path is not None:
            figure.savefig(path, dpi=130)
        return figure

    def table(self) -> str:
        """Steady values with errors, beside theory where there is one."""
        return views.table(self)

    def __repr__(self) -> str:
        return f"<jdsmc.Result {self.attrs.get('scene', '')}>\n{self.table()}"

    def _repr_html_(self) -> str:
        return f"<b>{escape(str(self.attrs.get('scene', '')))}</b>{views.html(self)}"


def load(path: str | Path) -> Result:
    """Read a file written by `Result.save` or the command line.

    Raises FileNotFoundError, or ValueError for a file that is no result, that was changed since it
    was written, or that is of another schema. Warns of a file without the seal of jdsmc: saved by
    another program, or cut, it cannot be verified.
    """
    return Result(stored.read(path))
