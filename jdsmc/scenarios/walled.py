"""A gas between two walls that give it energy and momentum: at rest, or moving along x."""

from abc import abstractmethod
from dataclasses import replace
from typing import Any, ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from .. import random
from ..collisions.bound import next_bound
from ..collisions.meet import Collisions
from ..fields import count, number
from ..measure.distributions import AT_WALLS, AtWalls, at_walls
from ..measure.observable import Observable
from ..motion.cells import populations, totals
from ..motion.flight import Exchange, fly
from ..motion.walls import Walls
from ..types import Key, Positions, Profile, Scalar, Velocities
from ..units import INITIAL_TEMPERATURE
from .options import Options
from .slab import AbstractSlab, SlabRecord, SlabState, maxwellian_at, uniform

FAST = 4.0
"""Speed (v0) that must not carry a particle across the slab in one step."""

FIRST_DENSITY, FIRST_SPEED = 5.0, 4.0
"""What the first step is made short for: probabilities per time of 5 times the rate at 4 v0, a
density of 3 and a fast pair."""


class Conduction(eqx.Module):
    """Sums over the particles of each layer at one instant, or their mean over several.

    `number`; `square`: Σ v²; `zz`: Σ v_z²; `flux`: Σ v² v_z/2; and over all of them `height`: Σ z.
    """

    number: Profile
    square: Profile
    zz: Profile
    flux: Profile
    height: Scalar


class WalledRecord(SlabRecord):
    """One record: sums averaged over its samples, collisions, its length, and wall exchange."""

    exchange: Exchange


class WalledState(SlabState):
    """A gas and its walls: they never change, but their tables take time to make.

    `exchange`: what the walls did since it was last reported.
    """

    walls: Walls
    exchange: Exchange


def conducting(
    key: Key, options: Options, cold_temperature: Scalar, length: Scalar
) -> tuple[Positions, Velocities]:
    """Local equilibrium with n ∝ 1/T and T^{3/2} linear between the walls: eq. (31) of Tahiri."""
    share = uniform(random.fold_in(key, 0), options.n_particles, options.dtype)
    # z(share) of that density, free of the cancellation at T_- = T_+
    excess = 1.0 / jnp.sqrt(cold_temperature) - 1.0
    rise = share * excess
    place = share * (3.0 + 3.0 * rise + rise**2) / (3.0 + 3.0 * excess + excess**2)
    temperature = cold_temperature * (1.0 + rise) ** 2
    return place * length, maxwellian_at(random.fold_in(key, 1), INITIAL_TEMPERATURE * temperature)


def distance_of_walls() -> Any:
    """The field of L."""
    return number(
        "distance L of the walls", "λ0", low=0.0, high=1000.0, low_included=False, default=10.0
    )


def layers_between_walls() -> Any:
    """The field of the number of layers; None until the scene is made."""
    return count("layers across the slab, as many as its gas needs if not said", default=None)


