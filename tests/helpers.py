"""A gas solved in closed form, gases that state pair physics alone, what several tests share."""

from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

import jdsmc
from jdsmc import random
from jdsmc.scenarios.homogeneous import maxwellian as maxwellian_state
from jdsmc.scenarios.options import Options


class IsotropicMolecules(jdsmc.AbstractGas):
    """Elastic, isotropic scattering at a rate that does not depend on the relative speed.

    Every collision keeps the stress of the centre of mass and makes the relative part isotropic:
    a collision halves the pair's traceless stress, which therefore decays as exp(-ν t/2), ν being
    the collisions per particle and time.
    """

    speed: Any = jdsmc.number("pair rate", "v0", low=0.0)

    def rate(self, speed):
        return self.speed * jnp.ones_like(speed)

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


class PlainSpheres(jdsmc.AbstractGas):
    """`InelasticHardSpheres` by another name, stating nothing but rate and collision rule."""

    alpha: Any = jdsmc.number("restitution", low=0.0, high=1.0, low_included=False)

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        share = (1.0 + self.alpha) / 4.0
        return tuple(share * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


class PlainDisks(PlainSpheres):
    """The same in two dimensions."""

    dimension = 2


class Viscoelastic(jdsmc.AbstractGas):
    """Spheres whose restitution falls with the impact speed: α = 1 - A g_n^{1/5}.

    With σ̂ along g - g' the normal speed is g_n = |g - g'|/2.
    """

    dissipation: Any = jdsmc.number("A in α = 1 - A g_n^{1/5}", low=0.0, high=1.0)

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        change = [g - e for g, e in zip(relative_velocity, outgoing, strict=True)]
        square = sum(c * c for c in change)
        # a power whose derivative at zero is infinite needs a floor under it
        normal = 0.5 * (square + 1e-20) ** 0.5
        share = (2.0 - self.dissipation * normal**0.2) / 4.0
        return tuple(share * c for c in change)


def options(n_particles, time_step=0.1, splitting="strang", dtype="float32", steps=1, **more):
    """Checked options, by the names of `run`."""
    return Options.checked(n_particles, time_step, splitting, dtype, steps, **more)


def maxwellian(seed, options, temperature=0.5):
    """Velocities of one realization in equilibrium."""
    key = seed if isinstance(seed, random.Key) else random.key_from_seed(seed)
    return maxwellian_state(key, options, jdsmc.InelasticHardSpheres(1.0), temperature).velocity


def keys(seed, count):
    """Keys of several realizations."""
    base = random.key_from_seed(seed)
    return jax.vmap(lambda r: random.fold_in(base, r))(jnp.arange(count))


def sums(velocity):
    """Momentum and energy per particle in float64."""
    v = np.array([np.asarray(c, float).ravel() for c in velocity])
    return v.mean(axis=1), 0.5 * np.mean(np.sum(v**2, axis=0))


def differences(one: jdsmc.Result, other: jdsmc.Result, besides: tuple[str, ...] = ()) -> list:
    """Groups in which two results differ in a bit, attributes included but for those `besides`."""
    trees = [result.to_xarray() for result in (one, other)]
    names = sorted({"/"}.union(*(tree.children for tree in trees)))
    found = []
    for name in names:
        if name != "/" and not all(name in tree.children for tree in trees):
            found.append(name)
            continue
        parts = [tree[name].to_dataset() for tree in trees]
        for part in parts:
            part.attrs = {n: x for n, x in part.attrs.items() if n not in besides}
        found += [] if parts[0].identical(parts[1]) else [name]
    return found


def f32(x):
    """A number as the step sees it."""
    return jnp.asarray(x, jnp.float32)
