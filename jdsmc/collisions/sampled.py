"""Pairs of a homogeneous gas that are looked at and not collided."""

import jax.numpy as jnp
from jax import lax

from .. import random
from ..gases.scatter import elastic_outgoing
from ..types import Key, Pairs, Particles, Velocity

AFTER_STEPS = 0xFFFF_FFFF
"""Folded into the key of a record: no step of it has this number."""


def sampling_key(key: Key) -> Key:
    """A key of a record that none of its steps has."""
    return random.fold_in(key, AFTER_STEPS)


def pairs_per_particle(count: int) -> float:
    """Collisions per particle and time of `count` particles over the mean rate of a pair."""
    return (count - 1) / count / (2.0 * 2.0**0.5)


def random_pairs(key: Key, velocity: Velocity) -> Pairs:
    """Half of the rows, and as many others shifted by a random number of lanes."""
    rows, lanes = velocity[0].shape
    order = random.permutation(key, rows, stream=random.Stream.ROWS)
    shift = random.bits(key, (1,), stream=random.Stream.SHIFT)[0][0] % jnp.uint32(lanes)
    half = rows // 2
    left = tuple(v[order[:half]] for v in velocity)
    right = tuple(jnp.roll(v[order[half : 2 * half]], shift, axis=1) for v in velocity)
    return left, right


def with_images(pair: Pairs, images: tuple[tuple[int, ...], ...]) -> list[Pairs]:
    """The same pair with each image of the second velocity: signs of the components (of disks, the
    first two), under which the distribution is the same."""
    left, right = pair
    return [
        (left, tuple(sign * v for sign, v in zip(signs, right, strict=False))) for signs in images
    ]


def both_ways(relative: Particles, speed, first, second) -> tuple[Particles, Particles]:
    """Two outgoing relative velocities of the right distribution: opposite ones for spheres.

    For disks the impact parameters are opposite.
    """
    one = elastic_outgoing(relative, speed, first, second)
    if len(relative) == 2:
        return one, elastic_outgoing(relative, speed, 1.0 - first, second)
    return one, tuple(-e for e in one)


def random_outgoing(key: Key, relative: Particles, speed) -> tuple[Particles, Particles]:
    """`both_ways` of random directions."""
    words = random.bits(key, speed.shape, random.Stream.OWN)
    first, second, _ = lax.optimization_barrier(random.three_uniforms(words, speed.dtype))
    return both_ways(relative, speed, first, second)
