"""Navier-Stokes coefficients of a cooling gas at zero field: nothing is disturbed, pairs tell.

The gas cools freely within a record and is scaled back to T0 at its start; pairs of the sample give
its linearised generator, `jdsmc.measure.linear_response`.
"""

from typing import ClassVar

import jax
import jax.numpy as jnp
import numpy as np

from .. import random
from ..collisions.meet import Collisions
from ..collisions.sampled import (
    pairs_per_particle,
    random_outgoing,
    random_pairs,
    sampling_key,
    with_images,
)
from ..fields import derived
from ..gases import AbstractGas
from ..gases.base import pair_rate
from ..gases.relaxation import relaxation
from ..measure.linear_response import ORDER, Generator, coefficients, generator
from ..measure.moments import moments
from ..measure.observable import Observable
from ..measure.polynomials import ISOTROPIC
from ..measure.responses import OBSERVABLES
from ..motion.drive import held_at, temperature_of
from ..types import Key, Particles, Scalar, Velocity
from ..units import INITIAL_TEMPERATURE
from .approach import MEASURED, Approach, cooling_rate, of_velocities
from .homogeneous import AbstractHomogeneous, HomogeneousRecord, HomogeneousState
from .options import Options
from .pace import make_steps
from .scaled import check_without_drag, scaling_exponent, unsettled

NAMES = ("modified_conductivity", "conductivity", "density_coefficient", "viscosity")
COEFFICIENTS = tuple(next(one for one in OBSERVABLES if one.name == name) for name in NAMES)
TRUNCATIONS = tuple(
    Observable(f"{one.name}_truncation", f"change of {one.meaning} with the last function")
    for one in COEFFICIENTS
)


class ResponseRecord(HomogeneousRecord):
    """A record of the gas held at T0, and what its pairs tell."""

    generator: Generator


class CoolingResponse(AbstractHomogeneous):
    """A cooling gas whose pairs give all Navier-Stokes coefficients at zero field.

    Arguments: `gas`, one of three components without drag whose pair rate is proportional to the
    relative speed. TypeError otherwise.
    """

    reports: ClassVar[tuple[Observable, ...]] = (*COEFFICIENTS, *TRUNCATIONS)
    sampled: ClassVar[tuple[Observable, ...]] = ()
    monitored: ClassVar[tuple[str, ...]] = ("fourth", "sixth")
    default_rtol: ClassVar[float] = 5e-3

    gas: AbstractGas
    exponent: float | None = derived()

    def __init__(self, gas: AbstractGas):
        self.gas, self.exponent = gas, scaling_exponent(gas)

    def __check_init__(self):
        check_without_drag(self.gas, "CoolingResponse")
        if self.exponent != 1.0:
            raise TypeError(
                "CoolingResponse needs a gas that collides at a rate proportional to the relative "
                "speed and has no speed of its own, as hard spheres."
            )

    def ends(self) -> tuple[str, ...]:
        """Those with the most noise."""
        return ("modified_conductivity", "conductivity", "viscosity")

    def approach(self, options: Options) -> Approach:
        """A few collisions per particle, or what the gas needs."""
        return of_velocities(self.gas, 0)

    def has_steady_state(self) -> bool:
        """True if gradients have a response: if the fluxes that they drive are forgotten faster
        than the gas cools."""
        return not unsettled(self.gas, self.exponent, 1, 2) and not self._outlives()

    def _outlives(self) -> bool:
        """True if a heat flux decays more slowly than T: κ = .../(ν_κ - 2ζ) has no limit then."""
        if isinstance(self.gas, MEASURED):
            return False
        cooling = cooling_rate(self.gas)
        flux = relaxation(self.gas, INITIAL_TEMPERATURE, 1).slowest(cooling)
        return flux <= 0.5 * cooling

    def no_steady_state(self) -> str:
        """Heat that outlives the gas."""
        why = unsettled(self.gas, self.exponent, 1, 2)
        return why or "a heat flux in this gas decays more slowly than its temperature"

    def step(
        self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options: Options
    ) -> tuple[Velocity, Collisions]:
        """Collisions, and nothing else."""
        return self.collide(key, velocity, majorant, duration, options)

    def advance(self, key: Key, state: HomogeneousState, options: Options):
        """One record: scale to T0, sample particles and pairs, then make the steps."""
        velocity, _ = held_at(state.velocity, INITIAL_TEMPERATURE)
        sampled, pairs = moments(velocity), self.pairs(sampling_key(key), velocity)

        def step(key, velocity, majorant, duration):
            velocity, tally = self.step(key, velocity, majorant, duration, options)
            return velocity, tally, None

        velocity, majorant, tally, elapsed, _ = make_steps(
            *(step, self.gas, key, velocity, state.majorant),
            *(sampled.temperature(), self.rate(), options),
        )
        whole = jnp.zeros_like(elapsed), jnp.ones(2, elapsed.dtype), temperature_of(velocity)
        record = ResponseRecord(sampled, tally, elapsed, *whole, pairs)
        return HomogeneousState(velocity, majorant), record

    def finish_chunk(self, state: HomogeneousState) -> tuple[HomogeneousState, None]:
        """Deal the particles into new rows."""
        mixed, _ = super().finish_chunk(state)
        return mixed, None

    def pairs(self, key: Key, velocity: Velocity) -> Generator:
        """Sums over pairs, with either sign of the second velocity: both are as likely."""
        images = with_images(random_pairs(key, velocity), ISOTROPIC.images)
        found = [
            self.of_pairs(random.fold_in(key, number), velocity, *pair)
            for number, pair in enumerate(images)
        ]
        return jax.tree.map(lambda *sums: sum(sums) / len(sums), *found)

    def of_pairs(
        self, key: Key, velocity: Velocity, left: Particles, right: Particles
    ) -> Generator:
        """Sums over pairs, each in a random direction and its opposite."""
        relative = tuple(a - b for a, b in zip(left, right, strict=True))
        speed = jnp.sqrt(sum(g * g for g in relative))
        transfers = tuple(
            self.gas.momentum_transfer(relative, outgoing)
            for outgoing in random_outgoing(key, relative, speed)
        )
        rate = pair_rate(self.gas, speed) * pairs_per_particle(velocity[0].size)
        return generator(velocity, left, right, rate, transfers)

    def averages(self, record: ResponseRecord) -> dict[str, np.ndarray]:
        """What every homogeneous gas has, and the sums over pairs."""
        sums = {name: np.asarray(x) for name, x in vars(record.generator).items()}
        averages = super().averages(record) | sums
        for name in ("local_rate", "local_loss", "instant_rate", "final_rate", "final_loss"):
            del averages[name]
        return averages

    def observables(self, means: dict) -> dict:
        """Coefficients, and how much the last function changes each."""
        found, fewer = coefficients(means), coefficients(means, ORDER - 1)
        change = {f"{n}_truncation": np.abs(x - fewer[n]) for n, x in found.items()}
        return found | change
