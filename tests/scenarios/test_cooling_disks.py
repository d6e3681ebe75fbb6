"""Cooling disks by DSMC: what is exact, in one cell and in many; the estimator on the real thing.

Dilute disks depend on N n σ² alone, so that a hundred real ones at n σ² = 0.2 with thirty copies do
what two thousand do at 0.01 with one or two.
"""

import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardDisks
from jdsmc.scenarios import CoolingDisks
from jdsmc.theory import langevin

SIGMAS = 4.5
"""As everywhere: with 8 realizations or more, exceeded by chance in one test of 300."""

REDUCED = 20.0
FINE = {"copies": 30, "real_per_cell": 0.16}
"""Of a hundred disks: 625 cells of 0.5 λ0 with 4.8 fictive particles."""
CELL_BIAS = 0.1
"""Relative, of η and C(0): cells of Δx add 0.13 to 0.3 (Δx/λ0)² to η (0.13 and 0.15 with 2.5 and
0.9 λ0, elastic), and recollisions of a few particles heat the gas by 2%."""


def simulate(alpha, seed, duration=300.0, density=0.2, n_particles=100, **scene):
    return jdsmc.run(
        CoolingDisks(InelasticHardDisks(alpha), density=density, **scene),
        **{"n_particles": n_particles, "n_realizations": 16, "progress": False},
        seed=seed,
        duration=duration,
    )


def deviation(result, name, expected):
    """(value - expected)/error, and the error."""
    value, error = result[name]
    return (value - expected) / error, error


@pytest.fixture(scope="module")
def elastic():
    """Elastic gases: one fictive disk for each real one in 25 wide cells, and thirty in 625."""
    return {1: simulate(1.0, 1, copies=1, real_per_cell=4.0), 30: simulate(1.0, 2, **FINE)}


@pytest.fixture(scope="module")
def cooling():
    """α = 0.8 in cells, with copies enough."""
    return simulate(0.8, 3, duration=400.0, **FINE)


@pytest.fixture(scope="module")
def one_cell():
    """α = 0.8 without space: every disk may meet every other."""
    return simulate(0.8, 5, duration=300.0, copies=60, real_per_cell=100.0)


# The elastic gas


@pytest.mark.parametrize("copies", [1, 30])
def test_elastic_equipartition(elastic, copies):
    """C(0) = 1 for any copies and cells, to the 3% of some 500 decay times."""
    distance, error = deviation(elastic[copies], "mode_amplitude", 1.0)
    assert error < 0.04
    assert abs(distance) < SIGMAS


@pytest.mark.parametrize("copies", [1, 30])
def test_elastic_noise_is_that_of_the_viscosity(elastic, copies):
    """η1/η = C(0)/(1 + μτ) is C(0) where μ = 0, to rounding; T~ = T0 to that of float32."""
    steady = elastic[copies].steady
    ratio = float(steady["noise_viscosity_ratio"] / steady["viscosity_ratio"])
    assert ratio == pytest.approx(float(steady["mode_amplitude"]), rel=1e-9)
    assert float(steady["noise_over_viscosity"]) == pytest.approx(ratio, rel=1e-9)
    # the net momentum that is removed and the rounding of some 10⁴ steps: measured 2e-6
    assert float(steady["temperature"]) == pytest.approx(1.0, abs=2e-5)


def test_elastic_viscosity(elastic):
    """η/η0 of the theory, and more in cells wider than the mean free path."""
    known = langevin.transverse_mode(1.0, REDUCED).viscosity_ratio
    value, error = elastic[30]["viscosity_ratio"]
    assert error < 0.08  # 0.06 or so, known to a fifth
    assert abs(value - known * (1 + CELL_BIAS / 2)) < SIGMAS * error + known * CELL_BIAS / 2
    value, error = elastic[1]["viscosity_ratio"]
    assert value - known > 3 * error


def test_elastic_collision_rate(elastic):
    """2√π nσ √(T/m) per disk, √π/2 in 1/τ0, a collision being of two: the rate counts halves.

    Copies do not change it, nor do cells.
    """
    gas = InelasticHardDisks(1.0)
    assert 2 * float(gas.collision_rate(0.5)) == pytest.approx(np.sqrt(np.pi) / 2, rel=1e-6)
    for result in elastic.values():
        distance, error = deviation(result, "collision_rate_ratio", 1.0)
        assert error < 3e-3
        # at fixed energy ⟨g⟩ of N M disks is lower by 1/(16 N M) + ..., 1e-3 for 100 of them
        assert abs(distance) < SIGMAS + 1e-3 / error


# The cooling gas


def test_cooling_rate_is_twice_the_growth_rate(cooling, one_cell):
    """2μ T~ makes up for the energy lost; the change of T~ from end to end is below 1e-3 of it."""
    mu = float(langevin.cooling_state(0.8).growth_rate)
    for result in (cooling, one_cell):
        value, error = result["cooling_rate"]
        assert error < 1e-3 * 2 * mu
        assert abs(value - 2 * mu) < SIGMAS * error + 1e-3 * 2 * mu


