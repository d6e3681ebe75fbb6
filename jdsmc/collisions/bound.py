"""Bounds on pair rates: never exceeded unnoticed, raised when they are, lowered slowly."""

import jax.numpy as jnp
from jax import lax

from ..types import Scalar
from .meet import Collisions

FASTEST_PAIR = 6.0
"""Relative speed over v0(T) that a Maxwellian exceeds once in 6e7 pairs: the first bound is the
rate of such a pair."""

RAISE, RELAX = 1.05, 0.0025
"""A pair faster than the majorant raises it to 1.05 times its speed; else it moves by 0.25% of
the way to the fastest pair of the step.

If it never fell, one rare pair of the exponential tail of a sheared gas would slow the rest of the
run (after 3e4 steps by half). The bound is then exceeded every hundred steps or so, by a percent of
one collision in 1e4: a share of 1e-6, counted as `Collisions.excess`; the limit is 1e-4.
"""


def next_majorant(reduced: Scalar, majorant: Scalar, tally: Collisions) -> Scalar:
    """The reduced majorant of the next step: raised if a pair was faster, else lowered.

    Arguments: the present one, reduced and in v0, and what the step's collisions told.
    """
    return next_bound(reduced, tally.fastest * (reduced / majorant))


def next_bound(bound: Scalar, met: Scalar) -> Scalar:
    """Raised above what was met in a step, or lowered a little of the way to it.

    Derivatives do not see it: it is numerics.
    """
    bound, met = lax.stop_gradient((bound, met))
    return jnp.where(met > bound, RAISE * met, bound + RELAX * (met - bound))
