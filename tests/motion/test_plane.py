"""The periodic square: exact flight, cells that cover it, modes against a plain sum."""

import itertools

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc.motion import plane

from ..helpers import f32

SIDE = 7.3


@pytest.fixture
def double():
    """Arrays of float64."""
    with jax.enable_x64(True):
        yield


def particles(number, seed=1):
    """Positions in the square and velocities of order one."""
    rng = np.random.default_rng(seed)
    return SIDE * rng.random((2, number)), rng.normal(size=(2, number))


@pytest.mark.parametrize("growth", [0.0, 1e-9, 0.0794, 0.5])
def test_flight_is_exact(double, growth):
    """x + w (e^{μh} - 1)/μ and w e^{μh}, eqs. (14), (15), also without growth.

    The series is cut at (μh)⁵/720 of the factor: 4e-12 at μh = 0.035, the largest here.
    """
    place, velocity = particles(200)
    h = 0.07
    at = tuple(map(jnp.asarray, place))
    moving = tuple(map(jnp.asarray, velocity))
    new, faster = plane.fly(at, moving, *map(jnp.asarray, (growth, SIDE, h)))
    length = h if growth == 0.0 else np.expm1(growth * h) / growth
    np.testing.assert_allclose(faster, np.exp(growth * h) * velocity, rtol=1e-11)
    np.testing.assert_allclose(new, (place + velocity * length) % SIDE, rtol=0, atol=1e-10)


def test_flights_add_up(double):
    """Two flights are one of both durations, to the rounding of float64."""
    place, velocity = (tuple(map(jnp.asarray, x)) for x in particles(100))
    numbers = jnp.asarray(0.05), jnp.asarray(SIDE)
    twice = plane.fly(
        *plane.fly(place, velocity, *numbers, jnp.asarray(0.03)), *numbers, jnp.asarray(0.04)
    )
    once = plane.fly(place, velocity, *numbers, jnp.asarray(0.07))
    np.testing.assert_allclose(twice[0], once[0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(twice[1], once[1], rtol=1e-12)


def test_places_stay_inside():
    """[0, L) in float32, however near to a side: -1e-9 must not become L."""
    side = np.float32(SIDE)
    near = np.array([-1e-9, 0.0, SIDE, np.nextafter(side, np.float32(9)), 3 * SIDE], np.float32)
    inside = np.asarray(plane._inside(jnp.asarray(near), jnp.asarray(side)))
    assert np.all((inside >= 0) & (inside < side))


@pytest.mark.parametrize("columns", [1, 3, 45, 100])
def test_cells_cover_the_square(columns):
    """The middle of every cell is in it, each number from 0 to columns² - 1 once; ends too."""
    middles = (np.arange(columns) + 0.5) * SIDE / columns
    x, y = np.array(list(itertools.product(middles, middles)), np.float32).T
    found = np.asarray(plane.cell_of((jnp.asarray(x), jnp.asarray(y)), f32(SIDE), columns))
    assert np.array_equal(found, np.arange(columns**2))
    last = np.nextafter(np.float32(SIDE), np.float32(0))
    ends = jnp.asarray([0.0, last], np.float32)
    assert plane.cell_of((ends, ends), f32(SIDE), columns).tolist() == [0, columns**2 - 1]


@pytest.mark.parametrize("number", [1, 255, 256, 3000])
def test_modes_are_the_sums(number):
    """Σ w_⊥ exp(ik·r) in float64 for the four wave vectors; float32 rounds 1e-6 of √N each."""
    place, velocity = (x.astype(np.float32) for x in particles(number))
    arrays = (tuple(map(jnp.asarray, x)) for x in (place, velocity))
    found = np.asarray(plane.transverse_modes(*arrays, f32(SIDE)), float)
    place, velocity = place.astype(float), velocity.astype(float)
    for wave, (real, imaginary) in zip(plane.MODES, found, strict=True):
        k = 2 * np.pi * np.array(wave) / float(np.float32(SIDE))
        across = np.array([wave[1], -wave[0]]) / np.hypot(*wave)
        sign = -1.0 if wave in ((1, 0), (1, -1)) else 1.0  # the direction is a convention
        exact = sign * np.sum((across @ velocity) * np.exp(1j * (k @ place)))
        assert abs(complex(real, imaginary) - exact) < 2e-6 * np.sqrt(number) * 3
        assert abs(wave @ across) < 1e-12


def test_still():
    """No net momentum, to rounding."""
    velocity = tuple(jnp.asarray(v + 0.3, np.float32) for v in particles(1000)[1])
    for v in plane.still(velocity):
        assert abs(float(np.mean(np.asarray(v, float)))) < 1e-6
