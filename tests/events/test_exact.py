"""What event-driven dynamics must do exactly, to rounding or bit for bit."""

import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

pytest.importorskip("numba")

from jdsmc import events
from jdsmc.events import system as at

from . import brute_force

EPSILON = np.finfo(float).eps


def same(first, second):
    """True if two tuples of arrays hold the same bits."""
    return all(np.array_equal(a, b, equal_nan=True) for a, b in zip(first, second, strict=True))


def closest(positions, side):
    """Smallest distance between two disks, from all pairs."""
    r = positions[:, None] - positions[None, :]
    r -= side * np.rint(r / side)
    distance = np.hypot(r[..., 0], r[..., 1])
    return np.min(distance[np.triu_indices(len(positions), 1)])


def test_units_and_start():
    system = events.start(500, 0.2, seed=1)
    side, diameter = system.box[at.SIDE], system.box[at.DIAMETER]
    positions, velocities = events.phase_space(system)
    assert 500 / side**2 * diameter == pytest.approx(1 / np.sqrt(8), rel=1e-14)  # λ0 = 1
    assert 500 / side**2 * diameter**2 == pytest.approx(0.2, rel=1e-14)
    assert closest(positions, side) > diameter
    # Sums of 500 numbers of order one, each rounded.
    assert np.mean(np.sum(velocities**2, axis=1)) == pytest.approx(1, abs=500 * EPSILON)
    assert np.abs(velocities.mean(axis=0)).max() < 500 * EPSILON


@pytest.mark.parametrize("restitution", [1.0, 0.6])
def test_two_disks_meet_as_computed_by_hand(restitution):
    """Disks at distance 4σ, impact parameter 0.6σ, relative speed 1: contact after 3.2σ.

    At contact σ̂ = (-0.8, 0.6) from the second to the first, g·σ̂ = -0.8.
    """
    diameter = 0.01 * np.sqrt(8)
    positions = np.array([[0.1, 0.2], [0.1 + 4 * diameter, 0.2 - 0.6 * diameter]])
    system = events.place(positions, [[1.0, 0.0], [0.0, 0.0]], 0.01)
    system = events.advance(system, restitution, 3.3 * diameter)
    kick = 0.5 * (1 + restitution) * 0.8 * np.array([-0.8, 0.6])
    positions_now, velocities = events.phase_space(system)
    assert system.counts[at.COLLISIONS] == 1
    # A handful of operations on numbers of order one.
    assert system.last_hit == pytest.approx(3.2 * diameter, abs=20 * EPSILON)
    assert velocities[0] == pytest.approx(np.array([1.0, 0.0]) + kick, abs=100 * EPSILON)
    assert velocities[1] == pytest.approx(-kick, abs=100 * EPSILON)
    path = positions[1] - 0.1 * diameter * kick
    assert positions_now[1] == pytest.approx(path % system.box[at.SIDE], abs=100 * EPSILON)
    assert system.sums[at.ENERGY_LOST] == pytest.approx(0.16 * (1 - restitution**2), rel=1e-12)
    assert system.sums[at.VIRIAL] == pytest.approx(0.4 * (1 + restitution) * diameter, rel=1e-12)


@pytest.mark.parametrize(
    ("n_particles", "density", "restitution"), [(24, 0.3, 0.8), (24, 0.02, 1.0), (30, 0.45, 0.9)]
)
def test_every_event_agrees_with_all_pairs(n_particles, density, restitution):
    """300 collisions in stretches of 10, each begun from the same state: chaos stays small.

    Rounding (1e-15) grows by up to 2 λ0/σ = 35 per collision of a disk, at most about four each.
    """
    system = events.start(n_particles, density, seed=3)
    for _ in range(30):
        positions, velocities = events.phase_space(system)
        times, pairs, expected = brute_force.simulate(
            positions, velocities, *system.box[:2], restitution, 10
        )
        now = 0.0
        for pair, begin, end in zip(pairs, times, [*times[1:], times[-1] + 1e-9], strict=True):
            before = system
            middle = 0.5 * (begin + end)
            system = events.advance(before, restitution, middle - now)
            now = middle
            hit = np.flatnonzero(system.links[:, at.HITS] - before.links[:, at.HITS])
            assert set(hit) == set(pair)
            assert system.counts[at.COLLISIONS] == before.counts[at.COLLISIONS] + 1
        assert events.phase_space(system)[1] == pytest.approx(expected, abs=1e-9)
    assert not any(events.faults(system).values())


@pytest.mark.parametrize("density", [0.01, 0.4])
def test_elastic_gas_conserves_momentum_and_energy(density):
    """2 10^4 collisions, each rounds by about one unit: random walks of 150 units, times 10."""
    system = events.start(500, density, seed=2)
    system = events.advance(system, 1.0, 90.0 if density < 0.1 else 40.0)
    _, velocities = events.phase_space(system)
    assert system.counts[at.COLLISIONS] > 15_000
    assert np.abs(velocities.sum(axis=0)).max() < 1500 * EPSILON
    assert abs(np.sum(velocities**2) - 500) < 1500 * EPSILON * 10
    assert not any(events.faults(system).values())
    assert system.sums[at.ENERGY_LOST] == 0.0


