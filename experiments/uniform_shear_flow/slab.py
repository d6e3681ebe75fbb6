"""The inhomogeneous problem, sections IV A and V A: what to run, and what was measured."""

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np
import xarray as xr
from jdsmc.gas import RATE_FACTORS

from jdsmc import Estimate, Result, run
from jdsmc.scenarios import ShearedSlab

from ..store import obtain
from .systems import FAST, GASES

RESTITUTION, LENGTH, LAYERS = 0.9, 2.5, 50
"""α, L/λ0 and M of the paper's slab; its shear rate is a τ0 = 4."""

BETA = {"ihs": 1.0, "ehs": RATE_FACTORS["linear"](RESTITUTION)}
"""Collision rate over that of IHS."""

Start = Literal["equilibrium", "nonequilibrium"]
STARTS: dict[Start, str] = {"equilibrium": "(3.5)", "nonequilibrium": "(3.6)"}
"""The two initial states of section V A, and their equations."""


@dataclass(frozen=True)
class SlabCase:
    """One simulation: a gas, an initial state, and the options of `run`."""

    name: str
    gas: str
    initial_state: Start
    options: dict = field(default_factory=dict)
    module: str = "scenarios/sheared_slab.py"

    def simulate(self) -> Result:
        """Run it."""
        gas = GASES[self.gas](RESTITUTION)
        scene = ShearedSlab(gas, FAST, LENGTH, self.initial_state, LAYERS)
        return run(scene, progress=False, **self.options)

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        return json.dumps([asdict(self), RESTITUTION, FAST, LENGTH, LAYERS], sort_keys=True)


@dataclass(frozen=True)
class SlabSize:
    """How much to compute. The paper: N = 1e4 particles, three realizations.

    `early`: particles and realizations for the profiles until t = 2.3; `late`: for the approach to
    the steady state; `collisions`: how long that is followed; `halved`: also with half the step?
    """

    early: tuple[int, int]
    late: tuple[int, int]
    collisions: float
    halved: bool


SIZES = {
    "small": SlabSize((10_000, 16), (5_000, 8), 140.0, halved=False),
    "full": SlabSize((40_000, 32), (20_000, 16), 400.0, halved=True),
}
EARLY_DURATION = 2.6


def cases(size: SlabSize) -> list[SlabCase]:
    """Profiles of both gases from both states, and their approach to the steady state."""
    early = dict(zip(("n_particles", "n_realizations"), size.early, strict=True))
    early |= {"duration": EARLY_DURATION, "steps_per_record": 2}
    late = dict(zip(("n_particles", "n_realizations"), size.late, strict=True))
    late |= {"collisions": size.collisions, "steps_per_record": 4}
    found = []
    for number, start in enumerate(STARTS):
        for other, gas in enumerate(BETA):
            options = {**early, "seed": 200 + 2 * number + other}
            found.append(SlabCase(f"slab_early_{gas}_{start}", gas, start, options))
    for seed, gas in ((210, "ihs"), (211, "ehs")):
        found.append(
            SlabCase(f"slab_late_{gas}_equilibrium", gas, "equilibrium", {**late, "seed": seed})
        )
    followed = {**late, "collisions": 60.0, "seed": 212}
    found.append(SlabCase("slab_late_ihs_nonequilibrium", "ihs", "nonequilibrium", followed))
    if size.halved:
        options = {**late, "time_step": 0.025, "seed": 213}
        found.append(SlabCase("slab_half_step_ihs", "ihs", "equilibrium", options))
    return found


class Slabs:
    """All results of the inhomogeneous problem, by case name."""

    def __init__(self, results: dict[str, Result]):
        self.results = results

    def series(self, stage: str, gas: str, start: str = "equilibrium") -> xr.Dataset:
        """Time series with `clock`, s for IHS and s'/β for EHS; stage "early" or "late"."""
        found = self.results[f"slab_{stage}_{gas}_{start}"].series
        return found.assign(clock=found["collisions"] / BETA[gas])

    def profile(self, gas: str, start: str, time: float, name: str) -> Estimate:
        """A profile at a time, interpolated between records: u_x/aL, n/n̄ or T/T̄."""
        return reduced(self.series("early", gas, start), name).at(time)

    def steady(self, gas: str, name: str) -> Estimate:
        """A steady average of the slab started from equilibrium."""
        return self.results[f"slab_late_{gas}_equilibrium"][name]


class Curve:
    """Values and errors against time, of each layer or of a group of them."""

    def __init__(self, time: np.ndarray, value: np.ndarray, error: np.ndarray):
        self.time, self.value, self.error = time, value, error

    def at(self, time: float) -> Estimate:
        """Interpolated linearly."""
        columns = zip(*np.broadcast_arrays(self.value.T, self.error.T), strict=True)
        if self.value.ndim == 1:
            return Estimate(
                *(float(np.interp(time, self.time, x)) for x in (self.value, self.error))
            )
        pairs = [[np.interp(time, self.time, x) for x in column] for column in columns]
        return Estimate(*np.array(pairs).T)

    def over(self, layers: slice) -> "Curve":
        """Average over some layers, whose errors are taken as independent."""
        error = self.error[:, layers]
        mean_error = np.sqrt(np.sum(error**2, axis=1)) / error.shape[1]
        return Curve(self.time, np.mean(self.value[:, layers], axis=1), mean_error)


def reduced(series: xr.Dataset, name: str) -> Curve:
    """A profile in the units of Fig. 2: u_x/aL, n/n̄ or T/T̄."""
    value, error = series[name].values, series[f"{name}_error"].values
    if name == "velocity_x":
        scale = FAST * LENGTH
    elif name == "temperature":
        scale = series["mean_temperature"].values[:, None]
    else:
        scale = 1.0
    return Curve(series["time"].values, value / scale, error / scale)


CENTRE = slice(LAYERS // 2 - 2, LAYERS // 2 + 2)
TOP = slice(LAYERS - 3, LAYERS)
"""The four central and the three top layers of Fig. 3."""

HEIGHT = (np.arange(LAYERS) + 0.5) / LAYERS - 0.5
"""Centres of the layers, y/L as in the paper: from -1/2 to 1/2."""


def measure(size: SlabSize, folder: Path, fresh: bool) -> Slabs:
    """Run or reuse every case."""
    return Slabs({case.name: obtain(case, folder, fresh) for case in cases(size)})
