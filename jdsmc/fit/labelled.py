"""The result of a calibration: free numbers and misfit over restitution and target."""

import json
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from .. import sweep as sweeps
from ..estimate import Estimate
from ..results.result import Result
from ..running.provenance import specification
from ..scenarios import AbstractScene
from ..views.common import named
from .targets import Target

KEPT = (
    *("jdsmc_version", "jax_version", "numpy_version", "equinox_version", "python_version"),
    *("commit", "backend", "n_particles", "n_realizations", "seed", "time_step", "dtype"),
)
"""Attributes of the model's run that the result of a calibration keeps."""


class Match(NamedTuple):
    """What a fit came to: the free numbers by name, the misfit that remains in %, a remark.

    Without a match the numbers are NaN, and the remark says why.
    """

    numbers: dict[str, Estimate]
    misfit: Estimate
    remark: str = ""


def nothing(free: Sequence[str], remark: str) -> Match:
    """No match, and why."""
    lost = Estimate(np.nan, np.nan)
    return Match(dict.fromkeys(free, lost), lost, remark)


def labelled(
    alpha: np.ndarray | None,
    fits: list[Target],
    free: tuple[str, ...],
    found: list[Match],
    model: AbstractScene,
    reference,
    made: Result,
    how: str,
) -> Result:
    """Arrays over `target`, and over `restitution` first unless that is None.

    Arguments: the matches in this order; the run of the model whose options and versions are kept;
    a clause on the method.
    """
    coords: dict = {"target": ("target", [one.label for one in fits], {"long_name": "matched"})}
    if alpha is not None:
        meaning = {"long_name": "coefficient of normal restitution α", "units": "1"}
        coords = {"restitution": ("restitution", alpha, meaning)} | coords
    shape = tuple(len(values) for _, values, _ in coords.values())
    data = xr.Dataset(coords=coords)
    columns = {name: [one.numbers[name] for one in found] for name in free}
    columns["misfit"] = [one.misfit for one in found]
    for name, values in columns.items():
        facts = _facts(model, name)
        data[name] = tuple(coords), _array(values, 0).reshape(shape), facts
        wrong = {"long_name": f"standard error of {facts['long_name']}", "units": facts["units"]}
        data[f"{name}_error"] = tuple(coords), _array(values, 1).reshape(shape), wrong
    attrs = {name: made.attrs[name] for name in KEPT if name in made.attrs}
    data.attrs = attrs | {
        "scene": "Calibration",
        "gas_model": type(model.gas).__name__,
        **{f"option_{name}": str(value) for name, value in _switches(model, free)},
        "model": json.dumps(specification(model)),
        "reference": _named(reference),
        "free": " ".join(free),
        "swept": " ".join(coords),
        "seconds": float(made.attrs.get("seconds", 0.0)),
        "remarks": " ".join(_remarks(alpha, fits, found)),
        "stopped": how,
    }
    return Result(xr.DataTree.from_dict({"/": data, "/series": xr.Dataset()}))


def _switches(model: AbstractScene, free: tuple[str, ...]) -> list[tuple[str, Any]]:
    """What of the model is no number, but for what was free."""
    found = [(path.removeprefix("gas."), x) for path, x in sweeps.statics(model).items()]
    return [(name, x) for name, x in found if name not in free]


def _array(values: list[Estimate], part: int) -> np.ndarray:
    return np.array([float(tuple(one)[part]) for one in values])


def _facts(model: AbstractScene, name: str) -> dict:
    if name == "misfit":
        return {"long_name": "misfit that remains", "units": "%", "symbol": "misfit"}
    paths = {path.split(".")[-1]: path for path in sweeps.numbers(model)}
    known = sweeps.facts(model, paths.get(name, f"gas.{name}"))
    return {
        "long_name": known.get("meaning", name),
        "units": known.get("unit", "1"),
        "symbol": named(name),
    }


def _remarks(alpha, fits: list[Target], found: list[Match]) -> list[str]:
    """A sentence for each fit without a match."""
    remarks = []
    for k, one in enumerate(found):
        where = "" if alpha is None else f"restitution {alpha[k // len(fits)]:g}: "
        remarks += [f"{where}{one.remark}."] if one.remark else []
    return remarks


def _named(reference) -> str:
    if isinstance(reference, Result):
        return str(reference.attrs.get("specification", reference.attrs.get("gas_model", "")))
    return "numbers"
