"""What to run: every simulation of the reproduction, in a tiny, a small and the full size."""

import json
import zlib
from dataclasses import asdict, dataclass, field, replace
from typing import Literal

import numpy as np
from jdsmc.options import TIME_STEP

from jdsmc import InelasticHardSpheres, Result, run
from jdsmc.scenarios import HeatFluxForce, HomogeneousCooling
from jdsmc.transport import navier_stokes

PAPER_FIELD = 0.025
"""ε* that the paper takes as linear for all quantities (section 4)."""

PAPER_STEP = 0.003
PAPER_PARTICLES, PAPER_REALIZATIONS = 200_000, 200
"""δt/τ, N and the number of realizations of the paper (section 4)."""

STUDY_RESTITUTION, STUDY_FIELD = 0.5, 0.1
"""Where time steps are compared: a large field, as errors of κ' go as 1/ε. What a step gets wrong
of the response depends on the field no more than the response itself does."""


@dataclass(frozen=True)
class Case:
    """One simulation, swept over restitution; `strength` holds ε* of the force or ε of the kick.

    Where steady values are asked for, it is made longer until there are some.
    """

    name: str
    scene: Literal["force", "cooling", "kicks"]
    restitution: tuple[float, ...]
    strength: tuple[float, ...] = ()
    scheme: Literal["exact", "paper"] = "exact"
    options: dict = field(default_factory=dict)
    steady: bool = True

    @property
    def module(self) -> str:
        """Source of the simulation in `jdsmc`."""
        names = {"force": "heat_flux_force", "cooling": "homogeneous_cooling"}
        return f"scenarios/{names[self.scene]}.py" if self.scene in names else "transport.py"

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        return json.dumps(asdict(self), sort_keys=True)

    def simulate(self) -> Result:
        """Run it, with a seed made from its name."""
        gas, strength = InelasticHardSpheres(np.array(self.restitution)), np.array(self.strength)
        options = {"seed": zlib.crc32(self.name.encode()), "progress": False, **self.options}
        if self.scene == "kicks":
            return navier_stokes(gas, kick=strength, **options)
        force = HeatFluxForce(gas, strength, self.scheme) if self.scene == "force" else None
        result = run(force or HomogeneousCooling(gas), **options)
        while self.steady and not result.is_steady:
            options["duration"] *= 1.5
            result = run(force or HomogeneousCooling(gas), **options)
        return result


@dataclass(frozen=True)
class Study:
    """Several equal simulations that differ in the seed: saved one by one, averaged together."""

    case: Case
    parts: int

    def cases(self) -> list[Case]:
        """The case of every part."""
        return [replace(self.case, name=f"{self.case.name}_{k}") for k in range(self.parts)]


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
        kick_options: sizes of a part of the kicks. They are followed for 10 τ0 only: beyond, the
            noise of κ grows faster than the extrapolated tail shrinks (`Coefficient.tail`).
    """

    name: str
    restitutions: tuple[float, ...]
    gas: dict
    duration: float
    fields: dict[float, int]
    transients: dict[tuple[float, float], int]
    steps: dict[tuple[Literal["exact", "paper"], float], int]
    numbers: tuple[int, ...]
    cooling: int
    kicks: dict[tuple[float, float], int]
    kick_options: dict


EIGHT = tuple(float(alpha) for alpha in np.round(np.arange(0.3, 1.05, 0.1), 1))
FIVE = (0.3, 0.5, 0.7, 0.9, 1.0)
"""The restitutions of Figs. 5 to 7."""

KICK, KICK_STEP = 0.2, 0.1
"""Defaults of `jdsmc.transport.navier_stokes`; the step is shortened to 0.079."""

TINY = Size(
    name="tiny",
    restitutions=FIVE,
    gas={"n_particles": 512, "n_realizations": 4},
    duration=40.0,
    fields={0.0125: 2, 0.025: 2, 0.05: 2, 0.1: 2},
    transients={(0.3, 0.025): 2, (0.3, 0.05): 2, (1.0, 0.025): 2},
    steps={("exact", 0.05): 1, ("exact", 0.025): 1, ("paper", 0.05): 1, ("paper", 0.025): 1},
    numbers=(),
    cooling=2,
    kicks={(0.2, 0.1): 1, (0.4, 0.1): 1},
    kick_options={"n_particles": 512, "n_realizations": 4, "n_kicks": 1, "duration": 5.0},
)
"""For the tests: every table and figure, numbers without meaning."""

SMALL = Size(
    name="small",
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
    kick_options={"n_particles": 10_000, "n_realizations": 16, "n_kicks": 1, "duration": 10.0},
)

FULL = Size(
    name="full",
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
    kick_options={"n_particles": 20_000, "n_realizations": 16, "n_kicks": 4, "duration": 10.0},
)

APPROACH = 25.0
"""Duration of the transients (τ0); the paper finds the steady state after about 10."""


def steady_name(strength: float) -> str:
    """Name of the study of the steady states at a field."""
    return f"force_{strength:g}"


def transient_name(restitution: float, strength: float) -> str:
    """Name of the study of an approach to the steady state."""
    return f"transient_{restitution:g}_{strength:g}"


def step_name(scheme: str, step: float) -> str:
    """Name of the study of a scheme at a time step."""
    return f"step_{scheme}_{step:g}"


def number_name(n_particles: int) -> str:
    """Name of the study of a particle number."""
    return f"number_{n_particles}"


def kick_name(kick: float, step: float) -> str:
    """Name of the study of the impulse response at a kick and a time step."""
    return f"kick_{kick:g}_dt{step:g}"


def studies(size: Size) -> dict[str, Study]:
    """Every study of a size by its name, the cheapest first."""
    long = {**size.gas, "duration": size.duration}
    found = [Study(Case("cooling", "cooling", size.restitutions, options=long), size.cooling)]
    for (kick, step), parts in size.kicks.items():
        options = {**size.kick_options, "time_step": step}
        name = kick_name(kick, step)
        found.append(Study(Case(name, "kicks", size.restitutions, (kick,), options=options), parts))
    for (alpha, strength), parts in size.transients.items():
        options = {**size.gas, "duration": APPROACH, "steps_per_record": 4}
        name = transient_name(alpha, strength)
        case = Case(name, "force", (alpha,), (strength,), options=options, steady=False)
        found.append(Study(case, parts))
    for (scheme, step), parts in size.steps.items():
        options = {**long, "time_step": step, "steps_per_record": max(1, round(0.8 / step))}
        name = step_name(scheme, step)
        case = Case(name, "force", (STUDY_RESTITUTION,), (STUDY_FIELD,), scheme, options)
        found.append(Study(case, parts))
    for number in size.numbers:
        realizations = size.gas["n_particles"] * size.gas["n_realizations"] // number
        options = {**long, "n_particles": number, "n_realizations": realizations}
        point = (STUDY_RESTITUTION,), (STUDY_FIELD,)
        found.append(Study(Case(number_name(number), "force", *point, options=options), 2))
    for strength, parts in size.fields.items():
        name = steady_name(strength)
        case = Case(name, "force", size.restitutions, (strength,), options=long)
        found.append(Study(case, parts))
    return {study.case.name: study for study in found}


DEFAULT_STEP = TIME_STEP
"""Time step of `jdsmc.run` by default, and of all runs here but the time-step study."""
