"""Labelled results: steady values, time series and velocity distributions, with error bars."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr


class Estimate(NamedTuple):
    """A number (or an array over the swept dimensions) and one standard error."""

    value: float | np.ndarray
    error: float | np.ndarray

    def __str__(self) -> str:
        if isinstance(self.value, np.ndarray):
            rows = zip(self.value, np.asarray(self.error), strict=True)
            return "\n".join(str(Estimate(v, e)) for v, e in rows)
        return format_estimate(float(self.value), float(self.error))


def format_estimate(value: float, error: float) -> str:
    """Value with its error in units of the last digits, e.g. 0.3325(4)."""
    if not np.isfinite(error) or error <= 0:
        return f"{value:.6g}"
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    shown = round(error * 10**digits)
    if digits and shown >= 100:  # 0.0999 rounds up to 0.100: one digit fewer
        digits, shown = digits - 1, round(error * 10 ** (digits - 1))
    return f"{value:.{digits}f}({shown})" if digits else f"{value:.0f}({error:.0f})"


class Result:
    """What a run measured.

    `result["shear_stress"]` is the steady mean and its standard error; `result.series` and
    `result.distribution` are xarray Datasets; `result.to_xarray()` is everything in one tree, as
    in the file that `result.save(path)` writes. Names and units: docs/observables.md.
    """

    def __init__(self, tree: xr.DataTree):
        self._tree = tree

    def __getitem__(self, name: str) -> Estimate:
        """Steady mean and error of an observable; KeyError names what there is."""
        steady = self._tree.to_dataset()
        if name not in steady or f"{name}_error" not in steady:
            known = [n for n in steady.data_vars if f"{n}_error" in steady]
            if not known:
                raise KeyError(
                    f"no steady values: {self.attrs.get('stopped', 'the run was not steady')}. "
                    "Time series are in result.series."
                )
            raise KeyError(f"no observable {name!r}; there are {', '.join(map(str, known))}.")
        value, error = steady[name].values, steady[f"{name}_error"].values
        return Estimate(*(x if x.ndim else float(x) for x in (value, error)))

    @property
    def is_steady(self) -> bool:
        """True if there are steady values."""
        return any(str(name).endswith("_error") for name in self._tree.data_vars)

    @property
    def attrs(self) -> dict:
        """Parameters, options, seed, versions and how the run ended."""
        return dict(self._tree.attrs)

    @property
    def series(self) -> xr.Dataset:
        """Observables against time, averaged over realizations."""
        return self._tree["series"].to_dataset()

    @property
    def distribution(self) -> xr.Dataset:
        """Steady velocity distributions against C = V/√(2T/m)."""
        if "distribution" not in self._tree.children:
            raise KeyError("no velocity distributions: the run ended before it was steady.")
        return self._tree["distribution"].to_dataset()

    def to_xarray(self) -> xr.DataTree:
        """Everything: steady values at the root, groups `series` and `distribution`."""
        return self._tree

    def save(self, path: str | Path, overwrite: bool = False) -> Path:
        """Write a NetCDF4 (HDF5) file; raises FileExistsError rather than replace one."""
        path = check_writable(path, overwrite)
        self._tree.to_netcdf(path, engine="h5netcdf", mode="w")
        return path

    def plot(self, path: str | Path | None = None):
        """Draw the result; returns the matplotlib figure, saved to `path` if given."""
        from .views import draw  # noqa: PLC0415 - matplotlib is slow to import

        figure = draw(self)
        if path is not None:
            figure.savefig(path, dpi=130)
        return figure

    def table(self) -> str:
        """Steady values with errors, beside theory where there is one."""
        from .views import table  # noqa: PLC0415

        return table(self)

    def __repr__(self) -> str:
        return f"<jdsmc.Result {self.attrs.get('scene', '')}>\n{self.table()}"


def check_writable(path: str | Path, overwrite: bool = False) -> Path:
    """The path, if a file may be created there; a clear error otherwise, before any work."""
    path = Path(path)
    if path.exists() and not overwrite:
        raise FileExistsError(f"{path} exists; choose another name or delete it first.")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"the folder {path.parent} of the output file does not exist.")
    try:
        existed = path.exists()
        with path.open("ab"):
            pass
        if not existed:
            path.unlink()
    except OSError as error:
        raise PermissionError(f"cannot write {path}: {error.strerror}.") from None
    return path


def load(path: str | Path) -> Result:
    """Read a file written by `Result.save` or the command line.

    Raises FileNotFoundError, or ValueError if it is no jdsmc file.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"there is no file {path}.")
    try:
        tree = xr.open_datatree(path, engine="h5netcdf")
    except (OSError, ValueError):
        raise ValueError(f"{path} is not an HDF5 file written by jdsmc.") from None
    with tree:
        tree = tree.load()
    if "jdsmc_version" not in tree.attrs:
        raise ValueError(f"{path} was not written by jdsmc.")
    return Result(tree)


def join_gases(results: dict[str, Result]) -> Result:
    """One result with a dimension `gas` from results of the same sweep with different gases.

    Series of different lengths are padded with NaN at the end.
    """
    gases = list(results)
    trees = [r.to_xarray() for r in results.values()]
    groups = {}
    for group in ("/", "/series", "/distribution"):
        parts = [t[group].to_dataset() for t in trees if group == "/" or group[1:] in t.children]
        if len(parts) == len(trees):
            groups[group] = _stack([part.reset_coords() for part in parts], gases)
    if "/series" in groups:
        groups["/series"] = groups["/series"].set_coords("time")
    for name in ("stopped", "gas_model"):
        each = {gas: r.attrs[name] for gas, r in results.items()}
        same = len(set(each.values())) == 1
        text = each[gases[0]] if same else "; ".join(f"{gas}: {v}" for gas, v in each.items())
        groups["/"].attrs |= {name: text} | {f"{name}_{gas}": v for gas, v in each.items()}
    return Result(xr.DataTree.from_dict(groups))


def _stack(parts: list[xr.Dataset], gases: list[str]) -> xr.Dataset:
    """Datasets side by side along `gas`; attributes that differ are left out."""
    stacked = xr.concat(
        parts, dim="gas", join="outer", data_vars="all", combine_attrs="drop_conflicts"
    )
    return stacked.assign_coords(gas=gases)
