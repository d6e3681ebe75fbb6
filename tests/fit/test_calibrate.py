"""Calibrations that are run: small ones, and the blind test of their errors."""

import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, Estimate, InelasticHardSpheres
from jdsmc.fit import calibrate, elastic_sweep
from jdsmc.scenarios import UniformShear

TINY = {"n_particles": 256, "time_step": 0.1, "progress": False}
TARGETS = "shear_stress,reduced_shear_rate,shear_stress+reduced_shear_rate"
LONG = {
    0.5: ((0.5637, 0.0014), (0.9194, 0.0018), (0.7426, 0.0015)),
    0.7: ((0.7244, 0.0009), (0.8850, 0.0014), (0.8028, 0.0011)),
    0.9: ((0.9080, 0.0012), (0.9453, 0.0014), (0.9265, 0.0012)),
}
"""β for `TARGETS` and one standard error: 20000 particles, rtol 0.001, 12 points of the sweep."""


@pytest.mark.slow
def test_an_elastic_gas_is_matched_by_itself():
    """The reference is an elastic gas with a known β; its error is below 10%, the match in 4 σ."""
    model = UniformShear(ElasticHardSpheres([0.5]), 4.0)
    reference = UniformShear(ElasticHardSpheres([0.5], rate_factor=0.7), 2.0)
    found = calibrate(reference, model, "reduced_viscosity", rtol=0.02, **TINY)
    beta = found["rate_factor"]
    assert np.all(beta.error / beta.value < 0.1)
    assert np.all(np.abs(beta.distance(0.7)) < 4.0)
    assert found.dims == ("restitution", "target")


@pytest.mark.slow
def test_blind():
    """20 seeds of small gases against long ones: mean score within 0.5, 2σ coverage >= 88%."""
    alpha = np.array(list(LONG))
    truth, doubt = np.moveaxis(np.array(list(LONG.values())), -1, 0)
    model = UniformShear(ElasticHardSpheres(alpha), 4.0)
    scores = []
    for seed in range(20):
        options = {"n_particles": 1024, "rtol": 0.01, "seed": seed, "progress": False}
        reference = UniformShear(InelasticHardSpheres(alpha), 4.0)
        beta = calibrate(reference, model, TARGETS, **options)["rate_factor"]
        scores.append((beta.value - truth) / np.hypot(beta.error, doubt))
    scores = np.array(scores)
    print(np.round(np.mean(scores, axis=0), 2), np.std(scores, axis=0).round(2))
    assert np.all(np.isfinite(scores))  # NaN: no match was found where there is one
    assert np.all(np.abs(np.mean(scores, axis=0)) < 0.5)
    assert np.mean(np.abs(scores) < 2.0) >= 0.88


@pytest.mark.slow
def test_near_the_elastic_limit():
    """β -> 1 for η* as α -> 1: Navier-Stokes viscosities of both gases are then that of spheres.

    To first order in 1-α both factors of the paper have slopes of 1/2 and 5/6: at α = 0.98 β lies
    above 0.97, and below 1 by more than its error.
    """
    model = UniformShear(ElasticHardSpheres(0.98), 1.0)
    reference = UniformShear(InelasticHardSpheres(0.98), 1.0)
    options = {"n_particles": 4096, "rtol": 0.003, "progress": False}
    beta = calibrate(reference, model, "reduced_viscosity", **options)["rate_factor"][0, 0]
    assert beta.error < 0.01
    assert float(beta) + 2 * beta.error > 0.97 and float(beta) - 2 * beta.error < 1.0


@pytest.mark.slow
def test_newton_finds_what_scaling_finds():
    """Another route to the same β; and a restitution from a stress, where nothing scales."""
    asked = jdsmc.run(UniformShear(InelasticHardSpheres(0.7), 4.0), rtol=0.005, **TINY)
    one = calibrate(
        *(asked, UniformShear(InelasticHardSpheres(0.8), 4.0), "shear_stress"),
        **{"free": "restitution", "rtol": 0.01, **TINY},
    )
    assert abs(one["restitution"].distance(0.7)[0]) < 4.0
    assert one["restitution"].error[0] < 0.01


def test_newton_says_what_cannot_be_found():
    """A number that nothing depends on, a run too short to be steady, and seeds at their end."""
    small = {"n_particles": 512, "progress": False, "seed": 2**64 - 1}
    wanted, model = (
        {"shear_stress": Estimate(0.3, 0.001)},
        UniformShear(ElasticHardSpheres(0.5), 4.0),
    )
    found = calibrate(wanted, model, free="shear_rate", rtol=0.05, **small)
    assert np.isnan(found["shear_rate"].value)
    assert "shear_stress does not depend on shear_rate" in found.attrs["remarks"]
    found = calibrate(wanted, model, free="restitution", collisions=5.0, **small)
    assert np.isnan(found["restitution"].value) and "no steady value" in found.attrs["remarks"]


@pytest.mark.slow
def test_transients():
    """The transient of an elastic gas of known β and d is matched by these."""
    gas = ElasticHardSpheres(0.7, rate_factor=0.9, drag_factor=1.1)
    options = {"duration": 4.0, "steps_per_record": 4, **TINY, "n_particles": 2048}
    found = calibrate(
        *(UniformShear(gas, 4.0), UniformShear(ElasticHardSpheres(0.7), 4.0)),
        ["series/temperature", "series/shear_stress"],
        **options,
    )
    for name, known in (("rate_factor", 0.9), ("drag_factor", 1.1)):
        value, error = found[name][0]
        assert error < 0.1 and abs(value - known) < 4.0 * error
    # noise of the reference alone is left, about 1%
    assert float(found["misfit"].value[0]) < 3.0


def test_the_sweep_covers_what_is_asked():
    """x from β = 1.3 at the largest α to 0.45 at the smallest; the kind of drag is kept."""
    model = UniformShear(ElasticHardSpheres([0.5, 0.9], drag="measured"), 3.0)
    scene = elastic_sweep(model)
    x = scene.gas.drag_factor * (1 - scene.gas.restitution**2) / scene.gas.rate_factor
    np.testing.assert_allclose([x[0], x[-1]], [0.19 / 1.3, 0.75 / 0.45])
    assert scene.gas.drag == "measured" and scene.shear_rate == 3.0
