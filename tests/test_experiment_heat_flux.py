"""The reproduction of the heat-flux paper: every file at a tiny size, and its analysis exactly."""

import numpy as np
import pytest
from scipy.special import gamma

from experiments import store
from experiments.heat_flux_force import distribution, limits
from experiments.heat_flux_force.figures import DRAW
from experiments.heat_flux_force.reference import NUMBERS
from experiments.heat_flux_force.statements import CLAIMS
from experiments.heat_flux_force.systems import FULL, SMALL, studies

from . import tiny_run


def test_tiny_reproduction(tmp_path):
    """All tables and figures from gases of 512 particles; a second call simulates nothing."""
    tiny_run.reproduce("heat_flux_force", tmp_path)
    files = [tmp_path / f"{name}.{'md' if name == 'table' else 'png'}" for name in ("table", *DRAW)]
    assert all(path.stat().st_size > 1000 for path in files)
    text = files[0].read_text()
    for entry in (*NUMBERS, *CLAIMS):
        assert entry.what in text


@pytest.mark.parametrize("size", [SMALL, FULL], ids=lambda size: size.name)
def test_sizes_hold_what_the_analysis_needs(size):
    """Cases have names, hence seeds, of their own; the paper's fields and the study are there."""
    names = [case.name for study in studies(size).values() for case in study.cases()]
    assert len(set(names)) == len(names)
    assert {0.025, 0.05, 0.1} <= set(size.fields) and {0.3, 0.5, 1.0} <= set(size.restitutions)
    assert min(size.fields.values()) > 1  # errors of a distribution come from the parts


def test_fit_finds_the_limit():
    """An exact polynomial in ε*², to rounding; the error is that of weighted least squares."""
    strengths, error = np.array([0.01, 0.02, 0.05, 0.1]), np.array([4.0, 2.0, 1.0, 0.5]) * 1e-3
    value = 1.2 + 7 * strengths**2 - 300 * strengths**4
    found = limits.fit(strengths, value, error, (1, 2))
    np.testing.assert_allclose(found.best, [1.2, 7.0, -300.0], rtol=1e-9)
    assert found.excess(0.05).value == pytest.approx((value[2] - 1.2) / 1.2)
    constant = limits.fit(strengths, value, error, ())
    assert constant.value.error == pytest.approx(np.sum(error**-2.0) ** -0.5)


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
    assert distribution.share_below(odd).value == pytest.approx(exact, abs=1e-3)
    # (3.12): 2 Γ(3/2)/Γ(5/2) ⟨c_x L_1⟩ over ε*, both halves of the axis
    first = np.sum(centres * (1.5 - centres**2) * odd.density[0]) * 0.1
    assert 2 * 2 * gamma(1.5) / gamma(2.5) * first == pytest.approx(b[0], rel=5e-3)


def test_program_follows_imports(tmp_path, monkeypatch):
    """A file counts if the simulation imports it, however indirectly, and not otherwise."""
    monkeypatch.setattr(store, "PACKAGE", tmp_path)
    (tmp_path / "scenes").mkdir()
    sources = {
        "run.py": "from . import deep\n",
        "deep.py": "x = 1\n",
        "scenes/one.py": "from ..near import thing\n",
        "near.py": "thing = 1\n",
        "other.py": "y = 1\n",
    }
    for name, text in sources.items():
        (tmp_path / name).write_text(text)

    def fingerprint():
        store.program.cache_clear()
        return store.program("scenes/one.py")

    before = fingerprint()
    (tmp_path / "other.py").write_text("y = 2\n")
    assert fingerprint() == before
    for name in ("near.py", "deep.py"):
        (tmp_path / name).write_text("thing = 2\n")
        assert fingerprint() != before
        before = fingerprint()
    store.program.cache_clear()