def test_energy_lost_is_the_sum_over_collisions():
    system = events.start(500, 0.1, seed=4)
    system = events.advance(system, 0.7, 50.0)
    _, velocities = events.phase_space(system)
    energy = 0.5 * np.sum(velocities**2)
    # 10^4 losses that add up to 250, each rounded relative to the sum.
    assert energy + system.sums[at.ENERGY_LOST] == pytest.approx(250.0, abs=1e4 * 250 * EPSILON)
    assert energy < 25.0


@pytest.mark.parametrize(("density", "restitution"), [(0.01, 0.8), (0.5, 0.9)])
def test_disks_never_overlap(density, restitution):
    system = events.start(200, density, seed=5)
    diameter, side = system.box[at.DIAMETER], system.box[at.SIDE]
    for _ in range(20):
        system = events.advance(system, restitution, 1.0)
        # Contact is met to 1e-13 of a diameter per collision time that is known to 1e-15.
        assert closest(events.phase_space(system)[0], side) > diameter * (1 - 1e-11)
    assert not any(events.faults(system).values())


def test_elastic_gas_runs_backwards_to_its_start():
    """1000 collisions there and 1000 back, two per disk and up to nine.

    Rounding (4e-16) grows at nσ² = 0.1 by about 2 λ0/σ = 7 per collision of a disk: 7² for most,
    and for the worst of 1000 disks, with its partners' past, some 7^7 = 1e6.
    """
    first = events.start(1000, 0.1, seed=6)
    positions, velocities = events.phase_space(first)
    there = events.advance(first, 1.0, 2.1)
    half_way, reversed_velocities = events.phase_space(there)
    back = events.advance(events.place(half_way, -reversed_velocities, 0.1), 1.0, 2.1)
    final, final_velocities = events.phase_space(back)
    side = first.box[at.SIDE]
    error = np.abs(final - positions - side * np.rint((final - positions) / side)).max(axis=1)
    assert there.counts[at.COLLISIONS] == back.counts[at.COLLISIONS] > 1000
    assert np.abs(half_way - positions).max() > 1.0
    assert np.median(error) < 1e-12
    assert error.max() < 1e-8
    assert final_velocities == pytest.approx(-velocities, abs=1e-8)


def test_split_run_equals_whole_run_bit_for_bit(tmp_path):
    """Also through a file, and at a place that is no multiple of the rescalings."""
    begin = events.start(300, 0.02, seed=7)
    whole, samples = events.advance_scaled(begin, 0.8, 0.08, n_samples=40)
    half, first = events.advance_scaled(begin, 0.8, 0.08, n_samples=13)
    np.savez(tmp_path / "half.npz", **half._asdict())
    with np.load(tmp_path / "half.npz") as file:
        restored = events.System(**file)
    split, second = events.advance_scaled(restored, 0.8, 0.08, n_samples=27)
    assert same(split, whole)
    assert same([np.concatenate(pair) for pair in zip(first, second, strict=True)], samples)
    cooled = events.advance(events.advance(begin, 0.8, 3.0), 0.8, 4.0)
    assert same(cooled, events.advance(begin, 0.8, 7.0))


def test_given_systems_are_left_alone():
    begin = events.start(100, 0.05, seed=8)
    copy = begin.copy()
    events.advance(begin, 0.8, 2.0)
    events.advance_scaled(begin, 0.8, 0.1, n_samples=20)
    assert same(begin, copy)


def test_threads_change_nothing():
    systems = [events.start(200, 0.02, seed) for seed in range(4)]
    with ThreadPoolExecutor(2) as pool:
        side_by_side = list(pool.map(lambda s: events.advance(s, 0.9, 5.0), systems))
    for system, threaded in zip(systems, side_by_side, strict=True):
        assert same(events.advance(system, 0.9, 5.0), threaded)


def test_other_threads_run_meanwhile():
    """10^5 collisions take 0.2 s at least; a thread that held Python's lock would allow no tick."""
    system = events.advance(events.start(1000, 0.01, seed=9), 1.0, 0.0)
    thread = threading.Thread(target=events.advance, args=(system, 1.0, 230.0))
    thread.start()
    ticks = 0
    while thread.is_alive():
        time.sleep(0.002)
        ticks += 1
    assert ticks > 10


def test_import_is_free_of_numba_and_use_says_what_is_missing():
    code = (
        "import sys; sys.modules['numba'] = None\n"
        "from jdsmc import events\n"
        "try: events.start(100, 0.01, 1)\n"
        "except ImportError as error: print(error)"
    )
    answer = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout
    assert 'pip install "jdsmc[md]"' in answer


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ((1, 0.01, 1), "n_particles"),
        ((100, 0.8, 1), "density"),
        ((100, 0.0, 1), "density"),
        ((6, 0.5, 1), "n_particles"),
        ((100, 0.01, -1), "seed"),
    ],
)
def test_start_refuses(arguments, word):
    with pytest.raises(ValueError, match=word):
        events.start(*arguments)


def test_advance_refuses():
    system = events.start(100, 0.01, 1)
    with pytest.raises(ValueError, match="restitution"):
        events.advance(system, 1.1, 1.0)
    with pytest.raises(ValueError, match="duration"):
        events.advance(system, 0.9, -1.0)
    with pytest.raises(ValueError, match="growth_rate"):
        events.advance_scaled(system, 0.9, -0.1)
    with pytest.raises(ValueError, match="nearer than one diameter"):
        events.place(np.zeros((2, 2)), np.zeros((2, 2)), 0.01)
