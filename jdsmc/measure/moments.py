"""Sums over the particles of a homogeneous gas, on the device; ratios are taken on the host."""

from typing import Any

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..sums import mean
from ..types import Scalar, Velocity

SPEED_CLASSES = (1.0, 2.0, 3.0)
"""Inner limits C_1..C_3 of the speed classes of eq. (3.15), in units of v0(T)."""


class Moments(eqx.Module):
    """Means over the particles at one instant.

    `xx`..`xy`: ⟨V_i V_j⟩ in v0² (no `zz` in two dimensions). In units of v0(T) = √(2T/m), lest high
    powers leave the range of float32 in a hot or cold gas: `fourth`, `sixth`: ⟨C⁴⟩, ⟨C⁶⟩; `cubed`:
    ⟨C12³⟩ over N/2 pairs; `classes`: fractions of particles with C in [0,1), [1,2), [2,3), [3,∞).
    """

    xx: Scalar
    yy: Scalar
    zz: Scalar | None
    xy: Scalar
    fourth: Scalar
    sixth: Scalar
    cubed: Scalar
    classes: Float[Array, "4"]

    def temperature(self) -> Scalar:
        """T = m⟨V²⟩/d, eq. (4.15)."""
        return temperature(self)


def temperature(m) -> Any:
    """T of moments on the device, or of averages of them on the host."""
    return (m.xx + m.yy) / 2.0 if m.zz is None else (m.xx + m.yy + m.zz) / 3.0


def pair_cubed(velocity: Velocity, thermal: Scalar) -> Scalar:
    """⟨|V_1 - V_2|³⟩/thermal^{3/2} over N/2 pairs, each with one particle from either half of the
    rows.

    Particles are exchangeable, so a fixed choice of pairs is as good as a random one and costs no
    random access. The second is taken one lane further on: partners of a collision are left in the
    same lane of their rows, and would be met here 1/rows instead of 1/N of the time.
    """
    half = velocity[0].shape[0] // 2
    squared = sum((v[:half] - jnp.roll(v[half : 2 * half], 1, axis=1)) ** 2 for v in velocity)
    squared = squared / thermal
    return mean(squared * jnp.sqrt(squared))


def moments(velocity: Velocity) -> Moments:
    """All moments of one instant."""
    vx, vy, *rest = velocity
    squared = sum(v * v for v in velocity)
    diagonal = [mean(v * v) for v in velocity]
    thermal = (2.0 / len(velocity)) * sum(diagonal[1:], diagonal[0])
    reduced = squared / thermal
    below = [mean(jnp.less(reduced, c * c).astype(vx.dtype)) for c in SPEED_CLASSES]
    edges = jnp.stack([jnp.zeros_like(thermal), *below, jnp.ones_like(thermal)])
    return Moments(
        diagonal[0],
        diagonal[1],
        diagonal[2] if rest else None,
        mean(vx * vy),
        mean(reduced * reduced),
        mean(reduced * reduced * reduced),
        pair_cubed(velocity, thermal),
        jnp.diff(edges),
    )
