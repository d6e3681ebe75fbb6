"""Hydrodynamic noise of a cooling gas of disks, by DSMC in cells with copies.

Costantini and Puglisi, "Hydrodynamic noise of a cooling gas", PRE 82, 011305 (2010), appendix: N·M
fictive particles stand for N real disks; cells hold few real ones.
"""

import math
import warnings
from dataclasses import replace
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
from jax import lax

from .. import check, random
from ..collisions.in_cells import collide_in_layers
from ..collisions.meet import Collisions
from ..fields import count
from ..gases import InelasticHardDisks
from ..motion.drive import held_at
from ..motion.plane import cell_of, fly, still, transverse_modes
from ..sums import mean
from ..types import Key, Positions, Velocities
from ..units import INITIAL_TEMPERATURE
from .disk_modes import (
    AbstractCoolingDisks,
    DiskMoments,
    DiskRecord,
    density_field,
    growth_rate_field,
)
from .options import Options
from .slab import uniform

FEWEST_IN_CELL = 4.0
"""Fictive particles of a cell below which recollisions heat the gas by more than a percent."""

WIDEST_CELL = 0.6
"""In λ0. Cells of Δx add 0.13 to 0.17 (Δx/λ0)² to the viscosity (elastic, N n σ² = 20)."""


class PlaneState(eqx.Module):
    """Positions (λ0) and scaled velocities (v0) of all fictive disks."""

    position: tuple[Positions, Positions]
    velocity: Velocities


class CoolingDisks(AbstractCoolingDisks):
    """A cooling gas of inelastic hard disks in a periodic square, in the stationary representation.

    Arguments:
        gas: `InelasticHardDisks`, restitution in [0.4, 1].
        density: n σ² of the real gas, in (0, 0.5]: with N it decides the side, √(8 N nσ²) λ0. The
            simulated gas is dilute.
        growth_rate: μ in 1/τ0; by default the one that holds the dilute gas at T0.
        copies: M, fictive particles for each real one. More copies give fewer recollisions, not
            more samples of the modes.
        real_per_cell: real disks of a cell, about: the number of cells is the nearest square.
    `n_particles` of a run counts real disks. A run refuses what is unstable.
    """

    command: ClassVar[str] = "cooling-disks"
    default_time_step: ClassVar[float] = 0.07
    default_steps: ClassVar[int] = 10

    gas: InelasticHardDisks
    density: Any = density_field()
    growth_rate: Any = growth_rate_field()
    copies: int = count("fictive particles for each real one", default=10)
    real_per_cell: float = eqx.field(
        default=0.5, static=True, metadata={"meaning": "real disks in a cell, about"}
    )

    def __check_init__(self):
        check.scalar("real_per_cell", self.real_per_cell, 1e-6, math.inf, high_included=False)

    def fit_options(self, options: Options) -> Options:
        """Raise ValueError for an unstable system; warn if cells hold few fictive particles."""
        self.check_stability(options.n_particles)
        check.size("n_particles times copies", options.n_particles * self.copies, 64)
        columns = self.columns(options)
        in_cell = options.n_particles * self.copies / columns**2
        if columns > 1 and in_cell < FEWEST_IN_CELL:
            warnings.warn(
                f"{in_cell:.2g} fictive particles a cell collide again and again with the same "
                "few: the gas becomes too hot (by 2% with 1 a cell at restitution 0.8, 10% with "
                f"0.4); take copies = {math.ceil(self.copies * FEWEST_IN_CELL / in_cell)}.",
                stacklevel=4,
            )
        width = self.side(options.n_particles) / columns
        if columns > 1 and width > WIDEST_CELL:
            warnings.warn(
                f"cells of {width:.2g} λ0 make the viscosity too large, by some "
                f"{0.15 * width**2:.0%}; for cells of 0.3 λ0 take real_per_cell = "
                f"{self.real_per_cell * (0.3 / width) ** 2:.2g}, and more copies in proportion.",
                stacklevel=4,
            )
        return options

    def columns(self, options: Options) -> int:
        """Cells along a side."""
        return max(1, round(math.sqrt(options.n_particles / self.real_per_cell)))

    def initial(self, key: Key, options: Options) -> PlaneState:
        """Uniform places, Gaussian velocities with mean zero and the exact temperature."""
        number = options.n_particles * self.copies
        side = self.side(options.n_particles)
        places = [
            side * uniform(random.fold_in(key, axis), number, options.dtype) for axis in (0, 1)
        ]
        draws = random.bits(random.fold_in(key, 2), (number,))
        velocity, _ = held_at(random.normal_pair(draws, options.dtype), INITIAL_TEMPERATURE)
        return PlaneState((places[0], places[1]), velocity)

    def advance(
        self, key: Key, state: PlaneState, options: Options
    ) -> tuple[PlaneState, DiskRecord]:
        """One record: remove the net momentum, sample, then make `options.steps` steps.

        A step is half a flight, collisions in cells, half a flight ("strang"), or flight and
        collisions ("lie"); the flights of two steps are made at once.
        """
        state = PlaneState(state.position, still(state.velocity))
        side = self.side(options.n_particles)
        moments = self.measure(state, side)
        before, after = options.halves
        flights = jnp.ones(options.steps, options.dtype).at[0].set(before) * options.time_step

        def step(state, inputs):
            number, duration = inputs
            state = self.move(state, side, duration)
            return self.collide(random.fold_in(key, number), state, side, options)

        counts = jnp.arange(options.steps, dtype=jnp.uint32)
        state, tally = lax.scan(step, state, (counts, flights))
        if after:
            rest = jnp.asarray(after * options.time_step, options.dtype)
            state = self.move(state, side, rest)
        number = options.n_particles * self.copies
        real = jnp.asarray([options.n_particles, number], options.dtype)
        elapsed = jnp.asarray(options.steps * options.time_step, options.dtype)
        return state, DiskRecord(moments, self.of_real(Collisions.over(tally)), elapsed, real)

    def collide(
        self, key: Key, state: PlaneState, side, options: Options
    ) -> tuple[PlaneState, Collisions]:
        """Collisions within the cells during a time step."""
        columns = self.columns(options)
        velocity, tally, _ = collide_in_layers(
            *(key, self.gas, cell_of(state.position, side, columns), columns**2),
            *(state.velocity, jnp.asarray(options.time_step, options.dtype)),
            crowded=True,
        )
        return PlaneState(state.position, velocity), tally

    def move(self, state: PlaneState, side, duration) -> PlaneState:
        """The exact flow between collisions: eqs. (14), (15)."""
        return PlaneState(*fly(state.position, state.velocity, self.growth_rate, side, duration))

    def measure(self, state: PlaneState, side) -> DiskMoments:
        """Modes and moments of one instant."""
        square = sum(v * v for v in state.velocity)
        return DiskMoments(
            transverse_modes(state.position, state.velocity, side),
            0.5 * mean(square),
            mean(square * square),
        )

    def of_real(self, tally: Collisions) -> Collisions:
        """Collisions for each real disk: one of M copies counts 1/M."""
        return replace(
            tally,
            accepted=tally.accepted / self.copies,
            energy_lost=tally.energy_lost / self.copies,
            excess=tally.excess / self.copies,
        )
