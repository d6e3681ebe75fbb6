"""The simulation: relax, kick, follow; one record of the engine is one whole kick.

Hard-sphere collisions scale with the velocities. So every copy is scaled back, after every step, to
the temperature T1 that it had after its kick: what the engine steps through is the frame in which
the gas does not cool, and the scale is F = exp(ζs/2), with no value of ζ put in. The kick heats at
second order, T1 = T0 (1 + O(ε²)); s counts the copy's own τ(T1), else it alone would bias η by
-ε²/6.
"""

from dataclasses import replace
from math import ceil, log, sqrt
from typing import Any, ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from .. import check, random
from ..collisions.bound import next_majorant
from ..collisions.meet import Collisions
from ..collisions.pairs import LARGEST_HITS, TYPICAL_MAJORANT, plan_pairs, remix
from ..collisions.whole import collide
from ..fields import number
from ..gases import AbstractGas
from ..measure.kicks import COPIES, fluxes, kicked
from ..measure.observable import Observable
from ..measure.responses import OBSERVABLES, Responses, coefficients, kick_series
from ..motion.drive import held_at, temperature_of
from ..sums import mean
from ..types import Copies, Key, Scalar
from ..units import INITIAL_TEMPERATURE
from .approach import Approach
from .base import AbstractScene, Record
from .homogeneous import HomogeneousState, maxwellian
from .options import Options
from .pace import pace
from .scaled import check_without_drag, scaling_exponent

HIGHEST_MAJORANT = 9.0
"""Relative speed over v0(T) for which the longest step keeps its length; it reaches 10 at α = 0.3.
"""

WIDEST_MAJORANT = 12.0
"""The same for short steps: waves are made wide enough for it."""

SPARE = 1.25
"""Steps over those that the duration needs: very fast pairs shorten some (α = 0.3 and ε = 0.4 need
1.19)."""

WARM_UP, GAP = 20.0, 4.0
"""Reduced time from a Maxwellian to the first kick, and between two kicks of a sample (τ0).

The fourth cumulant relaxes at about the collision rate, 0.56/τ0: exp(-11) of it is left. Kicks have
collisions of their own; what two kicks share is the sample, whose fluxes decay at 0.35 to 0.6/τ0.
"""


NONLINEARITY = 0.125
"""What is nonlinear in a kick biases a coefficient by this times ε²: 0.5% at 0.2, measured."""

SLOWEST = 0.44
"""Slowest decay of a response (1/τ0), that of κ at α = 0.3."""


def kick_for(rtol: float) -> float:
    """ε whose bias is half of a relative error at most; 0.2 if more is allowed."""
    return min(0.2, sqrt(0.5 * rtol / NONLINEARITY))


def duration_for(rtol: float) -> float:
    """Reduced time (τ0) after which what is left to extrapolate is well below a relative error."""
    return max(6.0, log(0.2 / rtol) / SLOWEST)


