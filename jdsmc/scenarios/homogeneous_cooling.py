"""Homogeneous cooling: a gas left alone loses energy.

Where nothing but the velocities sets a scale of time, the reduced distribution becomes steady and
the gas is simulated at T0 (see `scaled`). A gas with a speed of its own (a restitution that depends
on the impact, say) is simulated as it is: its distribution changes for ever.
"""

from typing import ClassVar

import jax.numpy as jnp
import numpy as np

from ..collisions.meet import Collisions
from ..fields import derived
from ..gases import AbstractGas
from ..gases.relaxation import tail_exponent
from ..measure.moments import moments
from ..measure.observable import Observable
from ..measure.observables import REDUCED, TEMPERATURE
from ..measure.polynomials import ISOTROPIC, Symmetry
from ..motion.drive import centred, temperature_of
from ..types import Key, Scalar, Velocity
from ..units import INITIAL_TEMPERATURE
from .approach import Approach, of_velocities
from .homogeneous import AbstractHomogeneous, HomogeneousRecord, HomogeneousState
from .options import Options
from .pace import make_steps
from .scaled import (
    check_without_drag,
    log_plain_time,
    scaled_to_start,
    scaling_exponent,
    slowed_rates,
    tail_remark,
    unsettled,
)


class HomogeneousCooling(AbstractHomogeneous):
    """A gas that cools freely from a Maxwellian at T0.

    Arguments: `gas`, any without drag.
    Steady values are those of the reduced distribution (a2, a3, ...), which there are if the gas
    has no speed of its own. The series has T/T0 against plain time (Haff's law) and `reduced_time`,
    the time in units of τ(T)/τ(T0). After a few hundred collisions per particle T leaves the range
    of floats, and is 0 at a time of infinity: `log_temperature` and `log_time` go on.
    """

    command: ClassVar[str] = "cooling"
    dimensions: ClassVar[tuple[int, ...]] = (2, 3)
    reports: ClassVar[tuple[Observable, ...]] = (
        *(one for one in REDUCED if one.name == "relative_speed_cubed"),
        *(one for one in REDUCED if one.name != "relative_speed_cubed"),
    )
    evolves: ClassVar[tuple[Observable, ...]] = (
        TEMPERATURE,
        Observable("log_temperature", "ln T/T0", symbol="ln T/T0"),
        Observable("log_time", "ln(1 + t/τ0)", symbol="ln(1 + t/τ0)"),
        Observable("reduced_time", "reduced time ∫ dt τ0/τ(T)", "τ0", symbol="reduced time"),
    )
    symmetry: ClassVar[Symmetry | None] = ISOTROPIC
    monitored: ClassVar[tuple[str, ...]] = ("fourth", "sixth", "cubed")
    running: ClassVar[tuple[str, ...]] = ("log_scale",)

    gas: AbstractGas
    exponent: float | None = derived()

    def __init__(self, gas: AbstractGas):
        self.gas, self.exponent = gas, scaling_exponent(gas)

    def __check_init__(self):
        check_without_drag(self.gas, "HomogeneousCooling")

    def fit_options(self, options: Options) -> Options:
        """Only collisions act, so that there is nothing to split."""
        if options.splitting != "strang":
            raise ValueError("splitting = 'lie' has no meaning here: only collisions act.")
        return super().fit_options(options)

    def has_steady_state(self) -> bool:
        """True if the reduced distribution becomes steady: for a gas without a speed of its own,
        and without a tail so heavy that a2 means nothing."""
        return not unsettled(self.gas, self.exponent)

    def holds_temperature(self) -> bool:
        """True if the gas is scaled back to T0."""
        return self.exponent is not None

    def no_steady_state(self) -> str:
        """A gas with a speed of its own changes for ever; others have no averages to be steady."""
        return f"{unsettled(self.gas, self.exponent)}; give duration"

    def approach(self, options: Options) -> Approach:
        """A few collisions per particle, or what the gas needs."""
        return of_velocities(self.gas, 0)

    def remarks(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """Averages of a distribution that falls as a power law."""
        exponent = np.inf if self.exponent is None else tail_exponent(self.gas, self.exponent)
        return tail_remark(exponent, {"a2": 4, "a3": 6}, "The reduced distribution falls as")

    def step(
        self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options: Options
    ) -> tuple[Velocity, Collisions]:
        """Collisions, and nothing else."""
        return self.collide(key, velocity, majorant, duration, options)

    def advance(self, key: Key, state: HomogeneousState, options: Options):
        """One record: scale to T0 if that is allowed, measure, then make the steps."""
        velocity, log_scale = centred(state.velocity), jnp.zeros((), options.dtype)
        if self.exponent is not None:
            velocity, log_scale = scaled_to_start(state.velocity)
        sampled = moments(velocity)

        def step(key, velocity, majorant, duration):
            velocity, tally = self.step(key, velocity, majorant, duration, options)
            return velocity, tally, temperature_of(velocity)

        velocity, majorant, tally, elapsed, after = make_steps(
            *(step, self.gas, key, velocity, state.majorant),
            *(sampled.temperature(), 0.0, options),
        )
        slowing = jnp.ones(2, elapsed.dtype)
        if self.exponent is not None:
            slowing = slowed_rates(after, self.exponent)
        record = HomogeneousRecord(sampled, tally, elapsed, log_scale, slowing, after[-1])
        return HomogeneousState(velocity, majorant), record

    def averages(self, record: HomogeneousRecord) -> dict[str, np.ndarray]:
        """Averages over the particles at each record, the true temperature, the plain time."""
        averages = super().averages(record)
        elapsed, log_scale = (np.asarray(x) for x in (record.elapsed, record.log_scale))
        averages["log_plain_time"] = log_plain_time(elapsed, log_scale, self.exponent or 0.0)
        if self.exponent is not None:
            for name in ("instant_rate", "final_rate", "final_loss"):
                del averages[name]  # the steps know better
        with np.errstate(under="ignore"):
            averages["true_temperature"] = averages["temperature"] * np.exp(2.0 * log_scale)
        log_temperature = np.log(averages["temperature"] / INITIAL_TEMPERATURE) + 2.0 * log_scale
        return averages | {"log_temperature": log_temperature}

    def observables(self, means: dict) -> dict:
        """Observables of the reduced distribution; for a time series also what changes for ever."""
        reduced = super().observables(means)
        reduced["temperature"] = means["true_temperature"] / INITIAL_TEMPERATURE
        reduced["log_temperature"] = means["log_temperature"]
        if "log_time" in means:
            reduced["log_time"] = means["log_time"]
        if "local_collisions" in means:
            per_time = self.gas.collision_rate(INITIAL_TEMPERATURE)
            reduced["reduced_time"] = means["local_collisions"] / per_time
        return reduced
