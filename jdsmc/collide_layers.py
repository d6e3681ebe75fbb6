"""The collision stage of a gas in space: pairs within layers."""

import jax.numpy as jnp

from .collide import Collisions, meet
from .gas import AbstractGas
from .layers import populations
from .trios import groups_in, most_groups, seat, shares
from .types import Key, Layer, Scalar, Velocities


def collide_in_layers(
    key: Key,
    gas: AbstractGas,
    layer: Layer,
    count: int,
    velocity: Velocities,
    duration: Scalar,
) -> tuple[Velocities, Collisions, Scalar]:
    """Collisions of the particles of each of `count` layers during `duration` (τ0), second order.

    N particles stand for a slab of mean density n̄ cut into equal layers, so a given pair of one
    layer collides at the rate g count/(√2 N) (λ0 = v0 = 1).

    Returns: velocities; the tally; and the largest probability of a pair per time, which bounds
    the next step (`trios.LARGEST_PROBABILITY`).
    """
    (n_particles,) = layer.shape
    dtype = velocity[0].dtype
    population = populations(layer, count)
    groups = groups_in(population)
    first, second = shares(population, groups, dtype)
    trios = seat(key, 0, layer, groups, most_groups(n_particles, count))
    a, b, c = (tuple(v[seats] for v in velocity) for seats in trios.seats)
    has = trios.taken
    pair_rate = duration * (count / (2.0**0.5 * n_particles))
    factor = jnp.where(has[0] & has[1], pair_rate * first[trios.layer], 0.0)
    a, b, tally, largest = meet(key, 1, gas, a, b, factor)
    factor = jnp.where(has[1] & has[2], pair_rate * second[trios.layer], 0.0)
    b, c, later, larger = meet(key, 2, gas, b, c, factor)
    # an empty seat is written past the end, that is nowhere
    places = jnp.where(has, trios.seats, n_particles).ravel()
    velocity = tuple(
        v.at[places].set(jnp.concatenate(new), mode="drop", unique_indices=True)
        for v, *new in zip(velocity, a, b, c, strict=True)
    )
    return velocity, tally.then(later), jnp.maximum(largest, larger) / duration
