"""The collision stage of a gas in space: pairs within layers."""

import jax.numpy as jnp

from ..gases.base import AbstractGas
from ..motion.cells import populations
from ..random import Stream
from ..types import Key, Layer, Scalar, Velocities
from .meet import Collisions, Watch, meet
from .trios import groups_in, most_groups, seat, shares


def collide_in_layers(
    key: Key,
    gas: AbstractGas,
    layer: Layer,
    count: int,
    velocity: Velocities,
    duration: Scalar,
    watch: Watch | None = None,
    *,
    crowded: bool = False,
) -> tuple[Velocities, Collisions, Scalar]:
    """Collisions of the particles of each of `count` layers during `duration` (τ0), second order.

    N particles stand for a volume of mean density n̄ cut into equal cells (layers of a slab, squares
    of a plane), so a given pair of one cell collides at the rate g count/(√2 N) (λ0 = v0 = 1).

    Returns: velocities; the tally; and the largest probability of a pair per time, which bounds
    the next step (`trios.LARGEST_PROBABILITY`).
    """
    (n_particles,) = layer.shape
    dtype = velocity[0].dtype
    population = populations(layer, count)
    groups = groups_in(population, crowded=crowded)
    first, second = shares(population, groups, dtype)
    trios = seat(key, Stream.SEATS, layer, groups, most_groups(n_particles, count))
    a, b, c = (tuple(v[seats] for v in velocity) for seats in trios.seats)
    has = trios.taken
    pair_rate = duration * (count / (2.0**0.5 * n_particles))
    factor = jnp.where(has[0] & has[1], pair_rate * first[trios.layer], 0.0)
    a, b, tally, largest = meet(key, Stream.FIRST_SEATS, gas, a, b, factor, watch)
    factor = jnp.where(has[1] & has[2], pair_rate * second[trios.layer], 0.0)
    b, c, later, larger = meet(key, Stream.SECOND_SEATS, gas, b, c, factor, watch)
    # an empty seat is written past the end, that is nowhere
    places = jnp.where(has, trios.seats, n_particles).ravel()
    velocity = tuple(
        v.at[places].set(jnp.concatenate(new), mode="drop", unique_indices=True)
        for v, *new in zip(velocity, a, b, c, strict=True)
    )
    return velocity, tally.then(later), jnp.maximum(largest, larger) / duration
