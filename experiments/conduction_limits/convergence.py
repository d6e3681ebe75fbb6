"""`python -m experiments.conduction_limits.convergence [--full]`: step, layers, particles.

Heat flux of the Fourier flow at T_- = 0.2 T_+, L = 10, Maxwell walls, without gravity; sampled in
the gas, and from the energy that the walls exchange, which no sampling can bias. Known laws, with
the local mean free path and speed: κ (1 + (32/225π)(Δz/λ)²) (Alexander, Garcia and Alder 1998) and
κ (1 + (64/675π)(v0 dt/λ)²) (Hadjiconstantinou 2000). T^{3/2} being a straight line, the flux
changes by their average over the slab.
"""

from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import tyro

from jdsmc import InelasticHardSpheres, run
from jdsmc.result import format_estimate
from jdsmc.scenarios import FourierFlow

from ..publish import results_folder
from .analysis import discretization

RESULTS = Path(__file__).parent / "results"
COLD, LENGTH = 0.2, 10.0
TOTAL, SMALL_TIME, FULL_TIME = 80_000, 400.0, 1_600.0
"""Particles of all realizations together, and the time simulated."""


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
class Measured:
    """Fluxes of one setting with their errors, the step really taken, and the known laws."""

    setting: Setting
    sampled: tuple[float, float]
    walls: tuple[float, float]
    step: float
    law: float


def measure(setting: Setting, seed: int, duration: float) -> Measured:
    """Run one setting."""
    scene = FourierFlow(InelasticHardSpheres(1.0), COLD, length=LENGTH, layers=setting.layers)
    result = run(
        scene,
        n_particles=setting.particles,
        n_realizations=TOTAL // setting.particles,
        duration=duration,
        time_step=setting.time_step,
        splitting=setting.splitting,
        steps_per_record=8,
        seed=seed,
        progress=False,
    )
    data = result.to_xarray()["realizations"].to_dataset()
    walls = 0.5 * (data["heat_flux_cold_wall"] + data["heat_flux_hot_wall"]).values
    sampled = data["mean_heat_flux"].values
    step = float(np.mean(np.diff(result.series["time"].values)[1:])) / (
        8 * scene.samples_per_record
    )
    return Measured(setting, _mean(sampled), _mean(walls), step, _law(result, step))


def _mean(values) -> tuple[float, float]:
    return float(np.mean(values)), float(np.std(values, ddof=1) / np.sqrt(len(values)))


def _law(result, step: float) -> float:
    """Relative error of the flux by the known laws."""
    steady = result.to_xarray().to_dataset()
    density, temperature = steady["density"].values, steady["temperature"].values
    return float(np.mean(discretization(density, temperature, LENGTH / len(density), step)))


def main(full: bool = False):
    """Measure every setting; write convergence.md and convergence.png.

    Args:
        full: four times longer runs.
    """
    mpl.use("agg")
    folder = results_folder(RESULTS, "full" if full else "small")
    found = []
    for seed, setting in enumerate(SETTINGS):
        found.append(measure(setting, seed, FULL_TIME if full else SMALL_TIME))
        print(_row(found[-1], found[0]), flush=True)
    (folder / "convergence.md").write_text(_table(found))
    _draw(found).savefig(folder / "convergence.png", dpi=130)


def _relative(one: tuple[float, float], reference: float) -> tuple[float, float]:
    """Difference from the reference in percent, and its error (that of `one`)."""
    return 100 * (one[0] / reference - 1), 100 * abs(one[1] / reference)


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
        *(format_estimate(*_relative(x, reference.walls[0])) for x in (one.walls, one.sampled)),
        f"{100 * one.law:.3f}",
    ]
    return "| " + " | ".join(cells) + " |"


def _draw(found: list[Measured]):
    """Three panels: against dt, layer width, and particles per layer."""
    figure, panels = plt.subplots(1, 3, figsize=(11, 3.6), sharey=True, layout="constrained")
    reference = found[0].walls[0]

    def points(panel, chosen, x, values, marker, label, filled=False):
        pairs = [_relative(getattr(one, values), reference) for one in chosen]
        y, error = np.array(pairs).T
        fill = None if filled else "none"
        panel.errorbar(x, y, error, fmt=marker, mfc=fill, capsize=2, ms=5, label=label)

    strang = [o for o in found if o.setting.splitting == "strang"]
    steps = [o for o in strang if o.setting.study in ("defaults", "time step")]
    lie = [o for o in found if o.setting.splitting == "lie"]
    for values, marker in (("walls", "s"), ("sampled", "o")):
        x = np.array([o.step for o in steps])
        points(panels[0], steps, x, values, marker, f"Strang, {values}", filled=True)
        points(panels[0], lie, [o.step for o in lie], values, marker, f"Lie, {values}")
    layers = [o for o in strang if o.setting.study in ("defaults", "layers")]
    width = np.array([LENGTH / o.setting.layers for o in layers])
    points(panels[1], layers, width, "walls", "s", "walls")
    order = np.argsort(width)
    law = 100 * (np.array([o.law for o in layers]) - layers[0].law)
    panels[1].plot(width[order], law[order], "k-", lw=1, label="(32/225π)⟨(Δz/λ)²⟩")
    crowd = [o for o in strang if o.setting.study in ("defaults", "particles")]
    number = [o.setting.particles / o.setting.layers for o in crowd]
    points(panels[2], crowd, number, "walls", "s", "walls")
    panels[2].set_xscale("log")
    for panel, label in zip(panels, ("dt/τ0", "Δz/λ0", "particles per layer"), strict=True):
        panel.axhspan(-0.3, 0.3, color="0.9", zorder=0)
        panel.axhline(0, color="0.6", lw=0.8)
        panel.set_xlabel(label)
        panel.legend(fontsize=8, frameon=False)
    panels[0].set_xlim(left=0)
    panels[0].set_ylabel("heat flux, % off the default (walls)")
    return figure


if __name__ == "__main__":
    tyro.cli(main)
