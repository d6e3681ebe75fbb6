"""The sequential peer of the benchmarks obeys the physics that it is compared on."""

import numpy as np
import pytest

pytest.importorskip("numba")

from benchmarks.peer_numba import simulate

# A collision rounds six components, by half a unit of the last place each; the errors are random,
# so 10 collisions per particle leave a few units in the mean: 16 units of the last place.
ROUNDING = {"float32": 16 * 2.0**-24, "float64": 16 * 2.0**-53}


@pytest.mark.parametrize("dtype", ["float32", "float64"])
def test_elastic_gas_at_rest_keeps_energy_and_momentum(dtype):
    run = simulate(1000, 1.0, 0.0, 18.0, seed=1, time_step=0.1, record_every=8, dtype=dtype)
    velocity = run.velocity.astype(float)
    assert run.collisions[-1] > 10
    assert np.abs(velocity.mean(axis=0)).max() < ROUNDING[dtype]
    assert abs(np.sum(velocity**2) / 1500 - 1) < ROUNDING[dtype]


def test_equilibrium_collision_rate():
    """s0 = t / (sqrt(pi) tau): 3.4e6 collisions, at most Poisson; 3 error bars are 0.16%."""
    run = simulate(50_000, 1.0, 0.0, 120.0, seed=2, time_step=0.05, record_every=10)
    expected = run.time[-1] / np.sqrt(np.pi)
    assert run.collisions[-1] == pytest.approx(run.accepted / 50_000, rel=1e-15)
    assert abs(run.collisions[-1] / expected - 1) < 3 / np.sqrt(expected * 50_000)


def test_elastic_collisions_leave_an_isotropic_gas_isotropic():
    """Stresses of N Maxwellian particles scatter by 1/sqrt(N) and sqrt(4/N); 4 error bars each."""
    run = simulate(50_000, 1.0, 0.0, 10.0, seed=3, time_step=0.1, record_every=8)
    assert abs(run.shear_stress[-1]) < 4 / np.sqrt(50_000)
    assert abs(run.normal_stress_xy[-1]) < 4 * np.sqrt(4 / 50_000)


def test_free_cooling_rate():
    """zeta0 = 2 (1 - alpha^2) / (3 sqrt(pi) tau): Haff's law T = T0 (1 + zeta0 t / 2)^-2.

    At alpha = 0.9 the kurtosis changes zeta by 3 a2 / 16 = -0.3%, the step (dt = 0.02 tau) by less
    than zeta dt / 2 = 0.1%, and noise by 1 / sqrt(collisions) = 0.2%: together within 1%.
    """
    run = simulate(50_000, 0.9, 0.0, 20.0, seed=4, time_step=0.02, record_every=40)
    zeta = 2 * (1 - 0.9**2) / (3 * np.sqrt(np.pi))
    measured = 2 * (run.temperature[-1] ** -0.5 - 1) / run.time[-1]
    assert measured == pytest.approx(zeta, rel=0.01)


def test_steady_shear_flow():
    """Paper, section V: T_s/T0 about 147 and -P_xy/nT about 0.33 at alpha = 0.9, a = 4.

    2% of T is the reading of the figure; fluctuations of the mean over 10 tau0 are below 0.5%.
    """
    run = simulate(10_000, 0.9, 4.0, 20.0, seed=5, time_step=0.005)
    steady = run.time > 10
    assert run.temperature[steady].mean() == pytest.approx(147, rel=0.02)
    assert run.shear_stress[steady].mean() == pytest.approx(0.33, abs=0.01)


def test_deferred_streaming_gives_the_same_numbers_as_streaming_every_step():
    """Rounding (1e-16) grows by e per collision or so; 3 collisions per particle leave 1e-9 ample.

    The carried moments are compared with those of the final velocities in both.
    """
    flow = {"n_particles": 1000, "restitution": 0.8, "shear_rate": 4.0, "duration": 1.5, "seed": 6}
    settings = {"time_step": 0.02, "record_every": 10, "dtype": "float64"}
    runs = [simulate(**flow, **settings, streaming=name) for name in ("deferred", "every_step")]
    np.testing.assert_allclose(runs[0].velocity, runs[1].velocity, rtol=0, atol=1e-9)
    for run in runs:
        x, y, _ = run.velocity.T
        energy = np.sum(run.velocity**2) / 3
        assert run.temperature[-1] == pytest.approx(energy / 500, rel=1e-12)
        assert run.shear_stress[-1] == pytest.approx(-x @ y / energy, rel=1e-11)
        assert run.normal_stress_xy[-1] == pytest.approx((x @ x - y @ y) / energy, rel=1e-11)


def test_a_majorant_that_is_too_low_is_raised_and_the_excess_counted(monkeypatch):
    """w starts at 2 thermal speeds, the largest relative speed of 1e5 candidates is 4.5 to 6."""
    monkeypatch.setattr("benchmarks.peer_numba.INITIAL_MAJORANT", 2.0)
    run = simulate(1000, 1.0, 0.0, 60.0, seed=7, time_step=0.1, record_every=8)
    acceptance = run.accepted / run.candidates
    assert 0 < run.excesses < 0.01 * run.candidates
    assert np.sqrt(8 / np.pi) / 6 < acceptance < np.sqrt(8 / np.pi) / 4.5  # <g> / w
