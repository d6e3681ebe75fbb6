"""Initial states of a sheared slab: places across it, and velocities at each place.

Astillero and Santos (2005), section III. Their y runs from -L/2 to L/2, ours from 0 to L. Planes,
collisions and drag keep Σ(v_x - a y) as long as Σ v_y = 0: from rest the gas ends in uniform shear
with u_x = 0 in the middle; from eq. (3.6), whose centre of mass is at L/4π from it, with -aL/4π.
"""

import jax.numpy as jnp
from jax import lax

from .. import random
from ..types import Key, Positions, Scalar, Velocities
from ..units import INITIAL_TEMPERATURE

UNIFORM = ("local_equilibrium", "steady")
STATES = ("equilibrium", "nonequilibrium", *UNIFORM)
"""Eq. (3.5): Maxwellian at rest. Eq. (3.6): all peculiar speeds equal, density a sine, flow an
arch. Eq. (3.12): Maxwellian about the linear profile, which stresses and a temperature of the
kinetic model make "steady"."""

NEWTON = 8
"""Steps of Newton's method from y = u: each squares an error that is at most 1/2π at first."""


def places(state: str, chance: Positions) -> Positions:
    """Places y/L with the density of the state, from uniform numbers in (0, 1).

    Eq. (3.7) is n/n̄ = 1 - sin(2π y/L)/2 with y from 0 to L, which is integrated and inverted.
    """
    if state != "nonequilibrium":
        return chance
    turn = 2.0 * jnp.pi

    def closer(_, y):
        excess = y - (1.0 - jnp.cos(turn * y)) / (2.0 * turn) - chance
        return y - excess / (1.0 - 0.5 * jnp.sin(turn * y))

    return jnp.clip(lax.fori_loop(0, NEWTON, closer, chance), 0.0, 1.0)


def flow(state: str, place: Positions, difference: Scalar) -> Positions:
    """u_x (v0) at places y/L, eqs. (3.8), (3.12); `difference`: U = aL, between the planes."""
    if state == "nonequilibrium":
        return difference * (jnp.sin(jnp.pi * place) - 2.0 / jnp.pi)
    if state in UNIFORM:
        return difference * (place - 0.5)
    return jnp.zeros_like(place)


def peculiar(state: str, key: Key, count: int, dtype) -> Velocities:
    """Peculiar velocities, shifted and scaled to mean zero and the exact temperature T0."""
    x, y = random.normal_pair(random.bits(random.fold_in(key, 0), (count,)), dtype)
    z, _ = random.normal_pair(random.bits(random.fold_in(key, 1), (count,)), dtype)
    velocity = (x, y, z)
    if state == "nonequilibrium":
        speed = jnp.sqrt(sum(v * v for v in velocity))
        velocity = tuple(v / speed for v in velocity)
    velocity = tuple(v - jnp.mean(v) for v in velocity)
    square = sum(jnp.mean(v * v) for v in velocity)
    return tuple(v * jnp.sqrt(3.0 * INITIAL_TEMPERATURE / square) for v in velocity)
