"""Flows between collisions against their closed forms and an ODE solver."""

import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from jdsmc.motion.drive import shear, sheared_drag

from ..helpers import f32, maxwellian, options, sums

OPTIONS = options(1000)


def test_shear_is_the_free_flow():
    """V_x - a t V_y; two half strains are one whole, to rounding."""
    velocity = maxwellian(1, OPTIONS)
    once = shear(velocity, f32(0.4))
    twice = shear(shear(velocity, f32(0.2)), f32(0.2))
    np.testing.assert_allclose(once[0], velocity[0] - 0.4 * velocity[1], atol=1e-6)
    np.testing.assert_allclose(once[0], twice[0], atol=1e-6)
    assert once[1] is velocity[1]


def test_drag_alone_is_haffs_law():
    """√T(t) = √T(0)/(1 + c√(2T(0)) t/2), whatever the step: exact to float32 rounding."""
    velocity, c, t = maxwellian(1, OPTIONS), 0.3, 5.0
    after = sheared_drag(velocity, f32(0.0), f32(c), f32(t))
    factor = 1 / (1 + 0.5 * c * t)  # √(2T) = 1 at the start
    assert sums(after)[1] == pytest.approx(0.75 * factor**2, rel=1e-6)


@pytest.mark.parametrize("duration", [0.05, 0.2])
def test_shear_with_drag_against_an_ode_solver(duration):
    """dV/dt = -a V_y x̂ - (c/2)√(2T) V for 1000 particles; Simpson's error is O(dt^5): < 2e-6."""
    velocity, a, c = maxwellian(2, OPTIONS), 4.0, 0.5
    start = np.array([np.asarray(v, float).ravel() for v in velocity])

    def rate(_, flat):
        v = flat.reshape(3, -1)
        speed = np.sqrt(2 * np.mean(np.sum(v**2, axis=0)) / 3)
        out = -0.5 * c * speed * v
        out[0] -= a * v[1]
        return out.ravel()

    exact = solve_ivp(rate, (0, duration), start.ravel(), rtol=1e-9, atol=1e-10).y[:, -1]
    after = sheared_drag(velocity, f32(a), f32(c), f32(duration))
    ours = np.array([np.asarray(v, float).ravel() for v in after]).ravel()
    np.testing.assert_allclose(ours, exact, atol=5e-6)


def test_drag_is_fifth_order_in_one_step():
    """Halving the step divides the error by 2^5 in the limit; by 20 at this size."""
    rng = np.random.default_rng(1)
    v = rng.normal(size=(3, 4000))
    v[0] -= 0.7 * v[1]  # a stress, so that T is not stationary
    a, c = 3.0, 0.5
    e, xy, yy = np.mean(np.sum(v**2, 0)), np.mean(v[0] * v[1]), np.mean(v[1] ** 2)

    def factor(h):
        after = sheared_drag(
            tuple(jnp.asarray(x, jnp.float32)[None] for x in v), f32(a), f32(c), f32(h)
        )
        return float(np.mean(np.asarray(after[2], float)[0] / v[2]))

    def exact(h):
        t = np.linspace(0, h, 2001)
        integrand = np.sqrt(2 / 3 * (e - 2 * a * t * xy + (a * t) ** 2 * yy))
        return 1 / (1 + 0.5 * c * np.trapezoid(integrand, t))

    # at h = 0.4 the error is still visible above float32 rounding (1e-7); order 4 to 5
    errors = [abs(factor(h) - exact(h)) for h in (0.8, 0.4)]
    assert errors[1] > 1e-6
    assert errors[0] / errors[1] > 2**4
