"""A case: a scene and the options of its run, obtained from the store or simulated."""

import json
import sys
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from jdsmc import Estimate, Result, resume, run, transport
from jdsmc.running.provenance import specification
from jdsmc.scenarios.navier_stokes import NavierStokes

from . import store
from .claims import Claim, Verdict

LONGER = 1.25
"""Factor by which a run is made longer, again and again, until it has steady values."""


@dataclass(frozen=True)
class Case:
    """One simulation.

    Arguments:
        name: of its file, without suffix; the seed is made from it.
        scene: of `jdsmc.scenarios`, swept or not.
        options: of `jdsmc.run`, or of `navier_stokes` for its scene.
        steady: if needed at every point: a run of given length then goes on until they are known.
    """

    name: str
    scene: Any
    options: dict = field(default_factory=dict)
    steady: bool = True

    def parts(self, count: int) -> "list[Case]":
        """As many equal cases with seeds of their own."""
        return [replace(self, name=f"{self.name}_{k}") for k in range(count)]

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        asked = [self.name, specification(self.scene), self.options, self.steady]
        return json.dumps(asked, sort_keys=True)

    def sources(self) -> list[Path]:
        """Modules that the simulation starts from."""
        start = transport.navier_stokes if isinstance(self.scene, NavierStokes) else run
        first = (type(self.scene), type(self.scene.gas), start, resume)
        return [Path(str(sys.modules[one.__module__].__file__)) for one in first]

    def simulate(self) -> Result:
        """Run it."""
        options = {"seed": zlib.crc32(self.name.encode()), "progress": False, **self.options}
        result = self._once(options)
        while self.steady and not (steady_everywhere(result) or result.interrupted):
            clock = next(name for name in ("duration", "collisions") if name in options)
            options[clock] *= LONGER
            result = resume(result, progress=False, **{clock: options[clock]})
        return result

    def _once(self, options: dict) -> Result:
        if isinstance(self.scene, NavierStokes):
            asked = {"kick": self.scene.kick, "duration": self.scene.duration}
            return transport.navier_stokes(self.scene.gas, **asked, **options)
        return run(self.scene, **options)


def steady_everywhere(result: Result) -> bool:
    """True if there are steady values at every point of a sweep."""
    start = result.to_xarray().get("steady_from_collisions")
    return result.is_steady and (start is None or bool(np.all(np.isfinite(start.values))))


class Measurements:
    """Results of the cases of one size of a paper, by name; papers add how they look things up.

    Arguments: the size; its cases; the folder of the store; True to run everything again.
    """

    def __init__(self, size: Any, cases: Iterable[Case], folder: Path, fresh: bool = False):
        self.size, self.folder, self.fresh = size, folder, fresh
        self.cases = {case.name: case for case in cases}
        self.results = {n: store.obtain(case, folder, fresh) for n, case in self.cases.items()}
        self.verdicts: dict[Claim, Verdict] = {}


@cache
def _of_all_points(result: Result, name: str) -> Estimate:
    return result[name]


@cache
def _place(result: Result, point: frozenset) -> tuple:
    wanted, index = dict(point), []
    for name in result.dims:
        values = result.steady[name].values
        if name in wanted:
            found = np.flatnonzero(np.isclose(values, wanted[name], atol=1e-9))
            if not len(found):
                raise KeyError(f"{name} = {wanted[name]} was not run.")
            index.append(int(found[0]))
        else:
            index.append(0 if len(values) == 1 else slice(None))
    return tuple(index)


def steady(result: Result, name: str, **point) -> Estimate:
    """A steady value at one point of a sweep, or against the numbers that are not named.

    Values of one point are correlated, as they are measured in the same gas; dimensions of the
    observable itself (orders, layers) come last. Raises KeyError for a point that was not run.
    """
    place = _place(result, frozenset(point.items()))
    return _of_all_points(result, name)[place] if place else _of_all_points(result, name)


def at(data: xr.Dataset, **point) -> xr.Dataset:
    """One point of a sweep, with only the axes that are longer than 1; KeyError if not run."""
    named = {name: value for name, value in point.items() if name in data.dims}
    return data.sel(named, method="nearest", tolerance=1e-9).squeeze()


def estimate(data: xr.Dataset, name: str) -> Estimate:
    """A variable of a dataset with its standard error."""
    return Estimate(data[name].values, data[f"{name}_error"].values)
