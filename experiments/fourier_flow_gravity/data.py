"""What was measured, looked up by combination, state and study."""

from functools import cached_property
from pathlib import Path

import numpy as np
import xarray as xr

from jdsmc import Estimate, Result
from jdsmc.results.gravity_effect import linear_response, points

from ..case import Measurements
from ..paper import Paper
from . import cases
from .cases import BEYOND, EXAMPLE, Combination, sweep_name


class Fourier(Measurements):
    """All results of a run of this experiment, by the name of their case."""

    def __init__(self, size, folder: Path, fresh: bool = False):
        super().__init__(size, cases.cases(size), folder, fresh)
        self.gravity = cases.sweeps(size)

    def sweep(self, combination: Combination) -> Result:
        """The states of one of tables 2 to 5."""
        return self.results[sweep_name(combination)]

    def state(self, combination: Combination, gravity: float) -> xr.Dataset:
        """Steady values of one state, profiles over z."""
        return _at(self._holding(combination, gravity).steady, gravity)

    def realizations(self, combination: Combination, gravity: float) -> xr.Dataset:
        """Averages of one state in every realization, profiles over (realization, z)."""
        tree = self._holding(combination, gravity).to_xarray()
        return _at(tree["realizations"].to_dataset().transpose(..., "realization", "z"), gravity)

    def _holding(self, combination: Combination, gravity: float) -> Result:
        held = combination == BEYOND and gravity not in self.gravity[BEYOND]
        return self.results[cases.BEYOND_NAME] if held else self.sweep(combination)

    @cached_property
    def effects(self) -> dict[Combination, dict[str, Estimate]]:
        """z0, 𝒩(z0), g*, κ* and Δκ* of every sweep by the paper's rule, at the default window."""
        return {c: points(self.sweep(c)) for c in self.gravity}

    @cached_property
    def responses(self) -> dict[Combination, dict[str, Estimate]]:
        """B, C and κ*(g = 0) of every sweep."""
        return {c: linear_response(self.sweep(c)) for c in self.gravity}

    @property
    def variants(self) -> dict[str, Result]:
        """Sweeps of the error budget, the one it starts from first."""
        others = [result for name, result in self.results.items() if name.startswith("budget")]
        names = ("default", *self.size.variants)
        return dict(zip(names, (self.sweep(EXAMPLE), *others), strict=True))

    @property
    def molecules(self) -> dict[float, Result]:
        """Sweeps with Maxwell molecules by the length of the slab."""
        return {length: self.results[f"molecules_{length:g}"] for length, *_ in self.size.maxwell}


def _at(data: xr.Dataset, gravity: float) -> xr.Dataset:
    return data.sel(gravity=gravity, method="nearest", tolerance=1e-9)


def share(state: xr.Dataset) -> np.ndarray:
    """z/L of the layers."""
    z = state["z"].values
    return z / (z[-1] + z[0])


PAPER = Paper("fourier_flow_gravity", Fourier)
