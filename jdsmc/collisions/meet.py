"""Disjoint pairs meet: accept candidates, scatter them, and count what went wrong."""

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from .. import random
from ..gases.base import AbstractGas, pair_rate
from ..gases.scatter import elastic_outgoing, root
from ..sums import total
from ..types import Key, Particles, Scalar


class Collisions(eqx.Module):
    """Sums over one collision stage; all add up over stages except `fastest`.

    `accepted`: collisions; `energy_lost`: kinetic energy removed by them (m v0²);
    `excess`: expected collisions missed because a pair was faster than the majorant;
    `overflow`: candidates missed because the waves had too few slots;
    `fastest`: largest rate of a candidate pair, its relative speed for hard spheres;
    `watched`: sums over the candidate pairs that a `Watch` asked for, None without one.
    """

    accepted: Scalar
    energy_lost: Scalar
    excess: Scalar
    overflow: Scalar
    fastest: Scalar
    watched: Any = None

    @staticmethod
    def over(stages: "Collisions") -> "Collisions":
        """Tally of consecutive stages stacked along the first axis."""
        total = jax.tree.map(lambda x: jnp.sum(x, axis=0), stages)
        return eqx.tree_at(lambda t: t.fastest, total, jnp.max(stages.fastest))

    def then(self, later: "Collisions") -> "Collisions":
        """Tally of this stage followed by another."""
        total = jax.tree.map(lambda a, b: a + b, self, later)
        fastest = jnp.maximum(self.fastest, later.fastest)
        return eqx.tree_at(lambda t: t.fastest, total, fastest)


class Candidates(eqx.Module):
    """What a watch sees: candidate pairs before their collisions, and what became of them.

    `left`, `right`: velocity components; `probability` of a collision; `accepted`; `outgoing`, the
    relative velocity after an elastic one; `transfer`, the momentum that the left one gave away
    (zero where there was no collision). Arrays of one shape.
    """

    left: Particles
    right: Particles
    probability: Any
    accepted: Any
    outgoing: Particles
    transfer: Particles


Watch = Callable[[Candidates], Any]
"""Maps the candidate pairs of a wave to a pytree of sums over them; waves and stages add up."""


def meet(
    key: Key,
    stream: int,
    gas: AbstractGas,
    left: Particles,
    right: Particles,
    factor,
    watch: Watch | None = None,
):
    """Disjoint pairs, each accepted with probability rate x factor (one number, or one a pair).

    Random numbers come from a `stream` of the key that nothing else in the step uses.
    Returns: the two sides after the collisions, their tally, and the largest probability.
    The barriers keep XLA from computing the random numbers and the transfer again for each
    component and each sum (2 to 3 times slower).
    """
    shape, dtype = left[0].shape, left[0].dtype
    uniforms = random.three_uniforms(
        lax.optimization_barrier(random.bits(key, shape, stream)), dtype
    )
    relative = tuple(a - b for a, b in zip(left, right, strict=True))
    speed = root(sum(g * g for g in relative))
    rate = pair_rate(gas, speed)
    probability = rate * factor
    accepted = uniforms[2] < probability
    outgoing = elastic_outgoing(relative, speed, uniforms[0], uniforms[1])
    transfer = tuple(jnp.where(accepted, t, 0.0) for t in gas.momentum_transfer(relative, outgoing))
    transfer, accepted, probability, rate = lax.optimization_barrier(
        (transfer, accepted, probability, rate)
    )
    lost = sum(t * (a - b - t) for t, a, b in zip(transfer, left, right, strict=True))
    met = Candidates(left, right, probability, accepted, outgoing, transfer)
    watched = None if watch is None else watch(met)
    tally = Collisions(
        total(accepted.astype(dtype)),
        total(lost),
        total(jnp.maximum(probability - 1.0, 0.0)),
        jnp.zeros((), dtype),
        jnp.max(rate),
        watched,
    )
    left = tuple(v - t for v, t in zip(left, transfer, strict=True))
    right = tuple(v + t for v, t in zip(right, transfer, strict=True))
    return left, right, tally, jnp.max(probability)
