"""What to run: every simulation of the reproduction (`sizes.toml`)."""

from dataclasses import replace
from typing import Literal

import numpy as np

from jdsmc import ElasticHardSpheres, InelasticHardSpheres
from jdsmc.scenarios import ShearedSlab, UniformShear
from jdsmc.scenarios.options import TIME_STEP

from ..case import Case
from .symmetry import HalvedShear

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


LEAST_REALIZATIONS = 8
"""Error bars of the convergence study come from at least this many."""

SINGLE = 0.6
"""Share of `rtol` for a single point: a sweep goes on until its worst point is precise enough."""

EVIDENCE = 6e-4
"""`rtol` of the runs that stand behind a disagreement: those are of 0.5% or more."""


def scene(gas: str, restitution, shear_rate) -> UniformShear:
    """A homogeneous gas, swept over both numbers."""
    return UniformShear(GASES[gas](np.array(restitution)), np.array(shear_rate))


def cases(size) -> list[Case]:
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
    halved = HalvedShear(GASES["ihs"](0.5), FAST)
    found += [Case("symmetry", halved, size.symmetry)]
    return [*found, *slab_cases(size), *study_cases(size)]


def slab_cases(size) -> list[Case]:
    """Profiles of both gases from both states, and their approach to the steady state."""
    early = {**size.slab_early, "duration": 2.6, "steps_per_record": 2}
    late = {**size.slab_late, "collisions": size.slab_collisions, "steps_per_record": 4}
    found = []

    def add(stage: str, gas: str, start: Start, options: dict, steady: bool) -> None:
        size = {"length": LENGTH, "layers": LAYERS, "initial_state": start}
        slab = ShearedSlab(gas=GASES[gas](SLAB_RESTITUTION), shear_rate=FAST, **size)
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


def study_cases(size) -> list[Case]:
    """The convergence study: steady states for several time steps and particle numbers."""
    usual, *others = size.study_numbers
    pairs = [(usual, step) for step in size.study_steps] + [(n, TIME_STEP) for n in others]
    found = []
    for number, step in pairs:
        realizations = max(LEAST_REALIZATIONS, size.study_particles // number)
        options = {"n_particles": number, "n_realizations": realizations, "time_step": step}
        options["collisions"] = size.study_collisions
        for gas, restitution in (("ihs", (0.5, 0.9)), ("ehs", (0.5,))):
            name = f"convergence_{gas}_dt{step:g}_n{number}"
            found.append(Case(name, scene(gas, restitution, (FAST,)), options))
    return found


def variation(case: Case, gas: str, restitution: float, shear_rate: float, label: str) -> Case:
    """One point of a sweep with "another seed", with "4 N", or with half the step, "dt/2"."""
    options = {**case.options, "rtol": max(SINGLE * case.options["rtol"], EVIDENCE)}
    if label == "4 N":
        options["n_particles"] *= 4
    if label == "dt/2":
        options["time_step"] = TIME_STEP / 2
    name = f"evidence_{gas}_{restitution:g}_{shear_rate:g}_{label.translate({32: 95, 47: 95})}"
    return replace(
        case, name=name, scene=scene(gas, (restitution,), (shear_rate,)), options=options
    )
