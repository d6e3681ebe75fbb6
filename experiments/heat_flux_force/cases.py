"""What to run: every simulation of the reproduction, in a tiny, a small and the full size."""

from dataclasses import dataclass
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

APPROACH = 25.0
"""Duration of the transients (τ0); the paper finds the steady state after about 10."""


@dataclass(frozen=True)
class Size:
    """How much to compute.

    Arguments:
        restitutions: of all steady states.
        gas: particles and realizations of one part of any force run.
        duration: of one part of the steady states (τ0); the approach takes 18 of it.
        fields: parts for each ε* of the steady states.
        transients: parts for each pair (α, ε*) of Figs. 1 and 2.
        steps: parts for each (scheme, time step) of the time-step study, of duration `duration`.
        numbers: particle numbers compared with that of `gas`, with as many particles in all.
        cooling: parts of the cooling states; kicks: parts for each (ε, time step).
        kick_options: sizes of a part of the kicks; followed: for how long (τ0). Beyond 10 the noise
            of κ grows faster than the extrapolated tail shrinks (`Coefficient.tail`).
    """

    restitutions: tuple[float, ...]
    gas: dict
    duration: float
    fields: dict[float, int]
    transients: dict[tuple[float, float], int]
    steps: dict[tuple[Scheme, float], int]
    numbers: tuple[int, ...]
    cooling: int
    kicks: dict[tuple[float, float], int]
    kick_options: dict
    followed: float = 10.0


EIGHT = tuple(float(alpha) for alpha in np.round(np.arange(0.3, 1.05, 0.1), 1))
FIVE = (0.3, 0.5, 0.7, 0.9, 1.0)
"""The restitutions of Figs. 5 to 7."""

KICK_STEP = 0.1
"""Default of `jdsmc.transport.navier_stokes`, which shortens it to 0.079."""

TINY = Size(
    restitutions=FIVE,
    gas={"n_particles": 512, "n_realizations": 8},
    duration=40.0,
    fields={0.0125: 2, 0.025: 2, 0.05: 2, 0.1: 2},
    transients={(0.3, 0.025): 2, (0.3, 0.05): 2, (1.0, 0.025): 2},
    steps={("exact", 0.05): 1, ("exact", 0.025): 1, ("paper", 0.05): 1, ("paper", 0.025): 1},
    numbers=(),
    cooling=2,
    kicks={(0.2, 0.1): 1, (0.4, 0.1): 1},
    kick_options={"n_particles": 512, "n_realizations": 8, "n_kicks": 1},
    followed=5.0,
)
"""For the tests: every table and figure, numbers without meaning."""

SMALL = Size(
    restitutions=FIVE,
    gas={"n_particles": 10_000, "n_realizations": 16},
    duration=80.0,
    fields={0.0125: 3, 0.025: 5, 0.05: 2, 0.07: 2, 0.1: 2},
    transients={(0.3, 0.025): 12, (0.3, 0.05): 6, (1.0, 0.025): 12},
    steps={("exact", 0.1): 2, ("exact", 0.05): 2, ("exact", 0.025): 2}
    | {("paper", 0.05): 2, ("paper", 0.025): 2},
    numbers=(500, 2_000),
    cooling=2,
    kicks={(0.2, 0.1): 3, (0.4, 0.1): 3, (0.2, 0.039): 1},
    kick_options={"n_particles": 10_000, "n_realizations": 16, "n_kicks": 1},
)

FULL = Size(
    restitutions=EIGHT,
    gas={"n_particles": 20_000, "n_realizations": 16},
    duration=160.0,
    fields={0.0125: 4, 0.025: 8, 0.05: 3, 0.07: 2, 0.1: 2},
    transients={(0.3, 0.025): 30, (0.3, 0.05): 15, (1.0, 0.025): 30},
    steps={("exact", 0.1): 16, ("exact", 0.05): 16, ("exact", 0.025): 16}
    | {("paper", 0.05): 4, ("paper", 0.025): 4, ("paper", 0.0125): 4},
    numbers=(500, 2_000),
    cooling=2,
    kicks={(0.2, 0.1): 6, (0.4, 0.1): 4, (0.2, 0.039): 2},
    kick_options={"n_particles": 20_000, "n_realizations": 16, "n_kicks": 4},
)

SIZES = {"tiny": TINY, "small": SMALL, "full": FULL}


def steady_name(strength: float) -> str:
    """Name of the steady states at a field."""
    return f"force_{strength:g}"


def transient_name(restitution: float, strength: float) -> str:
    """Name of an approach to the steady state."""
    return f"transient_{restitution:g}_{strength:g}"


def step_name(scheme: str, step: float) -> str:
    """Name of a scheme at a time step."""
    return f"step_{scheme}_{step:g}"


def number_name(n_particles: int) -> str:
    """Name of a particle number."""
    return f"number_{n_particles}"


def kick_name(kick: float, step: float) -> str:
    """Name of the impulse response at a kick and a time step."""
    return f"kick_{kick:g}_dt{step:g}"


def studies(size: Size) -> dict[str, list[Case]]:
    """Every study of a size by its name, the cheapest first: equal cases, saved one by one."""
    found: dict[str, list[Case]] = {}
    gas, long = _gas(size.restitutions), {**size.gas, "duration": size.duration}

    def add(name: str, scene, options: dict, parts: int, steady: bool = True) -> None:
        found[name] = Case(name, scene, options, steady).parts(parts)

    add("cooling", HomogeneousCooling(gas), long, size.cooling)
    for (kick, step), parts in size.kicks.items():
        options = {**size.kick_options, "time_step": step}
        add(kick_name(kick, step), NavierStokes(gas, kick, size.followed), options, parts)
    for (alpha, strength), parts in size.transients.items():
        options = {**size.gas, "duration": APPROACH, "steps_per_record": 4}
        scene = HeatFluxForce(_gas((alpha,)), strength)
        add(transient_name(alpha, strength), scene, options, parts, steady=False)
    for (scheme, step), parts in size.steps.items():
        options = {**long, "time_step": step, "steps_per_record": max(1, round(0.8 / step))}
        add(step_name(scheme, step), _studied(scheme), options, parts)
    for number in size.numbers:
        realizations = size.gas["n_particles"] * size.gas["n_realizations"] // number
        options = {**long, "n_particles": number, "n_realizations": realizations}
        add(number_name(number), _studied("exact"), options, 2)
    for strength, parts in size.fields.items():
        add(steady_name(strength), HeatFluxForce(gas, strength), long, parts)
    return found


def _gas(restitutions: tuple[float, ...]) -> InelasticHardSpheres:
    return InelasticHardSpheres(np.array(restitutions))


def _studied(scheme: Scheme) -> HeatFluxForce:
    return HeatFluxForce(_gas((STUDY_RESTITUTION,)), STUDY_FIELD, scheme)
