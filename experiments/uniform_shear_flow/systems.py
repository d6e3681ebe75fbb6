"""What to run: every simulation of the reproduction, in a small and in the full size."""

import json
from dataclasses import asdict, dataclass, field, replace

import numpy as np
from jdsmc.options import TIME_STEP

from jdsmc import ElasticHardSpheres, InelasticHardSpheres, Result, run
from jdsmc.scenarios import UniformShear

FAST, SLOW = 4.0, 0.1
"""The two shear rates a τ0 of the paper: viscous heating or cooling prevails at the start."""

MODULE = "scenarios/uniform_shear.py"
"""Source in `jdsmc` of every simulation here."""

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


@dataclass(frozen=True)
class Case:
    """One simulation: a gas, swept over restitution and shear rate, and the options of `run`."""

    name: str
    gas: str
    restitution: tuple[float, ...]
    shear_rate: tuple[float, ...]
    options: dict = field(default_factory=dict)

    def scene(self) -> UniformShear:
        """The scene of this case; both numbers are swept."""
        return UniformShear(
            gas=GASES[self.gas](np.array(self.restitution)), shear_rate=np.array(self.shear_rate)
        )

    @property
    def module(self) -> str:
        """Source of the simulation in `jdsmc`."""
        return MODULE

    def simulate(self) -> Result:
        """Run it."""
        return run(self.scene(), progress=False, **self.options)

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        return json.dumps(asdict(self), sort_keys=True)


@dataclass(frozen=True)
class Size:
    """How much to compute. The paper: N = 1e4 particles, one run, N_p = 2.5e4 pairs.

    `transients`: restitutions followed in time; `sweep`: restitutions of the steady states;
    `particles` x `realizations` of each; `rtol`, `budget`: of the steady states;
    `study_*`: the convergence study: particles altogether, collisions per particle, particle
    numbers, time steps; `independent`, `symmetry`: arguments of these checks.
    """

    name: str
    transients: tuple[float, ...]
    sweep: tuple[float, ...]
    particles: int
    realizations: int
    rtol: float
    budget: float
    study_particles: int
    study_collisions: float
    study_numbers: tuple[int, ...]
    study_steps: tuple[float, ...]
    independent: dict
    symmetry: dict


TEN = tuple(float(alpha) for alpha in np.round(np.arange(0.5, 0.96, 0.05), 2))

SMALL = Size(
    name="small",
    transients=(0.5, 0.7, 0.9),
    sweep=(0.5, 0.6, 0.7, 0.8, 0.9),
    particles=10_000,
    realizations=8,
    rtol=1.5e-3,
    budget=400.0,
    study_particles=80_000,
    study_collisions=140.0,
    study_numbers=(1_000, 20_000),
    study_steps=(0.1, 0.05, 0.025),
    independent={"n_particles": 10_000, "n_gases": 12, "step": 0.08},
    symmetry={"n_gases": 64, "n_samples": 8},
)

FULL = Size(
    name="full",
    transients=TEN,
    sweep=TEN,
    particles=20_000,
    realizations=16,
    rtol=3e-4,
    budget=2_000.0,
    study_particles=320_000,
    study_collisions=500.0,
    study_numbers=(1_000, 4_000, 20_000, 80_000),
    study_steps=(0.4, 0.2, 0.1, 0.05, 0.025),
    independent={"n_particles": 20_000, "n_gases": 48, "step": 0.05},
    symmetry={"n_gases": 256, "n_samples": 40},
)

LEAST_REALIZATIONS = 8
"""Error bars of the convergence study come from at least this many."""


SINGLE = 0.6
"""Share of `rtol` for a single point: a sweep goes on until its worst point is precise enough."""


def main_cases(size: Size) -> list[Case]:
    """Transients and steady states of both gases, and the paper's control simulations."""
    both = (FAST, SLOW)
    common = {"n_particles": size.particles, "n_realizations": size.realizations}
    follow = {**common, "collisions": 60.0, "steps_per_record": 2}
    steady = {**common, "rtol": size.rtol, "budget": size.budget}
    single = {**steady, "rtol": SINGLE * size.rtol}
    cases = [
        Case("transient_ihs", "ihs", size.transients, both, {**follow, "seed": 1}),
        Case("transient_ehs", "ehs", size.transients, both, {**follow, "seed": 2}),
        Case("steady_ihs", "ihs", size.sweep, both, {**steady, "seed": 3}),
        Case("steady_ehs", "ehs", size.sweep, both, {**steady, "seed": 4}),
        Case("steady_ehs_measured", "ehs_measured", (0.5,), (FAST,), {**single, "seed": 5}),
        Case(
            "steady_ehs_viscosity", "ehs_viscosity", size.transients, (FAST,), {**steady, "seed": 6}
        ),
    ]
    return cases


def study_cases(size: Size) -> list[Case]:
    """The convergence study: steady states for several time steps and particle numbers."""
    default_number, default_step = 20_000, TIME_STEP
    pairs = [(default_number, step) for step in size.study_steps]
    pairs += [(number, default_step) for number in size.study_numbers if number != default_number]
    cases = []
    for place, (number, step) in enumerate(pairs):
        for gas, restitution in (("ihs", (0.5, 0.9)), ("ehs", (0.5,))):
            options = {
                "n_particles": number,
                "n_realizations": max(LEAST_REALIZATIONS, size.study_particles // number),
                "time_step": step,
                "collisions": size.study_collisions,
                "seed": 100 + 2 * place + (gas == "ehs"),
            }
            name = f"convergence_{gas}_dt{step:g}_n{number}"
            cases.append(Case(name, gas, restitution, (FAST,), options))
    return cases


EVIDENCE = 6e-4
"""`rtol` of the runs that stand behind a disagreement: those are of 0.5% or more."""


def variations(case: Case, restitution: float, shear_rate: float) -> dict[str, Case]:
    """One point of a sweep again with 4 N, with half the time step, and with another seed."""
    particles, seed = case.options["n_particles"], case.options["seed"]
    step = case.options.get("time_step", TIME_STEP)
    changes = {
        "again": {"seed": seed + 1000},
        "4N": {"n_particles": 4 * particles, "seed": seed + 2000},
        "half step": {"time_step": step / 2, "seed": seed + 3000},
    }
    options = {**case.options, "rtol": max(SINGLE * case.options["rtol"], EVIDENCE)}
    return {
        label: replace(
            case,
            name=f"evidence_{case.gas}_{restitution:g}_{shear_rate:g}_{label.replace(' ', '_')}",
            restitution=(restitution,),
            shear_rate=(shear_rate,),
            options={**options, **change},
        )
        for label, change in changes.items()
    }
