"""Heat flux without gradients: a velocity-dependent force that acts like a temperature gradient.

Montanero, Santos and Garzó, "First-order Chapman-Enskog velocity distribution function in a
granular gas", Physica A 376, 75 (2007), section 3.1. To first order in the field ε the force
F = (T/2m) ε - ½ V (V·ε) (eqs. 2.32, 3.2) on a cooling gas makes the distribution 𝒜'·ε, hence the
modified thermal conductivity κ' = -q_x/(T ε).

Collisions and force both scale with the velocities: the thermostat of the paper is a change of the
unit of time. So the gas cools freely within a record (eight steps) and is scaled back to T0 at its
start: no thermostat stands between collisions, and none can bias their rate.
"""

from typing import Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from ..fields import choice, derived, number
from ..gases import AbstractGas
from ..measure.distributions import BIN_WIDTH
from ..measure.heat import (
    RESPONSES,
    MarginalVelocity,
    heat_moments,
    marginal_velocity,
    odd_averages,
    responses,
)
from ..measure.observable import Observable
from ..measure.observables import REDUCED
from ..measure.polynomials import AXIAL, Averages, Powers, Symmetry
from ..motion.drive import centred, held_at, temperature_of
from ..types import Key, Scalar, Velocity
from ..units import INITIAL_TEMPERATURE
from .approach import Approach, of_heat_flux_force
from .homogeneous import (
    DISTRIBUTIONS,
    AbstractHomogeneous,
    HomogeneousRecord,
    HomogeneousState,
    homogeneous_averages,
)
from .options import Options
from .pace import make_steps
from .scaled import (
    check_without_drag,
    scaling_exponent,
    slowed_rates,
    tail_remark,
    unsettled,
)


class HeatRecord(HomogeneousRecord):
    """A record of the gas held at T0: `elapsed` is ∫ dt (T/T0)^{γ/2}, `slowing` refers to it.

    `runaway` is the largest -½ ε V_x dt of a particle in a step, `step` the mean dt.
    """

    runaway: Scalar
    step: Scalar


