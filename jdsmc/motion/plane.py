"""A periodic square of side L: flight in the stationary representation, square cells, modes.

Costantini and Puglisi, PRE 82, 011305: eqs. (6), (7), (14), (15).
"""

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..random import sin_cos_turns
from ..sums import mean, total
from ..types import Layer, Positions, Scalar, Velocities

MODES = ((0, 1), (1, 0), (1, 1), (1, -1))
"""Wave vectors in units of 2π/L; the first two are equivalent, and so are the last two."""


def fly(
    position: tuple[Positions, Positions],
    velocity: Velocities,
    growth_rate: Scalar,
    side: Scalar,
    duration: Scalar,
) -> tuple[tuple[Positions, Positions], Velocities]:
    """x += w (e^{μh} - 1)/μ, w *= e^{μh}: free flight while the unit of time shrinks, exactly."""
    grown = growth_rate * duration
    # (e^g - 1)/g by its series: g is below 0.1, the next term below 1e-7
    share = 1.0 + grown / 2.0 * (1.0 + grown / 3.0 * (1.0 + grown / 4.0 * (1.0 + grown / 5.0)))
    length, factor = duration * share, 1.0 + grown * share
    moved = tuple(_inside(x + length * v, side) for x, v in zip(position, velocity, strict=True))
    return (moved[0], moved[1]), tuple(factor * v for v in velocity)


def _inside(place: Positions, side: Scalar) -> Positions:
    """The image in [0, L)."""
    inside = place - side * jnp.floor(place / side)
    return jnp.where(inside >= side, 0.0, jnp.maximum(inside, 0.0))


def cell_of(position: tuple[Positions, Positions], side: Scalar, columns: int) -> Layer:
    """The square cell of each particle, 0 to columns² - 1."""
    index = [
        jnp.clip(jnp.floor(x * (columns / side)).astype(jnp.int32), 0, columns - 1)
        for x in position
    ]
    return index[0] * columns + index[1]


def transverse_modes(
    position: tuple[Positions, Positions], velocity: Velocities, side: Scalar
) -> Float[Array, "4 2"]:
    """Σ w_⊥ exp(i k·r), real and imaginary part, for the four smallest wave vectors (`MODES`).

    Velocities across k: w_x for k along y, w_y for k along x, (w_x ∓ w_y)/√2 for the diagonals. The
    sums are made in rows: in float32 their rounding is 1e-6 of what fluctuates.
    """
    (sx, cx), (sy, cy) = (sin_cos_turns(x / side) for x in position)
    vx, vy = velocity
    root = 1.0 / np.sqrt(2.0)
    waves = (
        (vx, cy, sy),
        (vy, cx, sx),
        (root * (vx - vy), cx * cy - sx * sy, sx * cy + cx * sy),
        (root * (vx + vy), cx * cy + sx * sy, sx * cy - cx * sy),
    )
    return jnp.stack([jnp.stack([total(v * c), total(v * s)]) for v, c, s in waves])


def still(velocity: Velocities) -> Velocities:
    """Without the net momentum, which grows as e^{μs}."""
    return tuple(v - mean(v) for v in velocity)
