"""Flight between walls: exact trajectories, bounces, and what the walls exchange."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import random
from jdsmc.motion import queue
from jdsmc.motion.flight import cross_planes, fly, time_to_floor
from jdsmc.motion.walls import Walls

f32 = jnp.float32
KEY = random.key_from_seed(1)
fly_compiled = jax.jit(fly)  # once for each number of particles


def _fly(position, velocity, duration, gravity=0.0, length=10.0, cold=0.05):
    velocity = tuple(jnp.asarray(v, f32) for v in velocity)
    walls = Walls.maxwell(f32(cold))
    return fly_compiled(
        *(KEY, walls, jnp.asarray(position, f32), velocity),
        *(f32(gravity), f32(length), f32(duration)),
    )


@pytest.mark.parametrize("gravity", [0.0, 0.3, -0.3])
def test_flight_without_a_hit_is_a_parabola(gravity):
    vz = np.array([-1.0, 0.0, 2.0])
    position, velocity, exchange = _fly([5.0] * 3, (vz, vz, vz), 1.5, gravity)
    np.testing.assert_allclose(position, 5 + 1.5 * vz - 0.5 * gravity * 1.5**2, rtol=1e-6)
    np.testing.assert_allclose(velocity[2], vz - gravity * 1.5, rtol=1e-6)
    np.testing.assert_allclose(velocity[0], vz)
    assert float(exchange.lower_energy) == float(exchange.upper_energy) == 0


@pytest.mark.parametrize(
    ("height", "speed", "gravity", "expected"),
    [
        (1.0, -2.0, 0.0, 0.5),
        (1.0, 2.0, 0.0, np.inf),
        (1.0, 0.0, 2.0, 1.0),
        (0.0, 3.0, 2.0, 3.0),  # thrown up from the floor
        (1.0, 1.0, -2.0, np.inf),
        (1.0, -1.0, -2.0, np.inf),  # turns before the floor
        (1.0, -3.0, -4.0, 0.5),  # falls against gravity, hits at the first root
        (0.0, -1.0, 0.0, 0.0),
    ],
)
def test_time_to_the_floor(height, speed, gravity, expected):
    times = time_to_floor(jnp.asarray([height], f32), jnp.asarray([speed], f32), f32(gravity))
    np.testing.assert_allclose(times, [expected], rtol=1e-6)


def test_a_tiny_gravity_changes_nothing():
    """The root is free of cancellation: g = 1e-7 must not move the hit by more than rounding."""
    heights, speeds = jnp.asarray([1.0, 3.0], f32), jnp.asarray([-1.0, -0.01], f32)
    np.testing.assert_allclose(
        time_to_floor(heights, speeds, f32(1e-7)), heights / -speeds, rtol=3e-3
    )


@pytest.mark.parametrize("gravity", [0.0, 0.5, -0.5])
def test_particles_stay_between_the_walls_however_often_they_hit_them(gravity):
    """A slab so thin that most particles cross it several times in a step; energy is booked."""
    rng = np.random.default_rng(0)
    n = 2000
    start = rng.random(n) * 0.1
    velocity = rng.normal(size=(3, n)) * 0.7
    position, after, exchange = _fly(start, velocity, 1.0, gravity, 0.1, 0.5)
    position = np.asarray(position)
    assert position.min() >= 0 and position.max() <= f32(0.1)
    assert float(exchange.lost) == 0
    assert np.mean(np.abs(velocity[2])) * 1.0 / 0.1 > 3  # crossings, at the first velocity
    assert np.mean(np.asarray(after[0]) != velocity[0].astype(np.float32)) > 0.9  # who hit a wall
    energy = [
        0.5 * np.sum(np.asarray(v, float) ** 2) + gravity * np.sum(np.asarray(z, float))
        for v, z in ((velocity, start), (after, position))
    ]
    given = float(exchange.lower_energy + exchange.upper_energy)
    # 1e4 hits, each rounded to 1e-7 of an energy of 1
    assert energy[1] - energy[0] == pytest.approx(given, abs=0.02)


def _thin_slab(count=1000):
    """Particles that hit the walls several times in a step, and some that never do."""
    rng = np.random.default_rng(4)
    place, velocity = rng.random(count), rng.normal(size=(3, count))
    velocity[:, ::3] *= 1e-3
    return place, velocity


@pytest.mark.parametrize("gravity", [0.0, 0.4])
def test_nothing_depends_on_how_many_are_served_at_once(gravity, monkeypatch):
    """One place, a few, or one for everybody: the same particles, bit by bit.

    What the walls gave is summed in another order: single precision of a thousand hits.
    """
    place, velocity = _thin_slab()
    found = []
    for particles in (1, 20, 10_000):
        monkeypatch.setattr(queue, "PARTICLES_A_PLACE", particles)
        jax.clear_caches()
        found.append(_fly(place, velocity, 1.0, gravity, 1.0, 0.5))
    jax.clear_caches()
    (position, after, exchange), *others = found
    hit = np.asarray(after[0]) != velocity[0].astype(np.float32)
    assert 100 < np.sum(hit) < 900
    for position_too, after_too, exchange_too in others:
        np.testing.assert_array_equal(position_too, position)
        np.testing.assert_array_equal(after_too, after)
        np.testing.assert_allclose(
            jax.tree.leaves(exchange_too), jax.tree.leaves(exchange), rtol=1e-4
        )


def test_gases_flown_together_fly_as_alone():
    """Under `vmap` loops go on for all until the last is done: nobody is served twice."""
    place, velocity = _thin_slab()
    batch = [
        (jnp.asarray(x[..., part], f32) for x in (place, velocity))
        for part in (slice(0, 500), slice(500, 1000))
    ]
    positions, velocities = (jnp.stack(both) for both in zip(*batch, strict=True))
    walls, numbers = Walls.maxwell(f32(0.5)), (f32(0.1), f32(1.0), f32(1.0))

    def one(position, velocity, calm):
        return fly(KEY, walls, position, tuple(calm * v for v in velocity), *numbers)

    calm = jnp.asarray([1.0, 0.02], f32)
    together = jax.jit(jax.vmap(one))(positions, velocities, calm)
    for k in range(2):
        alone = jax.jit(one)(positions[k], velocities[k], calm[k])
        for a, b in zip(jax.tree.leaves(alone), jax.tree.leaves(together), strict=True):
            np.testing.assert_allclose(b[k], a, rtol=1e-4, atol=1e-6)  # single precision


def test_endless_bouncing_is_counted_as_lost():
    position, _, exchange = _fly([1e-4] * 10, np.zeros((3, 10)), 1000.0, 50.0, 10.0, 1e-4)
    assert float(exchange.lost) == 10
    assert np.all(np.isfinite(position))


def test_a_hit_takes_the_rest_of_the_step_with_the_new_velocity():
    """From z = 1 with v = -2 for 1 τ0: the wall is hit at 0.5, so z = 0.5 v_new."""
    position, velocity, _ = _fly([1.0] * 50, np.full((3, 50), -2.0), 1.0)
    np.testing.assert_allclose(position, 0.5 * np.asarray(velocity[2]), rtol=1e-5)
    assert np.all(np.asarray(velocity[2]) > 0)
    assert len(np.unique(np.asarray(velocity[2]))) == 50


def test_heat_flux_of_a_free_molecular_gas():
    """Collisionless steady state between walls at T_- and T_+, in closed form.

    Two half-Maxwellians with n_- √T_- = n_+ √T_+ and n_- + n_+ = 2 n: the energy flux is
    -(n w_- w_+/(w_- + w_+)) (w_+² - w_-²)/√π in units of n m v0³, w = √(T/T0).
    """
    n, cold, length, steps = 20_000, 0.2, 1.0, 400
    walls = Walls.maxwell(f32(cold))
    rng = np.random.default_rng(0)
    position = jnp.asarray(rng.random(n) * length, f32)
    velocity = tuple(jnp.asarray(rng.normal(size=n) * 0.5, f32) for _ in range(3))

    @jax.jit
    def step(carry, number):
        position, velocity = carry
        key = random.fold_in(random.key_from_seed(2), number)
        position, velocity, exchange = fly(
            *(key, walls, position, velocity), *(f32(0.0), f32(length), f32(1.0))
        )
        return (position, velocity), exchange

    _, exchange = jax.lax.scan(step, (position, velocity), jnp.arange(steps, dtype=jnp.uint32))
    late = slice(100, None)  # slow particles need a few crossing times of 1/0.45
    w = np.sqrt(cold)
    expected = -(w / (1 + w)) * (1 - cold) / np.sqrt(np.pi)
    for energy, sign in ((exchange.lower_energy, 1), (exchange.upper_energy, -1)):
        flux = sign * np.asarray(energy, float)[late] * length / n
        blocks = flux.reshape(20, -1).mean(axis=1)  # 15 crossing times each
        error = np.std(blocks) / np.sqrt(len(blocks))
        assert error < 0.01 * abs(expected)
        assert abs(blocks.mean() - expected) < 4 * error


def test_lees_edwards_planes_shift_the_velocity_at_every_image():
    position = jnp.asarray([0.5, 0.5, 0.5, 1.9], f32)
    vy = jnp.asarray([0.0, 5.2, -7.1, 0.1], f32)
    vx = jnp.asarray([1.0, 1.0, 1.0, 1.0], f32)
    place, (wx, wy, _) = cross_planes(position, (vx, vy, vx), f32(3.0), f32(2.0), f32(1.0))
    np.testing.assert_allclose(place, [0.5, 1.7, 1.4, 0.0], atol=1e-5)
    np.testing.assert_allclose(wx, [1.0, 1.0 - 2 * 6, 1.0 + 4 * 6, 1.0 - 6], rtol=1e-6)
    np.testing.assert_allclose(wy, vy)
    assert np.all((np.asarray(place) >= 0) & (np.asarray(place) < 2.0))
