"""What was measured, looked up by gas, restitution and shear rate."""

import itertools
import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import xarray as xr
from jdsmc.gas import RATE_FACTORS
from jdsmc.options import STEPS_PER_RECORD

from jdsmc import Estimate, Result

from .systems import Case


class Term(NamedTuple):
    """One steady observable of one gas at one point; `index` picks a speed class."""

    gas: str
    restitution: float
    shear_rate: float
    name: str
    index: int | None = None


@dataclass(frozen=True)
class SteadyQuantity:
    """A function of steady observables, which may come from several gases."""

    terms: tuple[Term, ...]
    function: Callable[..., float]

    def of(self, lookup: Callable[[Term], Estimate]) -> Estimate:
        """Its value and standard error, the terms taken as independent."""
        return propagate(self.function, [lookup(term) for term in self.terms])


def propagate(function: Callable[..., float], estimates: list[Estimate]) -> Estimate:
    """Value and standard error of a function of independent estimates (linear propagation)."""
    values = [e.value for e in estimates]
    centre = function(*values)
    shifts = [
        function(*values[:k], e.value + e.error, *values[k + 1 :]) - centre
        for k, e in enumerate(estimates)
    ]
    return Estimate(float(centre), float(np.sqrt(np.sum(np.square(shifts)))))


class Measurements:
    """All results of a run of this experiment, by case name; `symmetry`: see `symmetry.check`."""

    def __init__(self, cases: dict[str, Case], results: dict[str, Result], symmetry: dict):
        self.cases, self.results, self.symmetry = cases, results, symmetry

    def steady_case(self, gas: str) -> Case:
        """The case that holds the steady states of a gas."""
        return self.cases[f"steady_{gas}"]

    def restitutions(self, gas: str = "ihs") -> tuple[float, ...]:
        """Restitutions of the steady states of a gas."""
        return self.steady_case(gas).restitution

    def steady(self, gas: str, restitution: float, shear_rate: float) -> xr.Dataset:
        """Steady values at one point."""
        tree = self.results[f"steady_{gas}"].to_xarray()
        return at_point(tree.to_dataset(), restitution, shear_rate)

    def lookup(self, term: Term) -> Estimate:
        """Value and error of one steady observable."""
        return estimate_in(self.steady(term.gas, term.restitution, term.shear_rate), term)

    def steady_values(self, gas: str, shear_rate: float, name: str) -> Estimate:
        """A steady observable against restitution: arrays in the order of `restitutions`."""
        points = [self.lookup(Term(gas, a, shear_rate, name)) for a in self.restitutions(gas)]
        return Estimate(*(np.array(column) for column in zip(*points, strict=True)))

    def distribution(self, gas: str, restitution: float, shear_rate: float) -> xr.Dataset:
        """Steady velocity distributions at one point."""
        found = self.results[f"steady_{gas}"].distribution
        return at_point(found, restitution, shear_rate)

    def mean_distribution(self, gas: str, restitution: float) -> xr.Dataset:
        """Distributions averaged over the shear rates, as in the paper's Fig. 18."""
        rates = self.steady_case(gas).shear_rate
        parts = [self.distribution(gas, restitution, rate) for rate in rates]
        mean = sum(parts[1:], parts[0].copy()) / len(parts)
        for name in ("marginal_x", "marginal_y", "speed"):
            squares = sum(part[f"{name}_error"] ** 2 for part in parts)
            mean[f"{name}_error"] = np.sqrt(squares) / len(parts)
        return mean

    def series(self, gas: str, restitution: float, shear_rate: float) -> xr.Dataset:
        """Time series at one point, with `clock`: s for IHS and s'/β for EHS."""
        found = at_point(self.results[f"transient_{gas}"].series, restitution, shear_rate)
        beta = 1.0 if gas == "ihs" else RATE_FACTORS["linear"](restitution)
        return found.assign(clock=found["collisions"] / beta)


def at_point(data: xr.Dataset, restitution: float, shear_rate: float) -> xr.Dataset:
    """One point of a sweep; raises KeyError if it was not simulated."""
    point = {"restitution": restitution, "shear_rate": shear_rate}
    return data.sel(point, method="nearest", tolerance=1e-9)


def estimate_in(data: xr.Dataset, term: Term) -> Estimate:
    """Value and error of a term in the steady values of its point."""
    pair = (data[term.name].values, data[f"{term.name}_error"].values)
    if term.index is not None:
        pair = tuple(array[term.index] for array in pair)
    return Estimate(*(float(array) for array in pair))


def actual_steps(result: Result) -> np.ndarray:
    """Time step really used in the steady state, in units of τ(T): array like the sweep.

    `run` shortens the step asked for so that a particle is a candidate at most 0.5 times a step;
    the times of the records tell what it was.
    """
    options = json.loads(result.attrs["request"])["options"]
    series, root = result.series, result.to_xarray().to_dataset()
    shape = root["steady_from_time"].shape
    steps = np.empty(shape)
    for point in itertools.product(*map(range, shape)):
        time, temperature = series["time"].values[point], series["temperature"].values[point]
        step = (
            np.diff(time)
            / options.get("steps_per_record", STEPS_PER_RECORD)
            * np.sqrt(temperature[:-1])
        )
        steps[point] = np.mean(step[time[:-1] >= root["steady_from_time"].values[point]])
    return steps


def measured_collisions(result: Result) -> np.ndarray:
    """Collisions per particle over which the steady values were averaged: array like the sweep."""
    start = result.to_xarray()["steady_from_collisions"].values
    return result.series["collisions"].values[..., -1] - start
