"""Maxwell molecules: the gas whose moments close."""

import math

import jax.numpy as jnp
import numpy as np

from .base import AbstractGas
from .hard_spheres import normal_transfer, share

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

    def rate(self, speed):
        return jnp.full_like(speed, MAXWELL_RATE)

    def momentum_transfer(self, relative_velocity, outgoing):
        return normal_transfer(1.0, relative_velocity, outgoing)

    def transfer_share(self) -> float:
        return share(1.0)

    def speed_exponent(self) -> float:
        return 0.0

    def collision_rate(self, temperature):
        return np.full_like(temperature, MAXWELL_RATE / (2.0 * math.sqrt(2.0)), dtype=float)

    def energy_loss_rate(self, temperature):
        return np.zeros_like(temperature, dtype=float)
