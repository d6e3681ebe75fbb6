"""A gas under white noise: heating, the balance of a steady state, and its distribution."""

import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardDisks, InelasticHardSpheres, MaxwellMolecules
from jdsmc.scenarios import WhiteNoiseThermostat
from jdsmc.theory.cooling_expansion import solve_heated

from ..helpers import options
from .batches import observed, standard_error, window

SIZES = {"n_particles": 4096, "n_realizations": 8}


def _a2(alpha, order=16):
    """⟨c⁴⟩ 4/15 - 1 of the Boltzmann equation."""
    return solve_heated(alpha, order).moment(2) * 4.0 / 15.0 - 1.0


def _van_noije_and_ernst(alpha, d=3):
    """Their a2 of a heated gas, linear in a2."""
    bottom = 73 + 56 * d - 24 * d * alpha - 105 * alpha + 30 * (1 - alpha) * alpha**2
    return 16 * (1 - alpha) * (1 - 2 * alpha**2) / bottom


@pytest.mark.parametrize("alpha", [0.3, 0.6, 0.8, 0.9])
def test_theory_is_that_of_van_noije_and_ernst_but_for_higher_cumulants(alpha):
    """What their approximation leaves out, a2² and a3, is below 0.001; six digits by order 12."""
    assert _a2(alpha, 12) == pytest.approx(_a2(alpha, 18), abs=5e-6)
    assert 1e-5 < abs(_a2(alpha) - _van_noije_and_ernst(alpha)) < 1e-3


def test_an_elastic_gas_is_heated_at_the_rate_of_the_noise():
    """dT/dt = ξ²(1 - 1/N), the mean being taken out: T/T0 = 1 + 2 ξ² t, and no steady state."""
    noise = 0.3
    scene = WhiteNoiseThermostat(InelasticHardSpheres(1.0), noise)
    assert not scene.has_steady_state() and "loses energy" in scene.no_steady_state()
    series = jdsmc.run(scene, duration=4.0, seed=2, progress=False, **SIZES).series
    time, heat, error = (
        series[name].values for name in ("time", "temperature", "temperature_error")
    )
    expected = 1.0 + 2.0 * noise * time
    assert time[-1] > 3.0 and error[-1] < 0.01 * heat[-1]
    # error bars from eight realizations: Student's t with seven degrees of freedom
    assert np.all(np.abs(heat - expected) < 6.0 * error + 1e-6)


def test_steady_temperature_and_a2():
    """α = 0.3: ξ² is what collisions take, T_s follows, and a2 is that of the Boltzmann equation.

    Errors of 0.3% of the loss and 0.002 of a2, which cooling would have at 0.103.
    """
    alpha, noise = 0.3, 2.0
    scene = WhiteNoiseThermostat(InelasticHardSpheres(alpha), noise)
    lost = window(scene, 12, 4, records=4, seed=3, **SIZES)["energy_lost"]
    assert standard_error(lost) < 0.003 * noise
    assert abs(np.mean(lost) - 1.5 * noise * 4095 / 4096) < 4.5 * standard_error(lost)
    value, error = observed(scene, 12, 4, records=4, seed=3, **SIZES)
    assert error["a2"] < 0.003
    assert abs(value["a2"] - _a2(alpha)) < 4.5 * error["a2"]
    # ξ² = ζT, ζ being √(2T) times that of the expansion
    steady = (noise / (2.0**0.5 * solve_heated(alpha, 16).rate)) ** (2.0 / 3.0)
    assert error["temperature"] < 0.005 * value["temperature"]
    assert abs(value["temperature"] - 2.0 * steady) < 4.5 * error["temperature"]


@pytest.mark.parametrize("gas", [InelasticHardSpheres(0.9), InelasticHardDisks(0.9)])
def test_what_is_known_of_the_approach(gas):
    """d/3(1-α²) collisions, (3/2) ζ(T_s) in time, however strong the noise; farther if hot."""
    sizes = options(256, 0.1)
    strong, weak = (WhiteNoiseThermostat(gas, noise).approach(sizes) for noise in (1e4, 1e-4))
    for found in (strong, weak):
        assert found.collisions == pytest.approx(gas.dimension / 3.0 / (1.0 - 0.9**2), rel=1e-3)
        assert found.certain
    assert strong.distance == 0.0 and weak.distance > 3.0


@pytest.mark.parametrize("noise", [0.0, -1.0])
def test_noise_is_positive(noise):
    with pytest.raises(ValueError, match=r"noise = .* outside the allowed range \(0, inf\)"):
        WhiteNoiseThermostat(InelasticHardSpheres(0.9), noise)


def test_a_gas_with_drag_is_refused():
    with pytest.raises(TypeError, match="does not apply the drag"):
        WhiteNoiseThermostat(ElasticHardSpheres(0.9), 0.2)


def test_maxwell_molecules_have_no_steady_state():
    assert not WhiteNoiseThermostat(MaxwellMolecules(), 0.2).has_steady_state()
