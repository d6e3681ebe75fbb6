"""Pairs are uniform, hits are Poisson to second order, and the step is second order in time."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax

from jdsmc import InelasticHardSpheres, random
from jdsmc.collisions.meet import meet
from jdsmc.collisions.pairs import (
    LARGEST_HITS,
    PairPlan,
    arrange,
    plan_pairs,
    put_rows,
    remix,
    take_rows,
    thinning,
)
from jdsmc.collisions.whole import collide, hits_per_particle
from jdsmc.scenarios import UniformShear

from .. import helpers
from ..helpers import IsotropicMolecules, f32, keys, maxwellian


def _indices(plan):
    """Particle numbers laid out like a velocity component."""
    return jnp.arange(plan.rows * plan.lanes, dtype=jnp.float32).reshape(plan.rows, plan.lanes)


@pytest.mark.parametrize("n", [64, 97, 1000, 2048, 10_000, 250_000])
def test_layout(n):
    rows = arrange(n)
    assert n % rows == 0
    assert rows >= 64


@pytest.mark.parametrize("n, message", [(63, "outside the allowed range"), (10_007, "10048")])
def test_layout_that_cannot_be(n, message):
    with pytest.raises(ValueError, match=message):
        arrange(n)


@pytest.mark.parametrize("n", [64, 97, 1000, 10_000, 20_000])
@pytest.mark.parametrize("time_step", [0.001, 0.02, 0.1, 1.0])
def test_waves_fit_into_the_rows(n, time_step):
    plan = plan_pairs(n, time_step)
    assert plan.second <= plan.first
    assert 2 * plan.first + plan.second <= plan.rows
    hits = plan.largest_hits()
    assert hits <= LARGEST_HITS
    # what the waves can serve is what they promise, to float32 rounding
    assert all(share <= 1 + 1e-6 for share in thinning(plan, f32(hits)))


@pytest.mark.parametrize("hits", [0.5, 0.3, 0.1])
@pytest.mark.parametrize("n, time_step", [(64, 0.1), (1000, 0.1), (20_000, 0.05), (20_000, 0.01)])
def test_weights_of_the_waves_are_of_second_order(n, time_step, hits):
    """The shares give Q(Q, f) the weight κ² and Q(f, f) the weight κ - 3κ²/2, exactly.

    θ1, θ2: shares of slots that are candidates; a reused particle was hit before with θ1 only.
    """
    plan = plan_pairs(n, time_step)
    kappa = min(hits, plan.largest_hits())
    one, two = (float(share) for share in thinning(plan, f32(kappa)))
    pairs, again = 2 * plan.first / plan.rows, plan.second / plan.rows
    assert 2 * again * one * two == pytest.approx(kappa**2, rel=1e-6)
    weight = (pairs - again) * one + again * (1 - two) * one + 2 * again * two * (1 - one)
    assert weight == pytest.approx(kappa - 1.5 * kappa**2, rel=1e-6)


def test_rows_are_taken_once_and_put_back():
    """Writing back what was taken, shifted, loses no particle and doubles none."""
    plan = plan_pairs(1000, 0.1)
    numbers = _indices(plan)
    taken, *sides = take_rows(random.key_from_seed(1), plan, (numbers,))
    after = put_rows((numbers,), taken, *sides)[0]
    assert len(np.unique(np.asarray(taken))) == 2 * plan.first + plan.second
    np.testing.assert_array_equal(np.sort(np.asarray(after).ravel()), np.arange(1000))


def test_remix_meets_every_row():
    """After one remix every pair of particles can meet: a row holds one of each old row."""
    plan = PairPlan(80, 125, 10, 10)
    old_row = np.asarray(remix(_indices(plan))).astype(int) // plan.lanes
    assert all(len(set(row)) == 80 for row in old_row)


@pytest.mark.parametrize("n", [64, 128])
def test_partners_are_uniform(n):
    """Chi-square of how often each pair is a candidate, remixing as a run does, small N.

    Wave 1 alone; n(n-1)/2 cells. A pair of one step excludes others of the same step, which makes
    the sum slightly narrower than chi-square: 4.5 of its standard deviations is a safe bound.
    """
    plan = plan_pairs(n, 0.1)
    steps, per_step = 4000, plan.first * plan.lanes

    def one(numbers, step):
        key = random.fold_in(random.key_from_seed(2), step)
        taken, left, right, fresh = take_rows(key, plan, (numbers,))
        numbers = remix(put_rows((numbers,), taken, left, right, fresh)[0])
        return numbers, (left[0], right[0])

    _, (left, right) = jax.jit(lambda x: lax.scan(one, x, jnp.arange(steps)))(_indices(plan))
    a, b = (np.asarray(x).astype(int).ravel() for x in (left, right))
    counts = np.zeros((n, n))
    np.add.at(counts, (np.minimum(a, b), np.maximum(a, b)), 1)
    counts = counts[np.triu_indices(n, 1)]
    expected = steps * per_step / len(counts)
    chi, freedom = np.sum((counts - expected) ** 2 / expected), len(counts) - 1
    assert abs(chi - freedom) < 4.5 * np.sqrt(2 * freedom)


def test_hits_are_poisson_to_second_order():
    """P(0) = 1-κ+κ²/2, P(1) = κ-κ², P(2) = κ²/2 at the largest κ, when every slot is used.

    Exact by counting rows: no statistics.
    """
    plan = PairPlan(rows=64, lanes=4, first=8, second=8)
    kappa = plan.largest_hits()
    assert kappa == pytest.approx(0.5)
    once = (2 * plan.first - plan.second + plan.second) / plan.rows
    twice = plan.second / plan.rows
    assert once == pytest.approx(kappa - kappa**2)
    assert twice == pytest.approx(kappa**2 / 2)


def _stress_after(gas, options, steps, duration, count, waves):
    """⟨V_x² - V_y²⟩ of realizations started with it equal to 2, after a number of steps."""
    first = _anisotropic(options)

    def one(key):
        def step(velocity, number):
            step_key = random.fold_in(key, number)
            return waves(step_key, gas, options.plan, velocity, duration), None

        velocity, _ = lax.scan(step, first, jnp.arange(steps))
        vx, vy, _ = velocity
        return jnp.mean(jnp.mean(vx * vx - vy * vy, axis=1))

    return np.asarray(jax.jit(jax.vmap(one))(keys(3, count)), float)


def _anisotropic(options):
    vx, vy, vz = maxwellian(5, options)
    vx, vy, vz = (v / jnp.sqrt(jnp.mean(v * v)) for v in (vx, vy, vz))
    return (jnp.sqrt(f32(2.2)) * vx, jnp.sqrt(f32(0.2)) * vy, jnp.sqrt(f32(0.6)) * vz)


def _two_waves(key, gas, plan, velocity, duration):
    return collide(key, gas, plan, velocity, f32(5.0), duration)[0]


def _plain_disjoint(key, gas, plan, velocity, duration):
    """The same number of candidates, all disjoint: first order in time."""
    plain = plan._replace(first=2 * plan.first, second=0)
    taken, left, right, fresh = take_rows(key, plain, velocity)
    hits = hits_per_particle(plan, f32(5.0), duration)
    bound = f32(5.0) * (2.0 * plain.first / plan.rows) / hits
    left, right, *_ = meet(key, 2, gas, left, right, 1.0 / bound)
    return put_rows(velocity, taken, left, right, fresh)


@pytest.mark.parametrize("kappa", [0.5, 0.3])
def test_two_waves_are_second_order_where_disjoint_pairs_are_first(kappa):
    """Stress of Maxwell molecules decays as exp(-ν t/2) exactly; κ = 0.5 is the largest in use.

    At κ = 0.3 six tenths of the slots are candidates. ν dt/2 = x = κ·acceptance/2 = 0.05 (0.03)
    per step. After 1/x steps disjoint pairs are off by x/2 = 2.5% (1.5%), two waves by x²/6 =
    0.04%, below the error bar of about 0.2%.
    """
    options = helpers.options(2**16)
    gas = IsotropicMolecules(f32(1.0))
    duration = f32(kappa * np.sqrt(2.0) / 5.0)
    steps, count = round(10 / kappa), 48
    hits = float(hits_per_particle(options.plan, f32(5.0), duration))
    exact = 2.0 * np.exp(-hits / 5.0 / 2.0 * steps)
    two = _stress_after(gas, options, steps, duration, count, _two_waves)
    plain = _stress_after(gas, options, steps, duration, count, _plain_disjoint)
    error = two.std(ddof=1) / np.sqrt(count)
    assert error < 0.003 * exact
    assert abs(two.mean() - exact) < 4.5 * error
    assert abs(plain.mean() - exact) > 5 * error
    expected = 1 - kappa / 20
    np.testing.assert_allclose(plain.mean() / exact, expected, atol=4.5 * error / exact + 0.002)


def test_rows_of_neighbours_equal_single_particles():
    """Sixty-four rows of 32 against 2048 rows of one (fully random pairs), under shear.

    Mean and variance over realizations of T and of the shear stress agree within 4.5 standard
    errors: that neighbours travel together changes neither.
    """
    options = helpers.options(2048, steps=8)
    scene = jax.tree.map(f32, UniformShear(InelasticHardSpheres(0.7), 1.0))
    samples = {}
    for plan in (options.plan, PairPlan(2048, 1, 256, 256)):
        chosen = replace(options, plan=plan)

        def one(key, chosen=chosen):
            state = scene.initial(key, chosen)

            def record(state, number):
                state, out = scene.advance(random.fold_in(key, number), state, chosen)
                return state, (out.moments.temperature(), out.moments.xy)

            _, out = lax.scan(record, state, jnp.arange(24))
            return jax.tree.map(lambda x: x[-1], out)

        t, xy = jax.jit(jax.vmap(one))(keys(7, 400))
        samples[plan.rows] = np.array([t, -xy / t], float)
    a, b = samples.values()
    count = a.shape[1]
    error = np.sqrt((a.var(axis=1) + b.var(axis=1)) / count)
    assert np.all(np.abs(a.mean(axis=1) - b.mean(axis=1)) < 4.5 * error)
    ratio = a.var(axis=1) / b.var(axis=1)
    assert np.all(np.abs(np.log(ratio)) < 4.5 * np.sqrt(4 / count))
