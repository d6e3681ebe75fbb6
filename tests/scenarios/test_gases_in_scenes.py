"""Gases that are no inelastic hard spheres, in the scenes that take any gas: exact solutions."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardDisks, MaxwellMolecules
from jdsmc.gases.base import check_gas
from jdsmc.gases.maxwell import MAXWELL_RATE
from jdsmc.scenarios import (
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    NavierStokes,
    ShearedSlab,
    UniformShear,
)

from .batches import relative_error, window, within

RELAXATION = MAXWELL_RATE / (2 * np.sqrt(2))
"""Of the stress of Maxwell molecules (1/τ0): a collision halves that of its pair."""


def test_maxwell_molecules_left_alone_stay_in_equilibrium():
    """No steady state is missed, T = T0 to rounding, a2 = -2/(3N) (fixed energy), no cooling."""
    scene = HomogeneousCooling(MaxwellMolecules())
    result = jdsmc.run(scene, n_particles=2000, rtol=0.005, seed=4, progress=False)
    np.testing.assert_allclose(result.series["temperature"], 1.0, rtol=2e-5)
    a2, error = result["a2"]
    assert abs(a2 + 2 / (3 * 2000)) < 4.5 * error
    assert np.isnan(result["relative_speed_cubed_collisional"].value)


def test_maxwell_molecules_collide_at_a_rate_of_their_own():
    """Collisions per particle and time, w (N-1)/N/(2√2), whatever T: errors 0.3%."""
    for scene in (HomogeneousCooling(MaxwellMolecules()), UniformShear(MaxwellMolecules(), 1.0)):
        rate = window(scene, chunks=4, skip=0)["accepted"]
        assert relative_error(rate) < 3e-3
        assert within(rate / RELAXATION - 3999 / 4000)


EVERY_STEP = {"n_particles": 2000, "steps_per_record": 1, "progress": False}
"""One compiled program for those below."""


def _pressure(rate, times):
    """Pressure tensor (over nT0) of sheared Maxwell molecules: closed equations, solved."""

    def change(_, pressure):
        xx, yy, zz, xy = pressure
        mean = (xx + yy + zz) / 3
        nu = RELAXATION * 1999 / 2000  # N - 1 partners
        return [
            nu * (mean - xx) - 2 * rate * xy,
            nu * (mean - yy),
            nu * (mean - zz),
            -nu * xy - rate * yy,
        ]

    times = np.concatenate([[0.0], times])
    exact = solve_ivp(change, (0, times[-1]), [1, 1, 1, 0], t_eval=times, rtol=1e-9, atol=1e-12)
    return exact.y[:, 1:]


@pytest.mark.parametrize("rate", [0.3, 2.0])
def test_sheared_maxwell_molecules_obey_their_moment_equations(rate):
    """T and stresses of the series against the closed equations, within 4.5 errors at six times.

    Realizations have clocks of their own, interpolated between records 0.05/a apart at most: a
    relative curvature of (0.05)²/8 at T'' = a² T, and the splitting's (a dt)²/12 alike: 6e-4.
    """
    scene = UniformShear(MaxwellMolecules(), rate)
    options = {"n_realizations": 32, "duration": 3.0 / rate, "seed": 5}
    series = jdsmc.run(scene, **options, **EVERY_STEP).series
    picked = np.linspace(0, len(series["time"]) - 1, 7).astype(int)[1:]
    here = series.isel(sample=picked)
    xx, yy, zz, xy = _pressure(rate, here["time"].values)
    heat = (xx + yy + zz) / 3
    exact = {
        "temperature": heat,
        "shear_stress": -xy / heat,
        "normal_stress_xy": (xx - yy) / heat,
        "normal_stress_zy": (zz - yy) / heat,
    }
    for name, values in exact.items():
        value, error = here[name].values, here[f"{name}_error"].values
        assert np.all(error < 0.02 * max(1.0, np.max(np.abs(values)))), name
        assert np.all(np.abs(value - values) < 4.5 * error + 6e-4 * np.abs(values)), name
    assert heat[-1] > 1.5 and exact["shear_stress"][-1] > 0.2


def test_reduced_shear_rate_of_maxwell_molecules():
    """τ_η does not depend on T: a* = a τ_η at all times, and η* tends to -P_xy/nT over it."""
    scene = UniformShear(MaxwellMolecules(), 1.0)
    series = jdsmc.run(scene, duration=2.0, **EVERY_STEP).series
    reduced = series["reduced_shear_rate"].values
    np.testing.assert_allclose(reduced, reduced[0], rtol=1e-12)
    np.testing.assert_allclose(
        series["reduced_viscosity"][1:] * reduced[0], series["shear_stress"][1:], rtol=0.01
    )  # a ratio of means is the mean of a ratio but for the jackknife of eight


@pytest.mark.parametrize(
    "scene",
    [
        UniformShear(ElasticHardSpheres(1.0, rate_factor=2.0), 0.0),
        ShearedSlab(ElasticHardSpheres(1.0, rate_factor=2.0), 0.0, layers=10),
    ],
    ids=["homogeneous", "slab"],
)
def test_gas_that_collides_twice_as_often(scene):
    """β = 2 at the default step: 2/√π collisions per particle and time, none lost (α = 1)."""
    result = jdsmc.run(scene, n_particles=2000, duration=20.0, seed=2, progress=False)
    rate, error = (float(result.series[name][-1]) for name in ("collisions", "collisions_error"))
    time = float(result.series["time"][-1])
    exact = 2 / np.sqrt(np.pi) * 1999 / 2000
    assert error / time < 0.005
    assert abs(rate / time - exact) < 4.5 * error / time


@pytest.mark.parametrize(
    "made",
    [
        lambda gas: UniformShear(gas, 1.0),
        lambda gas: HeatFluxForce(gas, 0.1),
        lambda gas: ShearedSlab(gas, 1.0),
        lambda gas: FourierFlow(gas, 0.5),
        NavierStokes,
    ],
)
def test_disks_are_refused_where_three_components_are_needed(made):
    with pytest.raises(TypeError, match="needs a gas of 3 velocity components"):
        made(InelasticHardDisks(1.0))


@pytest.mark.parametrize("made", [lambda gas: HeatFluxForce(gas, 0.1), NavierStokes])
def test_gases_that_cannot_be_held_at_one_temperature_are_refused(made):
    with pytest.raises(TypeError, match="rate proportional to the relative speed"):
        made(MaxwellMolecules())


@pytest.mark.parametrize("gas", [None, 0.5, "ihs", MaxwellMolecules])
def test_what_is_no_gas(gas):
    """The check that every scene begins with; that of annotations, in tests only, comes before."""
    with pytest.raises(TypeError, match="gas must be a jdsmc gas, got"):
        check_gas(gas)
