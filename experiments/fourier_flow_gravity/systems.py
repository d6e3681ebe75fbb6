"""What to run: every simulation of the reproduction, in a tiny, a small and the full size."""

import json
import zlib
from dataclasses import asdict, dataclass, field
from typing import Literal, NamedTuple

import numpy as np
from jdsmc.options import TIME_STEP

from jdsmc import InelasticHardSpheres, MaxwellMolecules, Result, run
from jdsmc.scenarios import FourierFlow


class Combination(NamedTuple):
    """A cold temperature and a kind of walls: one of the paper's four sweeps over gravity."""

    cold: float
    wall: Literal["maxwell", "bgk"]

    @property
    def label(self) -> str:
        """As in the paper."""
        return f"T_- = {self.cold:g}, type {'I' if self.wall == 'maxwell' else 'II'}"

    @property
    def key(self) -> str:
        """For names of files and numbers."""
        return f"{self.cold:g} {self.wall}"


COMBINATIONS = tuple(
    Combination(cold, wall) for cold in (0.05, 0.01) for wall in ("maxwell", "bgk")
)
"""In the order of tables 2 to 5."""

EXAMPLE = Combination(0.05, "bgk")
"""The paper's reference example, Figs. 2 to 5."""

COLDEST = Combination(0.01, "bgk")
"""The densest gas at the cold wall."""

EXAMPLE_GRAVITY = (-0.016, -0.008, 0.0, 0.008, 0.012)
"""g of Figs. 2 to 5."""

FIGURE_6 = (-0.016, 0.012)
"""g of Fig. 6."""

BEYOND = Combination(0.01, "maxwell")
"""Fig. 6 has a state of it at g = 0.012, beyond the last row of table 4: no point has ε0 there."""

STUDY_GRAVITY = (-0.016, 0.0)
"""g of the error budget, at the paper's reference example."""

PAPER = {"n_particles": 5000, "layers": 100, "length": 10.0, "averaged": 1800.0, "step": 0.004}
"""Sizes of the paper (section 3): one run of 2000, the last 1800 averaged over 5000 snapshots."""


@dataclass(frozen=True)
class Case:
    """One simulation: a sweep over gravity. It is made longer until there are steady values."""

    name: str
    cold: float
    wall: Literal["maxwell", "bgk"]
    gravity: tuple[float, ...]
    gas: Literal["hard spheres", "Maxwell molecules"] = "hard spheres"
    length: float = 10.0
    layers: int = 100
    options: dict = field(default_factory=dict)
    module: str = "scenarios/fourier_flow.py"

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        return json.dumps(asdict(self), sort_keys=True)

    def simulate(self) -> Result:
        """Run it, with a seed made from its name."""
        gas = InelasticHardSpheres(1.0) if self.gas == "hard spheres" else MaxwellMolecules()
        gravity = np.array(self.gravity)
        scene = FourierFlow(gas, self.cold, gravity, self.length, self.wall, self.layers)
        seed = zlib.crc32(self.name.encode())
        options = {"seed": seed, "steps_per_record": 8, "progress": False, **self.options}
        result = run(scene, **options)
        while not result.is_steady:
            options["duration"] *= 1.5
            result = run(scene, **options)
        return result


@dataclass(frozen=True)
class Size:
    """How much to compute.

    Arguments:
        gravity: g of each combination, those of its table (and of its figures) or some of them.
        options: particles, realizations and duration (τ0) of all runs with hard spheres.
        variants: of the error budget, by name: what differs from these options, and layers.
        maxwell: lengths of the slab of Maxwell molecules, and options for each.
        per_length: layers per λ0; 10 in the paper.
        slower: duration of the sweeps at the lowest T_- over that of the others: there the steady
            state takes long to come about if gravity is strong.
    """

    name: str
    gravity: dict[Combination, tuple[float, ...]]
    options: dict
    variants: dict[str, dict]
    maxwell: dict[float, dict]
    per_length: int = 10
    slower: float = 1.5


TABLE_GRAVITY = (
    (-0.024, -0.02, -0.016, -0.012, -0.01, -0.008, -0.006, -0.004, 0.0, 0.003, 0.006, 0.008, 0.01),
    (-0.02, -0.016, -0.012, -0.01, -0.008, -0.006, -0.003, 0.0, 0.004, 0.008, 0.01, 0.012, 0.014),
    (-0.024, -0.02, -0.016, -0.014, -0.012, -0.008, -0.004, 0.0, 0.004, 0.006, 0.008, 0.01, 0.011),
    (-0.024, -0.02, -0.016, -0.012, -0.008, -0.004, 0.0, 0.004, 0.006, 0.008, 0.01, 0.011, 0.012),
)
"""g of tables 2 to 5; the second one has -0.008 of Figs. 2 to 5 besides."""

