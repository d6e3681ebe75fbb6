"""Conservation laws and rates of the collision stage."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from jax import lax

from jdsmc import ElasticHardSpheres, InelasticHardSpheres, random
from jdsmc.collisions.whole import collide
from jdsmc.units import MAXWELL_CUBED

from ..helpers import f32, keys, maxwellian, options, sums

OPTIONS = options(20_000)


def _collide(gas, velocity, majorant=7.0, duration=0.1, seed=2, sizes=OPTIONS):
    gas = jax.tree.map(f32, gas)
    key = random.key_from_seed(seed)
    return jax.jit(lambda v: collide(key, gas, sizes.plan, v, f32(majorant), f32(duration)))(
        velocity
    )


@pytest.mark.parametrize("restitution", [0.3, 0.9, 1.0])
def test_momentum_is_conserved(restitution):
    """Sums of 20000 float32 velocities: rounding of one collision is 1e-7 v0, random in sign."""
    before = maxwellian(1, OPTIONS)
    after, tally = _collide(InelasticHardSpheres(restitution), before)
    assert tally.accepted > 500
    np.testing.assert_allclose(sums(after)[0], sums(before)[0], atol=2e-8)


@pytest.mark.parametrize("gas", [InelasticHardSpheres(1.0), ElasticHardSpheres(0.5, 0.75)])
def test_elastic_collisions_conserve_energy(gas):
    """Relative rounding 1e-6 a collision (sine and cosine), about 1e-8 in the mean."""
    before = maxwellian(1, OPTIONS)
    after, tally = _collide(gas, before)
    assert tally.accepted > 500
    assert sums(after)[1] == pytest.approx(sums(before)[1], rel=2e-7)


def test_energy_tally_is_the_energy_lost():
    """To float32 rounding of both."""
    before = maxwellian(1, OPTIONS)
    after, tally = _collide(InelasticHardSpheres(0.5), before)
    lost = (sums(before)[1] - sums(after)[1]) * 20_000
    assert float(tally.energy_lost) == pytest.approx(lost, rel=1e-4)


def test_a_watch_sums_over_the_candidates():
    """It sees what the tally counts, to float32 rounding, and changes nothing."""
    before, key = maxwellian(1, OPTIONS), random.key_from_seed(2)
    gas = jax.tree.map(f32, InelasticHardSpheres(0.5))

    def watch(met):
        pairs = zip(met.transfer, met.left, met.right, strict=True)
        lost = sum(t * (a - b - t) for t, a, b in pairs)
        return {
            "made": jnp.sum(met.accepted),
            "expected": jnp.sum(met.probability),
            "lost": lost.sum(),
        }

    arguments = (key, gas, OPTIONS.plan, before, f32(7.0), f32(0.1))
    plain, tally = jax.jit(lambda: collide(*arguments))()
    watched, seen = jax.jit(lambda: collide(*arguments, watch))()
    assert tally.watched is None
    np.testing.assert_allclose(watched, plain, rtol=1e-6)
    assert int(seen.watched["made"]) == int(seen.accepted) == int(tally.accepted)
    assert float(seen.watched["lost"]) == pytest.approx(float(tally.energy_lost), rel=1e-5)
    # collisions made are a sum of independent chances: within 5 of the standard error at most
    expected = float(seen.watched["expected"])
    assert abs(int(tally.accepted) - expected) < 5 * np.sqrt(expected)


def _rates(gas, steps, count):
    """Accepted collisions and energy lost per particle and time of a gas held in equilibrium."""
    gas, duration = jax.tree.map(f32, gas), f32(0.1)

    def one(key):
        velocity = maxwellian(random.fold_in(key, 0), OPTIONS)

        def step(total, number):
            _, tally = collide(
                random.fold_in(key, number + 1), gas, OPTIONS.plan, velocity, f32(7.0), duration
            )
            return total + jnp.stack([tally.accepted, tally.energy_lost]), None

        total, _ = lax.scan(step, jnp.zeros(2, jnp.float32), jnp.arange(steps))
        return total / (20_000 * steps * duration)

    return np.asarray(jax.jit(jax.vmap(one))(keys(11, count)), float)


@pytest.mark.parametrize("factor", [1.0, 0.75])
def test_collision_frequency_in_equilibrium(factor):
    """4 n σ² √(πT/m) hits per particle, i.e. s = t/(√π τ): within errors of 0.1% or less.

    Of the first wave and, at κ = 0.5, of the second, in its proper share: the velocities of the
    second wave's old partners have changed, but equilibrium has not.
    """
    gas = InelasticHardSpheres(1.0) if factor == 1.0 else ElasticHardSpheres(1.0, factor)
    rates = _rates(gas, steps=40, count=48)[:, 0]
    error = rates.std(ddof=1) / np.sqrt(len(rates))
    assert error < 1e-3 * factor / np.sqrt(np.pi)
    # the particles' own Maxwellian samples fluctuate: their error is included in `error`
    assert abs(rates.mean() - factor / np.sqrt(np.pi)) < 4.5 * error


def test_cooling_rate_from_the_relative_speeds():
    """ζ = (1/48τ)(m/T)^{3/2}⟨V12³⟩(1-α²), eq. (2.10), with ⟨V12³⟩ in equilibrium: within 0.1%.

    In one step, before the second wave feels the first: α close to 1 makes that error of order
    (1-α) ν dt ζ, 1e-5 of ζ here.
    """
    restitution = 0.999
    rates = _rates(InelasticHardSpheres(restitution), steps=40, count=64)[:, 1]
    error = rates.std(ddof=1) / np.sqrt(len(rates))
    zeta = MAXWELL_CUBED / 48.0 * (1 - restitution**2)
    exact = zeta * 1.5 * 0.5
    # the float32 coefficient of restitution is 0.999 to 3e-8, hence 1-α² to 5e-5
    assert error < 1e-3 * exact
    assert abs(rates.mean() - exact) < 4.5 * error + 5e-5 * exact


def test_a_majorant_that_is_too_low_is_counted():
    """Pairs faster than w = 2 are accepted always; what they miss is counted exactly.

    accepted + excess is the unbiased number of collisions, N dt/√π, at the step that uses every
    slot (κ = 0.5): within 4.5 errors, Poisson plus 0.3 √N for the sample of velocities.
    """
    duration = 0.5 * 2.0**0.5 / 2.0
    tally = _collide(InelasticHardSpheres(1.0), maxwellian(1, OPTIONS), 2.0, duration)[1]
    assert tally.excess > 100
    expected = 20_000 * duration / np.sqrt(np.pi)
    error = np.sqrt(expected + 0.09 * 20_000)
    assert abs(float(tally.accepted + tally.excess) - expected) < 4.5 * error


def test_a_safe_majorant_has_no_excess():
    assert _collide(InelasticHardSpheres(1.0), maxwellian(1, OPTIONS))[1].excess == 0


def test_overflow_is_counted():
    """A step three times too long for the waves."""
    _, tally = _collide(InelasticHardSpheres(1.0), maxwellian(1, OPTIONS), duration=0.3)
    assert tally.overflow > 0


def test_fastest_pair_is_reported():
    velocity = maxwellian(1, OPTIONS)
    _, tally = _collide(InelasticHardSpheres(1.0), velocity)
    speeds = np.sqrt(sum(np.asarray(v, float) ** 2 for v in velocity))
    assert 3.0 < float(tally.fastest) <= 2 * speeds.max()


def test_step_is_differentiable_in_the_restitution():
    """d(energy after)/dα along a fixed choice of collisions equals a finite difference.

    The choice does not depend on α (the acceptance of this gas does not), so the pathwise
    derivative is the whole one for one wave; central difference, h = 1e-2, in float32.
    """
    velocity = maxwellian(1, OPTIONS)
    key = random.key_from_seed(2)

    def energy(alpha):
        after, _ = collide(
            key, InelasticHardSpheres(alpha), OPTIONS.plan, velocity, f32(7.0), f32(0.001)
        )
        return 0.5 * jnp.mean(sum(v * v for v in after))

    alpha = jnp.float32(0.8)
    _, derivative = jax.jvp(energy, (alpha,), (jnp.float32(1.0),))
    h = 0.05
    difference = (float(energy(alpha + h)) - float(energy(alpha - h))) / (2 * h)
    # the energy is quadratic in α for disjoint pairs: the central difference is exact but for
    # float32 rounding of an energy 0.75 (6e-8/2h = 6e-7) against a derivative of 2e-4
    assert float(derivative) == pytest.approx(difference, rel=2e-2)
    assert float(derivative) == pytest.approx(float(jax.grad(energy)(alpha)), rel=1e-4)
