"""Homogeneous gases: what a scene needs to say when particles have velocities and no places."""

from abc import abstractmethod
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .. import check, random
from ..collisions.bound import FASTEST_PAIR
from ..collisions.meet import Collisions
from ..collisions.pairs import remix
from ..collisions.whole import collide
from ..gases.base import check_share, pair_rate
from ..measure.balance import Balance, balance_of, balances, noise_of, squares, without_noise
from ..measure.distributions import (
    DISTRIBUTIONS,
    Distributions,
    bin_centres,
    densities,
    distributions,
)
from ..measure.moments import moments
from ..measure.observable import Observable
from ..measure.observables import (
    REDUCED,
    TEMPERATURE,
    collisional,
    isotropic,
    moment_averages,
)
from ..measure.polynomials import Averages, Powers, Symmetry
from ..motion.drive import centred, temperature_of
from ..sums import mean
from ..types import Key, Scalar, Velocity
from ..units import INITIAL_TEMPERATURE
from .base import AbstractScene, Record, weighted_means
from .options import Options
from .pace import make_steps


class HomogeneousState(eqx.Module):
    """Velocities, each component rows x lanes (v0), and the majorant over `pace.warmth`."""

    velocity: Velocity
    majorant: Scalar


def maxwellian(key: Key, options: Options, gas, temperature: float) -> HomogeneousState:
    """Maxwellian velocities, shifted and scaled to mean zero and the exact temperature."""
    shape, dtype = (options.rows.rows, options.rows.lanes), options.dtype
    normal = [
        number
        for draw in (0, 1)
        for number in random.normal_pair(random.bits(random.fold_in(key, draw), shape), dtype)
    ]
    velocity = tuple(v - mean(v) for v in normal[: gas.dimension])
    scale = jnp.sqrt(temperature / temperature_of(velocity))
    return HomogeneousState(tuple(scale * v for v in velocity), first_majorant(gas, dtype))


def first_majorant(gas, dtype) -> Scalar:
    """The rate of a pair so fast that a Maxwellian hardly has a faster one."""
    return pair_rate(gas, jnp.asarray(FASTEST_PAIR, dtype))


class HomogeneousRecord(Record):
    """A record of a homogeneous gas.

    `log_scale`: logarithm of what velocities were divided by before they were measured. `slowing`:
    averages over the steps, relative to the start, of what collisions and their loss of energy go
    with. `final`: temperature at the end.
    """

    log_scale: Scalar
    slowing: Float[Array, "2"]
    final: Scalar


class BalancedRecord(HomogeneousRecord):
    """A record that knows the noise of its collisions."""

    balance: Balance


def homogeneous_observables(*names: str) -> tuple[Observable, ...]:
    """What every homogeneous gas reports, the named ones first; ValueError for other names."""
    known = {one.name: one for one in (TEMPERATURE, *REDUCED)}
    for name in names:
        check.one_of("name", name, list(known))
    return tuple(known.pop(name) for name in names) + tuple(known.values())


