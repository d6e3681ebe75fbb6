"""Derivatives from a smooth fit over a sweep, against closed forms."""

from itertools import pairwise

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import quad
from scipy.special import erf, erfc

import jdsmc
from jdsmc import InelasticHardSpheres, sweep
from jdsmc.derivatives.by_sweep import planned, sensitivity_by_sweep, slope_weights, slopes_of
from jdsmc.derivatives.numbers import slope
from jdsmc.results import Result
from jdsmc.scenarios import FourierFlow, ShearedSlab, UniformShear


class Rarefied(jdsmc.AbstractGas):
    """Elastic spheres that meet once in 20 crossings of the slab below."""

    def rate(self, speed):
        return 0.05 * speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


def test_slope_of_a_polynomial_is_exact():
    """Of degree 4 about any point within or at the end of the values; degree 2 is not enough."""
    for x in (np.linspace(-1.0, 1.0, 7), np.linspace(-2.0, 0.0, 7), np.linspace(-0.4, 1.6, 7)):
        values = 3.0 - 2.0 * x + x**2 - 5.0 * x**3 + x**4
        assert slope_weights(x, 4) @ values == pytest.approx(-2.0, rel=1e-9)  # rounding
        assert abs(slope_weights(x, 2) @ values + 2.0) > 0.1


FLOW = FourierFlow(InelasticHardSpheres(1.0), cold_temperature=0.3, gravity=0.0)
BORDERS = [
    (FLOW, "cold_temperature", 0.3, None),
    (
        FourierFlow(InelasticHardSpheres(1.0), cold_temperature=1.0, gravity=0.0),
        "cold_temperature",
        1.0,
        None,
    ),
    (
        FourierFlow(InelasticHardSpheres(1.0), cold_temperature=0.05, gravity=0.0),
        "cold_temperature",
        0.05,
        0.2,
    ),
    (FLOW, "gravity", 0.0, None),
    (UniformShear(InelasticHardSpheres(0.95), 1.0), "gas.restitution", 0.95, 0.5),
    (UniformShear(InelasticHardSpheres(0.95), 0.01), "shear_rate", 0.01, 1.0),
]


@pytest.mark.parametrize(("scene", "path", "number", "width"), BORDERS)
def test_values_keep_to_the_allowed_range(scene, path, number, width):
    """The scene accepts all values, the slope of θ itself is one, that of a constant zero."""
    varied, own, lower = planned(scene, path, width)
    values = sweep.numbers(varied)[path]
    assert len(sweep.points(varied)[0]) == 7
    assert np.ptp(values) > 0.0
    for weights in (own, lower):
        assert np.sum(weights) == pytest.approx(0.0, abs=1e-8 * np.sum(np.abs(weights)))
    if path == "gas.restitution":  # linear in the variable of the fit is α² there
        assert own @ np.sqrt(1.0 - values**2) == pytest.approx(-number / np.sqrt(1 - number**2))
    else:
        assert own @ values == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("scene", "wrt", "what"),
    [
        (FLOW, "restitution", "restitution cannot be varied: FourierFlow needs an elastic gas"),
        (FLOW, "layers", "choose among restitution, cold_temperature, gravity, length"),
        (
            ShearedSlab(InelasticHardSpheres(1.0), shear_rate=1.0),
            "restitution",
            "give a restitution below 1",
        ),
        (
            FourierFlow(InelasticHardSpheres(1.0), cold_temperature=[0.3, 0.4]),
            "gravity",
            "without arrays",
        ),
        (UniformShear(InelasticHardSpheres(0.9), 0.0), "shear_rate", "give widths"),
    ],
)
def test_what_cannot_be_had_gets_a_sentence(scene, wrt, what):
    with pytest.raises(ValueError, match=what):
        sensitivity_by_sweep(scene, wrt)


def a_sweep() -> Result:
    """Seven points of an observable y = sin x with errors of 0.01, and a profile of two."""
    x, rng = np.linspace(0.5, 1.5, 7), np.random.default_rng(2)
    scatter = 0.01 * rng.normal(size=(8, 7)) / np.sqrt(7.0)  # spread of leave-one-out values
    y = np.sin(x)
    both = np.stack([y, 2.0 * y], -1)
    root = xr.Dataset(
        {
            "y": ("x", y),
            "y_error": ("x", np.full(7, 0.01)),
            "profile": (("x", "z"), both),
            "profile_error": (("x", "z"), np.full((7, 2), 0.01)),
            "steady_from_time": ("x", np.zeros(7)),
        },
        {"x": x},
        {"swept": "x", "run": "this"},
    )
    left_out = xr.Dataset(
        {
            "y": (("realization", "x"), y + scatter),
            "profile": (("realization", "x", "z"), both + scatter[..., None]),
        }
    )
    return Result(xr.DataTree.from_dict({"/": root, "/left_out": left_out}))


