"""Sums of polynomials over the two particles of a pair, before a collision and after it.

A collision leaves velocities c ± ρ e, the centre c and ρ fixed by the pair. Where e has any
direction, the average of a polynomial φ over it is known, with no direction drawn:

    ⟨φ(c + ρ e)⟩ = Σ_j ρ^{2j}/(2j+1)! (∇²)^j φ(c)

(three components). Another gas draws a direction and its opposite. Barriers keep the compiler from
working out every polynomial again for each sum it stands in (1.3 times as long).
"""

from typing import Any

import jax.numpy as jnp
from jax import lax

from ..collisions.sampled import random_outgoing
from ..gases import AbstractGas
from ..measure.polynomials import Powers, Symmetry
from ..types import Key, Pairs, Particles, Scalar


def both(symmetry: Symmetry, basis: list[Powers], left: Particles, right: Particles) -> list:
    """φ_k(1) + φ_k(2) of every pair."""
    values = (symmetry.values(side, basis) for side in (left, right))
    return lax.optimization_barrier([a + b for a, b in zip(*values, strict=True)])


def after(
    symmetry: Symmetry,
    basis: list[Powers],
    key: Key,
    gas: AbstractGas,
    pair: Pairs,
    reference: Scalar,
) -> list:
    """The same after a collision, averaged over its direction or over two opposite ones.

    Arguments: velocities of the two in units of `reference`.
    """
    left, right = pair
    relative = tuple(a - b for a, b in zip(left, right, strict=True))
    share = gas.transfer_share()
    if share is not None:
        return _over_all(symmetry, basis, share, pair, relative)
    speed = jnp.sqrt(sum(g * g for g in relative))
    found: list[Any] = [0.0 for _ in basis]
    for one in random_outgoing(key, relative, speed):
        transfer = gas.momentum_transfer(
            tuple(g * reference for g in relative), tuple(e * reference for e in one)
        )
        moved = _moved(pair, tuple(t / reference for t in transfer))
        found = [a + 0.5 * b for a, b in zip(found, both(symmetry, basis, *moved), strict=True)]
    return found


def _over_all(symmetry: Symmetry, basis: list[Powers], share, pair, relative) -> list:
    centres = _moved(pair, tuple(share * g for g in relative))
    square = share * share * sum(g * g for g in relative)
    own = dict(zip(basis, both(symmetry, basis, *centres), strict=True))
    own[(0,) * len(symmetry.degrees)] = jnp.full_like(square, 2.0)
    found, factor, most = dict(own), jnp.ones_like(square), max(map(symmetry.degree, basis)) // 2
    for j in range(1, most + 1):
        factor = factor * square / (2 * j * (2 * j + 1))
        every = {powers: _laplacian(symmetry, powers, own) for powers in own}
        own = lax.optimization_barrier(
            {p: value for p, value in every.items() if value is not None}
        )
        found |= {powers: found[powers] + factor * value for powers, value in own.items()}
    return lax.optimization_barrier([found[powers] for powers in basis])


def _laplacian(symmetry: Symmetry, powers: Powers, values: dict) -> Any:
    terms = [(n, values[p]) for n, p in symmetry.laplacian(powers) if p in values]
    return sum(n * value for n, value in terms) if terms else None


def _moved(pair, transfer) -> tuple[Particles, Particles]:
    left, right = pair
    return (
        tuple(v - t for v, t in zip(left, transfer, strict=True)),
        tuple(v + t for v, t in zip(right, transfer, strict=True)),
    )
