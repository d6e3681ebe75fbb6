"""Gases that cool for ever, held at T0 by a change of the unit of time.

Where nothing but the velocities sets a scale of time (pair rate ∝ g^γ, transfer linear in g),
multiplying all velocities by a number only changes the unit of time. So at every record velocities
are scaled back to T0 and the logarithm of the scale is kept: Haff's law in plain time and the
steady state in reduced time come from one run, exactly, without a thermostat or underflow.
"""

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..gases import AbstractGas, ElasticHardSpheres
from ..gases.base import check_gas, speed_exponent
from ..gases.relaxation import tail_exponent
from ..motion.drive import held_at
from ..types import Scalar, Velocity
from ..units import INITIAL_TEMPERATURE
from .approach import NEVER, cooling_rate, of_velocities

MOMENTS_OF_VALUE, MOMENTS_OF_ERROR = 2, 4
"""An average of order n has a finite variance if there are averages of order 2n; its error bar can
be trusted if there are some of order 4n. Seen in the heat-flux force at an exponent of 14: scores
of κ' have ⟨z²⟩ = 1.4, as eight realizations should, a2 1.6 and a3 2.6."""


def scaled_to_start(velocity: Velocity) -> tuple[Velocity, Scalar]:
    """Velocities with mean zero and temperature T0, and the logarithm of what they were divided by.

    Its sum over the records tells how cold the gas is. The history adds up, in float64: in float32
    the rounding of a sum of thousands would show.
    """
    velocity, factor = held_at(velocity, INITIAL_TEMPERATURE)
    return velocity, -jnp.log(factor)


def slowed_rates(after: Float[Array, " steps"], exponent: float) -> Float[Array, "2"]:
    """Averages over the steps of (T/T0)^{γ/2} and (T/T0)^{1+γ/2}, by the trapezoidal rule.

    `after` are the temperatures after each step; the first started at T0. Rates of collisions go
    with the first, rates of energy loss with the second.
    """
    root = jnp.sqrt(jnp.concatenate([jnp.ones(1, after.dtype), after / INITIAL_TEMPERATURE]))
    power = int(exponent) if exponent == int(exponent) else exponent
    both = jnp.stack([root**power, root ** (2 + power)])
    return jnp.mean(0.5 * (both[:, 1:] + both[:, :-1]), axis=1)


def log_plain_time(elapsed: np.ndarray, log_scale: np.ndarray, exponent: float) -> np.ndarray:
    """Logarithm of the time (τ0) of records whose velocities were divided by exp(log_scale)."""
    return np.log(elapsed) - exponent * log_scale


def scaling_exponent(gas: AbstractGas) -> float | None:
    """γ if the gas (which may be swept) knows no speed of its own, else None."""
    if not isinstance(gas, AbstractGas) or isinstance(gas, ElasticHardSpheres):
        return None
    return speed_exponent(gas)


def unsettled(gas: AbstractGas, exponent: float | None, *ranks: int) -> str:
    """Why the reduced distribution of one cooling gas has no steady averages; empty if it has some.

    `ranks`: of the disturbances that must decay beside isotropic ones (`of_velocities`).
    """
    if exponent is None:
        return "its gas has a speed of its own, so that it changes for ever"
    if cooling_rate(gas) < 0:
        return "its gas makes energy in collisions"
    tail = tail_exponent(gas, exponent)
    if tail <= 4 * MOMENTS_OF_VALUE:
        return (
            "the distribution of its gas falls as a power of the speed: averages of c^p exist up "
            f"to p = {tail:.2g}, and a2 needs {4 * MOMENTS_OF_VALUE} to have an error bar"
        )
    if of_velocities(gas, 0, *ranks) is NEVER:
        return "disturbances of its reduced distribution grow"
    return ""


def tail_remark(exponent: float, orders: dict[str, int], cause: str) -> str:
    """A sentence on averages whose error bars hang on particles too rare to be seen; or none."""
    highest = exponent / MOMENTS_OF_ERROR
    doubted = [name for name, order in orders.items() if order > highest]
    if not doubted:
        return ""
    return (
        f"{cause} a power law of exponent {exponent:.0f}: averages of more than {highest:.1f} "
        f"powers of the speed hang on rare particles, and the errors of {', '.join(doubted)} may "
        "be too small."
    )


def check_without_drag(gas, scene: str) -> None:
    """Raise TypeError unless it is a gas, and one without drag."""
    check_gas(gas)
    if isinstance(gas, ElasticHardSpheres):
        raise TypeError(
            f"{scene} needs a gas without drag (a drag only changes the scale of velocities); use "
            "InelasticHardSpheres."
        )
