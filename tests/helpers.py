"""A gas solved in closed form, and helpers that several tests share."""

import jax
import jax.numpy as jnp
import numpy as np

from jdsmc import random
from jdsmc.gas import AbstractGas
from jdsmc.state import HomogeneousState


class MaxwellMolecules(AbstractGas):
    """Elastic, isotropic scattering at a rate that does not depend on the relative speed.

    Every collision keeps the stress of the centre of mass and makes the relative part isotropic:
    a collision halves the pair's traceless stress, which therefore decays as exp(-ν t/2), ν being
    the collisions per particle and time.
    """

    frictional = False
    viscosity_exponent = 1.0
    speed: np.ndarray

    @property
    def measured_drag(self):
        return False

    def is_dissipative(self):
        return False

    def rate(self, speed):
        return self.speed * jnp.ones_like(speed)

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))

    def drag_coefficient(self):
        return jnp.zeros(())

    def local_collision_factor(self):
        return jnp.ones(())


def maxwellian(seed, options, temperature=0.5):
    """Velocities of one realization in equilibrium."""
    return HomogeneousState.maxwellian(random.key_from_seed(seed), options, temperature).velocity


def keys(seed, count):
    """Keys of several realizations."""
    base = random.key_from_seed(seed)
    return jax.vmap(lambda r: random.fold_in(base, r))(jnp.arange(count))


def sums(velocity):
    """Momentum and energy per particle in float64."""
    v = np.array([np.asarray(c, float).ravel() for c in velocity])
    return v.mean(axis=1), 0.5 * np.mean(np.sum(v**2, axis=0))


def f32(x):
    """A number as the step sees it."""
    return jnp.asarray(x, jnp.float32)
