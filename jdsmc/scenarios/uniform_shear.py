"""Uniform shear flow, homogeneous in the frame that moves with the flow.

Astillero and Santos, "Uniform shear flow in dissipative gases" (2005), sections III and IV B: only
peculiar velocities are kept, and convection is the inertial force -m a V_y x̂ (eq. 3.4).
"""

from dataclasses import replace
from typing import Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from ..collisions.meet import Collisions
from ..fields import choice, number
from ..gases import AbstractGas, ElasticHardSpheres
from ..gases.hard_spheres import loses_energy
from ..measure.balance import without_noise
from ..measure.moments import pair_cubed
from ..measure.observable import Observable
from ..measure.observables import PRESSURES, REDUCED, RHEOLOGY, TEMPERATURE, rheology
from ..measure.polynomials import SHEARED, Averages, Powers, Symmetry
from ..motion.drive import shear, sheared_drag, temperature_of
from ..types import Key, Scalar, Velocity
from ..units import MAXWELL_CUBED
from .approach import Approach, of_sheared_gas
from .homogeneous import AbstractHomogeneous, HomogeneousState
from .kinetic_model import check_start, sheared
from .options import Options

STRESS = next(one for one in RHEOLOGY if one.name == "shear_stress")


class UniformShear(AbstractHomogeneous):
    """A gas under a constant shear rate.

    Arguments:
        gas: any gas of three velocity components; `ElasticHardSpheres` with its drag.
        shear_rate: a in units of 1/τ0, at least 0; number or, for a sweep, a 1-D array.
        initial_state: "equilibrium" (local equilibrium at T0, eq. 3.12), which shows the approach;
            or "steady", for steady values sooner: temperature and stresses of the kinetic model in
            its steady state, of gases of hard spheres that have one.
    Raises ValueError for other values.
    """

    command: ClassVar[str] = "shear"
    reports: ClassVar[tuple[Observable, ...]] = (
        *(STRESS, TEMPERATURE),
        *(one for one in RHEOLOGY if one != STRESS),
        *(*PRESSURES, *REDUCED),
    )
    applies_drag: ClassVar[bool] = True
    balanced: ClassVar[bool] = True
    symmetry: ClassVar[Symmetry | None] = SHEARED
    monitored: ClassVar[tuple[str, ...]] = ("temperature", "xy", "xx", "fourth")

    gas: AbstractGas
    shear_rate: Any = number("shear rate a", "1/τ0", low=0.0, high_included=False, example=4.0)
    initial_state: Literal["equilibrium", "steady"] = choice(
        "local equilibrium at T0 (eq. 3.12), or the steady state of the kinetic model",
        ("equilibrium", "steady"),
        default="equilibrium",
    )

    def initial(self, key: Key, options: Options) -> HomogeneousState:
        """Velocities with mean exactly zero, and exactly T0 or the temperature of the model."""
        start = super().initial(key, options)
        if self.initial_state == "equilibrium":
            return start
        return replace(start, velocity=sheared(start.velocity, self.gas, self.shear_rate))

    def step(
        self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options: Options
    ) -> tuple[Velocity, Collisions]:
        """Half a flow, collisions, half a flow ("strang"); or the whole flow first ("lie")."""
        drag_ratio = self.drag_ratio(velocity)
        before, after = options.halves
        velocity = self.flow(velocity, before * duration, drag_ratio)
        velocity, tally = self.collide(key, velocity, majorant, duration, options)
        if after:
            velocity = self.flow(velocity, after * duration, drag_ratio)
        return velocity, tally

    def flow(self, velocity: Velocity, duration: Scalar, drag_ratio: Scalar) -> Velocity:
        """Shear, and for a frictional gas the drag, during `duration`."""
        if isinstance(self.gas, ElasticHardSpheres):
            drag = self.gas.drag_coefficient() * drag_ratio
            return sheared_drag(velocity, self.shear_rate, drag, duration)
        return shear(velocity, self.shear_rate * duration)

    def drag_ratio(self, velocity: Velocity) -> Scalar:
        """Factor of the drag: 1, or ⟨V12³⟩/⟨V12³⟩0 of the present velocities if asked."""
        if not (isinstance(self.gas, ElasticHardSpheres) and self.gas.drag == "measured"):
            return jnp.ones((), velocity[0].dtype)
        return pair_cubed(velocity, temperature_of(velocity)) / MAXWELL_CUBED

    def rate(self) -> Any:
        """The shear rate."""
        return self.shear_rate

    def moment_drift(self, powers: Powers, mean: Averages) -> Any:
        """Shear turns v_x into v_y; the drag takes (c/2) √(2T) of each power of the velocity."""
        i, j, k = powers
        shear = -self.shear_rate * i * mean[i - 1, j + 1, k]
        if not isinstance(self.gas, ElasticHardSpheres):
            return shear
        heat = (mean[2, 0, 0] + mean[0, 2, 0] + mean[0, 0, 1]) / 3.0
        loss = 0.5 * self.gas.drag_coefficient() * np.sqrt(2.0 * heat)
        if self.gas.drag == "measured":
            loss = loss * mean["cubed"] / (MAXWELL_CUBED * heat**1.5)
        return shear - loss * SHEARED.degree(powers) * mean[powers]

    def has_steady_state(self) -> bool:
        """True if heating and cooling can balance: a > 0, and a gas that loses energy."""
        return bool(self.shear_rate > 0 and loses_energy(self.gas))

    def no_steady_state(self) -> str:
        """What a steady state needs."""
        return "it needs shear_rate > 0 and a gas that loses energy; else give duration, collisions"

    def approach(self, options: Options) -> Approach:
        """That of the kinetic model."""
        return of_sheared_gas(self.gas, self.shear_rate, self.initial_state == "steady")

    def fit_options(self, options: Options) -> Options:
        """As they are; ValueError for a start that the gas does not have."""
        if self.initial_state == "steady":
            check_start(self.gas, self.has_steady_state())
        return super().fit_options(options)

    def observables(self, means: dict) -> dict:
        """Stresses and the viscometric functions, beside what every homogeneous gas has."""
        means = without_noise(means)  # once: what it returns has no balance any more
        own = rheology(means, self.shear_rate, self.gas.speed_exponent())
        return super().observables(means) | own
