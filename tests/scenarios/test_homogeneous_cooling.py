"""The freely cooling gas: exact balances, Haff's law, the steady reduced distribution."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres
from jdsmc.scenarios import HomogeneousCooling
from jdsmc.scenarios.scaled import scaled_to_start, slowed_rates
from jdsmc.theory import homogeneous_cooling as theory
from jdsmc.units import MAXWELL_CUBED

from .batches import simulate, standard_error, within

ALPHAS = [0.5, 0.9]
CHUNKS, SKIP = 14, 5
"""Simulated, and left out: 5 chunks of 64 steps are 15 collisions per particle, as far as any
memory of the Maxwellian goes (it decays within two of them)."""


@pytest.fixture(scope="module")
def gases():
    """One batch of both gases: its history and the records of a chunk."""
    runs = {}
    for alpha in ALPHAS:
        scene = HomogeneousCooling(InelasticHardSpheres(alpha))
        runs[alpha] = simulate(scene, CHUNKS, n_particles=16_000, n_realizations=16, seed=2)
    return runs


def _steady(run):
    history, records = run
    return history.point(0, SKIP * records, history.length)


def _ratio(means):
    return means["cubed"] / (MAXWELL_CUBED * means["T3"])


def _a2(means):
    return means["fourth"] / (15 * means["T4"]) - 1


def _mean_powers(means, alpha):
    """√T and T^{3/2} averaged over the steps, from the rates of local equilibrium."""
    root, cube = means["local_rate"], means["local_loss"] / (1 - alpha**2)
    return root * np.sqrt(np.pi / 2), cube * np.sqrt(np.pi / 2)


@pytest.mark.parametrize("alpha", ALPHAS)
def test_haffs_law_in_plain_time(gases, alpha):
    """1/√T grows by the integral of ζ/(2√T) over plain time, to 0.1%; ζ from the energy lost.

    The sum over records takes ζ/√T as constant within one, which it is on average. Both sides come
    from the same collisions, so that their noise cancels.
    """
    history, records = gases[alpha]
    first = SKIP * records
    inverse = 1 / np.sqrt(2 * history["true_temperature"][0])
    _, cube = _mean_powers(history, alpha)
    slope = (history["energy_lost"] / history["elapsed"] / cube)[0] / (3 * 2**0.5)
    plain = np.diff(history["time"][0], axis=1)  # slope: (ζ/2)/√(T/T0), with ζ = (2/3) loss/T
    gained = inverse[:, -1] - inverse[:, first]
    expected = np.sum(slope[:, first:-1] * plain[:, first:], axis=1)
    assert standard_error(gained / expected) < 2.5e-4
    assert abs(np.mean(gained / expected) - 1) < 1e-3


def test_every_loss_is_a_collision(gases):
    """The energy between two records falls by what collisions took, to rounding (5e-5 of it)."""
    history, _ = gases[0.5]
    heat = history["true_temperature"][0]
    left = heat[:, 1:] / heat[:, :-1]
    np.testing.assert_allclose(
        0.75 * (1 - left), history["energy_lost"][0, :, :-1], rtol=1e-4, atol=1e-5
    )


@pytest.mark.parametrize("alpha", ALPHAS)
def test_cooling_rate_by_pairs_and_from_the_energy_lost(gases, alpha):
    """⟨V12³⟩ by pairs, which random pairs of the gas have, and by what collisions took (2.10)."""
    means = _steady(gases[alpha])
    lost = means["energy_lost"] / means["local_loss"]
    assert standard_error(lost - _ratio(means)) < 1.5e-3
    assert within(lost - _ratio(means))


@pytest.mark.parametrize("alpha", ALPHAS)
def test_collision_rate(gases, alpha):
    """1 - a2/16 times that of the Maxwellian, with the a2 measured.

    a3 and a2² change it by a few 1e-4 (measured a3: -0.014 at α = 0.5; its factor is 1/48).
    """
    means = _steady(gases[alpha])
    rate = means["accepted"] / means["local_rate"]
    difference = rate - (1 - _a2(means) / 16)
    assert standard_error(difference) < 5e-4
    assert abs(np.mean(difference)) < 4.5 * standard_error(difference) + 5e-4


@pytest.mark.parametrize("alpha", ALPHAS)
def test_steady_cumulants(gases, alpha):
    """The formula for a2 is off by 10% at most down to α = 0.5 (it leaves out a3 and a2²)."""
    means = _steady(gases[alpha])
    a2, known = _a2(means), theory.kurtosis(alpha)
    assert standard_error(a2) < 0.15 * abs(known)
    assert abs(np.mean(a2)) > 4.5 * standard_error(a2)
    assert abs(np.mean(a2) - known) < 4.5 * standard_error(a2) + 0.1 * abs(known)
    a3 = -means["sixth"] / (105 * means["T6"]) + 1 + 3 * a2
    # Brilliantov and Pöschel (2006): a3 from -0.015 at α = 0.5 to -0.003 at 0.9, second order
    # in what a2 is of first order, hence smaller: |a3| < |a2| and never positive
    assert np.mean(a3) < 4.5 * standard_error(a3)
    assert abs(np.mean(a3)) < abs(known) / 2 + 4.5 * standard_error(a3)


def test_every_record_is_at_t0_and_at_rest(gases):
    """Scaled and centred at each record, to the rounding of 16000 float32 velocities."""
    history, _ = gases[0.5]
    np.testing.assert_allclose(history["temperature"], 0.5, rtol=1e-6)
    velocity = tuple(jax.random.normal(jax.random.key(k), (64, 100)) + k for k in range(3))
    scaled, log_scale = scaled_to_start(velocity)
    for before, after in zip(velocity, scaled, strict=True):
        assert abs(float(np.mean(np.asarray(after, dtype=float)))) < 1e-6
        relative = np.asarray(before - jnp.mean(before))
        np.testing.assert_allclose(
            np.exp(float(log_scale)) * np.asarray(after), relative, rtol=1e-4, atol=1e-5
        )
    energy = sum(np.mean(np.asarray(v, dtype=float) ** 2) for v in scaled)
    assert energy / 3 == pytest.approx(0.5, rel=1e-6)


def test_slowed_rates():
    """The trapezoidal rule: exact for a linear √T; for its cube to h² = 1/64 of the curvature."""
    root = np.linspace(1, 0.6, 9)
    first, third = slowed_rates(jnp.asarray(0.5 * root[1:] ** 2, dtype=jnp.float32), 1.0)
    assert float(first) == pytest.approx(0.8, rel=1e-6)
    exact = (1 - 0.6**4) / (4 * 0.4)
    assert float(third) == pytest.approx(exact, abs=6 * 0.4**2 / 64 / 12 * 1.05)


def test_rescaling_changes_nothing():
    """Scaling every 2 or every 16 steps: the same distribution, the same Haff's law.

    The time step follows the temperature of the record's start, so that with 16 steps it is up to
    a third shorter: the agreement is one of two time steps as well. Errors: 0.15% and 4% of a2.
    """
    scene = HomogeneousCooling(InelasticHardSpheres(0.5))
    measured = {}
    for steps in (2, 16):
        options = dict(n_particles=8000, steps=steps, records=64 // steps, seed=3 + steps)
        history, records = simulate(scene, 10, **options)
        means = history.point(0, 4 * records, history.length)
        measured[steps] = means["energy_lost"] / means["local_loss"], _a2(means)
    for (few, many), precision in zip(
        zip(*measured.values(), strict=True), (3e-3, 0.1), strict=True
    ):
        error = np.hypot(standard_error(few), standard_error(many))
        assert error < precision * np.mean(few)
        assert abs(np.mean(few) - np.mean(many)) < 4.5 * error


def test_elastic_gas_does_not_cool():
    """α = 1: T = T0 at all times, to rounding; a2 = 0; no cooling rate to speak of."""
    scene = HomogeneousCooling(InelasticHardSpheres(1.0))
    result = jdsmc.run(scene, n_particles=4000, rtol=0.005, progress=False, seed=4)
    np.testing.assert_allclose(result.series["temperature"], 1.0, rtol=2e-5)
    a2, error = result["a2"]
    # E[V⁴] of a microcanonical sample is lower by 2/(3N): 1.7e-4
    assert abs(a2 + 2 / (3 * 4000)) < 4.5 * error
    assert np.isnan(result["relative_speed_cubed_collisional"].value)


def test_series(gases):
    """T/T0 obeys Haff's law in the series; reduced time is ∫ √(T/T0) dt, s/s0 stays near one."""
    scene = HomogeneousCooling(InelasticHardSpheres(0.7))
    result = jdsmc.run(scene, n_particles=4000, duration=60.0, progress=False, seed=5)
    series = result.series
    time = series["time"].values
    haff = theory.haff_temperature(time, 0.7)
    # ζ differs from its steady value by at most (3/16)|a2| and noise, 0.5% each: T by twice that
    assert np.max(np.abs(series["temperature"].values / haff - 1)) < 0.02
    assert time[-1] > 55 and series["temperature"].values[-1] < 0.025
    exact = 2 * np.log1p(theory.cooling_rate(0.7) * time / 2) / theory.cooling_rate(0.7)
    np.testing.assert_allclose(series["reduced_time"], exact, rtol=0.01, atol=1e-9)
    np.testing.assert_allclose(series["collision_ratio"][1:], 1.0, atol=0.02)