class HeatFluxForce(AbstractHomogeneous):
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

    command: ClassVar[str] = "heat-flux"
    reports: ClassVar[tuple[Observable, ...]] = (*RESPONSES, *REDUCED)
    sampled: ClassVar[tuple[Observable, ...]] = DISTRIBUTIONS[:1]
    symmetry: ClassVar[Symmetry | None] = AXIAL
    monitored: ClassVar[tuple[str, ...]] = ("fourth", "flux3", "flux5")

    gas: AbstractGas
    field: Any = number("strength λ0 ε of the force", low=0.0, high=2.0, example=0.025)
    scheme: Literal["exact", "paper"] = choice(
        "the force of a step: its exact flow around the collisions, or the paper's explicit step",
        ("exact", "paper"),
        default="exact",
    )
    exponent: float | None = derived()

    def __init__(self, gas: AbstractGas, field, scheme: Literal["exact", "paper"] = "exact"):
        self.gas, self.field, self.scheme = gas, field, scheme
        self.exponent = scaling_exponent(gas)

    def __check_init__(self):
        check_without_drag(self.gas, "HeatFluxForce")
        if self.exponent != 1.0:
            raise TypeError(
                "HeatFluxForce needs a gas that collides at a rate proportional to the relative "
                "speed and has no speed of its own, as hard spheres: collisions and force then "
                f"scale alike, and the gas can be held at T0; {type(self.gas).__name__} does not."
            )

    def moment_drift(self, powers: Powers, mean: Averages) -> Any:
        """-½ V (V·ε), and the mean velocity subtracted."""
        i, j = powers
        forced = -AXIAL.degree(powers) * mean[i + 1, j] + i * mean[2, 0] * mean[i - 1, j]
        return 0.5 * self.field * forced

    def holds_temperature(self) -> bool:
        """True: each record starts at T0."""
        return True

    def has_steady_state(self) -> bool:
        """True if there is a heat flux to be measured, and the gas answers to a force."""
        return bool(self.field > 0) and not unsettled(self.gas, self.exponent, 1)

    def no_steady_state(self) -> str:
        """Without a field all responses are 0/0."""
        if self.field > 0:
            return f"{unsettled(self.gas, self.exponent, 1)}; give duration or collisions"
        return (
            "field = 0 drives no heat flux to be measured; give field > 0, or duration or "
            "collisions"
        )

    def approach(self, options: Options) -> Approach:
        """A few collisions per particle in a weak field."""
        return of_heat_flux_force(self.gas, self.field)

    def flow(self, velocity: Velocity, duration: Scalar) -> tuple[Velocity, Scalar]:
        """V/(1 + ½ ε V_x t), the exact flow of -½ V (V·ε), then mean velocity zero.

        Returns also the largest -½ ε V_x t of the particles; at one a particle reaches infinity.
        """
        strength = (0.5 * self.field * duration) * velocity[0]
        forced = tuple(v / (1.0 + strength) for v in velocity)
        return centred(forced), jnp.max(-strength)

    def step(self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options):
        """One time step."""
        return self.forced(key, velocity, majorant, duration, options)[:2]

    def forced(self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options):
        """Half a flow, collisions, half a flow; or collisions and the paper's explicit step.

        With first-order splitting the whole flow comes first.
        """
        if self.scheme == "paper":
            velocity, tally = self.collide(key, velocity, majorant, duration, options)
            strength = (0.5 * self.field * duration) * velocity[0]
            velocity = tuple(v - strength * v for v in velocity)
            velocity, _ = held_at(velocity, INITIAL_TEMPERATURE)
            return velocity, tally, jnp.max(-strength)
        share, rest = options.halves
        velocity, before = self.flow(velocity, share * duration)
        velocity, tally = self.collide(key, velocity, majorant, duration, options)
        velocity, after = self.flow(velocity, rest * duration)
        return velocity, tally, jnp.maximum(before, after) / share

    def advance(self, key: Key, state: HomogeneousState, options: Options):
        """One record: scale to T0, measure, then make `options.steps` steps."""
        velocity, _ = held_at(state.velocity, INITIAL_TEMPERATURE)
        sampled = heat_moments(velocity)

        def step(key, velocity, majorant, duration):
            velocity, tally, runaway = self.forced(key, velocity, majorant, duration, options)
            return velocity, tally, (runaway, temperature_of(velocity))

        velocity, majorant, tally, elapsed, (runaway, after) = make_steps(
            *(step, self.gas, key, velocity, state.majorant),
            *(sampled.isotropic.temperature(), 0.0, options),
        )
        root, cube = slowed_rates(after, 1.0)
        record = HeatRecord(
            *(sampled, tally, elapsed * root),
            jnp.zeros_like(root),
            jnp.stack([jnp.ones_like(root), cube / root]),
            after[-1],
            jnp.nanmax(runaway),
            elapsed / options.steps,
        )
        return HomogeneousState(velocity, majorant), record

    def finish_chunk(self, state: HomogeneousState) -> tuple[HomogeneousState, MarginalVelocity]:
        """Sample the distribution of c_x and deal the particles into new rows."""
        mixed, _ = super().finish_chunk(state)
        return mixed, marginal_velocity(state.velocity)

    def faults(self, record: HeatRecord) -> str:
        """A force that drives particles away."""
        share = np.nan_to_num(record.runaway, nan=0.0, posinf=np.inf)  # NaN is found elsewhere
        realization, number = np.unravel_index(np.argmax(share), share.shape)
        if np.max(share) < RUNAWAY:
            return ""
        step = float(np.min(record.step[:, number]))
        speed = 2 * RUNAWAY / self.field / step
        return (
            f"The heat-flux force runs away with the fastest particles: at field = {self.field:g} "
            f"and a time step of {step:.2g} τ0 one (of realization {realization}) is faster than "
            f"{speed:.2g} v0 and would reach infinity within {1 / RUNAWAY:.0f} steps. Reduce "
            "field, or time_step."
        )

    def tail_exponent(self) -> float:
        """Largest p for which a stationary gas can have ⟨V^p⟩.

        A particle that flies against the force gains ½ ε V² and collides V/√2 times a unit of time:
        the share that reaches V before a collision falls as V^{-√2/ε}.
        """
        rate = float(self.gas.rate(jnp.ones(()))) / np.sqrt(2.0)
        return rate / (0.5 * float(self.field)) if self.field > 0 else np.inf

    def remarks(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """Which averages hang on particles so rare that their scatter does not tell their error."""
        cause = f"field = {float(self.field):g} stretches the tail of fast particles to"
        found = tail_remark(self.tail_exponent(), ORDERS, cause)
        return found and f"{found} Take a smaller field for them."

    def averages(self, record: HeatRecord) -> dict[str, np.ndarray]:
        """Averages over the particles at each record, odd ones included."""
        m = record.moments
        averages = homogeneous_averages(self.gas, m.isotropic, record.slowing)
        del averages["instant_rate"]  # the steps know better
        return averages | odd_averages(m, averages["temperature"])

    def observables(self, means: dict) -> dict:
        """Conductivity, Sonine coefficients and cumulants."""
        return super().observables(means) | responses(means, self.field)

    def sample_densities(self, sample: dict) -> dict:
        """The density of c_x."""
        return {"marginal_x": sample["marginal_x"] / BIN_WIDTH}

    def axes(self, options: Options) -> dict:
        """Sonine orders beside those of every homogeneous gas."""
        return super().axes(options) | {"sonine_order": np.arange(1, 4)}


RUNAWAY = 0.3
"""Largest -½ ε V_x dt of a particle in a step: its speed grows by 1/(1 - 0.3) = 1.4."""

ORDERS = {"modified_conductivity": 3, "a2": 4, "b'_2": 5, "a3": 6, "b'_3": 7}
"""Powers of the speed in what is reported."""
