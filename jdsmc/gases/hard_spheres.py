"""Hard spheres and disks with constant restitution, and elastic spheres under a drag."""

import math
from typing import Any, ClassVar, Literal

import numpy as np

from ..fields import choice, number
from ..units import COOLING, INITIAL_TEMPERATURE
from .base import AbstractGas, energy_loss_rates

MEAN_RATE = math.sqrt(2.0 / math.pi)
"""Collisions per particle and time of hard spheres over √T: eq. (3.11) of Astillero and Santos."""


def restitution_field():
    """α in (0, 1]."""
    meaning = "coefficient of normal restitution α"
    return number(meaning, low=0.0, high=1.0, low_included=False, example=0.9)


def share(restitution):
    """c of the momentum c (g - e) that is transferred along the line of centres."""
    return (1.0 + restitution) / 4.0


def normal_transfer(restitution, relative_velocity, outgoing):
    """(1+α)/2 of what is exchanged along the line of centres; elastic particles exchange it all."""
    c = share(restitution)
    return tuple(c * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


class InelasticHardSpheres(AbstractGas):
    """Smooth inelastic hard spheres (IHS) with constant normal restitution.

    Arguments: `restitution` α in (0, 1], a number or, for a sweep, a one-dimensional array.
    Raises ValueError outside that range. Collision rule: eq. (2.8) of Astillero and Santos.
    """

    restitution: Any = restitution_field()

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return normal_transfer(self.restitution, relative_velocity, outgoing)

    def transfer_share(self) -> Any:
        return share(self.restitution)

    def speed_exponent(self) -> float:
        return 1.0

    def collision_rate(self, temperature):
        return MEAN_RATE * np.sqrt(temperature)

    def energy_loss_rate(self, temperature):
        """(3/2) ζ0 T with ζ0 = 2(1-α²)/(3√π τ), eq. (2.16)."""
        return (1.0 - self.restitution**2) * MEAN_RATE * temperature**1.5


class InelasticHardDisks(AbstractGas):
    """Smooth inelastic hard disks: two velocity components, constant normal restitution.

    Arguments: `restitution` α in (0, 1]. λ0 = 1/(2√2 n̄ σ), so that a pair collides at the same
    rate g/√2N as spheres do. Collision rule: eq. (1) of Costantini and Puglisi (2010).
    """

    restitution: Any = restitution_field()
    dimension: ClassVar[int] = 2

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return normal_transfer(self.restitution, relative_velocity, outgoing)

    def speed_exponent(self) -> float:
        return 1.0

    def collision_rate(self, temperature):
        """⟨g⟩/2√2 with ⟨g⟩ = √(πT)."""
        return math.sqrt(math.pi / 8.0) * np.sqrt(temperature)

    def energy_loss_rate(self, temperature):
        """ζ0 T, ζ0 = √π n σ √T (1-α²) with n σ = 1/2√2."""
        return (1.0 - self.restitution**2) * math.sqrt(math.pi / 8.0) * temperature**1.5


RATE_FACTORS = {
    "linear": lambda alpha: (1.0 + alpha) / 2.0,
    "viscosity": lambda alpha: (1.0 + alpha) * (2.0 + alpha) / 6.0,
}
"""β(α): eq. (2.21), and the alternative of section VI that gives the right viscosity."""


class ElasticHardSpheres(AbstractGas):
    """Elastic hard spheres under a drag that mimics inelastic cooling (EHS).

    Arguments:
        restitution: α in (0, 1] of the inelastic gas to mimic; number or 1-D array.
        rate_factor: β, the collision rate over that of the inelastic gas: "linear" for
            (1+α)/2, "viscosity" for (1+α)(2+α)/6, or a number in (0, 2].
        drag: "local" for γ = ζ0/2, "measured" for γ = (ζ0/2)⟨V12³⟩/⟨V12³⟩0.
        drag_factor: d >= 0 that multiplies this friction, 1 in the paper; number or 1-D array.
    Raises ValueError for values outside these. Source: Astillero and Santos, eqs. (2.20), (2.21).

    In steady shear every reduced stress and cumulant, and a*/β, depends on x = d (1-α²)/β alone:
    divide the Boltzmann equation by β.
    """

    restitution: Any = restitution_field()
    rate_factor: Any = number(
        "collision rate β of the elastic gas over that of the inelastic one",
        low=0.0,
        high=2.0,
        low_included=False,
        default="linear",
        names=tuple(RATE_FACTORS),
    )
    drag: Literal["local", "measured"] = choice(
        "friction of the elastic gas", ("local", "measured"), default="local"
    )
    drag_factor: Any = number(
        "factor d of the friction of the elastic gas", low=0.0, high_included=False, default=1.0
    )

    def collision_factor(self):
        """β as a number."""
        if isinstance(self.rate_factor, str):
            return RATE_FACTORS[self.rate_factor](self.restitution)
        return self.rate_factor

    def rate(self, speed):
        return self.collision_factor() * speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return normal_transfer(1.0, relative_velocity, outgoing)

    def transfer_share(self) -> float:
        return share(1.0)

    def speed_exponent(self) -> float:
        return 1.0

    def collision_rate(self, temperature):
        return self.collision_factor() * MEAN_RATE * np.sqrt(temperature)

    def energy_loss_rate(self, temperature):
        """None: energy goes to the drag, not in collisions."""
        return np.zeros_like(temperature)

    def drag_coefficient(self):
        """c in ζ = c √(2T), twice the friction constant γ: d ζ0, ζ0 = 2(1-α²)/(3√π τ) (2.16)."""
        return self.drag_factor * COOLING * (1.0 - self.restitution**2)


def drag_loss_rate(gas: AbstractGas, temperature):
    """Energy that the drag of a gas takes, per particle and time, at T: (3/2) c √2 T^{3/2}."""
    if not isinstance(gas, ElasticHardSpheres):
        return 0.0 * temperature
    return 1.5 * gas.drag_coefficient() * math.sqrt(2.0) * temperature**1.5


def loses_energy(gas: AbstractGas) -> bool:
    """True if one gas (not a sweep) cools at some temperature, by collisions or drag."""
    drag = drag_loss_rate(gas, INITIAL_TEMPERATURE)
    return bool(drag > 0 or np.any(energy_loss_rates(gas) > 0))
