"""Ways to bring the particles of a layer together, per particle and step, on one core.

`seats` is what the library does (`jdsmc.collisions.trios`): one scatter. The others order all
particles by layer, at random within a layer, as sequential DSMC codes do; pairs then follow from
the ranks. An order that is kept for several steps costs that much less, but partners are then up to
a flight of several steps farther apart, which the scatter never needs.
"""

import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from jdsmc import random
from jdsmc.collisions import trios

from .timing import say, seconds, summary

LAYERS = 100
CALLS = 16
"""Calls within one timing, in one compiled loop, so that dispatch does not count."""


def seats(key, layer):
    """Three seats a group, by one scatter of N integers."""
    (count,) = layer.shape
    population = jnp.zeros(LAYERS, jnp.int32).at[layer].add(1)
    groups = trios.groups_in(population)
    return trios.seat(key, 0, layer, groups, trios.most_groups(count, LAYERS)).seats


def packed_sort(key, layer):
    """One sort of words that hold layer, random bits and index: nothing else has to move."""
    (count,) = layer.shape
    layer_bits, index_bits = (int(np.ceil(np.log2(n))) for n in (LAYERS, count))
    chance, _ = random.bits(key, (count,))
    word = layer.astype(jnp.uint32) << (32 - layer_bits)
    word |= (chance >> (layer_bits + index_bits)) << index_bits
    ordered = jnp.sort(word | jnp.arange(count, dtype=jnp.uint32))
    return (ordered & jnp.uint32(2**index_bits - 1)).astype(jnp.int32)


def two_operand_sort(key, layer):
    """A sort of words of layer and random bits that carries the index along."""
    word, index = _words(key, layer), jnp.arange(len(layer), dtype=jnp.int32)
    return lax.sort((word, index), num_keys=1)[1]


def argsort(key, layer):
    """`jax.numpy.argsort` of the same words."""
    return jnp.argsort(_words(key, layer))


def _words(key, layer):
    layer_bits = int(np.ceil(np.log2(LAYERS)))
    chance, _ = random.bits(key, layer.shape)
    return layer.astype(jnp.uint32) << (32 - layer_bits) | chance >> layer_bits


WAYS = {way.__name__: way for way in (seats, packed_sort, two_operand_sort, argsort)}


def measure(way: str, n_particles: int, repeats: int) -> dict:
    """Nanoseconds per particle of one way."""
    find = WAYS[way]
    layer = jnp.asarray(np.random.default_rng(0).integers(0, LAYERS, n_particles))

    @jax.jit
    def many(layer):
        def once(total, count):
            key = random.fold_in(random.key_from_seed(1), count)
            return total + jnp.sum(find(key, layer)[..., ::7]), None

        return lax.scan(once, jnp.int32(0), jnp.arange(CALLS))[0]

    many(layer).block_until_ready()
    times = [seconds(lambda: many(layer).block_until_ready()) for _ in range(repeats)]
    say(f"{way}, N = {n_particles}: {1e9 * min(times) / (CALLS * n_particles):.1f} ns a particle")
    nanoseconds = summary(1e9 * np.array(times) / (CALLS * n_particles))
    return {"way": way, "n_particles": n_particles, "nanoseconds": nanoseconds}
