"""What to run: every simulation of the reproduction (`sizes.toml`)."""

from typing import Literal, NamedTuple

import numpy as np

from jdsmc import AbstractGas, InelasticHardSpheres, MaxwellMolecules
from jdsmc.scenarios import FourierFlow

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

MAXWELL_COLD, MAXWELL_WALL = 0.2, "bgk"
"""The slabs of Maxwell molecules, between walls of type II."""


def sweep_name(combination: Combination) -> str:
    """Name of a sweep of tables 2 to 5."""
    return f"spheres_{combination.cold:g}_{combination.wall}"


BEYOND_NAME = f"{sweep_name(BEYOND)}_beyond"


def sweeps(size) -> dict[Combination, tuple[float, ...]]:
    """g of every combination."""
    return {c: tuple(g) for c, g in zip(COMBINATIONS, size.gravity, strict=True)}


def cases(size) -> list[Case]:
    """Every simulation of a size."""
    found, spheres = [], InelasticHardSpheres(1.0)

    def add(name, combination, gravity, options, gas: AbstractGas = spheres, length=size.length):
        layers = options.pop("layers", round(size.per_length * length))
        scene = FourierFlow(
            gas=gas,
            cold_temperature=combination.cold,
            gravity=np.array(gravity),
            length=length,
            wall=combination.wall,
            layers=layers,
        )
        found.append(Case(name, scene, {"steps_per_record": 8, **options}))

    def lasting(combination):
        factor = size.slower if combination.cold == BEYOND.cold else 1.0
        return {**size.gas, "duration": factor * size.duration}

    for combination, gravity in sweeps(size).items():
        add(sweep_name(combination), combination, gravity, lasting(combination))
    if FIGURE_6[1] not in sweeps(size)[BEYOND]:
        add(BEYOND_NAME, BEYOND, FIGURE_6[1:], lasting(BEYOND))
    for variant, changes in size.variants.items():
        options = {**size.gas, "duration": size.duration, **changes}
        add(
            f"budget_{variant.replace('/', '_').replace(' ', '_')}", EXAMPLE, STUDY_GRAVITY, options
        )
    for length, gravity, *amount in size.maxwell:
        options = dict(zip(("n_particles", "n_realizations", "duration"), amount, strict=True))
        walls = Combination(MAXWELL_COLD, MAXWELL_WALL)
        add(f"molecules_{length:g}", walls, gravity, options, MaxwellMolecules(), length)
    return found
