"""Heat flux without gradients: a velocity-dependent force that acts like a temperature gradient.

Montanero, Santos and Garzó, "First-order Chapman-Enskog velocity distribution function in a
granular gas", Physica A 376, 75 (2007), section 3.1. To first order in the field ε the force
F = (T/2m) ε - ½ V (V·ε) (eqs. 2.32, 3.2) on a cooling gas makes the distribution 𝒜'·ε, hence the
modified thermal conductivity κ' = -q_x/(T ε).

Collisions and force both scale with the velocities: the thermostat of the paper is a change of the
unit of time. So the gas cools freely within a record (eight steps) and is scaled back to T0 at its
start: no thermostat stands between collisions, and none can bias their rate.
"""

from typing import ClassVar, Literal

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from .. import check
from ..collide import collide
from ..gas import INITIAL_TEMPERATURE, AbstractGas
from ..heat import (
    HeatRecord,
    MarginalVelocity,
    heat_averages,
    heat_moments,
    heat_observables,
    marginal_velocity,
)
from ..measure import centred
from ..options import Options
from ..pace import make_steps
from ..pairs import remix
from ..state import HomogeneousState, held_at
from ..types import Key, Physical, Scalar, Velocity
from .homogeneous_cooling import check_without_drag, slowed_rates


class HeatFluxForce(eqx.Module):
    """A cooling gas under the heat-flux force along x, started from a Maxwellian at T0.

    Arguments:
        gas: one without drag (`InelasticHardSpheres`).
        field: reduced strength ε* = λ ε in [0, 2]; number or 1-D array. Linear response needs a
            small one: extrapolate to zero.
        scheme: "exact" (the force's exact flow, half before and half after the collisions; all
            before them with `splitting="lie"`), or "paper": eq. (4.1) for a whole step after the
            collisions, then eq. (4.2).
    Raises ValueError for values outside these. A run stops with FaultError if the force drives
    particles away (it does in finite time for V_x < 0 if collisions are too rare).
    """

    steady_observables: ClassVar[tuple[str, ...]] = (
        *("conductivity_ratio", "sonine", "sonine_marginal", "a2", "a3", "relative_speed_cubed"),
        "collision_rate_ratio",
    )
    densities: ClassVar[dict[str, float]] = {"marginal_x": 1.0}
    monitored: ClassVar[tuple[str, ...]] = ("fourth", "flux3", "flux5")
    default_observable: ClassVar[str] = "conductivity_ratio"
    default_particles: ClassVar[int] = 20_000

    gas: AbstractGas
    field: Physical = eqx.field(converter=check.physical)
    scheme: Literal["exact", "paper"] = eqx.field(default="exact", static=True)

    def __check_init__(self):
        check_without_drag(self.gas, "HeatFluxForce")
        check.in_range("field", self.field, 0.0, 2.0)
        check.one_of("scheme", self.scheme, ("exact", "paper"))

    def has_steady_state(self) -> bool:
        """The reduced distribution becomes steady."""
        return True

    def initial(self, key: Key, options: Options) -> HomogeneousState:
        """Maxwellian velocities with mean exactly zero and temperature exactly T0."""
        return HomogeneousState.maxwellian(key, options, INITIAL_TEMPERATURE)

    def flow(self, velocity: Velocity, duration: Scalar) -> tuple[Velocity, Scalar]:
        """V/(1 + ½ ε V_x t), the exact flow of -½ V (V·ε), then mean velocity zero.

        Returns also the largest -½ ε V_x t of the particles; at one a particle reaches infinity.
        """
        strength = (0.5 * self.field * duration) * velocity[0]
        forced = tuple(v / (1.0 + strength) for v in velocity)
        return centred(forced), jnp.max(-strength)

    def step(self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options):
        """Half a flow, collisions, half a flow; or collisions and the paper's explicit step.

        With first-order splitting the whole flow comes first.
        """
        if self.scheme == "paper":
            velocity, tally = collide(key, self.gas, options.plan, velocity, majorant, duration)
            strength = (0.5 * self.field * duration) * velocity[0]
            velocity = tuple(v - strength * v for v in velocity)
            velocity, _ = held_at(velocity, INITIAL_TEMPERATURE)
            return velocity, tally, jnp.max(-strength)
        share = 0.5 if options.splitting == "strang" else 1.0
        velocity, before = self.flow(velocity, share * duration)
        velocity, tally = collide(key, self.gas, options.plan, velocity, majorant, duration)
        velocity, after = self.flow(velocity, (1.0 - share) * duration)
        return velocity, tally, jnp.maximum(before, after) / share

    def advance(self, key: Key, state: HomogeneousState, options: Options):
        """One record: scale to T0, measure, then make `options.steps` steps."""
        velocity, _ = held_at(state.velocity, INITIAL_TEMPERATURE)
        sampled = heat_moments(velocity)

        def step(key, velocity, majorant, duration):
            velocity, tally, runaway = self.step(key, velocity, majorant, duration, options)
            return velocity, tally, (runaway, HomogeneousState.temperature_of(velocity))

        velocity, majorant, tally, elapsed, (runaway, after) = make_steps(
            step,
            key,
            velocity,
            state.majorant,
            sampled.isotropic.temperature(),
            0.0,
            options,
        )
        root, cube = slowed_rates(after)
        record = HeatRecord(
            sampled,
            tally,
            elapsed * root,
            jnp.stack([jnp.ones_like(root), cube / root]),
            jnp.nanmax(runaway),
            elapsed / options.steps,
        )
        return HomogeneousState(velocity, majorant), record

    def finish_chunk(self, state: HomogeneousState) -> tuple[HomogeneousState, MarginalVelocity]:
        """Sample the distribution of c_x and deal the particles into new rows."""
        sample = marginal_velocity(state.velocity)
        return HomogeneousState(tuple(map(remix, state.velocity)), state.majorant), sample

    def faults(self, record: HeatRecord) -> str:
        """Why this record cannot be trusted, or an empty string."""
        point, _, number = np.unravel_index(np.nanargmax(record.runaway), record.runaway.shape)
        if np.nanmax(record.runaway) < RUNAWAY:
            return ""
        field = float(self.field[point])
        step = float(np.min(record.step[point, :, number]))
        speed = 2 * RUNAWAY / field / step
        return (
            f"The heat-flux force runs away with the fastest particles: at field = {field:g} and a "
            f"time step of {step:.2g} τ0 one is faster than {speed:.2g} v0 and would reach "
            f"infinity within {1 / RUNAWAY:.0f} steps. Reduce field, or time_step."
        )

    def averages(self, record: HeatRecord) -> dict[str, np.ndarray]:
        """Averages over the particles at each record."""
        return heat_averages(record)

    def evolution(self, means: dict) -> dict:
        """Nothing but the observables; for the time series only."""
        return {}

    def observables(self, means: dict) -> dict:
        """Conductivity, Sonine coefficients and cumulants."""
        return heat_observables(means, self.field)


RUNAWAY = 0.3
"""Largest -½ ε V_x dt of a particle in a step: its speed grows by 1/(1 - 0.3) = 1.4."""
