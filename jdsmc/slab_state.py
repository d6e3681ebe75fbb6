"""What a gas in a slab carries from step to step."""

import equinox as eqx
import jax.numpy as jnp

from . import random
from .state import RAISE, RELAX
from .trios import LARGEST_PROBABILITY
from .types import Key, Positions, Scalar, Velocities


class SlabState(eqx.Module):
    """Positions across the slab (λ0), velocities (v0), and the largest probability per time.

    `crowding` is the largest collision probability of a candidate pair over the step, met lately:
    what the density, the temperature and the speed of the fastest pair make of it.
    """

    position: Positions
    velocity: Velocities
    crowding: Scalar

    def longest_step(self) -> Scalar:
        """The step in which no pair met lately collides with more than the allowed probability."""
        return LARGEST_PROBABILITY / self.crowding


def next_crowding(crowding: Scalar, met: Scalar) -> Scalar:
    """Raised above what was met in a step, or lowered a little of the way to it."""
    return jnp.where(met > crowding, RAISE * met, crowding + RELAX * (met - crowding))


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
