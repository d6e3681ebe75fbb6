"""Candidate pairs of a whole gas, without a conflict, a sort of the particles or a bias.

Particles of a homogeneous gas are exchangeable. Their array is cut into `rows` of neighbours in
memory; a random permutation of the rows and a random circular shift of the lanes pair every
particle with any particle of another row equally often, at the price of copying rows. (Rows are
mixed among themselves between chunks, so that no two particles are strangers for good.)

Two waves per step. With κ = 2M/N candidate hits per particle, wave 1 takes N(κ-κ²)/2 pairs and
wave 2 takes Nκ²/2 pairs of one particle from wave 1 and one fresh particle. The hits per particle
are then Poisson to second order, and so is the step in time (plain disjoint pairs are first order:
`docs/method.md`). The rows taken are fixed, for the largest κ = κ_c of the plan. For a smaller κ
every slot is a candidate with probability κ/κ_c only; a particle that wave 2 takes from wave 1 may
then not have been a candidate there, and counts as fresh: with shares θ1, θ2 of the slots of either
wave the weights of f, Q(f, f) and Q(Q, f) are right if and only if κ² = 2 θ1 θ2 s2 and
κ = 2 s1 θ1 + 2 s2 θ2 (s1, s2: rows of a wave over all rows).
"""

import math
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np

from .. import random
from ..types import Key, Rows, Scalar, TakenRows, Velocity

LARGEST_HITS = 0.5
"""Candidate hits per particle and step, κ: the second-order rates are off by (ν dt)²/6 at most."""

TYPICAL_MAJORANT = 8.0
"""Largest relative speed over v0(T) met in a sheared gas; sizes the waves, bounds nothing."""


class PairPlan(NamedTuple):
    """Static sizes: the array is rows x lanes; rows in wave 1 (each side) and in wave 2."""

    rows: int
    lanes: int
    first: int
    second: int

    def first_hits(self) -> float:
        """κ_c, from 2 first/rows = κ_c - κ_c²: the κ that uses every slot of wave 1."""
        return 0.5 - math.sqrt(max(0.0, 0.25 - 2.0 * self.first / self.rows))

    def largest_hits(self) -> float:
        """The κ at which the share of a wave reaches one."""
        critical = self.first_hits()
        return float(min(critical, 2.0 * self.second / (self.rows * critical)))


def plan_pairs(n_particles: int, time_step: float) -> PairPlan:
    """Lay out N particles and size the waves for steps of `time_step` (in units of τ).

    Raises ValueError if N has no divisor that makes rows of a useful length.
    """
    rows = arrange(n_particles)
    hits = min(LARGEST_HITS, time_step * TYPICAL_MAJORANT / np.sqrt(2.0))
    # not above rows/8, where κ - κ² is largest; rounded up only if that leaves it there
    first = min(max(1, int(np.ceil(rows * (hits - hits**2) / 2.0 - 1e-9))), rows // 8)
    critical = PairPlan(rows, 1, first, 1).first_hits()
    second = int(np.ceil(rows * min(hits, critical) * critical / 2.0 - 1e-9))
    return PairPlan(rows, n_particles // rows, first, min(max(1, second), first))


def arrange(n_particles: int) -> int:
    """Number of rows: the smallest divisor of N from 64 to 1024, or N itself if N is small."""
    for rows in range(64, 1025):
        if n_particles % rows == 0:
            return rows
    if 64 <= n_particles <= 2048:
        return n_particles
    if n_particles < 64:
        raise ValueError(
            f"n_particles = {n_particles} is outside the allowed range [64, inf): with fewer "
            "particles a gas is dominated by finite-number effects."
        )
    raise ValueError(
        f"n_particles = {n_particles} has no divisor between 64 and 1024, so that it cannot be "
        f"laid out in rows; use {-(-n_particles // 64) * 64} instead."
    )


def thinning(plan: PairPlan, hits: Scalar) -> tuple[Scalar, Scalar]:
    """Shares θ1, θ2 of the slots of either wave that are candidates at κ = `hits`.

    Solves the two conditions above; a share above one is an overflow.
    """
    critical = plan.first_hits()
    return hits / critical, hits * (critical * plan.rows / (2.0 * plan.second))


def take_rows(key: Key, plan: PairPlan, velocity: Velocity):
    """Random rows for the two sides of wave 1 and the fresh side of wave 2.

    Returns: the row indices taken, and three tuples of components of shapes (first, lanes),
    (first, lanes) and (second, lanes); the second and third are circularly shifted.
    """
    order = random.permutation(key, plan.rows, stream=random.Stream.ROWS)
    shift = random.bits(key, (2,), stream=random.Stream.SHIFT)[0] % jnp.uint32(plan.lanes)
    n, m = plan.first, plan.second
    taken = order[: 2 * n + m]
    left = tuple(v[taken[:n]] for v in velocity)
    right = tuple(jnp.roll(v[taken[n : 2 * n]], shift[0], axis=1) for v in velocity)
    fresh = tuple(jnp.roll(v[taken[2 * n :]], shift[1], axis=1) for v in velocity)
    return taken, left, right, fresh


def put_rows(velocity: Velocity, taken, left: TakenRows, right: TakenRows, fresh: TakenRows):
    """Write rows back where they were taken from."""
    return tuple(
        v.at[taken].set(jnp.concatenate(rows), unique_indices=True, mode="promise_in_bounds")
        for v, *rows in zip(velocity, left, right, fresh, strict=True)
    )


def remix(component: Rows) -> Rows:
    """Deal the particles into new rows: one of each old row (or as near as the shape allows)."""
    return component.T.reshape(component.shape)
