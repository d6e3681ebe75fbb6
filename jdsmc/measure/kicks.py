"""Displacements V -> V + ε G(V) whose response is a transport coefficient, and their fluxes.

The kicked density f0 - ε ∂/∂V·(G f0) is f0 plus ε times the right-hand side of a Chapman-Enskog
equation (docs/impulse_response.md; Montanero, Santos and Garzó, Physica A 376, 75 (2007), eqs.
2.20, 2.31, 2.32 and 2.37). Units m = 1, three dimensions.
"""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..motion.drive import centred, temperature_of
from ..sums import mean
from ..types import Copies, Scalar, Velocity

FIELDS = ("modified_conductivity", "conductivity", "viscosity")
"""The coefficient that each field gives, in the order of `fields`."""

COPIES = 2 * len(FIELDS)
"""Kicked copies of a sample: each field with +ε, then with -ε."""


def fields(velocity: Velocity) -> list[Velocity]:
    """G for κ' (½(T x̂ - V_x V)), for κ ((T - V²/4) x̂ - ¼ V_x V) and for η (-V_x ŷ).

    T is the temperature of the sample. The mean of G is still in them.
    """
    vx = velocity[0]
    temperature = temperature_of(velocity)
    square = sum(v * v for v in velocity)
    modified = [-0.5 * vx * v for v in velocity]
    modified[0] = modified[0] + 0.5 * temperature
    full = [0.5 * m for m in modified]
    full[0] = full[0] + 0.75 * temperature - 0.25 * square
    shear = (jnp.zeros_like(vx), -vx, jnp.zeros_like(vx))
    return [tuple(modified), tuple(full), shear]


def kicked(velocity: Velocity, strength: Scalar) -> Copies:
    """The six copies of a sample, stacked along a new first axis, each with mean velocity zero."""
    copies = [
        centred(tuple(v + sign * strength * g for v, g in zip(velocity, field, strict=True)))
        for field in fields(velocity)
        for sign in (1.0, -1.0)
    ]
    return tuple(jnp.stack(component) for component in zip(*copies, strict=True))


def fluxes(velocity: Velocity) -> Float[Array, "2"]:
    """q_x/n = ⟨(V²/2 - 5T/2) V_x⟩, eq. (2.26), and P_xy/n = ⟨V_x V_y⟩ (mean velocity zero)."""
    vx, vy, _ = velocity
    square = sum(v * v for v in velocity)
    excess = 0.5 * square - 2.5 * temperature_of(velocity)
    return jnp.stack([mean(excess * vx), mean(vx * vy)])
