"""What two walls give back: velocities of particles emitted by a bath behind each.

Tahiri, Tij and Santos, "Monte Carlo simulation of a hard-sphere gas in the planar Fourier flow with
a gravity field" (2000), section 2. A particle that hits a wall is absorbed and replaced by one with
the density |v_z| φ(v), eq. (15), φ being a Maxwellian (type I, eq. 17) or the distribution of the
BGK model under heat conduction (type II, eq. 18). Walls may move along x, and may reflect a share
of the particles as a mirror does.

Speeds away from the wall are sampled as w u(x), w = √(2T/m) of the wall and x = √(-ln p) for a
uniform p: the Maxwellian has u(x) = x, the other one a table of u at equal steps of x.
"""

from functools import partial

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .. import random
from ..gases.scatter import root
from ..types import Key, Positions, Scalar, Velocities

LARGEST_X = 4.2
"""√(-ln p) of the smallest p of 24 bits is 4.16."""
TABLE = 512
"""Steps of the table; doubling it moves no moment by more than 1e-5."""

STEEPEST = 20.0, 5.0
"""Largest ε_- and ε_+ of the tables: moments are right to 5e-4 up to there, and off by 1e-3 at
ε_- = 26, by 6e-3 at ε_+ = 8. Most speeds then lie between the first two entries, or beyond the last
random number."""

FLATTEST = 1e-4
"""Smallest ε of a table: eq. (18) for ε → 0 is a Maxwellian, and to 3e-4 it is one here."""

_LOG_SPEED = np.linspace(np.log(1e-4), np.log(2e3), 2048)
"""Logarithms of u: the survival function is computed at these, from 1 down to below 1e-8."""
_LOG_DEPTH = np.linspace(np.log(1e-8), np.log(1e4), 320)
"""Logarithms of the integration variable of eq. (18): |1 - τ|/τ or |1 - τ|."""


class Walls(eqx.Module):
    """The walls at z = 0 and z = L: thermal speeds √(2T/m), and tables of u(x) or None.

    `velocity`: of each wall along x, None at rest. `accommodation`: probability that a particle is
    absorbed and emitted anew, else it is reflected as by a mirror (Maxwell 1879); None for 1.
    """

    speed: Float[Array, "2"]
    table: Float[Array, "2 steps"] | None
    velocity: Float[Array, "2"] | None = None
    accommodation: Scalar | None = None

    @staticmethod
    def of(kind: str, cold_temperature: Scalar, length: Scalar) -> "Walls":
        """Walls of type I ("maxwell") or II ("bgk")."""
        if kind == "bgk":
            return Walls.bgk(cold_temperature, length)
        return Walls.maxwell(cold_temperature)

    @staticmethod
    def maxwell(cold_temperature: Scalar) -> "Walls":
        """Type I walls at T_- and T_+ = T0."""
        return Walls(jnp.stack([jnp.sqrt(cold_temperature), jnp.ones_like(cold_temperature)]), None)

    @staticmethod
    def bgk(cold_temperature: Scalar, length: Scalar) -> "Walls":
        """Type II walls; `cold_temperature` is T_-/T_+, `length` is L in λ0."""
        walls = Walls.maxwell(cold_temperature)
        cold, hot = wall_gradients(cold_temperature, length)
        return Walls(walls.speed, jnp.stack([speed_table(cold, True), speed_table(hot, False)]))

    def give_back(
        self, key: Key, stream, who: Array, at_top: Array, arriving: Velocities
    ) -> Velocities:
        """Velocities (x, y, z) away from the wall at z = 0, or z = L, of particles that arrive.

        Random numbers come from `stream` of the key and the one after it, at the number of each
        particle, `who`: they do not depend on which others are asked for.
        """
        dtype = arriving[2].dtype
        first, second = (random.words(key, who, stream + k) for k in (0, 1))
        radius = jnp.sqrt(-jnp.log(random.unit_interval(first[0], dtype)))
        sine, cosine = random.sin_cos_turns(random.unit_interval(first[1], dtype))
        x = jnp.sqrt(-jnp.log(random.unit_interval(second[0], dtype)))
        wall = at_top.astype(jnp.int32)
        thermal = jnp.where(at_top, self.speed[1], self.speed[0])
        away = thermal * (x if self.table is None else interpolate(self.table, wall, x))
        tangential = thermal * radius
        along = tangential * cosine
        if self.velocity is not None:
            along = along + jnp.where(at_top, self.velocity[1], self.velocity[0])
        emitted = along, tangential * sine, jnp.where(at_top, -away, away)
        if self.accommodation is None:
            return emitted
        absorbed = random.unit_interval(second[1], dtype) < self.accommodation
        vx, vy, vz = arriving
        mirrored = (vx, vy, -vz)
        return tuple(jnp.where(absorbed, a, b) for a, b in zip(emitted, mirrored, strict=True))