class NavierStokes(AbstractScene):
    """A cooling gas whose sample is copied, kicked six ways and followed, again and again.

    Arguments:
        gas: one without drag whose pair rate is proportional to the relative speed.
        kick: ε in (0, 1]. What is nonlinear in it biases by a few tenths of ε² (0.25% at 0.14).
        duration: reduced time (τ0) for which a kick is followed. What is left is extrapolated
            (`conductivity_tail`, ...); noise in κ grows like exp(ζs/2) with it.
    TypeError or ValueError otherwise. A record is one kick.
    """

    reports: ClassVar[tuple[Observable, ...]] = OBSERVABLES
    monitored: ClassVar[tuple[str, ...]] = ()
    default_rtol: ClassVar[float] = 5e-3

    gas: AbstractGas
    kick: Any = number(
        "strength ε of a kick",
        "1/v0",
        low=0.0,
        high=1.0,
        low_included=False,
        default=0.14,
        example=kick_for,
    )
    duration: float = eqx.field(
        default=8.0,
        static=True,
        metadata={
            "meaning": "reduced time for which a kick is followed",
            "unit": "τ0",
            "example": duration_for,
        },
    )

    def __check_init__(self):
        check_without_drag(self.gas, "NavierStokes")
        if scaling_exponent(self.gas) != 1.0:
            raise TypeError(
                "NavierStokes needs a gas that collides at a rate proportional to the relative "
                "speed and has no speed of its own, as hard spheres: only then a cooling gas can "
                "be held at one temperature."
            )
        check.in_range("duration", self.duration, 0.0, 100.0, low_included=False)

    def fit_options(self, options: Options) -> Options:
        """Waves wide enough for the fastest pairs, and as many steps as the duration needs."""
        step = min(options.time_step, LARGEST_HITS * 2.0**0.5 / HIGHEST_MAJORANT)
        plan = plan_pairs(options.n_particles, step * WIDEST_MAJORANT / TYPICAL_MAJORANT)
        steps = ceil(SPARE * self.duration / step) + 1
        return replace(options, plan=plan, time_step=step, steps=steps, records=1)

    def default_particles(self) -> int:
        """So many that a kick is seen against the noise of one copy."""
        return 20_000

    def ends(self) -> tuple[str, ...]:
        """Those with the most noise."""
        return ("modified_conductivity", "conductivity", "viscosity")

    def approach(self, options: Options) -> Approach:
        """None: what is sampled has relaxed before the first kick."""
        return Approach(0.0)

    def times(self) -> np.ndarray:
        """Times (τ0) after a kick at which responses are reported."""
        return np.linspace(0.0, self.duration, 5 * ceil(self.duration * 2.0) + 1)

    def initial(self, key: Key, options: Options) -> HomogeneousState:
        """A relaxed sample: the cooling state."""
        start = maxwellian(key, options, self.gas, INITIAL_TEMPERATURE)
        state, _ = self.relax(random.fold_in(key, 2), start, WARM_UP, options)
        return state

    def relax(self, key: Key, state: HomogeneousState, duration: float, options: Options):
        """The sample after some reduced time, rows mixed; and the tally of its collisions."""
        held = jnp.asarray(INITIAL_TEMPERATURE, options.dtype)

        def step(state, count):
            majorant, length = pace(self.gas, held, state.majorant, 0.0, options)
            velocity, tally = collide(
                random.fold_in(key, count), self.gas, options.rows, state.velocity, majorant, length
            )
            velocity, _ = held_at(velocity, held)
            return HomogeneousState(velocity, next_majorant(state.majorant, majorant, tally)), tally

        state, tallies = lax.scan(step, state, jnp.arange(ceil(duration / options.time_step)))
        mixed = tuple(map(remix, state.velocity))
        return HomogeneousState(mixed, state.majorant), Collisions.over(tallies)

    def follow(self, key: Key, copies: Copies, majorant: Scalar, options: Options):
        """Fluxes, clocks and ln F of all copies, which see the same random numbers.

        They share the majorant and the time step too, so that they make the same collisions for as
        long as they can. Returns arrays (times, copies) and the tally of all.
        """
        reference = jnp.asarray(INITIAL_TEMPERATURE, options.dtype)
        held = jax.vmap(temperature_of)(copies)
        thermal = jnp.sqrt(held / reference)
        zero = jnp.zeros(COPIES, options.dtype)

        def step(carry, count):
            copies, reduced, time, log_growth = carry
            majorant, length = pace(self.gas, reference, reduced, 0.0, options)
            stage_key = random.fold_in(key, count)

            def one_copy(velocity, temperature):
                velocity, tally = collide(
                    stage_key, self.gas, options.rows, velocity, majorant, length
                )
                velocity, factor = held_at(velocity, temperature)
                return velocity, factor, fluxes(velocity), tally

            copies, factor, flux, tally = jax.vmap(one_copy)(copies, held)
            # √T falls from 1 to 1/factor within the step: trapezoidal rule, error (ζ dt)²/48.
            time = time + 0.5 * length * (1.0 + 1.0 / factor) * thermal
            log_growth = log_growth + jnp.log(factor)
            tally = Collisions.over(tally)
            carry = (copies, next_majorant(reduced, majorant, tally), time, log_growth)
            return carry, (flux, time, log_growth, tally)

        carry = (copies, majorant, zero, zero)
        _, (flux, time, growth, tallies) = lax.scan(step, carry, jnp.arange(options.steps))
        flux = jnp.concatenate([jax.vmap(fluxes)(copies)[None], flux])
        time, growth = (jnp.concatenate([zero[None], x]) for x in (time, growth))
        flux = jnp.concatenate([flux[:, :4, 0], flux[:, 4:, 1]], axis=1)
        return flux, time, growth, Collisions.over(tallies)

    def advance(self, key: Key, state: HomogeneousState, options: Options):
        """One kick: let the sample evolve, copy and kick it, follow the copies."""
        state, before = self.relax(random.fold_in(key, 0), state, GAP, options)
        square = sum(v * v for v in state.velocity)
        copies = kicked(state.velocity, self.kick)
        flux, time, growth, tally = self.follow(
            random.fold_in(key, 1), copies, state.majorant, options
        )
        moments = Responses(flux, time, growth, mean(square * square))
        return state, Record(moments, before.then(tally), jnp.min(time[-1]))

    def faults(self, record: Record) -> str:
        """A kick that could not be followed to its end."""
        if np.min(record.elapsed) >= self.duration:
            return ""
        return (
            f"A kick was followed for {np.min(record.elapsed):.3g} τ0 instead of "
            f"{self.duration:g}: pairs much faster than {HIGHEST_MAJORANT:g} v0 shortened the "
            "steps; reduce kick, or give time_step = 0.05."
        )

    def averages(self, record: Record) -> dict[str, np.ndarray]:
        """Responses to every kick."""
        return kick_series(record.moments, self.kick, self.times())

    def window(self, series: dict[str, np.ndarray], weights: np.ndarray) -> dict[str, np.ndarray]:
        """Every kick counts alike."""
        return {name: np.mean(values, axis=1) for name, values in series.items()}

    def observables(self, means: dict) -> dict:
        """Coefficients, their tails, and the responses."""
        return coefficients(means)

    def axes(self, options: Options) -> dict:
        """Times after a kick."""
        return {"lag": (self.times(), {"long_name": "reduced time s", "units": "τ0"})}
