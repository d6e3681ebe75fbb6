"""The reproduction of the Fourier flow: every file at a tiny size, and its analysis exactly."""

import numpy as np
import pytest
import xarray as xr

from experiments.conduction_limits.analysis import small_gradient_limit
from experiments.fourier_flow_gravity import balance, effect, molecules, profiles
from experiments.fourier_flow_gravity.figures import DRAW
from experiments.fourier_flow_gravity.reference import COLUMNS, NUMBERS, table
from experiments.fourier_flow_gravity.statements import CLAIMS
from experiments.fourier_flow_gravity.systems import COMBINATIONS, FULL, SMALL, cases

from . import tiny_run


def test_tiny_reproduction(tmp_path):
    """All tables and figures from gases of 256 particles; a second call simulates nothing."""
    tiny_run.reproduce("fourier_flow_gravity", tmp_path)
    files = [tmp_path / f"{name}.{'md' if name == 'table' else 'png'}" for name in ("table", *DRAW)]
    assert all(path.stat().st_size > 1000 for path in files)
    text = files[0].read_text()
    for entry in (*NUMBERS, *CLAIMS):
        assert entry.what.replace("|", "\\|") in text


@pytest.mark.parametrize("size", [SMALL, FULL], ids=lambda size: size.name)
def test_sizes_hold_what_the_analysis_needs(size):
    """Names, hence seeds, of their own; g = 0 and the states of the figures are there."""
    names = [case.name for case in cases(size).values()]
    assert len(set(names)) == len(names)
    for combination, gravity in size.gravity.items():
        known = {*table(combination)["gravity"], -0.008}
        assert 0.0 in gravity and set(gravity) <= known and len(gravity) >= 4


def test_full_size_has_every_row_of_the_tables():
    rows = [len(table(c)["gravity"]) for c in COMBINATIONS]
    assert sum(rows) == 51
    for combination in COMBINATIONS:
        assert set(table(combination)["gravity"]) <= set(FULL.gravity[combination])


def test_tables_of_the_paper_are_copied_rightly():
    """Δκ* is κ* minus its value at g = 0 in all rows; g* has the sign of g and is monotonic."""
    for combination in COMBINATIONS:
        rows = table(combination)
        free = rows["kappa_star"][rows["gravity"] == 0]
        np.testing.assert_allclose(rows["kappa_star"] - free, rows["kappa_star_change"], atol=1e-9)
        assert np.all(np.diff(rows["reduced_gravity"]) > 0)
        assert np.all(np.diff(rows["mean_free_paths"]) >= 0)
        assert set(rows) == {"gravity", *COLUMNS}


def test_response_of_the_paper_by_hand():
    """B ε0 is the slope at g* = 0 of a parabola: close to the mean slope between ±0.02."""
    rows = table(COMBINATIONS[1])
    near = np.abs(rows["reduced_gravity"]) < 0.03
    slope = np.polyfit(rows["reduced_gravity"][near], rows["kappa_star"][near], 1)[0]
    found = effect.paper_response(COMBINATIONS[1])["B"]
    assert found.value == pytest.approx(slope / 0.36, rel=0.1)


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
    value, error = balance.slope(slab)
    assert abs(value - 1) < 4 * error
    assert balance.momentum(slab).probability > 0.01
    wrong = _slab(1 - 0.1 * z, np.ones(10), np.ones(10), gravity=0.2)
    assert balance.momentum(wrong).probability == pytest.approx(1 / 128)  # of 128 choices of signs
    assert balance.slope(wrong).value == pytest.approx(0.5, abs=0.05)


def test_exchange_across_layers_is_counted():
    """A flux reduced by the known cell error is uniform in thin layers once that is added."""
    density = np.array([12.0, *np.linspace(4.8, 1, 9)])
    lost = 1 / (1 + balance.CELL * (0.1 * density) ** 2)
    slab = _slab(np.ones(10), lost, density)
    tested = balance.energy(slab)
    assert len(tested.deviation) == 9  # the thick layer is left out
    assert tested.probability > 0.01
    assert balance.energy(slab, thin=False).probability == pytest.approx(1 / 128)


def test_crossing_of_known_profiles():
    z = np.arange(100) * 0.1 + 0.05
    zz = np.ones((8, 100)) + np.random.default_rng(3).normal(0, 1e-4, (8, 100))
    data = {"pressure_zz": (("realization", "z"), zz)}
    data["pressure"] = (("realization", "z"), zz + 0.03 * (0.4 - z / 10))
    found = profiles.crossing(xr.Dataset(data, coords={"z": z}))
    assert found.value == pytest.approx(0.4, abs=1e-9)


def test_eq_6_is_the_theory():
    assert molecules.prediction(0.1, 0.0) == 1.0
    assert molecules.prediction(0.1, 0.01) == pytest.approx(1 + 0.0092 + (4.8 + 5.037) * 1e-4)


def test_limit_of_small_gradients():
    """A coefficient quadratic in the gradient gives its value at zero, errors in proportion.

    Weights (-1/3, 4/3) for gradients in the ratio 2: exact but for rounding.
    """
    gradient, error = np.array([0.04, 0.02]), np.array([0.003, 0.006])
    value, uncertainty = small_gradient_limit(gradient, 1.02 - 5.0 * gradient**2, error)
    assert value == pytest.approx(1.02, rel=1e-12)
    assert uncertainty == pytest.approx(np.hypot(0.001, 0.008), rel=1e-12)
