"""A result as a file: NetCDF4 (HDF5) under a seal, and what is believed of a file that is read."""

import warnings
from pathlib import Path

import h5py
import numpy as np
import xarray as xr

from ..files import look, seal
from ..files.readable import check_readable
from ..files.writable import check_writable

SCHEMA = 1
"""Of the files that are written; raised when what they hold changes its meaning."""

ENGINE = "h5netcdf"


def write(tree: xr.DataTree, path: str | Path, overwrite: bool) -> Path:
    """Write a tree, sealed, in one step; errors as of `check_writable`, and OSError.

    HDF5 writes to memory: over a disk that fills it leaves the whole program to crash.
    """
    path = check_writable(path, overwrite)
    numbered = tree.copy()
    numbered.attrs = tree.attrs | {"schema": SCHEMA}
    content = numbered.to_netcdf(engine=ENGINE)
    seal.write(path, lambda aside: aside.write_bytes(content), overwrite=overwrite)
    return path


def read(path: str | Path) -> xr.DataTree:
    """The tree of a file, if it is to be trusted, as it was written.

    The seal shows what changed since; it is no signature, and does not tell who wrote a file.
    Raises FileNotFoundError, PermissionError; ValueError for a file that was changed, is no result,
    is of another schema, or would harm. Warns of a file without a seal, which was read in another
    process first.
    """
    path = check_readable(path)
    sealed = seal.is_sealed(path)
    if sealed and not seal.is_whole(path):
        raise ValueError(f"{path} was changed after it was written: its digest is another.")
    try:
        if sealed:
            with h5py.File(path) as file:
                look.structure(file)
        else:
            look.in_another_process(path)
        with xr.open_datatree(
            path, engine=ENGINE, decode_times=False, decode_timedelta=False
        ) as opened:
            tree = opened.load()
    except Exception as error:  # of a library of three that read what anybody may have written
        why = " ".join(str(error).split()).rstrip(".")
        raise ValueError(f"{path} is not a result file that can be read: {why}.") from None
    _check_attributes(path, tree.attrs)
    if not sealed:
        warnings.warn(
            f"{path} has no seal, so that nobody can tell if it is as jdsmc wrote it.", stacklevel=3
        )
    del tree.attrs["schema"]
    for name in str(tree.attrs.get("swept", "")).split():  # NetCDF has no arrays of one element
        label = f"parameter_{name}"
        if label in tree.attrs:
            tree.attrs[label] = np.atleast_1d(tree.attrs[label])
    return tree


def _check_attributes(path: Path, attrs: dict) -> None:
    """Raise ValueError unless a file says that it is ours, and of this schema."""
    if str(attrs.get("kind", "")).startswith("jdsmc checkpoint"):
        raise ValueError(f"{path} keeps a run; `jdsmc resume {path}` gives its result.")
    if "jdsmc_version" not in attrs:
        raise ValueError(f"{path} was not written by jdsmc.")
    if "schema" not in attrs:
        raise ValueError(
            f"{path} was written by jdsmc {attrs['jdsmc_version']}, before its files had a schema; "
            "read it with that version, or run its scene again."
        )
    if not np.array_equal(attrs["schema"], SCHEMA):
        raise ValueError(
            f"{path} is of schema {attrs['schema']}, and this version of jdsmc reads {SCHEMA}; "
            f"read it with jdsmc {attrs['jdsmc_version']}."
        )
