"""What a simulation carries from step to step."""

import equinox as eqx
import jax.numpy as jnp

from . import random
from .collide import Collisions
from .drive import mean
from .measure import centred
from .options import Options
from .types import Key, Scalar, Velocity

INITIAL_MAJORANT = 6.0
"""First bound on relative speeds over v0(T): a Maxwellian exceeds it once in 6e7 pairs."""

RAISE, RELAX = 1.05, 0.0025
"""A pair faster than the majorant raises it to 1.05 times its speed; else it moves by 0.25% of
the way to the fastest pair of the step.

If it never fell, one rare pair of the exponential tail of a sheared gas would slow the rest of the
run (after 3e4 steps by half). The bound is then exceeded every hundred steps or so, by a percent of
one collision in 1e4: a share of 1e-6, counted as `Collisions.excess`; the limit is 1e-4.
"""


class HomogeneousState(eqx.Module):
    """Velocities, each component rows x lanes (v0), and the majorant over v0(T)."""

    velocity: Velocity
    majorant: Scalar

    @staticmethod
    def maxwellian(key: Key, options: Options, temperature: float) -> "HomogeneousState":
        """Maxwellian velocities, shifted and scaled to mean zero and the exact temperature."""
        shape = (options.plan.rows, options.plan.lanes)
        vx, vy = random.normal_pair(random.bits(random.fold_in(key, 0), shape), options.dtype)
        vz, _ = random.normal_pair(random.bits(random.fold_in(key, 1), shape), options.dtype)
        velocity = tuple(v - mean(v) for v in (vx, vy, vz))
        scale = jnp.sqrt(temperature / HomogeneousState.temperature_of(velocity))
        return HomogeneousState(
            tuple(scale * v for v in velocity), jnp.asarray(INITIAL_MAJORANT, options.dtype)
        )

    @staticmethod
    def temperature_of(velocity: Velocity) -> Scalar:
        """T = m⟨V²⟩/d."""
        return mean(sum(v * v for v in velocity)) / len(velocity)


def held_at(velocity: Velocity, temperature) -> tuple[Velocity, Scalar]:
    """Velocities of mean zero scaled to a temperature, and the factor they were scaled with."""
    velocity = centred(velocity)
    factor = jnp.sqrt(temperature / HomogeneousState.temperature_of(velocity))
    return tuple(factor * v for v in velocity), factor


def next_majorant(reduced: Scalar, majorant: Scalar, tally: Collisions) -> Scalar:
    """The majorant over v0(T) of the next step: raised if a pair was faster, else lowered.

    Arguments: the present one, over v0(T) and in v0, and what the step's collisions told.
    """
    fastest = tally.fastest * (reduced / majorant)
    relaxed = reduced + RELAX * (fastest - reduced)
    return jnp.where(fastest > reduced, RAISE * fastest, relaxed)
