"""The physics of one pair: how often two particles collide and what a collision does.

Units: m = 1, λ0 = 1, v0 = √(2 T0/m) = 1, hence τ0 = 1 and T0 = 1/2, at the mean density.
"""

from abc import abstractmethod
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from .. import sweep
from ..fields import as_html, check_fields, plain_methods, text
from . import local
from .rules import check_rules


class AbstractGas(eqx.Module):
    """A gas of identical particles: the collision rate of a pair, and the collision rule.

    A new gas states two things, `rate` and `momentum_transfer`. The rest is found from these by
    quadrature, or stated by a gas that knows it in closed form. For instance, spheres whose
    restitution falls with the impact speed:

        class Viscoelastic(jdsmc.AbstractGas):
            dissipation: Any = jdsmc.number("A in α = 1 - A g^{1/5}", low=0.0, high=1.0)

            def rate(self, speed):
                return speed

            def momentum_transfer(self, relative_velocity, outgoing):
                pairs = list(zip(relative_velocity, outgoing, strict=True))
                normal = 0.5 * jnp.sqrt(sum((g - e) ** 2 for g, e in pairs))  # impact speed
                share = (2.0 - self.dissipation * normal**0.2) / 4.0
                return tuple(share * (g - e) for g, e in pairs)

    `dimension` is the number of velocity components. Numbers may be arrays (sweeps); every method
    but `check` sees scalars.
    """

    dimension: ClassVar[int] = 3

    __getattribute__ = plain_methods

    def __check_init__(self):
        check_fields(self)

    def __repr__(self) -> str:
        return text(self)

    def _repr_html_(self) -> str:
        return as_html(self)

    @abstractmethod
    def rate(self, speed) -> Any:
        """Collision rate of a pair at a relative speed (v0): `speed` itself for hard spheres."""

    @abstractmethod
    def momentum_transfer(self, relative_velocity, outgoing) -> Any:
        """Momentum given by the first to the second particle, component by component.

        `outgoing` is the relative velocity after an *elastic* collision of the same geometry.
        """

    def transfer_share(self) -> Any:
        """s of a gas of spheres that transfers s (g - g') whatever the pair, traced; else None.

        Averages over directions are then known in closed form: such a gas is simulated faster (see
        `measure.balance`), and its derivatives have less noise.
        """
        return None

    # What follows is asked on the host, of one gas.

    def speed_exponent(self) -> float | None:
        """γ of a rate ∝ g^γ whose collision rule has no scale of speed; None if there is one.

        1 for hard spheres and 0 for Maxwell molecules: multiplying all velocities by a number is
        then a change of the unit of time, and η, κ ∝ T^{1-γ/2}.
        """
        return local.speed_exponent(self)

    def collision_rate(self, temperature):
        """Collisions per particle and time (1/τ0) of a Maxwellian at T (m v0²), mean density."""
        return local.collision_rate(self, temperature)

    def energy_loss_rate(self, temperature):
        """Energy lost in collisions per particle and time (m v0²/τ0) of such a Maxwellian."""
        return local.energy_loss_rate(self, temperature)


def check_gas(gas) -> None:
    """Raise TypeError for what is no gas, and for one whose methods return nonsense."""
    if not isinstance(gas, AbstractGas):
        raise TypeError(f"gas must be a jdsmc gas, got {gas!r}.")
    check_rules(gas)


def pair_rate(gas: AbstractGas, speed: Array) -> Array:
    """The rate of pairs, of the shape and type of their relative speeds; traced.

    A gas whose rate does not depend on the speed may state one number.
    """
    return jnp.broadcast_to(jnp.asarray(gas.rate(speed), speed.dtype), speed.shape)


def check_share(gas: AbstractGas) -> None:
    """Raise ValueError for one gas whose `transfer_share` is not what it transfers."""
    share = gas.transfer_share()
    if share is not None and (np.ndim(share) or np.asarray(share).dtype.kind not in "fiu"):
        raise TypeError(
            f"{type(gas).__name__}.transfer_share must return one number, or None; got {share!r}."
        )
    if share is not None and not (gas.dimension == 3 and local.transfers(gas, share)):
        raise ValueError(
            f"{type(gas).__name__}.transfer_share gives {float(share):g}, and momentum_transfer is "
            "no such share of g - g' of spheres; return None for a gas that has none."
        )


def speed_exponent(gas: AbstractGas) -> float | None:
    """The common exponent of a swept gas; None if a point has none or another."""
    found = {one.speed_exponent() for one in sweep.points(gas)[0]}
    return found.pop() if len(found) == 1 else None


def power_law(gas: AbstractGas) -> float:
    """The common exponent of a swept gas; ValueError if it has none."""
    exponent = speed_exponent(gas)
    if exponent is None:
        raise ValueError(f"the pair rate of {type(gas).__name__} is no power of the speed.")
    return exponent


def energy_loss_rates(gas: AbstractGas) -> np.ndarray:
    """Energy that one gas loses in collisions at temperatures of many decades."""
    rates = np.asarray(gas.energy_loss_rate(local.TEMPERATURES), dtype=float)
    return np.broadcast_to(rates, local.TEMPERATURES.shape)


def conserves_energy(gas: AbstractGas) -> bool:
    """True if no point of a swept gas loses energy in collisions or makes any, however warm."""
    return all(np.all(energy_loss_rates(one) == 0) for one in sweep.points(gas)[0])