def test_cooling_beyond_the_range_of_floats(tmp_path):
    """1200 collisions per particle at α = 0.3: T/T0 = e^{-750}, and every time has its logarithm.

    By Haff's law ln T/T0 = -2 ln(1 + ζt/2) exactly if ζ is steady; that of 64 particles is known to
    some percent of 1, here 0.3 with the first collisions, in which ζ changes. Both points of a
    sweep go all the way, though one cools four times as fast.
    """
    scene = HomogeneousCooling(InelasticHardSpheres([0.3, 0.9]))
    result = jdsmc.run(scene, n_particles=64, collisions=1200.0, progress=False, seed=6)
    last = result.series.isel(sample=-1)
    # the series ends with the realization that is least far in time: some percent of 1200 earlier
    assert np.all(last["collisions"] > 1150)
    assert np.all(np.isfinite(result.series["log_time"]))
    assert np.all(np.diff(result.series["log_time"]) > 0)
    assert last["log_temperature"][0] < -745 and last["temperature"][0] == 0
    for k, alpha in enumerate((0.3, 0.9)):
        half = np.log(0.5 * theory.cooling_rate(alpha))
        expected = -2 * np.logaddexp(0, half + last["log_time"][k])
        assert abs(float(last["log_temperature"][k] - expected)) < 0.3
    result.plot(tmp_path / "long.png")  # in logarithms


