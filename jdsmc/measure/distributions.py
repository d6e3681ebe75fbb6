"""Histograms of velocities: of a homogeneous gas, of a sheared slab, and at walls."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..motion.friction import LayerFlow, peculiar
from ..sums import mean
from ..types import Layer, Positions, Velocities, Velocity
from .observable import Observable

BIN_WIDTH = 0.1
LARGEST_VELOCITY = 10.0
"""Histograms cover |C| < 10; what lies beyond is left out of them, not moved into the last bin."""

DISTRIBUTIONS = (
    Observable("marginal_x", "g_x^(+)(C_x)", dims=("velocity",)),
    Observable("marginal_y", "g_y^(+)(C_y)", dims=("velocity",)),
    Observable("speed", "F(C)", dims=("speed_bin",)),
)

HALVES = {"marginal_x": 0.5, "marginal_y": 0.5, "speed": 1.0}
"""Norms: each marginal is that of a half space."""

PLACES = {"lower": "lowest", "middle": "middle", "upper": "highest"}
AT_WALLS = tuple(
    Observable(f"marginal_z_{place}", f"n f(c_z)/n̄, {words} layer", dims=("velocity",))
    for place, words in PLACES.items()
)


class Distributions(eqx.Module):
    """Fractions of particles in velocity bins of width 0.1 v0(T), at one instant.

    `marginal_x`: C_x sign(C_y), so that both halves of eq. (5.3) are used; `marginal_y` likewise;
    `speed`: C.
    """

    marginal_x: Float[Array, " bins"]
    marginal_y: Float[Array, " bins"]
    speed: Float[Array, " half_bins"]


class AtWalls(eqx.Module):
    """Particles in velocity bins in the lowest, a middle and the highest layer at one instant, over
    how many a layer has in the mean."""

    marginal_z_lower: Float[Array, " bins"]
    marginal_z_middle: Float[Array, " bins"]
    marginal_z_upper: Float[Array, " bins"]


def distributions(velocity: Velocity) -> Distributions:
    """Histograms of one instant, in units of the thermal speed of that instant."""
    scale = jnp.sqrt(0.5 * len(velocity) / mean(sum(v * v for v in velocity)))
    return _reduced(tuple(v * scale for v in velocity))


def over_slab(layer: Layer, velocity: Velocities, count: int) -> Distributions:
    """The same of velocities relative to the flow of their layer, over the whole slab.

    N velocities relative to their own mean have the variance (N-1)/N: they are stretched by its
    root. A particle alone in its layer shows none and is left out.
    """
    flow = LayerFlow.of(layer, velocity, count)
    several = flow.number > 1
    stretch = jnp.sqrt(flow.number / jnp.where(several, flow.number - 1.0, 1.0))
    relative = tuple(v * stretch[layer] for v in peculiar(layer, velocity, flow.mean))
    known = jnp.sum(jnp.where(several, flow.number, 0.0))
    scale = jnp.sqrt(1.5 * known / jnp.sum(sum(v * v for v in relative)))
    found = _reduced(tuple(jnp.where(several[layer], v * scale, jnp.inf) for v in relative))
    return jax.tree.map(lambda x: x * layer.size / known, found)


def _reduced(velocity: tuple) -> Distributions:
    vx, vy, *_ = velocity
    return Distributions(
        histogram(vx * jnp.sign(vy), symmetric=True),
        histogram(vy * jnp.sign(vx), symmetric=True),
        histogram(jnp.sqrt(sum(v * v for v in velocity)), symmetric=False),
    )


def at_walls(layer: Layer, velocity: Positions, count: int, thermal: tuple) -> AtWalls:
    """Of velocities across the slab, over the thermal speed of each place."""
    places = (0, count // 2, count - 1)
    return AtWalls(
        *(
            count * histogram(jnp.where(layer == place, velocity / speed, jnp.inf), symmetric=True)
            for place, speed in zip(places, thermal, strict=True)
        )
    )


def densities(sample: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Probability densities in units of the thermal speed."""
    return {name: HALVES.get(name, 1.0) / BIN_WIDTH * values for name, values in sample.items()}


def histogram(values, *, symmetric: bool):
    """Fractions of values in the bins of `bin_centres`; infinite ones are in none."""
    last = round(LARGEST_VELOCITY / BIN_WIDTH)
    first = -last if symmetric else 0
    within = jnp.clip(values, -2.0 * LARGEST_VELOCITY, 2.0 * LARGEST_VELOCITY)
    index = jnp.floor(within / BIN_WIDTH).astype(jnp.int32).ravel() - first
    inside = jnp.where(index < 0, 2 * last, index)  # a negative one would count from the end
    counts = jnp.zeros(last - first, jnp.int32).at[inside].add(1, mode="drop")
    return counts.astype(values.dtype) / values.size


def bin_centres(symmetric: bool) -> np.ndarray:
    """Centres of the bins: of `marginal_x`, `marginal_y` (symmetric) or of `speed`."""
    half = round(LARGEST_VELOCITY / BIN_WIDTH)
    return (np.arange(-half if symmetric else 0, half) + 0.5) * BIN_WIDTH
