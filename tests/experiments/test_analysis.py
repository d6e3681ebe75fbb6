"""The analysis of each study, exactly: known profiles, series and tables in, known answers out."""

import numpy as np
import pytest
import xarray as xr
from scipy.special import gamma

from experiments.conduction_limits.coefficients import small_gradient_limit
from experiments.fourier_flow_gravity import balance, effect, profiles
from experiments.fourier_flow_gravity.cases import COMBINATIONS
from experiments.heat_flux_force import distribution
from experiments.uniform_shear_flow import measured
from experiments.uniform_shear_flow.claims_distribution import equilibrium, share_of
from experiments.uniform_shear_flow.data import Curve
from jdsmc import Estimate


def test_tables_of_the_paper_are_copied_rightly():
    """Δκ* is κ* minus its value at g = 0 in all rows; g* has the sign of g and is monotonic."""
    for combination in COMBINATIONS:
        rows = effect.table(combination)
        free = rows["kappa_star"][rows["gravity"] == 0]
        np.testing.assert_allclose(rows["kappa_star"] - free, rows["kappa_star_change"], atol=1e-9)
        assert np.all(np.diff(rows["reduced_gravity"]) > 0)
        assert np.all(np.diff(rows["mean_free_paths"]) >= 0)
        assert set(rows) == {"gravity", *effect.SYMBOLS}


def test_response_of_the_paper_by_hand():
    """B ε0 is the slope at g* = 0 of a parabola: close to the mean slope between ±0.02."""
    rows = effect.table(COMBINATIONS[1])
    near = np.abs(rows["reduced_gravity"]) < 0.03
    slope = np.polyfit(rows["reduced_gravity"][near], rows["kappa_star"][near], 1)[0]
    found = effect.paper_response(COMBINATIONS[1])["B"]
    assert float(found) == pytest.approx(slope / 0.36, rel=0.1)


def _slab(stress, flux, density, gravity=0.0):
    """Realizations of a slab of ten layers of thickness 0.1 with noise of 1e-3."""
    noise = np.random.default_rng(5).normal(0.0, 1e-3, (2, 8, 10))
    z = np.arange(10) * 0.1 + 0.05
    data = {
        "pressure_zz": (("realization", "z"), stress + noise[0]),
        "heat_flux": (("realization", "z"), flux + noise[1]),
        "density": (("realization", "z"), np.broadcast_to(density, (8, 10))),
    }
    return xr.Dataset(data, coords={"z": z, "gravity": gravity})


def test_balance_of_a_hydrostatic_gas():
    """P_zz = 1 - g n z passes (12) with slope 1; with half the weight it fails."""
    z = np.arange(10) * 0.1 + 0.05
    slab = _slab(1 - 0.2 * z, np.ones(10), np.ones(10), gravity=0.2)
    assert abs(balance.slope(slab).distance(1.0)) < 4
    assert balance.momentum(slab).probability > 0.01
    wrong = _slab(1 - 0.1 * z, np.ones(10), np.ones(10), gravity=0.2)
    assert balance.momentum(wrong).probability == pytest.approx(1 / 128)  # of 128 choices of signs
    assert float(balance.slope(wrong)) == pytest.approx(0.5, abs=0.05)


def test_exchange_across_layers_is_counted():
    """A flux reduced by the known cell error is uniform in thin layers once that is added."""
    density = np.array([12.0, *np.linspace(4.8, 1, 9)])
    lost = 1 / (1 + balance.CELL * (0.1 * density) ** 2)
    slab = _slab(np.ones(10), lost, density)
    tested = balance.energy(slab)
    assert len(tested.deviation.value) == 9  # the thick layer is left out
    assert tested.probability > 0.01
    assert balance.energy(slab, thin=False).probability == pytest.approx(1 / 128)


def test_crossing_of_known_profiles():
    z = np.arange(100) * 0.1 + 0.05
    zz = np.ones((8, 100)) + np.random.default_rng(3).normal(0, 1e-4, (8, 100))
    data = {"pressure_zz": (("realization", "z"), zz)}
    data["pressure"] = (("realization", "z"), zz + 0.03 * (0.4 - z / 10))
    found = profiles.crossing(xr.Dataset(data, coords={"z": z}))
    assert float(found) == pytest.approx(0.4, abs=1e-9)