def test_one_cell_is_held_at_t0(one_cell):
    """T~ = T0 to 0.1% with the growth rate of the theory, a2 its exact one (eq. 13: -0.0219)."""
    value, error = one_cell["temperature"]
    assert error < 1e-3
    assert abs(value - 1.0) < 1e-3 + 2 * error
    state = langevin.cooling_state(0.8)
    assert state.a2 == pytest.approx(-0.0262, abs=5e-5)
    distance, error = deviation(one_cell, "a2", state.a2)
    assert error < 1e-3  # four of them tell it from eq. (13)
    # correlations of 6000 particles: 1/N M
    assert abs(distance) < SIGMAS + 1 / 6000 / error


@pytest.mark.parametrize("alpha", [0.6, 0.8])
def test_one_cell_has_no_noise_of_its_own(one_cell, alpha):
    """C(0) = 1 whatever the restitution: without places nothing correlates the velocities."""
    coarse = {"copies": 1, "real_per_cell": 100.0}
    result = one_cell if alpha == 0.8 else simulate(alpha, 6, density=0.15, **coarse)
    distance, error = deviation(result, "mode_amplitude", 1.0)
    assert error < 0.03
    # with fixed momentum pairs are correlated by 1/N M, which k ≠ 0 does not see
    assert abs(distance) < SIGMAS


@pytest.mark.parametrize(
    ("name", "attribute"),
    [
        ("mode_amplitude", "amplitude"),
        ("viscosity_ratio", "viscosity_ratio"),
        ("noise_viscosity_ratio", "noise_viscosity_ratio"),
        ("noise_over_viscosity", "noise_over_viscosity"),
        ("tail_noise_over_viscosity", "tail_noise_over_viscosity"),
    ],
)
def test_against_the_deterministic_theory(cooling, name, attribute):
    """All that fluctuates, at an error of some percents."""
    known = getattr(langevin.transverse_mode(0.8, REDUCED), attribute)
    value, error = cooling[name]
    assert error < 0.1 * known
    assert abs(value - known) < SIGMAS * error + CELL_BIAS * known


def test_autocorrelation_starts_flat(elastic, cooling):
    """dC/ds = 0 at s = 0: what C loses by the first lag is less than half of what its tail does."""
    for result, alpha in ((elastic[30], 1.0), (cooling, 0.8)):
        here = result.steady
        lag, c = here["lag"].values, here["autocorrelation"].values
        rate, amplitude = float(here["mode_decay_rate"]), float(here["mode_amplitude"])
        assert c[0] == pytest.approx(amplitude, rel=1e-9) and lag[0] == 0.0
        drop = 1.0 - c[1] / c[0]
        theory = langevin.transverse_mode(alpha, REDUCED).autocorrelation(lag[:2])
        # both from the same series: their ratio is known ten times better than either
        assert drop == pytest.approx(1.0 - theory[1] / theory[0], abs=0.01)
        assert drop < 0.75 * -np.expm1(-rate * lag[1])
        assert float(here["tail_amplitude"]) > amplitude


def test_same_reduced_number_same_statistics(cooling):
    """(N, n) and (N/2, 2n): the same box, and the same numbers within their errors."""
    half = simulate(
        0.8, 4, duration=400.0, density=0.1, n_particles=200, copies=15, real_per_cell=0.32
    )
    few, many = (
        CoolingDisks(InelasticHardDisks(0.8), density=n).side(size)
        for n, size in ((0.2, 100), (0.1, 200))
    )
    assert few == many == pytest.approx(np.sqrt(8 * REDUCED), rel=1e-12)
    for name in ("mode_amplitude", "viscosity_ratio", "noise_viscosity_ratio"):
        (one, error), (other, wrong) = cooling[name], half[name]
        assert abs(one - other) < SIGMAS * np.hypot(error, wrong)


def test_until_precise_at_every_point_of_a_sweep():
    """Without a duration a run ends when η is known, here to a quarter, and says so.

    The points have different numbers of blocks; what follows from estimates keeps their errors.
    """
    gas = InelasticHardDisks([0.8, 1.0])
    result = jdsmc.run(
        CoolingDisks(gas, density=0.15, copies=8, real_per_cell=1.0),
        **{"n_particles": 70, "rtol": 0.25, "progress": False},
        **{"time_step": 0.1, "steps_per_record": 7},
    )
    assert "viscosity_ratio is known" in result.attrs["stopped"]
    value, error = result["viscosity_ratio"]
    assert np.all(error <= 0.25 * value) and value.shape == (2,)
    doubled = 2.0 * result["viscosity_ratio"]
    np.testing.assert_allclose(doubled.error, 2.0 * error, rtol=1e-9)  # rounding
    exact = [langevin.transverse_mode(a, 70 * 0.15).viscosity_ratio for a in (0.8, 1.0)]
    # cells of 1.3 λ0 make η up to a half larger, and nothing smaller
    assert np.all(value - exact > -SIGMAS * error)
    assert np.all(value - exact < 0.5 + SIGMAS * error)
    assert result.steady["autocorrelation"].dims == ("restitution", "lag")
    assert np.all(np.isfinite(result.steady["autocorrelation_error"][:, 0]))
    assert "0.8" in result.table()
