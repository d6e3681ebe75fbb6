"""What to run: every simulation of the reproduction (`sizes.toml`)."""

from typing import Literal

import numpy as np

from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import HeatFluxForce, HomogeneousCooling
from jdsmc.scenarios.navier_stokes import NavierStokes
from jdsmc.scenarios.options import TIME_STEP

from ..case import Case

Scheme = Literal["exact", "paper"]

PAPER_FIELD = 0.025
"""ε* that the paper takes as linear for all quantities (section 4)."""

PAPER_STEP, PAPER_PARTICLES, PAPER_REALIZATIONS = 0.003, 200_000, 200
"""δt/τ, N and the number of realizations of the paper (section 4)."""

STUDY_RESTITUTION, STUDY_FIELD = 0.5, 0.1
"""Where time steps are compared: a large field, as errors of κ' go as 1/ε. What a step gets wrong
of the response depends on the field no more than the response itself does."""

DEFAULT_STEP = TIME_STEP
"""Time step of `jdsmc.run` by default, and of all runs here but the time-step study."""

KICK_STEP = 0.1
"""Default of `jdsmc.transport.navier_stokes`, which shortens it to 0.079."""

APPROACH = 25.0
"""Duration of the transients (τ0); the paper finds the steady state after about 10."""


def studies(size) -> dict[str, list[Case]]:
    """Every study of a size by its name, the cheapest first: equal cases, saved one by one."""
    found: dict[str, list[Case]] = {}
    gas, long = _gas(size.restitutions), {**size.gas, "duration": size.duration}

    def add(name: str, scene, options: dict, parts: int, steady: bool = True) -> None:
        found[name] = Case(name, scene, options, steady).parts(parts)

    add("cooling", HomogeneousCooling(gas), long, size.cooling)
    for kick, step, parts in size.kicks:
        options = {**size.kick_options, "time_step": step}
        add(f"kick_{kick:g}_dt{step:g}", NavierStokes(gas, kick, size.followed), options, parts)
    for alpha, strength, parts in size.transients:
        options = {**size.gas, "duration": APPROACH, "steps_per_record": 4}
        scene = HeatFluxForce(_gas([alpha]), strength)
        add(f"transient_{alpha:g}_{strength:g}", scene, options, parts, steady=False)
    for scheme, step, parts in size.steps:
        options = {**long, "time_step": step, "steps_per_record": max(1, round(0.8 / step))}
        add(f"step_{scheme}_{step:g}", _studied(scheme), options, parts)
    for number in size.numbers:
        realizations = size.gas["n_particles"] * size.gas["n_realizations"] // number
        options = {**long, "n_particles": number, "n_realizations": realizations}
        add(f"number_{number}", _studied("exact"), options, 2)
    for strength, parts in size.fields:
        add(f"force_{strength:g}", HeatFluxForce(gas, strength), long, parts)
    return found


def _gas(restitutions) -> InelasticHardSpheres:
    return InelasticHardSpheres(np.array(restitutions))


def _studied(scheme: Scheme) -> HeatFluxForce:
    return HeatFluxForce(_gas([STUDY_RESTITUTION]), STUDY_FIELD, scheme)
