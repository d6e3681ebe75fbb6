"""The steps of one record: majorant and time step follow the gas from step to step."""

import jax.numpy as jnp
from jax import lax

from .. import random
from ..collisions.bound import next_majorant
from ..collisions.meet import Collisions
from ..gases import AbstractGas, ElasticHardSpheres, InelasticHardDisks, InelasticHardSpheres
from ..gases.base import pair_rate
from ..types import Key, Scalar, Velocity
from .options import Options

LARGEST_SHARE = 0.9
"""Share of the slots that are candidates at most. A pair that outruns the majorant by less than 11%
then still collides as often as it should: a gas that heats up within a record makes such pairs."""

FAST_PAIR = 8.0
"""Relative speed over v0(T) of a fast pair: a power of two, so that rates proportional to the speed
give v0(T) to the bit."""


def pace(
    gas: AbstractGas, temperature: Scalar, reduced_majorant: Scalar, rate, options: Options
) -> tuple[Scalar, Scalar]:
    """Majorant (v0) and length (τ0) of a step.

    The step is the asked fraction of τ(T) or of 1/`rate` (a shear rate, say), whichever is shorter,
    and no longer than the pair selection allows. Derivatives do not see it: it is numerics.
    """
    thermal = lax.stop_gradient(jnp.sqrt(2.0 * temperature))
    majorant = lax.stop_gradient(reduced_majorant * warmth(gas, thermal))
    longest = LARGEST_SHARE * options.rows.largest_hits() * 2.0**0.5 / majorant
    wanted = options.time_step / jnp.maximum(thermal, lax.stop_gradient(rate))
    return majorant, jnp.minimum(wanted, longest)


def warmth(gas: AbstractGas, thermal: Scalar) -> Scalar:
    """What pair rates go with as v0(T) does: that itself, but of other gases than hard spheres the
    rate of fast pairs over that at T0. A majorant that followed v0(T) would fall below the rate of
    Maxwell molecules that cool."""
    if isinstance(gas, InelasticHardSpheres | ElasticHardSpheres | InelasticHardDisks):
        return thermal
    now, before = (pair_rate(gas, FAST_PAIR * v) for v in (thermal, jnp.ones_like(thermal)))
    known = (now > 0) & (before > 0)
    return jnp.where(known, now / jnp.where(known, before, 1.0), thermal)


def make_steps(
    step,
    gas: AbstractGas,
    key: Key,
    velocity: Velocity,
    reduced_majorant: Scalar,
    temperature,
    rate,
    options: Options,
):
    """`options.steps` steps at the pace of `temperature`, that of the start of the record.

    Arguments: `step(key, velocity, majorant, duration)` returns the new velocity, its `Collisions`
    and anything else to report; `reduced_majorant` is the majorant over `warmth`.
    Returns: velocity, reduced majorant, tally and duration of all steps, other reports stacked.
    """

    def one_step(carry, count):
        velocity, reduced = carry
        majorant, duration = pace(gas, temperature, reduced, rate, options)
        velocity, tally, other = step(random.fold_in(key, count), velocity, majorant, duration)
        return (velocity, next_majorant(reduced, majorant, tally)), (tally, duration, other)

    start = (velocity, reduced_majorant)
    (velocity, reduced), (tallies, durations, other) = lax.scan(
        one_step, start, jnp.arange(options.steps)
    )
    return velocity, reduced, Collisions.over(tallies), jnp.sum(durations), other
