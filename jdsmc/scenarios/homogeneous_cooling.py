"""Homogeneous cooling: a gas left alone loses energy and keeps a steady reduced distribution.

Hard-sphere collisions know no time scale but the velocities', so that multiplying all velocities by
a number only changes the unit of time. The simulation uses this: at every record velocities are
scaled back to T0 and the logarithm of the scale is kept, which gives Haff's law in plain time and
the steady state in reduced time from one run, exactly, without a thermostat and without underflow.
"""

from typing import ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..collide import collide
from ..gas import INITIAL_TEMPERATURE, AbstractGas
from ..measure import Distributions, Record, distributions, moments
from ..observables import isotropic, particle_means
from ..options import Options
from ..pace import make_steps
from ..pairs import remix
from ..state import HomogeneousState, held_at
from ..types import Key, Scalar, Velocity


class CoolingState(eqx.Module):
    """Velocities scaled to T0 (at the start of a record), majorant over v0(T), log of the scale.

    The true velocities are exp(log_scale) times these.
    """

    velocity: Velocity
    majorant: Scalar
    log_scale: Scalar


class HomogeneousCooling(eqx.Module):
    """A gas that cools freely from a Maxwellian at T0.

    Arguments: `gas`, one without drag (`InelasticHardSpheres`).
    Steady values are those of the reduced distribution (a2, a3, ...); the series has T/T0 against
    plain time (Haff's law) and `reduced_time`, ∫ dt √(T/T0).
    """

    steady_observables: ClassVar[tuple[str, ...]] = (
        *("relative_speed_cubed", "relative_speed_cubed_collisional", "a2", "a3"),
        *("speed_ratio", "collision_rate_ratio"),
    )
    densities: ClassVar[dict[str, float]] = {"marginal_x": 0.5, "marginal_y": 0.5, "speed": 1.0}
    monitored: ClassVar[tuple[str, ...]] = ("fourth", "sixth", "cubed")
    default_observable: ClassVar[str] = "relative_speed_cubed"
    default_particles: ClassVar[int] = 20_000

    gas: AbstractGas

    def __check_init__(self):
        check_without_drag(self.gas, "HomogeneousCooling")

    def has_steady_state(self) -> bool:
        """The reduced distribution always becomes steady."""
        return True

    def initial(self, key: Key, options: Options) -> CoolingState:
        """Maxwellian velocities with mean exactly zero and temperature exactly T0."""
        start = HomogeneousState.maxwellian(key, options, INITIAL_TEMPERATURE)
        return CoolingState(start.velocity, start.majorant, jnp.zeros((), options.dtype))

    def advance(self, key: Key, state: CoolingState, options: Options):
        """One record: scale to T0, measure, then `options.steps` collision stages."""
        velocity, log_scale = scaled_to_start(state.velocity, state.log_scale)
        sampled = moments(velocity)

        def step(key, velocity, majorant, duration):
            velocity, tally = collide(key, self.gas, options.plan, velocity, majorant, duration)
            return velocity, tally, HomogeneousState.temperature_of(velocity)

        velocity, majorant, tally, elapsed, after = make_steps(
            step, key, velocity, state.majorant, sampled.temperature(), 0.0, options
        )
        slowing = slowed_rates(after)
        record = Record(sampled, tally, elapsed, jnp.exp(log_scale), slowing)
        return CoolingState(velocity, majorant, log_scale), record

    def finish_chunk(self, state: CoolingState) -> tuple[CoolingState, Distributions]:
        """Sample the velocity distributions and deal the particles into new rows."""
        sample = distributions(state.velocity)
        mixed = tuple(map(remix, state.velocity))
        return CoolingState(mixed, state.majorant, state.log_scale), sample

    def faults(self, record: Record) -> str:
        """Nothing can fail here that does not fail in every scene."""
        return ""

    def averages(self, record: Record) -> dict[str, np.ndarray]:
        """Averages over the particles at each record."""
        return particle_means(record)

    def observables(self, means: dict) -> dict:
        """Observables of the reduced distribution."""
        reduced = isotropic(means)
        del reduced["temperature"]
        return reduced

    def evolution(self, means: dict) -> dict:
        """What changes for ever, for the time series only."""
        scale = means["scale"]
        return {
            "temperature": means["temperature"] * scale**2 / INITIAL_TEMPERATURE,
            "reduced_time": np.sqrt(np.pi) * means["local_collisions"],
        }


def scaled_to_start(velocity: Velocity, log_scale: Scalar) -> tuple[Velocity, Scalar]:
    """Velocities with mean zero and temperature T0, and the logarithm of their scale."""
    velocity, factor = held_at(velocity, INITIAL_TEMPERATURE)
    return velocity, log_scale - jnp.log(factor)


def slowed_rates(after: Float[Array, " steps"]) -> Float[Array, "2"]:
    """Averages over the steps of (T/T0)^{1/2} and (T/T0)^{3/2}, by the trapezoidal rule.

    `after` are the temperatures after each step; the first started at T0.
    """
    root = jnp.sqrt(jnp.concatenate([jnp.ones(1, after.dtype), after / INITIAL_TEMPERATURE]))
    both = jnp.stack([root, root**3])
    return jnp.mean(0.5 * (both[:, 1:] + both[:, :-1]), axis=1)


def check_without_drag(gas, scene: str) -> None:
    """Raise TypeError unless the gas is one without drag."""
    if not isinstance(gas, AbstractGas):
        raise TypeError(f"gas must be a jdsmc gas, got {gas!r}.")
    if gas.frictional:
        raise TypeError(
            f"{scene} needs a gas without drag (a drag only changes the scale of velocities); use "
            "InelasticHardSpheres."
        )
