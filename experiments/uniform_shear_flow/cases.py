"""What to run: every simulation of the reproduction, in a tiny, a small and the full size."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from jdsmc import ElasticHardSpheres, InelasticHardSpheres
from jdsmc.scenarios import ShearedSlab, UniformShear
from jdsmc.scenarios.options import TIME_STEP

from ..case import Case

FAST, SLOW = 4.0, 0.1
"""The two shear rates a τ0 of the paper: viscous heating or cooling prevails at the start."""

BOTH = ("ihs", "ehs")
GASES = {
    "ihs": lambda alpha: InelasticHardSpheres(restitution=alpha),
    "ehs": lambda alpha: ElasticHardSpheres(restitution=alpha),
    "ehs_measured": lambda alpha: ElasticHardSpheres(restitution=alpha, drag="measured"),
    "ehs_viscosity": lambda alpha: ElasticHardSpheres(restitution=alpha, rate_factor="viscosity"),
}
"""The paper's two gases and its two controls (end of section V B, and section VI)."""

LABELS = {
    "ihs": "IHS",
    "ehs": "EHS",
    "ehs_measured": "EHS, measured drag",
    "ehs_viscosity": "EHS, viscosity β",
}

SLAB_RESTITUTION, LENGTH, LAYERS = 0.9, 2.5, 50
"""α, L/λ0 and M of the paper's slab; its shear rate is a τ0 = 4."""

Start = Literal["equilibrium", "nonequilibrium"]
STARTS: dict[Start, str] = {"equilibrium": "(3.5)", "nonequilibrium": "(3.6)"}
"""The two initial states of section V A, and their equations."""

POINTS = (("ihs", 0.5), ("ehs", 0.5), ("ihs", 0.9))
"""Where numerics are studied, at a τ0 = 4."""


@dataclass(frozen=True)
class Size:
    """How much to compute. The paper: N = 1e4 particles, one run, N_p = 2.5e4 pairs.

    `transients`: restitutions followed in time; `sweep`: restitutions of the steady states;
    `gas`: particles and realizations of each; `rtol`, `budget`: of the steady states; `slab_early`,
    `slab_late`: of the profiles until t = 2.3, and of the approach to the steady state, followed
    for `slab_collisions`, and if `halved` also with half the step (the paper: N = 1e4, three
    realizations); `study_*`: the convergence study: particles altogether, collisions per particle,
    particle numbers (the first is that of the steps), time steps; `independent`, `symmetry`:
    arguments of these checks.
    """

    transients: tuple[float, ...]
    sweep: tuple[float, ...]
    gas: dict
    rtol: float
    budget: float
    slab_early: dict
    slab_late: dict
    slab_collisions: float
    halved: bool
    study_particles: int
    study_collisions: float
    study_numbers: tuple[int, ...]
    study_steps: tuple[float, ...]
    independent: dict
    symmetry: dict


def _gas(n_particles: int, n_realizations: int) -> dict:
    return {"n_particles": n_particles, "n_realizations": n_realizations}


TEN = tuple(float(alpha) for alpha in np.round(np.arange(0.5, 0.96, 0.05), 2))

SIZES = {
    "tiny": Size(
        transients=(0.5, 0.7, 0.9),
        sweep=(0.5, 0.7, 0.9),
        gas=_gas(256, 8),
        rtol=0.5,
        budget=1_000.0,
        slab_early=_gas(500, 8),
        slab_late=_gas(500, 8),
        slab_collisions=140.0,
        halved=False,
        study_particles=2_048,
        study_collisions=140.0,
        study_numbers=(256, 128),
        study_steps=(0.1, TIME_STEP),
        independent={"n_particles": 256, "n_gases": 2, "step": 0.08},
        symmetry={"n_gases": 8, "n_samples": 2},
    ),
    "small": Size(
        transients=(0.5, 0.7, 0.9),
        sweep=(0.5, 0.6, 0.7, 0.8, 0.9),
        gas=_gas(10_000, 8),
        rtol=1.5e-3,
        budget=400.0,
        slab_early=_gas(10_000, 16),
        slab_late=_gas(5_000, 8),
        slab_collisions=140.0,
        halved=False,
        study_particles=80_000,
        study_collisions=140.0,
        study_numbers=(20_000, 1_000),
        study_steps=(0.1, TIME_STEP, 0.025),
        independent={"n_particles": 10_000, "n_gases": 12, "step": 0.08},
        symmetry={"n_gases": 64, "n_samples": 8},
    ),
    "full": Size(
        transients=TEN,
        sweep=TEN,
        gas=_gas(20_000, 16),
        rtol=3e-4,
        budget=2_000.0,
        slab_early=_gas(40_000, 32),
        slab_late=_gas(20_000, 16),
        slab_collisions=400.0,
        halved=True,
        study_particles=320_000,
        study_collisions=500.0,
        study_numbers=(20_000, 1_000, 4_000, 80_000),
        study_steps=(0.4, 0.2, 0.1, TIME_STEP, 0.025),
        independent={"n_particles": 20_000, "n_gases": 48, "step": 0.05},
        symmetry={"n_gases": 256, "n_samples": 40},
    ),
}

