"""What stands behind the verdicts: the sequential program, other numerics, the limits."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from jdsmc import Estimate, Result
from jdsmc.scenarios.options import TIME_STEP

from .. import store
from ..case import steady
from ..numbers import Fit, within
from . import independent
from .cases import FAST, POINTS
from .data import Shear
from .measured import STEADY

TOLERANCE = 0.003
"""The accuracy that the defaults are to have."""


def sequential(data: Shear) -> dict[str, dict[str, Estimate]]:
    """Steady values of the sequential program at `POINTS` by name."""
    options = data.size.independent
    asked = {**options, "program": store.program(Path(independent.__file__))}

    def compute() -> dict:
        found = {}
        for gas, alpha in POINTS:
            start = float(data.steady(gas, alpha, FAST, "temperature"))
            values = independent.steady(gas, alpha, FAST, start, **options)
            found[f"{gas} {alpha}"] = {name: [*one] for name, one in values.items()}
        return found

    found = store.kept(data.folder / "independent.json", asked, compute, data.fresh)
    return {p: {n: Estimate(v, e) for n, (v, e) in x.items()} for p, x in found.items()}


def _difference(name: str):
    return lambda data: data.steady("ehs", 0.7, FAST, name) - data.steady("ihs", 0.7, FAST, name)


REPEATED: dict[str, Callable] = STEADY | {
    "crossing_a2": _difference("a2"),
    "crossing_cubed": _difference("relative_speed_cubed"),
}
"""What is measured again if a number differs: for a crossing EHS minus IHS at α = 0.7."""

AGAIN = ("another seed", "4 N", "dt/2")

PAPER_PARTICLES = 10_000
PAPER_COLLISIONS = 50.0
"""N of the paper, and about the collisions per particle its averages can cover (Figs. 4 to 13)."""


def evidence(data: Shear, key: str) -> list[Estimate]:
    """A quantity from the main runs, and with other numerics."""
    return [REPEATED[key](one) for one in (data, *map(data.repeated, AGAIN))]


class Effort:
    """The steady values of `Shear`; remembers particles times collisions behind each."""

    def __init__(self, data: Shear):
        self.data, self.spent = data, []

    def steady(self, gas: str, restitution: float, shear_rate: float, name: str) -> Estimate:
        """A steady value at one point."""
        result = self.data.results[f"steady_{gas}"]
        particles = int(result.attrs["n_particles"]) * int(result.attrs["n_realizations"])
        found = result.series["collisions"][..., -1] - result.steady["steady_from_collisions"]
        point = {"restitution": restitution, "shear_rate": shear_rate}
        self.spent.append(particles * float(found.sel(point, method="nearest")))
        return self.data.steady(gas, restitution, shear_rate, name)


def paper_error(data: Shear, key: str) -> float:
    """Standard error that one run of the paper's size would have for a quantity: ours, scaled."""
    effort = Effort(data)
    error = float(REPEATED[key](effort).error)
    return error * float(np.sqrt(np.mean(effort.spent) / (PAPER_PARTICLES * PAPER_COLLISIONS)))


PAPER_LAYERS, LAYER_PARTICLES = 50, 200
"""The paper's inhomogeneous runs: N = 1e4 in M = 50 layers (section IV A)."""


OBSERVABLES = {
    "temperature": "T_s",
    "shear_stress": "-P_xy/nT",
    "normal_stress_xy": "(P_xx-P_yy)/nT",
    "normal_stress_zy": "(P_zz-P_yy)/nT",
    "a2": "a2",
    "relative_speed_cubed": "⟨V12³⟩",
}
"""Of the convergence study."""


class Runs:
    """One point of the convergence study: all runs that hold it, and the limits dt → 0, N → ∞.

    Attributes: `number`, `asked`, `step`: N, the step asked for, the step really made (τ).
    """

    def __init__(self, data: Shear, gas: str, restitution: float):
        found = [name for name in data.results if name.startswith(f"convergence_{gas}_")]
        self.results: list[Result] = [data.results[name] for name in found]
        self.restitution, self.usual = restitution, data.size.study_numbers[0]
        options = [data.cases[name].options for name in found]
        self.number = np.array([one["n_particles"] for one in options])
        self.asked = np.array([one["time_step"] for one in options])
        self.step = np.array([float(one) for one in self.values("time_step")])
        usual = (self.number == self.usual) & (self.asked == TIME_STEP)
        self.default = float(self.step[usual][0])

    def values(self, name: str) -> list[Estimate]:
        """An observable in every run."""
        return [steady(result, name, restitution=self.restitution) for result in self.results]

    def limit(self, name: str) -> "Limit":
        """Weighted least squares of v + c dt² + b/N over all runs."""
        values = self.values(name)
        error = np.array([float(one.error) for one in values])
        # Errors from few realizations scatter; what they have in common is known better.
        error = np.sqrt(0.5 * (error**2 + np.median(error) ** 2))
        values = [Estimate(one.value, e) for one, e in zip(values, error, strict=True)]
        step, crowd = (self.step / self.default) ** 2, self.usual / self.number
        return Limit(np.stack([np.ones_like(step), step, crowd], axis=1), values)


class Limit(Fit):
    """v + c dt² + b/N: how far the defaults are from v, relative to it."""

    @property
    def by_step(self) -> Estimate:
        """What the default time step does."""
        return self.terms[1] / self.terms[0]

    @property
    def by_number(self) -> Estimate:
        """What the default particle number does."""
        return self.terms[2] / self.terms[0]

    def verdict(self) -> str:
        """Whether the defaults are within the tolerance, at two standard errors."""
        return within(self.by_step + self.by_number, TOLERANCE)
