"""Uniform shear flow, homogeneous in the frame that moves with the flow.

Astillero and Santos, "Uniform shear flow in dissipative gases" (2005), sections III and IV B: only
peculiar velocities are kept, and convection is the inertial force -m a V_y x̂ (eq. 3.4).
"""

from typing import ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from .. import check
from ..collide import Collisions, collide
from ..drive import shear, sheared_drag
from ..gas import INITIAL_TEMPERATURE, AbstractGas
from ..measure import (
    Distributions,
    Record,
    centred,
    distributions,
    moments,
    pair_cubed,
)
from ..observables import MAXWELL_CUBED, isotropic, particle_means, rheology
from ..options import Options
from ..pace import make_steps
from ..pairs import remix
from ..state import HomogeneousState
from ..types import Key, Physical, Scalar, Velocity


class UniformShear(eqx.Module):
    """A gas under a constant shear rate, started from local equilibrium at T0 (eq. 3.12).

    Arguments:
        gas: `InelasticHardSpheres` or `ElasticHardSpheres`.
        shear_rate: a in units of 1/τ0, at least 0; number or, for a sweep, a 1-D array.
    Raises ValueError for a negative shear rate.
    """

    steady_observables: ClassVar[tuple[str, ...]] = (
        *("temperature", "shear_stress", "normal_stress_xy", "normal_stress_zy"),
        *("reduced_shear_rate", "reduced_viscosity", "first_viscometric", "second_viscometric"),
        *("relative_speed_cubed", "a2", "a3", "speed_ratio", "collision_rate_ratio"),
    )

    densities: ClassVar[dict[str, float]] = {"marginal_x": 0.5, "marginal_y": 0.5, "speed": 1.0}
    monitored: ClassVar[tuple[str, ...]] = ("temperature", "xy", "xx", "fourth")
    default_observable: ClassVar[str] = "shear_stress"
    default_particles: ClassVar[int] = 20_000

    gas: AbstractGas
    shear_rate: Physical = eqx.field(converter=check.physical)

    def __check_init__(self):
        if not isinstance(self.gas, AbstractGas):
            raise TypeError(f"gas must be a jdsmc gas, got {self.gas!r}.")
        check.in_range("shear_rate", self.shear_rate, 0.0, np.inf, high_included=False)

    def has_steady_state(self) -> bool:
        """True if heating and cooling can balance at every point: a > 0 and α < 1."""
        return bool(np.all(self.shear_rate > 0) and self.gas.is_dissipative())

    def initial(self, key: Key, options: Options) -> HomogeneousState:
        """Maxwellian velocities with mean exactly zero and temperature exactly T0."""
        return HomogeneousState.maxwellian(key, options, INITIAL_TEMPERATURE)

    def flow(self, velocity: Velocity, duration: Scalar, drag_ratio: Scalar) -> Velocity:
        """Shear, and for a frictional gas the drag, during `duration`."""
        if self.gas.frictional:
            drag = self.gas.drag_coefficient() * drag_ratio
            return sheared_drag(velocity, self.shear_rate, drag, duration)
        return shear(velocity, self.shear_rate * duration)

    def step(
        self,
        key: Key,
        velocity: Velocity,
        majorant: Scalar,
        duration: Scalar,
        options: Options,
    ) -> tuple[Velocity, Collisions]:
        """One time step: half a flow, collisions, half a flow ("strang"), or as in the paper."""
        drag_ratio = self.drag_ratio(velocity)
        before, after = (0.5, 0.5) if options.splitting == "strang" else (1.0, 0.0)
        velocity = self.flow(velocity, before * duration, drag_ratio)
        velocity, tally = collide(key, self.gas, options.plan, velocity, majorant, duration)
        if after:
            velocity = self.flow(velocity, after * duration, drag_ratio)
        return velocity, tally

    def drag_ratio(self, velocity: Velocity) -> Scalar:
        """Factor of the drag: 1, or ⟨V12³⟩/⟨V12³⟩0 of the present velocities if asked."""
        if not self.gas.measured_drag:
            return jnp.ones((), velocity[0].dtype)
        temperature = HomogeneousState.temperature_of(velocity)
        return pair_cubed(velocity) / (MAXWELL_CUBED * temperature**1.5)

    def advance(
        self, key: Key, state: HomogeneousState, options: Options
    ) -> tuple[HomogeneousState, Record]:
        """One record: measure, choose the time step, then make `options.steps` of them."""
        velocity = centred(state.velocity)
        sampled = moments(velocity)

        def step(key, velocity, majorant, duration):
            velocity, tally = self.step(key, velocity, majorant, duration, options)
            return velocity, tally, None

        velocity, majorant, tally, elapsed, _ = make_steps(
            step,
            key,
            velocity,
            state.majorant,
            sampled.temperature(),
            self.shear_rate,
            options,
        )
        record = Record.steady_scale(sampled, tally, elapsed)
        return HomogeneousState(velocity, majorant), record

    def finish_chunk(self, state: HomogeneousState) -> tuple[HomogeneousState, Distributions]:
        """Sample the velocity distributions and deal the particles into new rows."""
        sample = distributions(state.velocity)
        return HomogeneousState(tuple(map(remix, state.velocity)), state.majorant), sample

    def faults(self, record: Record) -> str:
        """Nothing can fail here that does not fail in every scene."""
        return ""

    def averages(self, record: Record) -> dict[str, np.ndarray]:
        """Averages over the particles at each record."""
        return particle_means(record)

    def evolution(self, means: dict) -> dict:
        """Nothing but the observables; for the time series only."""
        return {}

    def observables(self, means: dict) -> dict:
        """Observables from averages over particles, realizations and time (host arrays)."""
        return {**isotropic(means), **rheology(means, self.shear_rate)}
