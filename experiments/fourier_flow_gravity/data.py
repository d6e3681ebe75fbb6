"""What was measured, looked up by combination, state and study."""

from functools import cached_property
from pathlib import Path

import xarray as xr
from jdsmc.gravity_effect import at_equal_gradient, linear_response

from jdsmc import Estimate, Result

from ..store import obtain
from .systems import (
    BEYOND,
    BEYOND_NAME,
    EXAMPLE,
    Combination,
    Size,
    cases,
    maxwell_name,
    sweep_name,
    variant_name,
)


class Measurements:
    """All results of a run of this experiment, by the name of their case."""

    def __init__(self, size: Size, results: dict[str, Result]):
        self.size, self.results = size, results

    def sweep(self, combination: Combination) -> Result:
        """The states of one of tables 2 to 5."""
        return self.results[sweep_name(combination)]

    def state(self, combination: Combination, gravity: float) -> xr.Dataset:
        """Steady values of one state, profiles over z."""
        return _at(self._holding(combination, gravity).to_xarray().to_dataset(), gravity)

    def realizations(self, combination: Combination, gravity: float) -> xr.Dataset:
        """Averages of one state in every realization."""
        tree = self._holding(combination, gravity).to_xarray()
        return _at(tree["realizations"].to_dataset(), gravity)

    def _holding(self, combination: Combination, gravity: float) -> Result:
        held = combination == BEYOND and gravity not in self.size.gravity[BEYOND]
        return self.results[BEYOND_NAME] if held else self.sweep(combination)

    @cached_property
    def effects(self) -> dict[Combination, xr.Dataset]:
        """z0, 𝒩(z0), g*, κ* and Δκ* of every sweep by the paper's rule, at the default window."""
        return {c: at_equal_gradient(self.sweep(c)) for c in self.size.gravity}

    @cached_property
    def responses(self) -> dict[Combination, dict[str, Estimate]]:
        """B, C and κ*(g = 0) of every sweep."""
        return {c: linear_response(self.sweep(c)) for c in self.size.gravity}

    @property
    def spheres(self) -> list[Result]:
        """The sweeps of tables 2 to 5."""
        return [self.sweep(combination) for combination in self.size.gravity]

    @property
    def variants(self) -> dict[str, Result]:
        """Sweeps of the error budget, the one it starts from first."""
        found = {"default": self.sweep(EXAMPLE)}
        return found | {v: self.results[variant_name(v)] for v in self.size.variants}

    @property
    def molecules(self) -> dict[float, Result]:
        """Sweeps with Maxwell molecules by the length of the slab."""
        return {length: self.results[maxwell_name(length)] for length in self.size.maxwell}


def plain(estimate: Estimate) -> tuple[float, float]:
    """Value and error of a single number."""
    return float(estimate.value), float(estimate.error)


def _at(data: xr.Dataset, gravity: float) -> xr.Dataset:
    return data.sel(gravity=gravity, method="nearest", tolerance=1e-9)


def measure(size: Size, folder: Path, fresh: bool) -> Measurements:
    """Every simulation of a size, from FOLDER where it is there."""
    return Measurements(size, {n: obtain(c, folder, fresh) for n, c in cases(size).items()})