class AbstractHomogeneous(AbstractScene):
    """A homogeneous gas started from a Maxwellian at T0: a scene states its `step`.

    It may state a `rate` that its steps must resolve, and add to `observables`.
    """

    sampled: ClassVar[tuple[Observable, ...]] = DISTRIBUTIONS
    symmetry: ClassVar[Symmetry | None] = None
    """That of the distribution, for derivatives; `moment_drift` goes with it."""
    balanced: ClassVar[bool] = False
    """True if the noise of collisions is taken out of steady second moments (`measure.balance`), in
    three dimensions."""

    @abstractmethod
    def step(
        self, key: Key, velocity: Velocity, majorant: Scalar, duration: Scalar, options: Options
    ) -> tuple[Velocity, Collisions]:
        """One time step of `duration` (τ0): collisions, and what drives the gas."""

    def rate(self) -> Any:
        """A rate (1/τ0) that time steps must be short against, beside 1/τ(T)."""
        return 0.0

    def collide(self, key, velocity, majorant, duration, options) -> tuple[Velocity, Collisions]:
        """The collision stage of a step."""
        watch = noise_of(self.gas) if self.balanced else None
        return collide(key, self.gas, options.rows, velocity, majorant, duration, watch)

    def fit_options(self, options: Options) -> Options:
        """As they are; ValueError for a gas that is mistaken about itself."""
        check_share(self.gas)
        return options

    def initial(self, key: Key, options: Options) -> HomogeneousState:
        """Maxwellian velocities with mean exactly zero and temperature exactly T0."""
        return maxwellian(key, options, self.gas, INITIAL_TEMPERATURE)

    def advance(
        self, key: Key, state: HomogeneousState, options: Options
    ) -> tuple[HomogeneousState, HomogeneousRecord]:
        """One record: measure, choose the time step, then make `options.steps` of them."""
        velocity = centred(state.velocity)
        sampled = moments(velocity)

        def step(key, velocity, majorant, duration):
            velocity, tally = self.step(key, velocity, majorant, duration, options)
            return velocity, tally, (tally.watched, duration)

        velocity, majorant, tally, elapsed, (noise, durations) = make_steps(
            *(step, self.gas, key, velocity, state.majorant),
            *(sampled.temperature(), self.rate(), options),
        )
        whole = sampled, tally, elapsed, jnp.zeros_like(elapsed), jnp.ones(2, elapsed.dtype)
        whole = *whole, temperature_of(velocity)
        state = HomogeneousState(velocity, majorant)
        if noise is None:
            return state, HomogeneousRecord(*whole)
        return state, BalancedRecord(*whole, balance_of(noise, durations, velocity))

    def finish_chunk(self, state: HomogeneousState) -> tuple[HomogeneousState, Distributions]:
        """Sample the velocity distributions and deal the particles into new rows."""
        sample = distributions(state.velocity)
        return HomogeneousState(tuple(map(remix, state.velocity)), state.majorant), sample

    def moment_drift(self, powers: Powers, mean: Averages) -> Any:
        """d⟨φ⟩/dt of one polynomial by all but collisions, for derivatives.

        `mean[powers]` is such an average, `mean["cubed"]` is ⟨V12³⟩. On the host, in float64; a
        number or an array (leading axes of any shape).
        """
        return 0.0

    def holds_temperature(self) -> bool:
        """True if each record starts at T0, in a unit of time that follows."""
        return False

    def averages(self, record: HomogeneousRecord) -> dict[str, np.ndarray]:
        """Averages over the particles at each record."""
        found = homogeneous_averages(self.gas, record.moments, record.slowing)
        found["final_rate"] = self.gas.collision_rate(record.final)
        found["final_loss"] = self.gas.energy_loss_rate(record.final)
        if isinstance(record, BalancedRecord):
            found |= balances(record.moments, record.balance, record.elapsed)
        return found

    def window(self, series: dict, weights: np.ndarray) -> dict[str, np.ndarray]:
        """Averages of each realization over a window, and what their balance is fitted to."""
        means = weighted_means(series, weights)
        if "balance" in series and self.has_steady_state():
            means |= squares(series["balance"], weights)
        return means

    def observables(self, means: dict) -> dict:
        """What every homogeneous gas has."""
        means = without_noise(means)
        return isotropic(means, self.gas.dimension) | collisional(means)

    def sample_densities(self, sample: dict) -> dict:
        """Probability densities in units of v0(T); each marginal is that of a half space."""
        return densities(sample)

    def axes(self, options: Options) -> dict:
        """Speed classes and velocity bins."""
        return {
            "speed_class": np.arange(4),
            "velocity": bin_centres(True),
            "speed_bin": bin_centres(False),
        }


def homogeneous_averages(gas, m, slowing) -> dict[str, np.ndarray]:
    """Moments, and the rates of collisions and of their loss in local equilibrium."""
    averages = moment_averages(m)
    heat = averages["temperature"]
    rate, loss = gas.collision_rate(heat), gas.energy_loss_rate(heat)
    return averages | {
        "instant_rate": rate,
        "local_rate": rate * slowing[..., 0],
        "local_loss": loss * slowing[..., 1],
    }
