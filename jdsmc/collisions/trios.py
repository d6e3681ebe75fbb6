"""Candidate pairs inside layers, without sorting the particles.

Every layer with N particles owns T groups of three seats. Each particle takes one of the 3T seats
at random; of several that want the same seat one, chosen at random, gets it. The particles a, b, c
of a group make the pairs (a, b) of wave 1 and (b, c) of wave 2. All pairs of a layer are then
equally likely, no particle is in two pairs of a wave, and the expected number of pairs of a wave is

    E = T (1 - 2 (1 - 1/3T)^N + (1 - 2/3T)^N),

for any N from 2 on, so that a pair probability of (N (N-1)/2) x (rate x time of one pair) / E gives
the collision rate exactly. A scatter of N integers does it all: no sort, no search, and no cost set
by the fullest layer.

Second order in time needs hits per particle that follow Poisson's law to second order: with the
shares θ1, θ2 of the two waves, 2 s (θ1 + θ2) = κ and 2 s q θ1 θ2 = κ² (see `pairs`; s = E/N pairs
per particle, q the probability that the pair (b, c) has its a). Solved by θ = (1 ± r)/4s κ with
r² = 1 - 8 s/q, which needs few enough groups: T = 0.1366 N makes r vanish for large N, so that both
waves share the work and a particle may be hit κ = 0.45 times.
"""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int32

from .. import random
from ..types import Key, Layer, Profile

GROUPS_PER_PARTICLE = 0.1366
"""T/N for which 8 s = q as N becomes large: 3T/N (1 - exp(-N/3T)) = 3/8."""

COARSE = 65_536
"""Seats that 23 random bits tell apart well enough, in less time: they are alike to one in 128, and
pairs to their mean square (1e-5). A million in a layer would make a pair in 2000 too few."""

LARGEST_PROBABILITY = 0.8
"""A step is so short that the likeliest pair met so far collides with this probability."""


class Trios(NamedTuple):
    """Groups of three particles: the index of each, and which seats are taken.

    `seats`: (3, groups) particle indices, 0 where empty; `taken`: (3, groups);
    `layer`: the layer of each group, 0 where its middle seat is empty.
    """

    seats: Int32[Array, "3 groups"]
    taken: Bool[Array, "3 groups"]
    layer: Int32[Array, " groups"]


def most_groups(n_particles: int, n_layers: int) -> int:
    """Groups there can be in all layers together."""
    return int(GROUPS_PER_PARTICLE * n_particles) + n_layers


def groups_in(
    population: Int32[Array, " layers"], *, crowded: bool = False
) -> Int32[Array, " layers"]:
    """Groups of each layer: none for fewer than two particles, else at least one.

    `crowded` rounds up instead of down. Cells of a few particles differ in number by factors: their
    pairs then are less likely to collide with a probability above one (10 particles have two groups
    instead of one), at the price of a third of the double hits in the fullest.
    """
    number = population.astype(jnp.float32)
    rounded = jnp.ceil if crowded else jnp.floor
    wanted = rounded(GROUPS_PER_PARTICLE * number).astype(jnp.int32)
    return jnp.where(population >= 2, jnp.maximum(wanted, 1), 0)


def seat(key: Key, stream: int, layer: Layer, groups: Int32[Array, " layers"], most: int) -> Trios:
    """Give the particles their seats, with random numbers from a `stream` of the key."""
    (count,) = layer.shape
    index_bits = int(np.ceil(np.log2(count + 1)))
    first_group = jnp.cumsum(groups) - groups
    place, chance = random.bits(key, (count,), stream)
    width = 3 * groups[layer]
    wanted = _one_of(place, width, fine=3 * most > COARSE)
    # a particle alone in its layer has no seat to take: it goes past the end
    wanted = jnp.where(width > 0, 3 * first_group[layer] + wanted, 3 * most)
    lot = (chance >> index_bits) << index_bits | jnp.arange(1, count + 1, dtype=jnp.uint32)
    table = jnp.zeros(3 * most, jnp.uint32).at[wanted].max(lot, mode="drop")
    table = table.reshape(most, 3).T
    taken = table > 0
    number = (table & jnp.uint32(2**index_bits - 1)).astype(jnp.int32)
    seats = jnp.where(taken, number - 1, 0)
    return Trios(seats, taken, layer[seats[1]])


def _one_of(place, width, *, fine: bool):
    """A number from 0 to width - 1 for each word: all alike, to one in 128 if not `fine`."""
    if fine:
        return random.below(place, width.astype(jnp.uint32)).astype(jnp.int32)
    uniform = random.unit_interval(place, jnp.float32)
    return jnp.minimum((uniform * width.astype(jnp.float32)).astype(jnp.int32), width - 1)


def shares(
    population: Int32[Array, " layers"], groups: Int32[Array, " layers"], dtype
) -> tuple[Profile, Profile]:
    """What a pair of wave 1 and of wave 2 stands for: pairs of the layer per pair of the wave.

    Multiplied with the collision probability of one given pair of the layer during the step, it is
    the probability that the pair of the wave collides; their sum is N (N-1)/2 over E.
    """
    number = population.astype(dtype)
    trios = jnp.maximum(groups, 1).astype(dtype)
    empty = [_none_in(k, number, trios) for k in (1, 2, 3)]
    two = jnp.maximum(1.0 - 2.0 * empty[0] + empty[1], jnp.finfo(dtype).tiny)
    three = 1.0 - 3.0 * empty[0] + 3.0 * empty[1] - empty[2]
    expected = trios * two
    per_particle = expected / jnp.maximum(number, 1.0)
    with_first = jnp.maximum(three / two, jnp.finfo(dtype).tiny)
    root = jnp.sqrt(jnp.maximum(1.0 - 8.0 * per_particle / with_first, 0.0))
    total = jnp.where(groups > 0, 0.5 * number * (number - 1.0) / expected, 0.0)
    return 0.5 * (1.0 + root) * total, 0.5 * (1.0 - root) * total


def _none_in(seats: int, number: Float[Array, " layers"], trios: Float[Array, " layers"]):
    """Probability that all N particles avoid some seats: (1 - seats/3T)^N."""
    share = seats / (3.0 * trios)
    avoiding = jnp.log1p(-jnp.minimum(share, 0.99))
    return jnp.where(share < 0.99, jnp.exp(number * avoiding), 0.0)
