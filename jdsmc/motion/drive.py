"""Velocity-only flows between collisions, each solved exactly."""

import jax.numpy as jnp

from ..sums import mean
from ..types import Particles, Scalar, Velocity


def shear(velocity: Velocity, strain: Scalar) -> Velocity:
    """Inertial force -m a V_y x̂ over a time t, strain = a t: eq. (4.21)."""
    vx, vy, *rest = velocity
    return (vx - strain * vy, vy, *rest)


def sheared_drag(
    velocity: Velocity, shear_rate: Scalar, coefficient: Scalar, duration: Scalar
) -> Velocity:
    """Shear and a drag γ = (c/2)√(2T(t)) acting together, exactly.

    A uniform scaling commutes with the linear shear, so V(t) = e^{-Γ} U(t) with U sheared freely
    and dΓ/dt = (c/2) e^{-Γ} √(2 T_U(t)), T_U(t) = T - (2a/3) P_xy t + (a²/3) P_yy t² per particle.
    Hence e^Γ = 1 + (c/2) ∫√(2 T_U) dt; Simpson's rule leaves an error of fifth order in the step.
    Without shear this is √T(t) = √T(0)/(1 + c√(2T(0)) t/2), Haff's law.
    """
    vx, vy, *_ = velocity
    dimension = len(velocity)
    energy = mean(sum(v * v for v in velocity))
    xy, yy = mean(vx * vy), mean(vy * vy)

    def thermal_speed(time):
        strain = shear_rate * time
        return jnp.sqrt((2.0 / dimension) * (energy - 2.0 * strain * xy + strain * strain * yy))

    integral = (duration / 6.0) * (
        thermal_speed(0.0) + 4.0 * thermal_speed(0.5 * duration) + thermal_speed(duration)
    )
    factor = 1.0 / (1.0 + 0.5 * coefficient * integral)
    return tuple(factor * v for v in shear(velocity, shear_rate * duration))


def centred(velocity: Particles) -> Particles:
    """Subtract the mean velocity: removes the drift that rounding lets in."""
    return tuple(v - mean(v) for v in velocity)


def temperature_of(velocity: Particles) -> Scalar:
    """T = m⟨V²⟩/d."""
    return mean(sum(v * v for v in velocity)) / len(velocity)


def held_at(velocity: Particles, temperature) -> tuple[Particles, Scalar]:
    """Velocities of mean zero scaled to a temperature, and the factor they were scaled with."""
    velocity = centred(velocity)
    factor = jnp.sqrt(temperature / temperature_of(velocity))
    return tuple(factor * v for v in velocity), factor