# Input


@pytest.mark.parametrize("alpha", [0.5, 1.0])
def test_gas_with_drag(alpha):
    with pytest.raises(TypeError, match="HomogeneousCooling needs a gas without drag"):
        HomogeneousCooling(ElasticHardSpheres(alpha))


def test_only_collisions_act():
    """First-order splitting is refused by the scene, not only on the command line."""
    scene = HomogeneousCooling(InelasticHardSpheres(0.9))
    with pytest.raises(ValueError, match="splitting = 'lie' has no meaning here"):
        jdsmc.run(scene, splitting="lie", duration=1.0)


@pytest.mark.slow
def test_molecular_chaos_to_a_thousandth():
    """⟨V12³⟩ of colliding and of random pairs, error 0.02%: they agree to 0.15%.

    It was 0.34(2)%, whatever N, when both waves were thinned as if by themselves.
    """
    scene = HomogeneousCooling(InelasticHardSpheres(0.5))
    options = dict(n_particles=16_000, n_realizations=32, time_step=0.05, steps=16, records=16)
    history, _ = simulate(scene, 20, seed=21, **options)
    means = history.point(0, 48, history.length)
    lost = means["energy_lost"] / means["local_loss"]
    difference = lost - _ratio(means)
    assert standard_error(difference) < 3e-4
    assert abs(np.mean(difference)) < 1.5e-3
