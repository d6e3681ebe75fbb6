"""Layers of equal width across a slab: which one a particle is in, and sums over each."""

import jax.numpy as jnp

from ..types import Layer, Positions, Profile, Scalar


def layer_of(position: Positions, length: Scalar, count: int) -> Layer:
    """The layer of each particle, 0 to count - 1.

    Positions lie in [0, length]; the last layer takes its upper edge too.
    """
    index = jnp.floor(position * (count / length)).astype(jnp.int32)
    return jnp.clip(index, 0, count - 1)


PART = 65_536
"""Particles that are added up one after the other: in float32 a sum of 65,000 squares rounds 1e-5
of them away, that of a million 4e-4, that of ten millions 2%."""


def totals(layer: Layer, values: Positions, count: int) -> Profile:
    """The sum of a value over the particles of each layer, part by part of them."""
    (number,) = layer.shape
    parts = -(-number // PART)
    if parts > 1:
        layer = layer + count * (jnp.arange(number, dtype=layer.dtype) // PART)
    sums = jnp.zeros(parts * count, values.dtype).at[layer].add(values, mode="promise_in_bounds")
    return jnp.sum(sums.reshape(parts, count), axis=0)


def populations(layer: Layer, count: int):
    """Number of particles in each layer (integers)."""
    return jnp.zeros(count, jnp.int32).at[layer].add(1, mode="promise_in_bounds")
