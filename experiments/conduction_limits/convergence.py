"""`python -m experiments.conduction_limits.convergence [--full]`: step, layers, particles.

Heat flux of the Fourier flow at T_- = 0.2 T_+, L = 10, Maxwell walls, without gravity; sampled in
the gas, and from the energy that the walls exchange, which no sampling can bias. Known laws, with
the local mean free path and speed: κ (1 + (32/225π)(Δz/λ)²) (Alexander, Garcia and Alder 1998) and
κ (1 + (64/675π)(v0 dt/λ)²) (Hadjiconstantinou 2000). T^{3/2} being a straight line, the flux
changes by their average over the slab.
"""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import matplotlib as mpl
import numpy as np
import tyro
from jdsmc.result import format_estimate

from jdsmc import InelasticHardSpheres, Result, run
from jdsmc.scenarios import FourierFlow

from ..publish import output_folder, results_folder
from ..store import obtain
from .analysis import discretization
from .convergence_figure import draw, relative

RESULTS = Path(__file__).parent / "results"
COLD, LENGTH = 0.2, 10.0
TOTAL, SMALL_TIME, FULL_TIME = 80_000, 400.0, 1_600.0
"""Particles of all realizations together, and the time simulated."""
STEPS = 8
"""Time steps between two samples."""


@dataclass(frozen=True)
class Setting:
    """One choice of the numerical parameters."""

    study: str
    time_step: float = 0.05
    layers: int = 100
    particles: int = 5_000
    splitting: str = "strang"


SETTINGS = (
    Setting("defaults"),
    Setting("time step", time_step=0.025),
    *(Setting("time step", dt, splitting="lie") for dt in (0.05, 0.025, 0.0125)),
    *(Setting("layers", layers=layers) for layers in (200, 25, 12, 8)),
    *(Setting("particles", particles=number) for number in (20_000, 1_000, 500)),
)


@dataclass(frozen=True)
class Case:
    """The simulation of one setting."""

    seed: int
    setting: Setting
    duration: float
    module: str = "scenarios/fourier_flow.py"

    @property
    def name(self) -> str:
        """Name of its file."""
        return f"convergence_{self.seed:02}"

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        return json.dumps([asdict(self), COLD, LENGTH, TOTAL], sort_keys=True)

    def simulate(self) -> Result:
        """Run it."""
        setting = self.setting
        scene = FourierFlow(InelasticHardSpheres(1.0), COLD, length=LENGTH, layers=setting.layers)
        return run(
            scene,
            n_particles=setting.particles,
            n_realizations=TOTAL // setting.particles,
            duration=self.duration,
            time_step=setting.time_step,
            splitting=setting.splitting,
            steps_per_record=STEPS,
            seed=self.seed,
            progress=False,
        )


@dataclass(frozen=True)
class Measured:
    """Fluxes of one setting with their errors, the step really taken, and the known laws."""

    setting: Setting
    sampled: tuple[float, float]
    walls: tuple[float, float]
    step: float
    law: float


def measure(setting: Setting, result: Result) -> Measured:
    """What the study needs of a simulation."""
    data = result.to_xarray()["realizations"].to_dataset()
    walls = 0.5 * (data["heat_flux_cold_wall"] + data["heat_flux_hot_wall"]).values
    sampled = data["mean_heat_flux"].values
    step = float(np.mean(np.diff(result.series["time"].values)[1:])) / (
        STEPS * FourierFlow.samples_per_record
    )
    return Measured(setting, _mean(sampled), _mean(walls), step, _law(result, step))


def _mean(values) -> tuple[float, float]:
    return float(np.mean(values)), float(np.std(values, ddof=1) / np.sqrt(len(values)))


def _law(result, step: float) -> float:
    """Relative error of the flux by the known laws."""
    steady = result.to_xarray().to_dataset()
    density, temperature = steady["density"].values, steady["temperature"].values
    return float(np.mean(discretization(density, temperature, LENGTH / len(density), step)))


def main(full: bool = False, out: Path | None = None, fresh: bool = False):
    """Measure every setting; write convergence.md and convergence.png.

    Args:
        full: four times longer runs, about twenty minutes on two cores.
        out: folder for simulations (*.h5, reused if they are what is asked for); by default
            output/conduction_limits/small or full.
        fresh: run every simulation again.
    """
    mpl.use("agg")
    size = "full" if full else "small"
    store = output_folder("conduction_limits", size, out)
    found = []
    for seed, setting in enumerate(SETTINGS):
        case = Case(seed, setting, FULL_TIME if full else SMALL_TIME)
        found.append(measure(setting, obtain(case, store, fresh)))
        print(_row(found[-1], found[0]), flush=True)
    folder = results_folder(RESULTS, size)
    (folder / "convergence.md").write_text(_table(found))
    draw(found, LENGTH).savefig(folder / "convergence.png", dpi=130)


def _table(found: list[Measured]) -> str:
    reference = found[0]
    lines = [
        "# Fourier flow: time step, layers, particles\n",
        f"T_- = {COLD:g} T_+, L = {LENGTH:g} λ0. Heat flux from the walls and sampled in the gas, "
        "in percent off the walls' value at the defaults; one standard error in brackets. The law "
        "is relative to no discretization at all.\n",
        f"At the defaults: {format_estimate(*reference.walls)} from the walls, "
        f"{format_estimate(*reference.sampled)} sampled; law: {100 * reference.law:+.3f}%.\n",
        "| study | splitting | dt asked | dt taken | layers | N | walls | sampled | law |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
        *(_row(one, reference) for one in found),
    ]
    return "\n".join(lines) + "\n"


def _row(one: Measured, reference: Measured) -> str:
    s = one.setting
    cells = [
        *(s.study, s.splitting, f"{s.time_step:g}", f"{one.step:.4f}"),
        *(str(s.layers), str(s.particles)),
        *(format_estimate(*relative(x, reference.walls[0])) for x in (one.walls, one.sampled)),
        f"{100 * one.law:.3f}",
    ]
    return "| " + " | ".join(cells) + " |"


if __name__ == "__main__":
    tyro.cli(main)
