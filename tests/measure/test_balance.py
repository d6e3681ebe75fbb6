"""Second moments without the noise of collisions: what is expected of a pair, and what is left."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres, MaxwellMolecules, random
from jdsmc.collisions.whole import collide
from jdsmc.measure import balance
from jdsmc.running.estimates import averages_to_print, estimates_of
from jdsmc.scenarios import UniformShear

from ..helpers import PlainSpheres, Viscoelastic, f32, keys, maxwellian, options

OPTIONS = options(1024)
GASES = [
    InelasticHardSpheres(0.5),
    ElasticHardSpheres(0.7, 0.85),
    MaxwellMolecules(),
    Viscoelastic(0.5),
]


def _sheared(key):
    """Velocities with every second moment different, and far from a Maxwellian."""
    x, y, z = maxwellian(key, OPTIONS)
    x = x - 0.8 * y
    return (jnp.where(x > 0, 1.5, 1.0) * x, y, 0.5 * z)


@pytest.mark.parametrize("gas", GASES, ids=repr)
def test_what_is_expected_of_the_pairs_is_right_in_the_mean(gas):
    """Whatever the state and the gas: within 4.5 errors, of 1% of the change of xx by collisions.

    Of one long step, whose second wave sees what the first left.
    """
    gas = jax.tree.map(f32, gas)

    def one(key):
        velocity = _sheared(key)
        before = jnp.stack(balance.second_moments(velocity))
        velocity, tally = collide(
            *(random.fold_in(key, 1), gas, OPTIONS.plan, velocity),
            *(f32(10.0), f32(0.08), balance.noise_of(gas)),
        )
        return tally.watched / 1024, jnp.stack(balance.second_moments(velocity)) - before

    noise, change = (np.asarray(x, float) for x in jax.jit(jax.vmap(one))(keys(3, 1000)))
    error = np.std(noise, axis=0, ddof=1) / np.sqrt(len(noise))
    assert np.all(error < 1e-2 * abs(np.mean(change[:, 0])))
    assert np.all(np.abs(np.mean(noise, axis=0)) < 4.5 * error)


def test_six_directions_are_exact_for_a_transfer_linear_in_them():
    """A gas that does not tell its share has the same expectation for each pair, to rounding."""
    relative, other = (tuple(v.ravel() for v in maxwellian(k, OPTIONS)) for k in (1, 2))
    speed, length = (jnp.sqrt(sum(v * v for v in one)) for one in (relative, other))
    outgoing = tuple(v * speed / length for v in other)
    known = balance.mean_changes(InelasticHardSpheres(0.5), relative, outgoing)
    found = balance.mean_changes(PlainSpheres(0.5), relative, outgoing)
    # products of speeds up to 4 v0, summed over six directions in float32
    np.testing.assert_allclose(found, known, atol=2e-5)


def test_a_gas_mistaken_about_its_share_is_refused():
    class Mistaken(PlainSpheres):
        def transfer_share(self):
            return 0.5

    with pytest.raises(ValueError, match=r"transfer_share gives 0\.5"):
        jdsmc.run(UniformShear(Mistaken(0.5), 1.0), collisions=1.0, progress=False)


def test_a_linear_drift_is_undone_exactly():
    """Moments that start anywhere and relax linearly: m* whatever the noise, to rounding."""
    rng = np.random.default_rng(1)
    relax = -np.diag([0.9, 0.7, 0.6, 0.8]) + 0.1 * rng.standard_normal((4, 4))
    steady = np.array([1.5, 0.7, 0.8, -0.5])
    middle = steady + rng.standard_normal((8, 20, 4)) + np.array([3.0, 0.0, -1.0, 0.5])
    drift = (middle - steady) @ relax.T
    weights = rng.uniform(0.5, 1.0, (8, 20))
    records = np.concatenate([middle, drift], axis=-1)
    means = {"balance": np.einsum("rn,rni->ri", weights, records) / weights.sum(1)[:, None]}
    means |= balance.squares(records, weights)
    means |= dict.fromkeys(balance.NAMES, np.zeros(8))
    found = balance.without_noise({name: np.mean(x, axis=0) for name, x in means.items()})
    np.testing.assert_allclose([found[n] for n in balance.NAMES], steady, rtol=1e-9)
    assert found["temperature"] == pytest.approx(1.0, rel=1e-9)


def test_collisions_early_in_a_record_count_for_longer():
    """The mean over time of a jump in the middle of the first of n equal steps: 1 - 1/2n."""
    noise = jnp.zeros((5, 4)).at[0].set(1.0)
    one = balance.balance_of(noise, jnp.full(5, 0.3), (jnp.ones((1, 1)),) * 3)
    np.testing.assert_allclose(one.path + 0.5 * one.noise, 1.0 - 0.1, rtol=1e-6)


def test_moments_that_never_change_are_left_as_they_are():
    """No collisions, no drift: nothing to fit, and no division by it."""
    records = np.zeros((8, 10, 8))
    records[..., :4] = np.arange(1.0, 5.0)
    weights = np.ones((8, 10))
    means = {"balance": np.mean(records, axis=1)} | balance.squares(records, weights)
    found = balance.without_noise(means | dict.fromkeys(balance.NAMES, np.zeros(8)))
    np.testing.assert_allclose(found["xy"], 4.0)


class Plain(UniformShear):
    """The time averages as they are."""

    balanced = False


def test_less_noise_and_the_same_mean():
    """Of one run, against its plain averages: the same within 4.5 errors, with a smaller one.

    Seen: variances down 5 times for the stress, 2 to 3 times for T; they are known to 50% here.
    """
    asked = {"n_particles": 1024, "collisions": 150.0, "seed": 5, "progress": False}
    gas = InelasticHardSpheres(0.7)
    result = jdsmc.run(UniformShear(gas, 4.0), **asked)
    session = result.under_way.session
    found = averages_to_print(session.history, 0, int(session.tracker.start[0]))
    plain = ({n: x for n, x in one.items() if not n.startswith("balance")} for one in found)
    value, error, _ = estimates_of(session.history.scenes[0], *plain)
    for name, least in (("shear_stress", 2.0), ("temperature", 1.2), ("normal_stress_xy", 1.5)):
        ours, its = result[name]
        assert (error[name] / its) ** 2 > least
        # the difference is the noise that was taken out: what the error of the plain value has
        assert 0 < abs(ours - value[name]) < 4.5 * error[name]


def test_a_scene_that_does_not_ask_pays_nothing():
    """No watch is handed to the collisions: the record has no balance."""
    sizes = options(1024, steps=2)
    for scene, there in ((Plain, False), (UniformShear, True)):
        one = scene(InelasticHardSpheres(0.7), 4.0)
        one = jax.tree.map(f32, one)
        state = eqx.filter_eval_shape(one.initial, random.key_from_seed(1), sizes)
        _, record = eqx.filter_eval_shape(one.advance, random.key_from_seed(1), state, sizes)
        assert (record.tally.watched is not None) == there


def test_a_point_without_numbers_and_one_without_collisions_leave_the_others_alone():
    """NaN stays where it is, and a moment that never changes is left as it was."""
    matrix = np.stack([2.0 * np.eye(4), np.zeros((4, 4)), np.full((4, 4), np.nan)])
    found = balance._solved(matrix, np.ones((3, 4, 1)))[..., 0]
    np.testing.assert_allclose(found[:2], [[0.5] * 4, [0.0] * 4], atol=1e-15)  # rounding
    assert np.all(np.isnan(found[2]))
