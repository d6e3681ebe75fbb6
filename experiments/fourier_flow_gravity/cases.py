"""What to run: every simulation of the reproduction, in a tiny, a small and the full size."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from jdsmc import InelasticHardSpheres, MaxwellMolecules
from jdsmc.scenarios import FourierFlow
from jdsmc.scenarios.options import TIME_STEP

from ..case import Case


class Combination(NamedTuple):
    """A cold temperature and a kind of walls: one of the paper's four sweeps over gravity."""

    cold: float
    wall: Literal["maxwell", "bgk"]

    @property
    def label(self) -> str:
        """As in the paper."""
        return f"T_- = {self.cold:g}, type {'I' if self.wall == 'maxwell' else 'II'}"


COMBINATIONS = tuple(
    Combination(cold, wall) for cold in (0.05, 0.01) for wall in ("maxwell", "bgk")
)
"""In the order of tables 2 to 5."""

EXAMPLE, BEYOND, COLDEST = COMBINATIONS[1:]
"""The paper's reference example, Figs. 2 to 5; the combination of which Fig. 6 has a state beyond
the last row of table 4 (no point has ε0 there); and the densest gas at the cold wall."""

EXAMPLE_GRAVITY = (-0.016, -0.008, 0.0, 0.008, 0.012)
"""g of Figs. 2 to 5."""

FIGURE_6 = (-0.016, 0.012)
"""g of Fig. 6."""

STUDY_GRAVITY = (-0.016, 0.0)
"""g of the error budget, at the paper's reference example."""

PAPER_WORK = 5000 * 1800.0
"""Particles times the time averaged over in the paper (section 3)."""

LENGTH = 10.0


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

    gravity: dict[Combination, tuple[float, ...]]
    options: dict
    variants: dict[str, dict]
    maxwell: dict[float, dict]
    per_length: int = 10
    slower: float = 1.5

    def lasting(self, cold: float) -> dict:
        """Options of a sweep at T_-."""
        factor = self.slower if cold == BEYOND.cold else 1.0
        return {**self.options, "duration": factor * self.options["duration"]}


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

TINY_OPTIONS = {"n_particles": 256, "n_realizations": 8, "duration": 150.0}
TINY_GRAVITY = {"maxwell": (-0.016, -0.008, 0.0, 0.006, 0.012), "bgk": EXAMPLE_GRAVITY}


def _many(n_particles: int, n_realizations: int, duration: float) -> dict:
    return {
        "n_particles": n_particles,
        "n_realizations": n_realizations,
        "duration": duration,
    }


SIZES = {
    "tiny": Size(
        gravity={combination: TINY_GRAVITY[combination.wall] for combination in COMBINATIONS},
        options=TINY_OPTIONS,
        variants={},
        maxwell={10.0: TINY_OPTIONS},
        per_length=2,
        slower=1.0,
    ),
    "small": Size(
        gravity=dict(zip(COMBINATIONS, SOME_GRAVITY, strict=True)),
        options=_many(5000, 8, 400.0),
        variants={
            "dt/2": {"time_step": TIME_STEP / 2, "steps_per_record": 16},
            "twice the layers": {"layers": 200},
            "N doubled": {"n_particles": 10_000},
        },
        maxwell={10.0: _many(5000, 8, 400.0), 20.0: _many(5000, 8, 1_000.0)},
    ),
}
SIZES["full"] = Size(
    gravity=dict(zip(COMBINATIONS, TABLE_GRAVITY, strict=True)),
    options=_many(5000, 16, 450.0),
    variants=SIZES["small"].variants,
    maxwell={10.0: _many(5000, 16, 600.0), 20.0: _many(10_000, 16, 1_200.0)},
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


def cases(size: Size) -> list[Case]:
    """Every simulation of a size."""
    found, layers, spheres = [], 10 * size.per_length, InelasticHardSpheres(1.0)

    def add(name, combination, gravity, options, gas=spheres, length=LENGTH, layers=layers):
        scene = FourierFlow(
            gas, combination.cold, np.array(gravity), length, combination.wall, layers
        )
        found.append(Case(name, scene, {"steps_per_record": 8, **options}))

    for combination, gravity in size.gravity.items():
        add(sweep_name(combination), combination, gravity, size.lasting(combination.cold))
    if FIGURE_6[1] not in size.gravity[BEYOND]:
        add(BEYOND_NAME, BEYOND, FIGURE_6[1:], size.lasting(BEYOND.cold))
    for variant, changes in size.variants.items():
        options = {**size.options, **changes}
        more = {"layers": options.pop("layers", layers)}
        add(variant_name(variant), EXAMPLE, STUDY_GRAVITY, options, **more)
    for length, options in size.maxwell.items():
        state = Combination(MAXWELL_COLD, MAXWELL_WALL), MAXWELL_GRAVITY[length], options
        more = {"length": length, "layers": round(size.per_length * length)}
        add(maxwell_name(length), *state, gas=MaxwellMolecules(), **more)
    return found
