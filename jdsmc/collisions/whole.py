"""The collision stage of a homogeneous gas: pairs out of the whole."""

import equinox as eqx
import jax.numpy as jnp

from ..gases.base import AbstractGas
from ..random import Stream
from ..types import Key, Scalar, Velocity
from .meet import Collisions, Watch, meet
from .pairs import PairPlan, put_rows, take_rows, thinning


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
    watch: Watch | None = None,
) -> tuple[Velocity, Collisions]:
    """Collisions of a homogeneous gas during `duration` (τ0), second order in it.

    `majorant` w (v0) bounds the pair rate. Whatever the gas, the candidates are drawn with w alone;
    the physics enters through the acceptance. `watch` adds sums over the candidates to the tally.
    """
    hits = hits_per_particle(plan, majorant, duration)
    share_first, share_second = thinning(plan, hits)
    taken, left, right, fresh = take_rows(key, plan, velocity)
    factors = share_first / majorant, share_second / majorant
    left, right, tally, _ = meet(key, Stream.FIRST_WAVE, gas, left, right, factors[0], watch)
    again = tuple(v[: plan.second] for v in left)
    again, fresh, later, _ = meet(key, Stream.SECOND_WAVE, gas, again, fresh, factors[1], watch)
    left = tuple(v.at[: plan.second].set(w) for v, w in zip(left, again, strict=True))
    missed = jnp.maximum(share_first - 1.0, 0.0) + jnp.maximum(share_second - 1.0, 0.0)
    tally = eqx.tree_at(lambda t: t.overflow, tally.then(later), missed * plan.first * plan.lanes)
    return put_rows(velocity, taken, left, right, fresh), tally