def test_eq_6_is_the_theory():
    assert profiles.prediction(0.1, 0.0) == 1.0
    assert profiles.prediction(0.1, 0.01) == pytest.approx(1 + 0.0092 + (4.8 + 5.037) * 1e-4)


def test_limit_of_small_gradients():
    """A coefficient quadratic in the gradient gives its value at zero, errors in proportion.

    Weights (-1/3, 4/3) for gradients in the ratio 2: exact but for rounding.
    """
    gradient, error = np.array([0.04, 0.02]), np.array([0.003, 0.006])
    found = small_gradient_limit(gradient, Estimate(1.02 - 5.0 * gradient**2, error))
    assert float(found) == pytest.approx(1.02, rel=1e-12)
    assert float(found.error) == pytest.approx(np.hypot(0.001, 0.008), rel=1e-12)


def test_distribution_of_a_known_series():
    """φ = b'_1 L_1 + b'_2 L_2 in; φ, its share of the heat flux and b'_1 out.

    Bins of width 0.1 with φ at their centres: what φ changes within them leaves a relative error of
    order 0.1²/12.
    """
    b, edges = (1.7, -0.4), np.arange(0, 6.01, 0.1)
    centres = 0.5 * (edges[1:] + edges[:-1])
    wanted = distribution.truncated(b, centres**2)
    weight = -0.5 * np.diff(np.exp(-(edges**2))) / np.sqrt(np.pi) / 0.1
    odd = distribution.Odd(edges, np.stack([wanted * weight] * 3))
    value, error = distribution.phi(odd)
    np.testing.assert_allclose(value, wanted, rtol=1e-12)
    assert np.max(error) < 1e-12
    share, _ = distribution.share(odd)
    assert share[-1] == 1.0
    x = np.sqrt(6.0)
    grid = np.linspace(0, x, 20_001)
    integrand = grid**2 * (1.5 - grid**2) * np.exp(-(grid**2))
    integrand *= distribution.truncated(b, grid**2)
    exact = 8 / (3 * np.sqrt(np.pi)) * np.trapezoid(integrand, grid) / b[0]
    assert float(distribution.share_below(odd)) == pytest.approx(exact, abs=1e-3)
    # (3.12): 2 Γ(3/2)/Γ(5/2) ⟨c_x L_1⟩ over ε*, both halves of the axis
    first = np.sum(centres * (1.5 - centres**2) * odd.density[0]) * 0.1
    assert 2 * 2 * gamma(1.5) / gamma(2.5) * first == pytest.approx(b[0], rel=5e-3)


def test_when_an_exponential_settles():
    """1 - e^{-s/2} is within 2%, 5%, 1% of 1 at 2 ln 50, 2 ln 20, 2 ln 100.

    Records are 0.02 apart; a running mean over one collision moves an exponential of rate 1/2 by
    (1/2)(1/2)²/12 = 0.02 in time: 0.05 together.
    """
    clock = np.arange(0, 60, 0.02)
    series = xr.Dataset({"clock": ("sample", clock), "time": ("sample", 3 * clock)})
    found = measured.settled(series, 1 - np.exp(-clock / 2), "time")
    wanted = 6 * np.log([50, 20, 100])
    np.testing.assert_allclose([found.value, found.low, found.high], wanted, atol=3 * 0.05)


def test_local_equilibrium_is_normalized():
    """Half a Gaussian's weight for a marginal of one half space, 1 for F; rectangles of 0.02."""
    for name, low, weight in (("marginal_x", -10.0, 0.5), ("speed", 0.0, 1.0)):
        found = share_of(lambda c, name=name: equilibrium(name, c), low, 10.0)
        assert found == pytest.approx(weight, rel=1e-6)


def test_curves_are_interpolated_layer_by_layer():
    time = np.array([0.0, 1.0, 2.0])
    value = np.array([[0.0, 1.0], [2.0, 1.0], [4.0, 5.0]])
    curve = Curve(time, Estimate(value, 0.1 * np.ones_like(value)))
    np.testing.assert_allclose(curve.at(0.5).value, [1.0, 1.0])
    np.testing.assert_allclose(curve.over(slice(0, 2)).at(1.5).value, 3.0)
    np.testing.assert_allclose(curve.over(slice(0, 2)).at(1.5).error, 0.1 / np.sqrt(2))
