"""`python -m experiments.conduction_limits.convergence [--full]`: step, layers, particles.

Heat flux of the Fourier flow at T_- = 0.2 T_+, L = 10, Maxwell walls, without gravity; sampled in
the gas, and from the energy that the walls exchange, which no sampling can bias. Known laws, with
the local mean free path and speed: κ (1 + (32/225π)(Δz/λ)²) (Alexander, Garcia and Alder 1998) and
κ (1 + (64/675π)(v0 dt/λ)²) (Hadjiconstantinou 2000). T^{3/2} being a straight line, the flux
changes by their average over the slab.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from jdsmc import Estimate, InelasticHardSpheres
from jdsmc.scenarios import FourierFlow

from ..case import Case, Measurements
from ..markdown import grid
from ..numbers import over_parts, stack
from ..paper import Paper
from .coefficients import discretization

COLD, LENGTH = 0.2, 10.0
STEPS = 8
"""Time steps between two samples."""

BOUND = 0.3
"""Percent of the heat flux that the defaults may be off."""

SHIFT = 4e-4
"""Of time steps, so that error bars do not cover each other."""


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


class Fluxes(Measurements):
    """The heat flux of every setting, off that of the walls at the defaults.

    `setting`, `walls`, `sampled` (%), `step` really taken, `law` (relative): lists over `SETTINGS`.
    """

    def __init__(self, size, folder: Path, fresh: bool):
        cases = []
        for number, s in enumerate(SETTINGS):
            slab = {"cold_temperature": COLD, "length": LENGTH, "layers": s.layers}
            scene = FourierFlow(gas=InelasticHardSpheres(1.0), **slab)
            particles = min(s.particles, size.study_particles // 8)
            options = {"n_particles": particles, "time_step": s.time_step}
            options |= {"n_realizations": size.study_particles // particles}
            options |= {"splitting": s.splitting, "steps_per_record": STEPS}
            options["duration"] = size.study_time
            cases.append(Case(f"convergence_{number:02}", scene, options))
        super().__init__(size, cases, folder, fresh)
        self.fluxes = [_fluxes(result) for result in self.results.values()]
        self.step, self.law = [], []
        for result in self.results.values():
            records = np.diff(result.series["time"].values)[1:]
            self.step.append(float(np.mean(records)) / (STEPS * FourierFlow.samples_per_record))
            state = result.steady["density"].values, result.steady["temperature"].values
            width = LENGTH / len(state[0])
            self.law.append(float(np.mean(discretization(*state, width, self.step[-1]))))

    def off(self, which: int) -> list[Estimate]:
        """Percent off the default; `which`: 0 from the walls, 1 sampled. Its error is left out."""
        start = float(self.fluxes[0][0])
        return [100.0 * (found[which] / start - 1.0) for found in self.fluxes]

    def of(self, study: str, splitting: str = "strang") -> np.ndarray:
        """Numbers of the settings of a study, the defaults among them."""
        wanted = ("defaults", study)
        chosen = [s.study in wanted and s.splitting == splitting for s in SETTINGS]
        return np.flatnonzero(chosen)


def _fluxes(result) -> tuple[Estimate, Estimate]:
    """From the walls, and sampled."""
    data = result.to_xarray()["realizations"].to_dataset()
    walls = 0.5 * (data["heat_flux_cold_wall"] + data["heat_flux_hot_wall"]).values
    return over_parts(walls), over_parts(data["mean_heat_flux"].values)


PAPER = Paper("conduction_limits.convergence", Fluxes, "convergence")


def at_the_defaults(data: Fluxes) -> str:
    """The fluxes behind all percentages."""
    walls, sampled = data.fluxes[0]
    return f"{walls} from the walls, {sampled} sampled; law: {100 * data.law[0]:+.3f}%"


def settings(data: Fluxes) -> list[str]:
    """What every setting gives."""
    columns = SETTINGS, data.step, data.off(0), data.off(1), data.law
    rows = [
        [
            *(s.study, s.splitting, f"{s.time_step:g}", f"{step:.4f}", s.layers, s.particles),
            *(walls, sampled, f"{100 * law:.3f}"),
        ]
        for s, step, walls, sampled, law in zip(*columns, strict=True)
    ]
    header = ["study", "splitting", "dt asked", "dt taken", "layers", "N"]
    return grid([*header, "walls", "sampled", "law"], rows)


@PAPER.figure("convergence", 1, 3, 11, 3.6)
def draw(data: Fluxes, axes) -> None:
    """Three panels: against dt, layer width, and particles per layer."""
    panels = axes[0]
    _against_time_step(panels[0], data)
    for panel, study, x in (
        (panels[1], "layers", [LENGTH / s.layers for s in SETTINGS]),
        (panels[2], "particles", [s.particles / s.layers for s in SETTINGS]),
    ):
        chosen = data.of(study)
        look = {"fmt": "s", "mfc": "none", "label": "walls", "capsize": 2, "ms": 5}
        panel.errorbar(np.array(x)[chosen], *_chosen(data, 0, chosen), **look)
    chosen = data.of("layers")
    chosen = chosen[np.argsort([-SETTINGS[k].layers for k in chosen])]
    width = [LENGTH / SETTINGS[k].layers for k in chosen]
    law = 100 * (np.array(data.law)[chosen] - data.law[0])
    panels[1].plot(width, law, "k-", lw=1, label="(32/225π)⟨(Δz/λ)²⟩")
    panels[2].set_xscale("log")
    for panel, label in zip(panels, ("dt/τ0", "Δz/λ0", "particles per layer"), strict=True):
        panel.axhspan(-BOUND, BOUND, color="0.9", zorder=0)
        panel.axhline(0, color="0.6", lw=0.8)
        panel.set_xlabel(label)
        panel.legend(fontsize=8, frameon=False)
    panels[0].set_ylabel("heat flux, % off the default (walls)")


def _chosen(data: Fluxes, which: int, chosen) -> Estimate:
    off = data.off(which)
    return stack(off[k] for k in chosen)


def _against_time_step(panel, data: Fluxes) -> None:
    """Both splittings; a line through what first order leaves in the sampled heat flux."""
    step, off = np.array(data.step), Estimate(0.0, 0.0)
    for splitting, colours, side in (("strang", ("C0", "C2"), -1), ("lie", ("C1", "C3"), 1)):
        chosen = data.of("time step", splitting)
        for which, name in enumerate(("walls", "sampled")):
            look = {"fmt": "so"[which], "color": colours[which], "capsize": 2, "ms": 5}
            look |= {"label": f"{splitting.title()}, {name}"}
            look |= {"mfc": None if splitting == "strang" else "none"}
            off = _chosen(data, which, chosen)
            panel.errorbar(step[chosen] + side * SHIFT, *off, **look)
    x = step[chosen]  # of the last: Lie, sampled
    slope = np.sum(x * off.value) / np.sum(x**2)
    panel.plot([0.0, x.max()], [0.0, slope * x.max()], "C3:", lw=1, label="first order")
    panel.set_xlim(left=0)


PAPER.tables |= {"at_the_defaults": at_the_defaults, "settings": settings}

if __name__ == "__main__":
    from ..__main__ import cli

    cli("conduction_limits.convergence")
