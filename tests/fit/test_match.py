"""Matches whose answer is known, errors that cover it, and what has none: nothing is simulated."""

import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, Estimate
from jdsmc.fit import calibrate
from jdsmc.fit.elastic_curve import Curve
from jdsmc.scenarios import UniformShear
from jdsmc.units import COOLING, VISCOSITY_TIME

from .known import estimates, kinetic, measured, sweep

ALPHA = np.array([0.5, 0.7, 0.9])
BETA = np.array([0.62, 0.8, 0.96])
MODEL = UniformShear(ElasticHardSpheres(ALPHA), 4.0)
EXACT = sweep(ALPHA, 1e-7, np.random.default_rng(0))
"""The kinetic model is a polynomial in u: what is left is the noise and rounding."""


def truth(drag=1.0) -> dict[str, Estimate]:
    """What the model does at `BETA`, with a small error."""
    return {n: Estimate(v, 1e-7 * v) for n, v in kinetic(ALPHA, BETA, drag).items()}


@pytest.mark.parametrize("name", kinetic(0.7, 0.8))
def test_known_rate_factor_is_found(name):
    """Each observable alone, all laws in β: 1e-5 is fifty times the noise."""
    found = calibrate(truth(), MODEL, name, sweep=EXACT)
    np.testing.assert_allclose(found["rate_factor"].value[:, 0], BETA, rtol=1e-5)
    assert not found.attrs["remarks"] and np.all(found["misfit"].value == 0)


def test_known_drag_is_found_too():
    """Two numbers from two observables; three observables agree, so that no misfit is left."""
    names = ["shear_stress", "reduced_shear_rate", "normal_stress_xy"]
    for wanted in (names[:2], names):
        found = calibrate(truth(1.1), MODEL, wanted, sweep=EXACT)
        np.testing.assert_allclose(found["rate_factor"].value[:, 0], BETA, rtol=1e-5)
        np.testing.assert_allclose(found["drag_factor"].value[:, 0], 1.1, rtol=1e-5)
        assert np.all(found["misfit"].value < 1e-3)  # percent
    alone = calibrate(truth(1.1), MODEL, "shear_stress", free="drag_factor", sweep=EXACT)
    wanted = kinetic(ALPHA, BETA, 1.1)["shear_stress"]
    d = alone["drag_factor"].value[:, 0]
    np.testing.assert_allclose(kinetic(ALPHA, (1 + ALPHA) / 2, d)["shear_stress"], wanted, 1e-6)


def test_joint_misfit():
    """One β for a stress and a shear rate that are both 2% too large: the rest is known.

    With r = ln Π and s = ln a* of slopes p and q against ln β the least squares leave 2% times
    |p - q|/√(2 (p² + q²)), to first order; the second order is a part of 2%.
    """
    asked = {n: 1.02 * one for n, one in truth().items()}
    found = calibrate(asked, MODEL, "shear_stress+reduced_shear_rate", sweep=EXACT)
    up, down = (kinetic(ALPHA, BETA * f) for f in (1.001, 0.999))
    p, q = (
        (np.log(up[n]) - np.log(down[n])) / 0.002 for n in ("shear_stress", "reduced_shear_rate")
    )
    left = 2.0 * np.abs(p - q) / np.sqrt(2.0 * (p**2 + q**2))
    np.testing.assert_allclose(found["misfit"].value[:, 0], left, rtol=0.05)
    heavy = calibrate(
        *(asked, MODEL, "shear_stress+reduced_shear_rate"),
        weights={"shear_stress": 1e4},
        sweep=EXACT,
    )
    alone = calibrate(asked, MODEL, "shear_stress", sweep=EXACT)
    np.testing.assert_allclose(heavy["rate_factor"].value, alone["rate_factor"].value, rtol=1e-6)


def test_reduced_values_do_not_depend_on_what_makes_x():
    """(β ∂_β + d ∂_d) of a reduced stress is zero: β and d scaled together match the same."""
    for d in (0.8, 1.25):
        model = UniformShear(ElasticHardSpheres(ALPHA, drag_factor=d), 1.0)
        found = calibrate(truth(), model, "shear_stress", sweep=EXACT)
        np.testing.assert_allclose(found["rate_factor"].value[:, 0], d * BETA, rtol=1e-5)


