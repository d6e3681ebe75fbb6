"""The collision stage: accept candidates, scatter them, and count what went wrong."""

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from . import random
from .gas import AbstractGas
from .pairs import PairPlan, put_rows, take_rows, thinning
from .scatter import elastic_outgoing
from .types import Key, Particles, Scalar, Velocity


class Collisions(eqx.Module):
    """Sums over one collision stage; all add up over stages except `fastest`.

    `accepted`: collisions; `energy_lost`: kinetic energy removed by them (m v0²);
    `excess`: expected collisions missed because a pair was faster than the majorant;
    `overflow`: candidates missed because the waves had too few slots;
    `fastest`: largest relative speed of a candidate pair.
    """

    accepted: Scalar
    energy_lost: Scalar
    excess: Scalar
    overflow: Scalar
    fastest: Scalar

    @staticmethod
    def over(stages: "Collisions") -> "Collisions":
        """Tally of consecutive stages stacked along the first axis."""
        total = jax.tree.map(jnp.sum, stages)
        return eqx.tree_at(lambda t: t.fastest, total, jnp.max(stages.fastest))

    def then(self, later: "Collisions") -> "Collisions":
        """Tally of this stage followed by another."""
        return Collisions(
            self.accepted + later.accepted,
            self.energy_lost + later.energy_lost,
            self.excess + later.excess,
            self.overflow + later.overflow,
            jnp.maximum(self.fastest, later.fastest),
        )


def hits_per_particle(plan: PairPlan, majorant: Scalar, duration: Scalar) -> Scalar:
    """κ = 2M/N with M = (N-1) w dt/(2√2) candidates: eq. (4.23a) with N-1 partners for N."""
    n = plan.rows * plan.lanes
    return majorant * duration * ((n - 1) / n / 2.0**0.5)


def collide(
    key: Key,
    gas: AbstractGas,
    plan: PairPlan,
    velocity: Velocity,
    majorant: Scalar,
    duration: Scalar,
) -> tuple[Velocity, Collisions]:
    """Collisions of a homogeneous gas during `duration` (τ0), second order in it.

    `majorant` w (v0) bounds the pair rate. Whatever the gas, the candidates are drawn with w
    alone; the physics enters through the acceptance, so that it can be differentiated.
    """
    hits = hits_per_particle(plan, majorant, duration)
    share_first, share_second = thinning(plan, hits)
    taken, left, right, fresh = take_rows(key, plan, velocity)
    factors = share_first / majorant, share_second / majorant
    left, right, tally, _ = meet(key, 2, gas, left, right, factors[0])
    again = tuple(v[: plan.second] for v in left)
    again, fresh, later, _ = meet(key, 3, gas, again, fresh, factors[1])
    left = tuple(v.at[: plan.second].set(w) for v, w in zip(left, again, strict=True))
    missed = jnp.maximum(share_first - 1.0, 0.0) + jnp.maximum(share_second - 1.0, 0.0)
    tally = eqx.tree_at(lambda t: t.overflow, tally.then(later), missed * plan.first * plan.lanes)
    return put_rows(velocity, taken, left, right, fresh), tally


def meet(key: Key, stream: int, gas: AbstractGas, left: Particles, right: Particles, factor):
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
    speed = jnp.sqrt(sum(g * g for g in relative))
    probability = gas.rate(speed) * factor
    accepted = uniforms[2] < probability
    outgoing = elastic_outgoing(relative, speed, uniforms[0], uniforms[1])
    transfer = tuple(jnp.where(accepted, t, 0.0) for t in gas.momentum_transfer(relative, outgoing))
    transfer, accepted, probability, speed = lax.optimization_barrier(
        (transfer, accepted, probability, speed)
    )
    lost = sum(t * (a - b - t) for t, a, b in zip(transfer, left, right, strict=True))
    tally = Collisions(
        _total(accepted.astype(dtype)),
        _total(lost),
        _total(jnp.maximum(probability - 1.0, 0.0)),
        jnp.zeros((), dtype),
        jnp.max(speed),
    )
    left = tuple(v - t for v, t in zip(left, transfer, strict=True))
    right = tuple(v + t for v, t in zip(right, transfer, strict=True))
    return left, right, tally, jnp.max(probability)


def _total(values) -> Scalar:
    """Sum by lanes, then rows: in float32 the rounding error grows as √rows + √lanes."""
    return jnp.sum(jnp.sum(values, axis=-1))
