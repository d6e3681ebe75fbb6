"""Candidate pairs in layers: exact rates for any population, second order in time."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import InelasticHardSpheres, MaxwellMolecules, random
from jdsmc.collisions.in_cells import collide_in_layers
from jdsmc.collisions.trios import _one_of, groups_in, most_groups, seat, shares
from jdsmc.motion.cells import layer_of, populations, totals

f32 = jnp.float32


def _trios(number, layer, count):
    groups = groups_in(populations(layer, count))
    most = most_groups(layer.size, count)
    return seat(random.fold_in(random.key_from_seed(1), number), 0, layer, groups, most)


@pytest.mark.parametrize("count", [1, 7, 300])
def test_nobody_sits_twice_and_groups_stay_in_their_layer(count):
    layer = jnp.asarray(np.random.default_rng(0).integers(0, count, 500), jnp.int32)
    trios = _trios(0, layer, count)
    seated = np.asarray(trios.seats)[np.asarray(trios.taken)]
    assert len(set(seated.tolist())) == len(seated)
    assert seated.max() < 500
    groups = np.asarray(trios.layer)
    for seats, taken in zip(trios.seats, trios.taken, strict=True):
        both = np.asarray(taken & trios.taken[1])
        assert np.array_equal(np.asarray(layer)[np.asarray(seats)][both], groups[both])


@pytest.mark.parametrize("population", [2, 3, 5, 8, 20, 100])
def test_every_pair_is_met_equally_often_and_as_often_as_said(population):
    """Chi-square of all pairs of one layer; the sum over pairs is N (N-1)/2 over the shares."""
    draws = 20_000
    layer = jnp.zeros(population, jnp.int32)
    trios = jax.jit(jax.vmap(lambda k: _trios(k, layer, 1)))(jnp.arange(draws))
    seats, taken = np.asarray(trios.seats), np.asarray(trios.taken)
    number = populations(layer, 1)
    parts = shares(number, groups_in(number), jnp.float32)
    pairs = population * (population - 1) / 2
    met = 0.0
    for wave in (0, 1):
        both = taken[:, wave] & taken[:, wave + 1]
        table = np.zeros((population, population))
        np.add.at(table, (seats[:, wave][both], seats[:, wave + 1][both]), 1)
        table = (table + table.T)[np.triu_indices(population, 1)]
        expected = table.sum() / pairs
        chi_square = np.sum((table - expected) ** 2 / expected)
        # a chi-square has mean `pairs` - 1 and variance twice that
        assert abs(chi_square - (pairs - 1)) < 5 * np.sqrt(2 * max(pairs - 1, 1))
        met += float(parts[wave][0]) * table.sum() / draws
    # each pair must be met once per unit of rate; counts are Poissonian or narrower
    assert met == pytest.approx(pairs, rel=5 / np.sqrt(table.sum()))


def test_millions_of_seats_are_all_alike():
    """The first word of each seat takes it, and the word before the seat before."""
    width = 10_000_019
    seats = np.random.default_rng(0).integers(1, width, 1000)
    first = np.array([-(-int(k) * 2**32 // width) for k in seats], np.uint32)
    many = jnp.full(1000, width, jnp.int32)
    for words, wanted in ((first, seats), (first - 1, seats - 1)):
        found = np.asarray(_one_of(jnp.asarray(words), many, fine=True))
        assert np.array_equal(found, wanted)
    # 23 bits cannot
    assert np.any(np.asarray(_one_of(jnp.asarray(first), many, fine=False)) != seats)


def _gas(key, n, count, temperature=0.5):
    rng = np.random.default_rng(key)
    position = jnp.asarray(rng.random(n) * 1.0, f32)
    velocity = tuple(jnp.asarray(rng.normal(size=n) * temperature**0.5, f32) for _ in range(3))
    return position, velocity, layer_of(position, f32(1.0), count)


@pytest.mark.parametrize(("n", "count"), [(2000, 10), (2000, 400), (200, 100)])
def test_collision_rate_of_an_ideal_gas_in_layers(n, count):
    """ν N/2 = N/(√π τ) on average, though many layers hold 0, 1 or 2 particles (mean of 2 to 200).

    Positions are uniform: the populations are binomial and ⟨N(N-1)⟩ is n (n-1)/count². The step is
    short enough for the fastest pair of the fullest layer.
    """
    steps = 3000
    gas = InelasticHardSpheres(f32(1.0))

    def one(number):
        key = random.fold_in(random.key_from_seed(5), number)
        words = random.bits(random.fold_in(key, 0), (n,))
        layer = layer_of(random.unit_interval(words[0], f32), f32(1.0), count)
        x, y = random.normal_pair(random.bits(random.fold_in(key, 1), (n,)), f32)
        z, _ = random.normal_pair(random.bits(random.fold_in(key, 2), (n,)), f32)
        velocity = tuple(v * f32(0.5**0.5) for v in (x, y, z))
        key = random.fold_in(key, 3)
        _, tally, _ = collide_in_layers(key, gas, layer, count, velocity, f32(0.01))
        return tally.accepted, tally.excess

    accepted, excess = (
        np.asarray(x, float) for x in jax.jit(jax.lax.map, static_argnums=0)(one, jnp.arange(steps))
    )
    expected = 0.01 * (n - 1) / np.sqrt(np.pi)
    error = np.std(accepted) / np.sqrt(steps)
    assert error < 0.02 * expected
    assert np.sum(excess) < 1e-4 * np.sum(accepted)
    assert abs(np.mean(accepted) - expected) < 4 * error


def test_momentum_and_energy_are_kept_in_every_layer():
    _, velocity, layer = _gas(3, 4000, 20)
    gas = InelasticHardSpheres(f32(1.0))
    key = random.key_from_seed(2)
    after, tally, _ = collide_in_layers(key, gas, layer, 20, velocity, f32(0.2))
    assert float(tally.accepted) > 100
    for before, now in zip(velocity, after, strict=True):
        difference = totals(layer, now, 20) - totals(layer, before, 20)
        np.testing.assert_allclose(difference, 0.0, atol=2e-4)  # 200 roundings of 1e-7 x speed 4
    energy = [totals(layer, sum(v * v for v in w), 20) for w in (velocity, after)]
    np.testing.assert_allclose(energy[1], energy[0], rtol=2e-6)


@pytest.mark.parametrize("population", [14, 200])
def test_stress_of_maxwell_molecules_decays_to_second_order(population):
    """One layer of Maxwell molecules: dP_xy/dt = -ν_η P_xy exactly, for any distribution.

    With disjoint pairs, an error of first order, the decay would lack (ν dt)²/2 = 1.2% at 0.17;
    what second order leaves is (ν dt)³/6, ν = 1.8 being the hits of a particle, or half of it.
    """
    gas, repeats = MaxwellMolecules(), 200_000 // population * 20
    step = 0.17 if population > 100 else 0.08
    rng = np.random.default_rng(1)
    layer = jnp.zeros(population, jnp.int32)
    start = rng.normal(size=(3, population)) * 0.5**0.5
    start[1] = start[0]  # all particles have v_x = v_y: a large stress
    start = tuple(jnp.asarray(v - v.mean(), f32) for v in start)

    def stress(number):
        key = random.fold_in(random.key_from_seed(7), number)
        velocity, tally, largest = collide_in_layers(key, gas, layer, 1, start, f32(step))
        return jnp.sum(velocity[0] * velocity[1]), tally.excess, largest

    values, excess, _ = (
        np.asarray(x, float) for x in jax.jit(jax.vmap(stress))(jnp.arange(repeats))
    )
    assert np.sum(excess) == 0
    before = float(jnp.sum(start[0] * start[1]))
    # a pair collides at the rate w/(√2 N) and halves the stress of its relative velocity
    rate = 16.0 * np.sqrt(2.0 / np.pi) / 5.0 / np.sqrt(2.0) / 2.0
    expected = before * np.exp(-rate * step)
    error = np.std(values) / np.sqrt(repeats)
    assert error < 1.5e-3 * expected
    assert abs(np.mean(values) - expected) < 4 * error + expected * (rate * step * 2) ** 3 / 12