def test_errors_cover_the_truth():
    """30 noisy sweeps and references: (β - truth)/error has mean 0 and variance 1.

    Mean of 30 within 0.5 (three of its errors); 2σ cover 88% of all 180: eight realizations know
    their error to 25%, Student's t leaves 7.6% outside, give or take 2%.
    """
    scores = []
    for seed in range(30):
        rng = np.random.default_rng(seed)
        asked = estimates(measured(kinetic(ALPHA, BETA), 2e-3, rng), "reference")
        noisy = sweep(ALPHA, 2e-3, rng)
        found = calibrate(asked, MODEL, "shear_stress,shear_stress+reduced_shear_rate", sweep=noisy)
        scores.append(found["rate_factor"].distance(BETA[:, None]))
    scores = np.array(scores)
    assert np.all(np.abs(np.mean(scores, axis=0)) < 0.5)
    coverage = np.mean(np.abs(scores) < 2.0, axis=(0, 1))
    assert np.all(coverage > 0.88)
    assert np.all(np.std(scores, axis=0) > 0.6), "errors are too large"


def test_no_match_is_said():
    """A stress above the largest of the elastic gas: NaN and a sentence, no end of a range."""
    values = truth()["shear_stress"].value + np.array([0.0, 1.0, 0.0])
    asked = {"shear_stress": Estimate(values, 1e-7 * values)}
    found = calibrate(asked, MODEL, "shear_stress", sweep=EXACT)
    assert list(np.isnan(found["rate_factor"].value[:, 0])) == [False, True, False]
    assert np.isnan(found["rate_factor"].error[1, 0])
    assert "restitution 0.7: no β matches shear_stress: looked at from" in found.attrs["remarks"]
    assert "–" in found.table()


def test_a_match_lost_within_its_error_is_said():
    """Near its largest value the stress hardly depends on β: no number is made of it."""
    z = 0.8  # the stress has its maximum at z = 1, or 1.6% higher
    beta = 0.75 * COOLING * VISCOSITY_TIME / z
    stress = kinetic(0.5, beta)["shear_stress"]
    asked = {"shear_stress": Estimate(np.array([stress]), np.array([0.01]))}
    model = UniformShear(ElasticHardSpheres([0.5]), 4.0)
    rng = np.random.default_rng(1)
    found = calibrate(asked, model, "shear_stress", sweep=sweep([0.3, 0.5], 1e-7, rng))
    assert np.isnan(found["rate_factor"].value[0, 0])
    assert "within two standard errors" in found.attrs["remarks"]


def test_a_curve_that_is_no_polynomial_says_so():
    """Its misfit is large and its errors grow with it."""
    noisy = sweep(ALPHA, 1e-3, np.random.default_rng(3))
    plain = Curve(noisy, "shear_stress")
    noisy.to_xarray()["shear_stress"].values[::2] *= 1.01
    bent = Curve(noisy, "shear_stress")
    assert plain.misfit < 5 < bent.misfit
    assert bent.estimate(0.8, 0.6).error > 2 * plain.estimate(0.8, 0.6).error


def test_saved_and_loaded(tmp_path):
    """The file has rate_factor and its error over restitution and target; tables, pictures."""
    found = calibrate(truth(), MODEL, "shear_stress,normal_stress_xy", sweep=EXACT)
    found.save(tmp_path / "beta.h5")
    again = jdsmc.load(tmp_path / "beta.h5")
    assert again.steady["rate_factor"].dims == ("restitution", "target")
    assert again.steady["rate_factor_error"].dims == ("restitution", "target")
    assert again.table() == found.table()
    one = again.at(restitution=0.7, target="normal_stress_xy")
    assert float(one["rate_factor"]) == pytest.approx(0.8, 1e-5)
    panels = again.plot(tmp_path / "beta.png").axes
    assert any("(1+α)/2" in line.get_label() for line in panels[0].lines)
