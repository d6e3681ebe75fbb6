"""Results of several gases side by side."""

import hashlib
from collections.abc import Iterable

import xarray as xr

from .result import PLACES, Result


def join_gases(results: dict[str, Result]) -> Result:
    """One result with a dimension `gas` from results of the same sweep with different gases.

    Series of different lengths are padded with NaN at the end.
    """
    gases = list(results)
    trees = [r.to_xarray() for r in results.values()]
    groups = {}
    alike = len({int(r.attrs["n_realizations"]) for r in results.values()}) == 1
    for group in ("/", "/series", "/distribution", *(["/left_out"] if alike else [])):
        parts = [t[group].to_dataset() for t in trees if group == "/" or group[1:] in t.children]
        if len(parts) == len(trees):
            groups[group] = _stack([part.reset_coords() for part in parts], gases)
    if "/series" in groups:
        groups["/series"] = groups["/series"].set_coords("time")
    swept = next(iter(results.values())).attrs.get("swept", "")
    groups["/"].attrs["swept"] = f"gas {swept}".strip()
    groups["/"].attrs.pop(PLACES, None)  # of parts of sweeps
    groups["/"].attrs["run"] = name_of(results.values())
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


def name_of(results: Iterable[Result]) -> str:
    """A name made of those of the runs."""
    names = sorted(str(one.attrs["run"]) for one in results)
    return hashlib.blake2b(" ".join(names).encode(), digest_size=12).hexdigest()
