"""The physics of one pair: how often two particles collide and what a collision does.

Units: m = 1, λ0 = 1, v0 = √(2 T0/m) = 1, hence τ0 = 1 and T0 = 1/2, at the mean density.
"""

import math
from abc import abstractmethod
from typing import Any, ClassVar, Literal

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from . import check
from .types import Physical

INITIAL_TEMPERATURE = 0.5
"""T0 in units of m v0²: with v0 = √(2 T0/m) = 1."""


class AbstractGas(eqx.Module):
    """A gas of identical particles: pair rate, collision rule, and drag if there is one.

    A new gas states three things. `rate` is the collision rate of a pair, g for hard spheres;
    `momentum_transfer` maps the relative velocity before and after an *elastic* collision of the
    same geometry to the momentum the first particle loses; `drag_coefficient` c makes the
    friction ζ = c √(2T), zero for none. `frictional` is static: a gas without drag pays nothing.
    `viscosity_exponent` is ω in η, κ ∝ T^ω.
    """

    frictional: eqx.AbstractClassVar[bool]
    viscosity_exponent: eqx.AbstractClassVar[float]

    @property
    @abstractmethod
    def measured_drag(self) -> bool:
        """True if the drag is scaled with the measured relative speeds."""

    @abstractmethod
    def is_dissipative(self) -> bool:
        """True if the gas cools at every point of a sweep (asked on the host)."""

    @abstractmethod
    def rate(self, speed) -> Any:
        """Collision rate of a pair, in units of the hard-sphere rate per unit relative speed."""

    @abstractmethod
    def momentum_transfer(self, relative_velocity, outgoing) -> Any:
        """Momentum given by the first to the second particle, component by component."""

    @abstractmethod
    def drag_coefficient(self) -> Any:
        """c in ζ = c √(2T): twice the friction constant γ over √(2T)."""

    @abstractmethod
    def local_collision_factor(self) -> Any:
        """Local-equilibrium collision frequency over that of hard spheres of diameter σ."""


class InelasticHardSpheres(AbstractGas):
    """Smooth inelastic hard spheres (IHS) with constant normal restitution.

    Arguments: `restitution` α in (0, 1], a number or, for a sweep, a one-dimensional array.
    Raises ValueError outside that range. Collision rule: eq. (2.8) of Astillero and Santos.
    """

    restitution: Physical = eqx.field(converter=check.physical)
    frictional: ClassVar[bool] = False
    viscosity_exponent: ClassVar[float] = 0.5

    def __check_init__(self):
        check.in_range("restitution", self.restitution, 0.0, 1.0, low_included=False)

    @property
    def measured_drag(self) -> bool:
        return False

    def is_dissipative(self) -> bool:
        return bool(np.all(self.restitution < 1))

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        share = (1.0 + self.restitution) / 4.0
        return tuple(share * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))

    def drag_coefficient(self):
        return jnp.zeros_like(jnp.asarray(self.restitution))

    def local_collision_factor(self):
        return jnp.ones_like(jnp.asarray(self.restitution))


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
    Raises ValueError for values outside these. Source: Astillero and Santos, eqs. (2.20), (2.21).
    """

    restitution: Physical = eqx.field(converter=check.physical)
    rate_factor: Physical = eqx.field(
        default="linear", converter=lambda b: b if isinstance(b, str) else check.physical(b)
    )
    drag: Literal["local", "measured"] = eqx.field(default="local", static=True)
    frictional: ClassVar[bool] = True
    viscosity_exponent: ClassVar[float] = 0.5

    def __check_init__(self):
        check.in_range("restitution", self.restitution, 0.0, 1.0, low_included=False)
        check.one_of("drag", self.drag, ("local", "measured"))
        if isinstance(self.rate_factor, str):
            check.one_of("rate_factor", self.rate_factor, (*RATE_FACTORS, "a number"))
        else:
            check.in_range("rate_factor", self.rate_factor, 0.0, 2.0, low_included=False)

    @property
    def measured_drag(self) -> bool:
        return self.drag == "measured"

    def is_dissipative(self) -> bool:
        return bool(np.all(self.restitution < 1))

    def local_collision_factor(self):
        if isinstance(self.rate_factor, str):
            return RATE_FACTORS[self.rate_factor](self.restitution)
        return self.rate_factor

    def rate(self, speed):
        return self.local_collision_factor() * speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))

    def drag_coefficient(self):
        """ζ0 = 2(1-α²)/(3√π τ) with τ = 1/√(2T): eq. (2.16)."""
        return (2.0 / (3.0 * math.sqrt(math.pi))) * (1.0 - self.restitution**2)


MAXWELL_RATE = 16.0 * math.sqrt(2.0 / math.pi) / 5.0
"""Pair rate of Maxwell molecules, as a relative speed of hard spheres: their viscosity at T0 is the
first approximation for hard spheres. Isotropic scattering halves the stress of two particles a
collision, so that nT/η = n MAXWELL_RATE/(2√2), to be 8/(5√π)."""


class MaxwellMolecules(AbstractGas):
    """Elastic molecules that collide at a rate independent of their relative speed, isotropically.

    Viscosity and conductivity are proportional to T, and those of hard spheres (first
    approximation) at T0. Moments of their Boltzmann equation form closed hierarchies, so that exact
    solutions are known: what hard spheres can be checked against only by expansions.
    """

    frictional: ClassVar[bool] = False
    viscosity_exponent: ClassVar[float] = 1.0

    @property
    def measured_drag(self) -> bool:
        return False

    def is_dissipative(self) -> bool:
        return False

    def rate(self, speed):
        return jnp.full_like(speed, MAXWELL_RATE)

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))

    def drag_coefficient(self):
        return jnp.zeros(())

    def local_collision_factor(self):
        """That of T0, where hard spheres have a mean relative speed of √(16 T0/π)."""
        return jnp.asarray(MAXWELL_RATE / math.sqrt(8.0 / math.pi))
