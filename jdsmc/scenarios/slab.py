"""Gases in a slab: what a scene needs to say when particles have places across it."""

from abc import abstractmethod
from dataclasses import replace
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax

from .. import random
from ..collisions.bound import next_bound
from ..collisions.in_cells import collide_in_layers
from ..collisions.meet import Collisions
from ..collisions.trios import LARGEST_PROBABILITY
from ..measure.distributions import bin_centres, densities
from ..motion.cells import layer_of
from ..types import Key, Layer, Positions, Scalar, Velocities
from .base import AbstractScene, Record
from .options import Options

CROWDED = 10
"""Fewer particles in a layer differ by factors from layer to layer: see `trios.groups_in`."""


class SlabState(eqx.Module):
    """Positions across the slab (λ0), velocities (v0), and the largest probability per time.

    `crowding` is the largest collision probability of a candidate pair over the step, met lately:
    what the density, the temperature and the speed of the fastest pair make of it.
    """

    position: Positions
    velocity: Velocities
    crowding: Scalar

    def longest_step(self) -> Scalar:
        """The step in which no pair met lately collides with more than the allowed probability.

        Derivatives do not see it: it is numerics.
        """
        return LARGEST_PROBABILITY / lax.stop_gradient(self.crowding)


class SlabRecord(Record):
    """A record of a gas in a slab, and how many particles were not in the slab at its start."""

    outside: Scalar


def maxwellian_at(key: Key, temperature: Positions) -> Velocities:
    """Maxwellian velocities of particles at places of given temperatures (m v0²)."""
    shape, dtype = temperature.shape, temperature.dtype
    x, y = random.normal_pair(random.bits(random.fold_in(key, 0), shape), dtype)
    z, _ = random.normal_pair(random.bits(random.fold_in(key, 1), shape), dtype)
    thermal = jnp.sqrt(temperature)
    return thermal * x, thermal * y, thermal * z


def uniform(key: Key, count: int, dtype) -> Positions:
    """Uniform numbers in (0, 1)."""
    return random.unit_interval(random.bits(key, (count,))[0], dtype)


class AbstractSlab(AbstractScene):
    """A gas in a slab of `length` cut into `layers`, collisions taking place within these.

    A scene states how particles `move`, and what to `measure`. It may add to `collide`.
    """

    length: eqx.AbstractVar[Any]
    layers: eqx.AbstractVar[int]
    axis: eqx.AbstractClassVar[str]

    in_space: ClassVar[bool] = True

    @abstractmethod
    def move(self, key: Key, state: SlabState, duration: Scalar) -> SlabState:
        """Flight during `duration` (τ0)."""

    @abstractmethod
    def measure(self, state: SlabState) -> Any:
        """Sums over each layer (a module of arrays)."""

    @abstractmethod
    def wanted_step(self, moments: Any, options: Options) -> Scalar:
        """The time step (τ0) if no pair were too likely, from what was measured."""

    def advance(self, key: Key, state: SlabState, options: Options) -> tuple[SlabState, SlabRecord]:
        """One record: measure, choose the time step, then make `options.steps` of them."""
        outside = self.outside(state.position)
        moments = self.measure(state)
        wanted = self.wanted_step(moments, options)

        def one_step(state, count):
            duration = jnp.minimum(wanted, state.longest_step())
            state, tally = self.step(random.fold_in(key, count), state, duration, options)
            return state, (tally, duration)

        counts = jnp.arange(options.steps, dtype=jnp.uint32)
        state, (tally, durations) = lax.scan(one_step, state, counts)
        elapsed = jnp.sum(durations)
        return state, SlabRecord(moments, Collisions.over(tally), elapsed, outside)

    def step(
        self, key: Key, state: SlabState, duration: Scalar, options: Options
    ) -> tuple[SlabState, Collisions]:
        """Half a flight, collisions, half a flight ("strang"); or flight and collisions ("lie").

        Records fall between two steps, so that in the symmetric step stress is sampled halfway
        between two collision stages.
        """
        before, after = options.halves
        state = self.move(key, state, before * duration)
        velocity, tally, met = self.collide(
            key, self.layer(state.position), state.velocity, duration, options
        )
        state = replace(state, velocity=velocity, crowding=next_bound(state.crowding, met))
        if after:
            state = self.move(key, state, after * duration)
        return state, tally

    def outside(self, position: Positions) -> Scalar:
        """Number of particles that are not in the slab: `layer` takes them for those at its ends.

        NaN is nowhere.
        """
        inside = (position >= 0.0) & (position <= self.length)
        return jnp.sum((~inside).astype(position.dtype))

    def layer(self, position: Positions) -> Layer:
        """The layer of each particle."""
        return layer_of(position, self.length, self.layers)

    def collide(
        self, key: Key, layer: Layer, velocity: Velocities, duration: Scalar, options: Options
    ) -> tuple[Velocities, Collisions, Scalar]:
        """Collisions within the layers."""
        few = options.n_particles <= CROWDED * self.layers
        return collide_in_layers(key, self.gas, layer, self.layers, velocity, duration, crowded=few)

    def faults(self, record: SlabRecord) -> str:
        """Particles that left the slab."""
        lost = float(np.max(record.outside))
        if lost == 0:
            return ""
        return (
            f"Particles left the slab from 0 to {float(self.length):g} ({lost:.0f} of them); "
            "`move` must bring every one back."
        )

    def fit_options(self, options: Options) -> Options:
        """Raise ValueError for too few particles in a layer."""
        if options.n_particles < 2 * self.layers:
            raise ValueError(
                f"n_particles = {options.n_particles} leaves fewer than 2 particles for each of "
                f"{self.layers} layers; take more particles, or fewer layers."
            )
        return options

    def axes(self, options: Options) -> dict:
        """Centres of the layers."""
        centres = (np.arange(self.layers) + 0.5) / self.layers * float(self.length)
        facts = {"long_name": f"position {self.axis}", "units": "λ0"}
        own = {self.axis: (centres, facts)}
        return own | ({"velocity": bin_centres(True)} if self.sampled else {})

    def sample_densities(self, sample: dict) -> dict:
        """Probability densities over a thermal speed."""
        return densities(sample)
