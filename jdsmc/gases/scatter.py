"""Directions of collisions of hard spheres and disks.

For hard spheres the impact parameter is uniform over the cross section. In three dimensions the
outgoing relative velocity of an *elastic* collision is then isotropic; in two dimensions the sine
of the angle between the line of centres and the relative velocity is uniform. Choosing the line of
centres uniformly instead loses a third of the inelastic energy loss.
"""

import jax
import jax.numpy as jnp

from ..random import sin_cos_turns


@jax.custom_jvp
def root(square):
    """√x, with a derivative of zero at zero: of an empty seat or layer nothing depends on anything.

    (That of `jnp.sqrt` is infinite there, and infinity times the weight zero is not a number.)
    """
    return jnp.sqrt(square)


@root.defjvp
def _slope_of_root(primals, tangents):
    value = jnp.sqrt(primals[0])
    some = value > 0
    return value, jnp.where(some, 0.5 * tangents[0] / jnp.where(some, value, 1.0), 0.0)


def elastic_outgoing(relative_velocity, speed, first, second):
    """Relative velocity after an elastic collision of hard spheres (3 components) or disks (2).

    Arguments: components of the relative velocity, its magnitude, and two uniform numbers in
    (0, 1), all of one shape (disks use only the first number).
    Returns: components of the outgoing relative velocity.
    """
    if len(relative_velocity) == 2:
        return _disk_outgoing(relative_velocity, first)
    cosine = 2.0 * first - 1.0
    sine = jnp.sqrt(1.0 - cosine * cosine)
    sin_phi, cos_phi = sin_cos_turns(second)
    return speed * sine * cos_phi, speed * sine * sin_phi, speed * cosine


def _disk_outgoing(relative_velocity, uniform):
    """Reflect g about a line of centres whose angle θ to g has a uniform sin θ = b."""
    gx, gy = relative_velocity
    b = 2.0 * uniform - 1.0
    along, across = 2.0 * b * b - 1.0, -2.0 * b * jnp.sqrt(1.0 - b * b)
    return along * gx - across * gy, along * gy + across * gx