def test_slope_error_and_truncation_of_a_sweep():
    """y = sin x about x = 1: its slope, errors in squares, and the cubic term as truncation."""
    own, lower = (slope_weights(np.linspace(-0.5, 0.5, 7), degree) for degree in (4, 2))
    found = slopes_of(a_sweep(), "x", own, lower)
    y, profile = found["y"], found["profile"]
    assert y[""] == pytest.approx(np.cos(1.0), abs=5e-4)  # h⁴/120 times a number of order one
    assert y["_error"] == pytest.approx(0.01 * np.sqrt(np.sum(own**2)))
    assert np.sqrt(7.0 * np.var(y["_left_out"])) == pytest.approx(y["_error"])
    # a straight line through x³ in [-h, h], seven points, has the slope (7/9) h²; fifth order: 2%
    assert y["_truncation"] == pytest.approx(np.cos(1.0) / 6.0 * 0.25 * 7 / 9, rel=0.05)
    assert profile[""] == pytest.approx(np.array([1.0, 2.0]) * y[""])


def of_beams(cold, gravity, length=1.0):
    """Heat flux and densities of four layers of a gas without collisions.

    Beams from either wall are Maxwellian; slow ones from below fall back before the upper wall. As
    many pass upwards as downwards: a √θ e^{-2gL/θ} = b, and q = -J (1 - θ) with J their number.
    """

    def beams(z):
        above = np.sqrt(2 * gravity * (length - z))
        up = np.exp(-2 * gravity * z / cold) * (1 + erf(above / np.sqrt(cold)))
        share = np.sqrt(cold) * np.exp(-2 * gravity * length / cold)
        return up + share * np.exp(above**2) * erfc(above)

    edges = np.linspace(0.0, length, 5)
    each = np.array([quad(beams, *ends)[0] for ends in pairwise(edges)])
    passing = length / np.sum(each) * np.sqrt(cold / np.pi) * np.exp(-2 * gravity * length / cold)
    return {"mean_heat_flux": -passing * (1 - cold), "density": 4 * each / np.sum(each)}


@pytest.mark.slow
def test_rarefied_gas_under_gravity():
    """Derivatives of the flux and of the densities with respect to both, in closed form.

    What collisions there are take off a few percent: their share of the flights, 1/20.
    """
    cold, gravity = 0.4, 0.15
    scene = FourierFlow(Rarefied(), cold_temperature=cold, gravity=gravity, length=1.0, layers=4)
    small = {"n_particles": 512, "duration": 3000.0, "time_step": 0.25, "progress": False}
    s = jdsmc.sensitivity(scene, ("cold_temperature", "gravity"), steps_per_record=8, **small)
    flux = s.result["mean_heat_flux"]
    known = of_beams(cold, gravity)
    assert abs(flux.value - known["mean_heat_flux"]) < 4 * flux.error + 0.02 * abs(flux.value)
    truth = {
        "cold_temperature": slope(lambda h: of_beams(cold + h, gravity), 1e-3),
        "gravity": slope(lambda h: of_beams(cold, gravity + h), 1e-3),
    }
    for number, of in truth.items():
        for name, exact in of.items():
            found = s[name][number]
            size = np.max(np.abs(exact))
            assert np.all(found.error > 0) and np.all(found.error < 0.1 * size)
            # fixed seed; the statistical error, what a fit leaves out, and collisions
            assert np.all(np.abs(found.value - exact) < 3.5 * found.uncertainty + 0.05 * size)
    assert "cold_temperature" in s.table()


@pytest.mark.slow
def test_second_route_for_a_homogeneous_gas():
    """d/dα at α = 0.7 against differences of long runs, extrapolated: -.5200(5), -1.28, -1.96.

    Truths to 1% (the last two have two digits and time_step = 0.1 moves them by less).
    """
    scene = UniformShear(InelasticHardSpheres(0.7), shear_rate=1.0)
    small = {"n_particles": 8192, "collisions": 120.0, "time_step": 0.1, "progress": False}
    s = sensitivity_by_sweep(scene, "restitution", **small)
    known = {"shear_stress": -0.52, "reduced_shear_rate": -1.28, "normal_stress_xy": -1.96}
    for name, truth in known.items():
        found = s[name]["restitution"]
        assert found.error < 0.01 * abs(truth)
        assert abs(found.value - truth) < 3.0 * found.uncertainty + 0.01 * abs(truth)
