"""Walls: what they emit, against closed forms and quadrature."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy import integrate

from jdsmc import random
from jdsmc.motion.walls import LARGEST_X, Walls, flux_density, speed_table, wall_gradients

f32 = jnp.float32
COUNT = 400_000


def _emitted(walls, top):
    key = random.key_from_seed(3)
    at_top = jnp.full(COUNT, top)
    arriving = tuple(jnp.zeros(COUNT, f32) for _ in range(3))
    back = walls.give_back(key, 0, jnp.arange(COUNT), at_top, arriving)
    return [np.asarray(v, float) for v in back]


def _check(values, expected):
    error = np.std(values) / np.sqrt(len(values))
    assert abs(np.mean(values) - expected) < 4 * error


@pytest.mark.parametrize(("top", "temperature"), [(False, 0.05), (True, 1.0)])
def test_maxwell_wall_emits_the_flux_of_a_maxwellian(top, temperature):
    """⟨v_n⟩ = √π w/2, ⟨v_n²⟩ = w², ⟨v_x²⟩ = w²/2: not those of a gas, ⟨v_n²⟩ = w²/2."""
    vx, vy, vz = _emitted(Walls.maxwell(f32(0.05)), top)
    away = -vz if top else vz
    thermal = np.sqrt(temperature)
    assert np.all(away > 0)
    _check(away, np.sqrt(np.pi) / 2 * thermal)
    _check(away**2, temperature)
    for v in (vx, vy):
        _check(v, 0.0)
        _check(v**2, temperature / 2)
    _check(vx * vz, 0.0)
    _check(vx**4, 0.75 * temperature**2)


def test_walls_in_motion_absorb_a_share_and_mirror_the_rest():
    """A share χ leaves with ⟨v_x⟩ and temperature of the wall, the others as they came."""
    share, motion = 0.3, np.array([-0.4, 1.1])
    rest = Walls.maxwell(f32(0.25))
    walls = Walls(rest.speed, None, jnp.asarray(motion, f32), f32(share))
    top = jnp.arange(COUNT) % 2 == 1
    old = (2.0, -3.0, 5.0)
    arriving = tuple(jnp.full(COUNT, v, f32) for v in (*old[:2], old[2]))
    arriving = (*arriving[:2], jnp.where(top, arriving[2], -arriving[2]))
    back = walls.give_back(random.key_from_seed(3), 0, jnp.arange(COUNT), top, arriving)
    vx, vy, vz = (np.asarray(v, float) for v in back)
    away = np.where(top, -vz, vz)
    assert np.all(away > 0)
    mirrored = (vx == old[0]) & (vy == old[1]) & (away == old[2])
    _check(~mirrored, share)
    for wall, temperature in ((0, 0.25), (1, 1.0)):
        here = ~mirrored & (np.asarray(top) == bool(wall))
        _check(vx[here], motion[wall])
        _check((vx[here] - motion[wall]) ** 2, temperature / 2)
        _check(vy[here], 0.0)
        _check(away[here] ** 2, temperature)


def _quadrature(gradient, cold, power):
    """∫du u^power |u|φ(u) by eq. (18) as printed: over τ first, adaptively."""

    def density(u):
        def integrand(tau):
            return tau**-1.5 * np.exp(-abs(1 - tau) / (gradient * u) - u * u / tau)

        reach = 60 * gradient * u
        ends = (max(0.0, 1 - reach), 1.0) if cold else (1.0, 1.0 + reach)
        return integrate.quad(integrand, *ends, limit=400)[0]

    grid = np.linspace(np.log(1e-3), np.log(8.0 if cold else 400.0), 700)
    u = np.exp(grid)
    return np.trapezoid([density(x) * x ** (power + 1) for x in u], grid)


@pytest.mark.parametrize("cold", [True, False])
@pytest.mark.parametrize("gradient", [0.01, 0.3, 3.0, 5.0])
def test_type_two_moments_against_quadrature(gradient, cold):
    """Moments of the sampled distribution, sampled at the quantiles instead of at random.

    2e-4: a sum over the table instead of an integral; a random number of 24 bits leaves out the
    last 6e-8 of the far tail at the hot wall, 3e-4 of ⟨u²⟩ at ε = 5 (0.3 in the paper).
    """
    table = np.asarray(speed_table(f32(gradient), cold), float)
    x = np.linspace(0, LARGEST_X, 100_001)
    weight = 2 * x * np.exp(-(x**2))
    u = np.interp(x, np.linspace(0, LARGEST_X, len(table)), table)
    norm = _quadrature(gradient, cold, 0)
    for power in (1, 2):
        sampled = np.trapezoid(weight * u**power, x) / np.trapezoid(weight, x)
        expected = _quadrature(gradient, cold, power) / norm
        assert sampled == pytest.approx(expected, rel=2e-4 if gradient < 5 else 5e-4)


def test_type_two_sampling_follows_its_table():
    walls = Walls.bgk(f32(0.05), f32(10.0))
    assert walls.table is not None
    x = np.linspace(0, LARGEST_X, 100_001)
    weight = 2 * x * np.exp(-(x**2))
    for top, thermal in ((False, np.sqrt(0.05)), (True, 1.0)):
        vz = np.abs(_emitted(walls, top)[2])
        table = np.asarray(walls.table[int(top)], float)
        u = np.interp(x, np.linspace(0, LARGEST_X, len(table)), table)
        for power in (1, 2, 3):
            expected = np.trapezoid(weight * u**power, x) / np.trapezoid(weight, x)
            _check((vz / thermal) ** power, expected)


def test_type_two_becomes_maxwellian_for_weak_gradients():
    """Below eq. (18): for ε -> 0 it is eq. (17). The first correction is of order ε."""
    for cold in (True, False):
        table = np.asarray(speed_table(f32(1e-3), cold), float)
        x = np.linspace(0, LARGEST_X, len(table))
        inner = (x > 0.05) & (x < 3.5)
        np.testing.assert_allclose(table[inner], x[inner], rtol=5e-3)


def test_gradients_at_the_walls():
    """Eq. (19); design: about 3.0 at the cold wall for T_- = 0.01, L = 10."""
    cold, hot = wall_gradients(jnp.float32(0.01), jnp.float32(10.0))
    assert float(cold) == pytest.approx(2.991, abs=2e-3)
    assert float(hot) == pytest.approx(0.2991, abs=2e-4)


def test_flux_density_is_finite_at_all_speeds():
    speeds = jnp.asarray(np.geomspace(1e-4, 2e3, 50), f32)
    for cold in (True, False):
        density = jax.jit(flux_density, static_argnums=1)(f32(0.3), cold, speeds)
        assert np.all(np.isfinite(density)) and np.all(np.asarray(density) >= 0)