@partial(jax.custom_jvp, nondiff_argnums=(0,))
def made_before(kind: str, cold_temperature: Scalar, length: Scalar, walls: Walls) -> Walls:
    """The walls of these numbers that were made before; derivatives are those of making them now.

    Tables take time to make: a run makes them once, and their derivatives only where asked for.
    """
    return walls


@made_before.defjvp
def _made_again(kind: str, primals, tangents):
    numbers, walls = primals[:2], primals[2]
    _, change = jax.jvp(partial(Walls.of, kind), numbers, tangents[:2])
    return walls, change


def interpolate(table: Float[Array, "2 steps"], wall: Array, x: Positions) -> Positions:
    """u(x), linear between the entries of the table of each particle's wall."""
    steps = table.shape[1] - 1
    place = x * (steps / LARGEST_X)
    index = jnp.clip(place.astype(jnp.int32), 0, steps - 1)
    flat = wall * (steps + 1) + index
    low = table.ravel().at[flat].get(mode="promise_in_bounds")
    high = table.ravel().at[flat + 1].get(mode="promise_in_bounds")
    return low + (place - index.astype(x.dtype)) * (high - low)


def wall_gradients(cold_temperature, length):
    """ε_- and ε_+ of eq. (19), with T_+ = 1 and λ0 = 1/(√2 π n̄ σ²) = 1."""
    root = jnp.sqrt(cold_temperature)
    hot = (15.0 * np.pi**0.5 / 8.0) * (1.0 - root) / length
    return hot / root, hot


def check_gradients(cold_temperature: float, length: float) -> None:
    """Raise ValueError for type II walls whose tables would be wrong."""
    root = np.sqrt(cold_temperature)
    hot = (15.0 * np.pi**0.5 / 8.0) * (1.0 - root) / length
    excess = max(hot / root / STEEPEST[0], hot / STEEPEST[1])
    if excess > 1.0:
        raise ValueError(
            f'wall = "bgk" at cold_temperature = {cold_temperature:g} and length = {length:g} has '
            f"the gradients ε = {hot / root:.3g} and {hot:.3g} at its walls, and at most "
            f"{STEEPEST[0]:g} and {STEEPEST[1]:g} are right: the allowed range of length is "
            f"[{excess * length:.3g}, 1000]."
        )


def flux_density(gradient: Scalar, cold: bool, speed):
    """|u| φ(u) of eq. (18) up to a constant factor, for speeds u > 0 away from the wall.

    With τ = 1/(1+y) at the cold wall (τ < 1) and τ = 1 + y at the hot one,
    ∫dτ τ^{-3/2} exp(-|1-τ|/(εu) - u²/τ) = ∫dy (1+y)^{-1/2} exp(-y/((1+y)εu) - u²(1+y)), and
    = ∫dy (1+y)^{-3/2} exp(-y/(εu) - u²/(1+y)); trapezoidal rule in ln y.
    """
    y = jnp.asarray(np.exp(_LOG_DEPTH), gradient.dtype).reshape((1,) * speed.ndim + (-1,))
    depth = gradient * speed[..., None]
    square = (speed * speed)[..., None]
    if cold:
        exponent = -y / ((1.0 + y) * depth) - square * (1.0 + y)
        weight = y / jnp.sqrt(1.0 + y)
    else:
        exponent = -y / depth - square / (1.0 + y)
        weight = y / (1.0 + y) ** 1.5
    return jnp.sum(weight * jnp.exp(exponent), axis=-1) * float(_LOG_DEPTH[1] - _LOG_DEPTH[0])


def speed_table(gradient: Scalar, cold: bool) -> Float[Array, " steps"]:
    """u at TABLE + 1 equal steps of x = √(-ln P), P being the probability of a larger u."""
    gradient = jnp.maximum(gradient, FLATTEST)
    speed = jnp.asarray(np.exp(_LOG_SPEED), gradient.dtype)
    density = flux_density(gradient, cold, speed) * speed
    pieces = 0.5 * (density[1:] + density[:-1])
    above = jnp.cumsum(pieces[::-1])[::-1]
    survival = jnp.append(above / above[0], 0.0)
    x = root(-jnp.log(jnp.maximum(survival, 1e-30)))
    at = jnp.asarray(np.linspace(0.0, LARGEST_X, TABLE + 1), gradient.dtype)
    return jnp.interp(at, x, speed).at[0].set(0.0)
