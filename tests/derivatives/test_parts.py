"""The parts of the method, each against what it must be exactly."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import ElasticHardSpheres, InelasticHardDisks, InelasticHardSpheres, random, sweep
from jdsmc.collisions.sampled import both_ways, random_pairs
from jdsmc.derivatives.numbers import slope
from jdsmc.derivatives.samples import Samples
from jdsmc.derivatives.sampling import Sampler
from jdsmc.measure.heat import heat_moments
from jdsmc.measure.moments import moments
from jdsmc.measure.polynomials import AXIAL, ISOTROPIC, SHEARED, Averages
from jdsmc.scenarios import HeatFluxForce, HomogeneousCooling, UniformShear
from jdsmc.units import MAXWELL_CUBED

from .. import helpers

SIZES = helpers.options(4096)


def sheared(seed=1):
    """Velocities without symmetry but those of a sheared gas."""
    vx, vy, vz = helpers.maxwellian(seed, SIZES)
    return 1.2 * vx - 0.4 * vy, 0.9 * vy, vz


def averages(symmetry, velocity, degree=7, cubed=None):
    """Averages of the polynomials of a gas, by their powers."""
    basis = symmetry.basis(degree)
    values = [float(jnp.mean(x)) for x in symmetry.values(velocity, basis)]
    return Averages(basis, np.array(values), {"cubed": cubed})


def test_numbers_of_polynomials():
    """As counted by hand: 13 and 29 of a sheared gas, 8 and 15 with axial symmetry, 2 and 3."""
    counts = [[len(s.basis(d)) for d in (4, 6)] for s in (SHEARED, AXIAL, ISOTROPIC)]
    assert counts == [[13, 29], [8, 15], [2, 3]]


@pytest.mark.parametrize("symmetry", [SHEARED, AXIAL, ISOTROPIC])
def test_images_have_the_same_trial_functions(symmetry):
    """A mirrored velocity is as likely: only products of signs, exact in floating point."""
    velocity, basis = sheared(), symmetry.basis(6)
    assert symmetry.images[0] == (1, 1, 1)
    assert len(set(symmetry.images)) == len(symmetry.images) > 1
    for signs in symmetry.images:
        image = tuple(sign * v for sign, v in zip(signs, velocity, strict=True))
        for one, other in zip(
            symmetry.values(velocity, basis), symmetry.values(image, basis), strict=True
        ):
            np.testing.assert_array_equal(one, other)


def test_trial_functions_come_first():
    assert SHEARED.basis(6)[:13] == SHEARED.basis(4)


def test_moments_from_polynomials():
    """To float32 rounding of a mean over 4096, 1e-5; the isotropic gas is turned to be so."""
    velocity = sheared()
    vx, vy, vz = velocity
    symmetric = tuple(
        jnp.concatenate(parts)
        for parts in ((vx, vx, -vx, -vx), (vy, -vy, vz, -vz), (vz, -vz, -vy, vy))
    )
    for symmetry, gas, measured in (
        (SHEARED, velocity, moments(velocity)),
        (ISOTROPIC, velocity, moments(velocity)),
        (AXIAL, symmetric, heat_moments(symmetric)),
    ):
        found = symmetry.moments(averages(symmetry, gas, cubed=1.0), 3)
        even, known = (
            (found, measured)
            if symmetry is not AXIAL
            else (
                found.isotropic,
                measured.isotropic,
            )
        )
        for name in ("fourth", "sixth"):
            assert float(vars(even)[name]) == pytest.approx(float(vars(known)[name]), rel=1e-5)
        if symmetry is not ISOTROPIC:
            assert float(even.xx) == pytest.approx(float(known.xx), rel=1e-5)
            assert float(even.yy) == pytest.approx(float(known.yy), rel=2e-2)
    assert float(found.flux[0]) == pytest.approx(float(measured.flux[0]), abs=1e-4)


@pytest.mark.parametrize(
    "scene",
    [
        UniformShear(InelasticHardSpheres(0.7), 0.8),
        UniformShear(ElasticHardSpheres(0.6), 0.8),
        UniformShear(ElasticHardSpheres(0.6, drag="measured"), 0.8),
    ],
)
def test_drift_of_a_sheared_gas_is_that_of_its_flow(scene):
    """Central difference of the flow over ±0.02 τ0: rounding 1e-6/0.02, third order 1e-4."""
    velocity = sheared()
    # as an engine casts them
    cast = jax.tree.map(lambda x: helpers.f32(x) if sweep.is_number(x) else x, scene)
    ratio = cast.drag_ratio(velocity)
    cubed = float(ratio) * MAXWELL_CUBED * temperature(velocity) ** 1.5
    mean = averages(SHEARED, velocity, cubed=cubed)
    before, after = (
        averages(SHEARED, cast.flow(velocity, helpers.f32(t), ratio)) for t in (-0.02, 0.02)
    )
    for powers in SHEARED.basis(6):
        rate = (after[powers] - before[powers]) / 0.04
        assert float(scene.moment_drift(powers, mean)) == pytest.approx(rate, rel=4e-3, abs=2e-3)


def temperature(velocity):
    return float(sum(jnp.mean(v * v) for v in velocity)) / 3.0


def test_drift_of_the_heat_flux_force_is_that_of_its_flow():
    """As above; velocities are made symmetric about the x axis first."""
    vx, vy, vz = sheared()
    velocity = tuple(
        jnp.concatenate(parts)
        for parts in ((vx, vx, vx, vx), (vy, -vy, vz, -vz), (vz, -vz, -vy, vy))
    )
    velocity = (velocity[0] - jnp.mean(velocity[0]), *velocity[1:])
    scene = HeatFluxForce(InelasticHardSpheres(0.7), 0.1)
    mean = averages(AXIAL, velocity)
    before, after = (
        averages(AXIAL, scene.flow(velocity, helpers.f32(t))[0]) for t in (-0.05, 0.05)
    )
    for powers in AXIAL.basis(6):
        rate = (after[powers] - before[powers]) / 0.1
        assert float(scene.moment_drift(powers, mean)) == pytest.approx(rate, rel=4e-3, abs=2e-3)


def sample(gas, velocity, paths=(), symmetry=SHEARED, degree=4):
    """Sums of one instant at the true scale of velocities."""
    gas = jax.tree.map(lambda x: jnp.asarray(x, jnp.float32), gas)
    return sums(Sampler(symmetry, degree, tuple(paths), False), gas, velocity)


@eqx.filter_jit
def sums(sampler, gas, velocity):
    """Compiled once for all gases of a kind."""
    return sampler.sample(random.key_from_seed(5), gas, velocity, jnp.ones(()))


def test_tangents_are_differences_of_the_source():
    """At fixed pairs and directions the source is a polynomial in α, of degree four at most.

    Differences over ±0.1 and ±0.2 together are exact for these: to rounding in float32.
    """
    velocity = sheared()
    tangent = sample(InelasticHardSpheres(0.7), velocity, ("restitution",))["tangents"][0]
    at = {a: sample(InelasticHardSpheres(a), velocity)["source"] for a in (0.5, 0.6, 0.8, 0.9)}
    near, far = (at[0.8] - at[0.6]) / 0.2, (at[0.9] - at[0.5]) / 0.4
    np.testing.assert_allclose(tangent, (4.0 * near - far) / 3.0, rtol=1e-4, atol=1e-4)


def test_elastic_collisions_conserve_energy_and_happen_as_often_as_they_must():
    """The rate of a Maxwellian to four standard errors: 2048 pairs know ⟨g⟩ to 1%."""
    found = sample(InelasticHardSpheres(1.0), helpers.maxwellian(3, SIZES))
    rows = [SHEARED.basis(4).index(powers) for powers in SHEARED.squares]
    assert abs(float(np.sum(np.asarray(found["source"])[rows]))) < 1e-5
    rate = InelasticHardSpheres(1.0).collision_rate(0.5)
    assert float(found["source"][-1]) == pytest.approx(float(rate), rel=0.04)


def test_inelastic_loss_is_that_of_the_gas():
    """To four standard errors, 2% each: pairs lose (1-α²) g²/8 at the rate g."""
    found = sample(InelasticHardSpheres(0.7), helpers.maxwellian(3, SIZES))
    rows = [SHEARED.basis(4).index(powers) for powers in SHEARED.squares]
    loss = -0.5 * float(np.sum(np.asarray(found["source"])[rows]))
    known = float(InelasticHardSpheres(0.7).energy_loss_rate(0.5))
    assert loss == pytest.approx(known, rel=0.08)


def test_disks_lose_what_they_must():
    sizes = helpers.options(4096)
    velocity = helpers.maxwellian(3, sizes)[:2]
    found = sample(InelasticHardDisks(0.7), velocity, symmetry=ISOTROPIC)
    loss = -0.5 * float(found["source"][0])
    heat = float(sum(jnp.mean(v * v) for v in velocity)) / 2.0
    known = float(InelasticHardDisks(0.7).energy_loss_rate(heat))
    assert loss == pytest.approx(known, rel=0.08)


def test_pairs_are_different_particles_and_directions_opposite():
    rows = jnp.arange(4096.0).reshape(64, 64)
    left, right = random_pairs(random.key_from_seed(1), (rows, rows, rows))
    both = np.concatenate([np.ravel(left[0]), np.ravel(right[0])])
    assert len(np.unique(both)) == 4096
    relative = (jnp.ones(3), jnp.zeros(3), jnp.zeros(3))
    u = jnp.array([0.1, 0.5, 0.9])
    one, other = both_ways(relative, jnp.ones(3), u, u)
    np.testing.assert_allclose(sum(a + b for a, b in zip(one, other, strict=True)), 0.0, atol=1e-6)


def test_slope_is_exact_for_polynomials_of_degree_four():
    assert float(slope(lambda h: (1.0 + h) ** 4, 0.1)) == pytest.approx(4.0, rel=1e-12)


def test_blocks_that_are_added_up_keep_their_averages():
    """Averages over all blocks do not depend on how often blocks were joined."""
    sampler = Sampler(ISOTROPIC, 2, (), True)
    rng, samples, kept = np.random.default_rng(1), Samples(sampler), []
    for k in range(700):
        sums = {
            "reference": np.ones((1, 2)),
            "moments": rng.normal(size=(1, 2, 3)),
            **{"second": np.ones((1, 2, 3, 1)), "source": np.ones((1, 2, 2))},
            **{"response": np.ones((1, 2, 2, 1)), "cubed": np.ones((1, 2))},
            **{"cubed_response": np.ones((1, 2, 1)), "tangents": np.ones((1, 2, 0, 2))},
        }
        elapsed = rng.uniform(0.5, 1.0, size=(1, 2))
        kept.append((sums["moments"], elapsed))
        samples.append(sums, elapsed, 4 * k)
    means, weights, first = samples.point(0, 0)
    assert len(first) <= 257 and first[0] == 0 and np.all(np.diff(first) > 0)
    whole = np.sum(means["moments"] * weights[..., None], axis=1)
    np.testing.assert_allclose(whole, sum(m[0] * w[0][:, None] for m, w in kept))


def test_scenes_say_what_they_hold():
    assert HomogeneousCooling(InelasticHardSpheres(0.7)).holds_temperature()
    assert not UniformShear(InelasticHardSpheres(0.7), 1.0).holds_temperature()
