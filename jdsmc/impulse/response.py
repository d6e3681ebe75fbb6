"""The simulation: relax, kick, follow; one record of the engine is one whole kick.

Hard-sphere collisions scale with the velocities. So every copy is scaled back, after every step, to
the temperature T1 that it had after its kick: what the engine steps through is the frame in which
the gas does not cool, and the scale is F = exp(ζs/2), with no value of ζ put in. The kick heats at
second order, T1 = T0 (1 + O(ε²)); s counts the copy's own τ(T1), else it alone would bias η by
-ε²/6.
"""

from math import ceil
from typing import ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Float

from .. import check, random
from ..collide import Collisions, collide
from ..drive import mean
from ..gas import INITIAL_TEMPERATURE, AbstractGas
from ..options import Options
from ..pace import pace
from ..pairs import remix
from ..scenarios.homogeneous_cooling import check_without_drag
from ..state import HomogeneousState, held_at, next_majorant
from ..types import Copies, Key, Physical, Scalar
from .kicks import COPIES, fluxes, kicked

WARM_UP, GAP = 20.0, 4.0
"""Reduced time from a Maxwellian to the first kick, and between two kicks of a sample (τ0).

The fourth cumulant relaxes at about the collision rate, 0.56/τ0: exp(-11) of it is left. Kicks have
collisions of their own; what two kicks share is the sample, whose fluxes decay at 0.35 to 0.6/τ0.
"""


class Responses(eqx.Module):
    """One kick, at time zero and after every step; the last axis is that of the copies.

    `flux`: q_x/n of the first four copies, P_xy/n of the last two (units of v0), the copy held at
    its temperature after the kick; `time`: reduced time s (τ of the copy); `log_growth`: ln F.
    `fourth`: ⟨V⁴⟩ of the sample at T0, before the kick.
    """

    flux: Float[Array, "times copies"]
    time: Float[Array, "times copies"]
    log_growth: Float[Array, "times copies"]
    fourth: Scalar


class KickRecord(eqx.Module):
    """What the engine hands to the host: the responses and the sums over all collision stages."""

    moments: Responses
    tally: Collisions
    elapsed: Scalar


class NavierStokes(eqx.Module):
    """A cooling gas whose sample is copied, kicked six ways and followed, again and again.

    Arguments: `gas`, one without drag; `kick`, ε in (0, 1]; numbers or 1-D arrays. TypeError or
    ValueError otherwise. `options.steps` are the steps that a kick is followed for.
    """

    gas: AbstractGas
    kick: Physical = eqx.field(converter=check.physical)
    kind: ClassVar[str] = "impulse response"

    def __check_init__(self):
        check_without_drag(self.gas, "NavierStokes")
        check.in_range("kick", self.kick, 0.0, 1.0, low_included=False)

    def initial(self, key: Key, options: Options) -> HomogeneousState:
        """A relaxed sample: the cooling state."""
        start = HomogeneousState.maxwellian(key, options, INITIAL_TEMPERATURE)
        state, _ = self.relax(random.fold_in(key, 2), start, WARM_UP, options)
        return state

    def relax(self, key: Key, state: HomogeneousState, duration: float, options: Options):
        """The sample after some reduced time, rows mixed; and the tally of its collisions."""
        held = jnp.asarray(INITIAL_TEMPERATURE, options.dtype)

        def step(state, count):
            majorant, length = pace(held, state.majorant, 0.0, options)
            velocity, tally = collide(
                random.fold_in(key, count), self.gas, options.plan, state.velocity, majorant, length
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
        held = jax.vmap(HomogeneousState.temperature_of)(copies)
        thermal = jnp.sqrt(held / reference)
        zero = jnp.zeros(COPIES, options.dtype)

        def step(carry, count):
            copies, reduced, time, log_growth = carry
            majorant, length = pace(reference, reduced, 0.0, options)
            stage_key = random.fold_in(key, count)

            def one_copy(velocity, temperature):
                velocity, tally = collide(
                    stage_key, self.gas, options.plan, velocity, majorant, length
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
        return state, KickRecord(moments, before.then(tally), jnp.min(time[-1]))

    def finish_chunk(self, state: HomogeneousState) -> tuple[HomogeneousState, None]:
        """Nothing: rows are mixed before every kick."""
        return state, None

    def faults(self, record: KickRecord) -> str:
        """Nothing can fail here that does not fail in every scene."""
        return ""