class AbstractWalled(AbstractSlab):
    """A gas between two walls, `gravity` pressing it to the lower one."""

    gravity: eqx.AbstractVar[Any]
    cold_temperature: eqx.AbstractVar[Any]

    sampled: ClassVar[tuple[Observable, ...]] = AT_WALLS
    samples_per_record: ClassVar[int] = 8
    measured_at: ClassVar[float] = 4.5 / 8.0  # samples come after the first to the last of 8 parts
    axis: ClassVar[str] = "z"

    @abstractmethod
    def walls(self) -> Walls:
        """The two walls."""

    @abstractmethod
    def motion(self) -> Any:
        """Velocity (v0) of the upper wall relative to the lower one."""

    @abstractmethod
    def same_walls(self, made: Walls) -> Walls:
        """The walls, which were made before: their tables need not be made again."""

    def default_particles(self) -> int:
        """Fifty in a layer, at least 5000 as in the paper.

        More would only spend their time on the way to the steady state: the heat flux is off by
        0.6% with ten in a layer, by less than 0.15% with fifty (experiments/conduction_limits).
        """
        return max(5_000, 50 * self.layers)

    def fit_options(self, options: Options) -> Options:
        """Raise ValueError for a step in which a particle of 4 v0 may cross the slab.

        Walls in motion send theirs off as much faster along x, not across; but where these collide
        what was along x is across, too.
        """
        longest = float(self.length) / (FAST + 0.5 * float(self.motion()))
        if options.time_step > longest:
            raise ValueError(
                f"time_step = {options.time_step:g} lets a particle cross the slab of length "
                f"{self.length:g} in one step; the allowed range is (0, {longest:.3g}]."
            )
        return super().fit_options(options)

    def advance(
        self, key: Key, state: WalledState, options: Options
    ) -> tuple[WalledState, WalledRecord]:
        """One record: samples, each after `options.steps` time steps."""

        def one_sample(state, number):
            return self.sample(random.fold_in(key, number), state, options)

        outside = self.outside(state.position)
        samples = jnp.arange(self.samples_per_record, dtype=jnp.uint32)
        start = replace(
            state, walls=self.same_walls(state.walls), exchange=Exchange.none(options.dtype)
        )
        state, (moments, tally, elapsed) = lax.scan(one_sample, start, samples)
        moments = jax.tree.map(lambda x: jnp.mean(x, axis=0), moments)
        tally, elapsed = Collisions.over(tally), jnp.sum(elapsed)
        return state, WalledRecord(moments, tally, elapsed, outside, state.exchange)

    def sample(self, key: Key, state: WalledState, options: Options):
        """Time steps, and what the layers hold after them.

        Strang: flights end half a step before and after the collisions, so a sample taken between
        two flights sees stress and heat flux halfway between two collision stages.
        """
        duration = self.wanted_step(state, options)
        before, after = options.halves
        flights = jnp.ones(options.steps, options.dtype).at[0].set(before)

        def step(state, inputs):
            number, share = inputs
            key_here = random.fold_in(key, number)
            state = self.move(key_here, state, share * duration)
            velocity, tally, met = self.collide(
                key_here, self.layer(state.position), state.velocity, duration, options
            )
            crowding = next_bound(state.crowding, met)
            return replace(state, velocity=velocity, crowding=crowding), tally

        counts = jnp.arange(options.steps, dtype=jnp.uint32)
        state, tally = lax.scan(step, state, (counts, flights))
        if after:
            state = self.move(random.fold_in(key, options.steps), state, after * duration)
        return state, (self.measure(state), Collisions.over(tally), options.steps * duration)

    def wanted_step(self, moments: WalledState, options: Options) -> Scalar:
        """The asked fraction of τ0, shorter where a pair would be too likely."""
        return jnp.minimum(options.time_step, moments.longest_step())

    def move(self, key: Key, state: WalledState, duration: Scalar) -> WalledState:
        """Free flight between the walls."""
        position, velocity, now = fly(
            *(key, state.walls, state.position, state.velocity),
            *(self.gravity, self.length, duration),
        )
        return replace(
            state, position=position, velocity=velocity, exchange=state.exchange.then(now)
        )

    def conduction(self, state: SlabState) -> Conduction:
        """Sums over each layer."""
        layer = self.layer(state.position)
        vx, vy, vz = state.velocity
        square = vx * vx + vy * vy + vz * vz
        return Conduction(
            populations(layer, self.layers).astype(vz.dtype),
            totals(layer, square, self.layers),
            totals(layer, vz * vz, self.layers),
            totals(layer, 0.5 * square * vz, self.layers),
            jnp.sum(state.position),
        )

    def finish_chunk(self, state: WalledState) -> tuple[WalledState, AtWalls]:
        """Sample velocities across the slab: c_z over the thermal speed of either wall, and of the
        temperature halfway where T^{3/2} is linear."""
        cold = self.cold_temperature
        thermal = jnp.sqrt(cold), jnp.cbrt(0.5 * (1.0 + cold**1.5)), 1.0
        layer = self.layer(state.position)
        return state, at_walls(layer, state.velocity[2], self.layers, thermal)

    def faults(self, record: WalledRecord) -> str:
        """Particles that bounce on without end, beside those outside."""
        lost = float(np.sum(record.exchange.lost))
        if lost == 0:
            return super().faults(record)
        return (
            f"{lost:.0f} particles hit a wall again and again within one step; reduce time_step, "
            "or gravity."
        )