LEAST_REALIZATIONS = 8
"""Error bars of the convergence study come from at least this many."""

SINGLE = 0.6
"""Share of `rtol` for a single point: a sweep goes on until its worst point is precise enough."""

EVIDENCE = 6e-4
"""`rtol` of the runs that stand behind a disagreement: those are of 0.5% or more."""


def scene(gas: str, restitution, shear_rate) -> UniformShear:
    """A homogeneous gas, swept over both numbers."""
    return UniformShear(GASES[gas](np.array(restitution)), np.array(shear_rate))


def cases(size: Size) -> list[Case]:
    """Every simulation of a size; those behind a disagreement come when there is one."""
    both, follow = (FAST, SLOW), {**size.gas, "collisions": 60.0, "steps_per_record": 2}
    steady = {**size.gas, "rtol": size.rtol, "budget": size.budget}
    single = steady | {"rtol": SINGLE * size.rtol}
    found = [
        Case(f"transient_{gas}", scene(gas, size.transients, both), follow, steady=False)
        for gas in BOTH
    ]
    found += [Case(f"steady_{gas}", scene(gas, size.sweep, both), steady) for gas in BOTH]
    measured = scene("ehs_measured", (0.5,), (FAST,))
    viscosity = scene("ehs_viscosity", size.transients, (FAST,))
    found += [Case("steady_ehs_measured", measured, single)]
    found += [Case("steady_ehs_viscosity", viscosity, steady)]
    return [*found, *slab_cases(size), *study_cases(size)]


def slab_cases(size: Size) -> list[Case]:
    """Profiles of both gases from both states, and their approach to the steady state."""
    early = {**size.slab_early, "duration": 2.6, "steps_per_record": 2}
    late = {**size.slab_late, "collisions": size.slab_collisions, "steps_per_record": 4}
    found = []

    def add(stage: str, gas: str, start: Start, options: dict, steady: bool) -> None:
        slab = ShearedSlab(GASES[gas](SLAB_RESTITUTION), FAST, LENGTH, start, LAYERS)
        found.append(Case(f"slab_{stage}_{gas}_{start}", slab, options, steady))

    for start in STARTS:
        for gas in BOTH:
            add("early", gas, start, early, False)
    for gas in BOTH:
        add("late", gas, "equilibrium", late, True)
    add("late", "ihs", "nonequilibrium", late | {"collisions": 60.0}, False)
    if size.halved:
        add("half_step", "ihs", "equilibrium", late | {"time_step": TIME_STEP / 2}, True)
    return found


def study_cases(size: Size) -> list[Case]:
    """The convergence study: steady states for several time steps and particle numbers."""
    usual, *others = size.study_numbers
    pairs = [(usual, step) for step in size.study_steps] + [(n, TIME_STEP) for n in others]
    found = []
    for number, step in pairs:
        realizations = max(LEAST_REALIZATIONS, size.study_particles // number)
        options = {**_gas(number, realizations), "time_step": step}
        options["collisions"] = size.study_collisions
        for gas, restitution in (("ihs", (0.5, 0.9)), ("ehs", (0.5,))):
            name = f"convergence_{gas}_dt{step:g}_n{number}"
            found.append(Case(name, scene(gas, restitution, (FAST,)), options))
    return found


def variation(case: Case, gas: str, restitution: float, shear_rate: float, label: str) -> Case:
    """One point of a sweep again: "another seed", with "4 N", or with half the time step, "dt/2"."""
    options = {**case.options, "rtol": max(SINGLE * case.options["rtol"], EVIDENCE)}
    if label == "4 N":
        options["n_particles"] *= 4
    if label == "dt/2":
        options["time_step"] = TIME_STEP / 2
    name = f"evidence_{gas}_{restitution:g}_{shear_rate:g}_{label.translate({32: 95, 47: 95})}"
    return replace(
        case, name=name, scene=scene(gas, (restitution,), (shear_rate,)), options=options
    )