SOME_GRAVITY = (
    (-0.016, -0.008, 0.0, 0.006, 0.01),
    EXAMPLE_GRAVITY,
    (-0.016, -0.008, 0.0, 0.006),
    (-0.016, 0.0, 0.006, 0.012),
)

MAXWELL_COLD, MAXWELL_WALL = 0.2, "bgk"
MAXWELL_GRAVITY = {
    10.0: (-0.016, -0.008, 0.0, 0.008, 0.016),
    20.0: (-0.032, -0.016, 0.0, 0.008, 0.016),
}
"""Maxwell molecules, between walls of type II: g by the length of the slab.

ε, and with it the effect of gravity, falls as 1/L, so that g is larger in the longer slab; but not
towards the cold wall: with g = 0.032 the gas is still cooling after 1000 τ0.
"""

HALF_STEP = {"time_step": TIME_STEP / 2, "steps_per_record": 16}

TINY_OPTIONS = {"n_particles": 256, "n_realizations": 4, "duration": 150.0}
TINY_GRAVITY = {
    "maxwell": (-0.016, -0.008, 0.0, 0.006, 0.012),
    "bgk": EXAMPLE_GRAVITY,
}

TINY = Size(
    name="tiny",
    gravity={combination: TINY_GRAVITY[combination.wall] for combination in COMBINATIONS},
    options=TINY_OPTIONS,
    variants={},
    maxwell={10.0: TINY_OPTIONS},
    per_length=2,
    slower=1.0,
)
"""For the tests: every table and figure, numbers without meaning."""

SMALL = Size(
    name="small",
    gravity=dict(zip(COMBINATIONS, SOME_GRAVITY, strict=True)),
    options={"n_particles": 5000, "n_realizations": 8, "duration": 400.0},
    variants={
        "dt/2": HALF_STEP,
        "twice the layers": {"layers": 200},
        "N doubled": {"n_particles": 10_000},
    },
    maxwell={
        10.0: {"n_particles": 5000, "n_realizations": 8, "duration": 400.0},
        20.0: {"n_particles": 5000, "n_realizations": 8, "duration": 1_000.0},
    },
)

FULL = Size(
    name="full",
    gravity=dict(zip(COMBINATIONS, TABLE_GRAVITY, strict=True)),
    options={"n_particles": 5000, "n_realizations": 16, "duration": 450.0},
    variants=SMALL.variants,
    maxwell={
        10.0: {"n_particles": 5000, "n_realizations": 16, "duration": 600.0},
        20.0: {"n_particles": 10_000, "n_realizations": 16, "duration": 1_200.0},
    },
)


def sweep_name(combination: Combination) -> str:
    """Name of a sweep of tables 2 to 5."""
    return f"spheres_{combination.cold:g}_{combination.wall}"


BEYOND_NAME = f"{sweep_name(BEYOND)}_beyond"


def variant_name(variant: str) -> str:
    """Name of a sweep of the error budget."""
    return "budget_" + variant.replace("/", "_").replace(" ", "_")


def maxwell_name(length: float) -> str:
    """Name of a sweep with Maxwell molecules."""
    return f"molecules_{length:g}"


def lasting(size: Size, cold: float) -> dict:
    """Options of a sweep at T_-."""
    factor = size.slower if cold == BEYOND.cold else 1.0
    return {**size.options, "duration": factor * size.options["duration"]}


def cases(size: Size) -> dict[str, Case]:
    """Every simulation of a size by its name."""
    found, layers = [], 10 * size.per_length
    for combination, gravity in size.gravity.items():
        name = sweep_name(combination)
        cold, wall = combination
        options = lasting(size, cold)
        found.append(Case(name, cold, wall, gravity, layers=layers, options=options))
    if FIGURE_6[1] not in size.gravity[BEYOND]:
        cold, wall = BEYOND
        options = lasting(size, cold)
        found.append(Case(BEYOND_NAME, cold, wall, FIGURE_6[1:], layers=layers, options=options))
    for variant, changes in size.variants.items():
        options = {"layers": layers, **size.options, **changes}
        state = (variant_name(variant), EXAMPLE.cold, EXAMPLE.wall, STUDY_GRAVITY)
        found.append(Case(*state, layers=options.pop("layers"), options=options))
    for length, options in size.maxwell.items():
        layers = round(size.per_length * length)
        state = (MAXWELL_COLD, MAXWELL_WALL, MAXWELL_GRAVITY[length])
        more = {"gas": "Maxwell molecules", "length": length, "layers": layers}
        found.append(Case(maxwell_name(length), *state, **more, options=options))
    return {case.name: case for case in found}
