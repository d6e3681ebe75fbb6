"""Navier-Stokes coefficients of the elastic gas under a drag."""

import numpy as np
import pytest

from jdsmc.theory import sonine_elastic
from jdsmc.theory.boltzmann import navier_stokes
from jdsmc.theory.frictional import coefficients, rate_factor


def test_without_drag():
    """Those of elastic spheres."""
    found = coefficients(0.0)
    assert found["conductivity"] == pytest.approx(sonine_elastic.conductivity_ratio(10), rel=1e-6)
    assert found["viscosity"] == pytest.approx(sonine_elastic.viscosity_ratio(10), rel=1e-6)
    assert abs(found["density_coefficient"]) < 1e-9


@pytest.mark.parametrize("x", [0.1, 0.7, 1.5])
def test_identities(x):
    """κ' does not know the drag; μ from its own equation is 2 (κ - κ'): eq. (2.38)."""
    found = coefficients(x)
    assert found["modified_conductivity"] == pytest.approx(coefficients(0.0)["conductivity"])
    twice = 2 * (found["conductivity"] - found["modified_conductivity"])
    assert found["density_coefficient"] == pytest.approx(twice, rel=1e-6)


@pytest.mark.parametrize("x", [0.05, 0.5, 1.0])
def test_first_sonine(x):
    """1/(1 + ζ/2ν_η) and 1/(1 - ζ/2ν_κ), ν_η τ = 8/5√π, ν_κ τ = 16/15√π: higher ones add 3%."""
    zeta, found = 2 * x / (3 * np.sqrt(np.pi)), coefficients(x)
    eta, kappa = 8 / (5 * np.sqrt(np.pi)), 16 / (15 * np.sqrt(np.pi))
    assert found["viscosity"] == pytest.approx(1 / (1 + zeta / 2 / eta), rel=0.03)
    assert found["conductivity"] == pytest.approx(1 / (1 - zeta / 2 / kappa), rel=0.06)


@pytest.mark.parametrize("name", ["viscosity", "modified_conductivity"])
def test_rate_factor(name):
    """1 at α = 1; near it that of η falls by 5/6 (1-α), as (1+α)(2+α)/6, the first Sonine one.

    Higher orders and a2, which is of first order in 1-α, change the slope by 7%.
    """
    alpha = 0.95
    beta = rate_factor(alpha, name)
    if name == "viscosity":
        assert (1 - beta) / (1 - alpha) == pytest.approx(5 / 6, rel=0.1)
    else:
        assert abs(1 - beta) < 0.1 * (1 - alpha)
    exact = vars(navier_stokes(alpha))[name]
    assert coefficients((1 - alpha**2) / beta)[name] / beta == pytest.approx(exact, rel=1e-9)


def test_range():
    with pytest.raises(ValueError, match="density"):
        rate_factor(0.7, "density_coefficient")
    with pytest.raises(ValueError, match=r"drag_over_rate = -1 .*\[0, inf\)"):
        coefficients(-1.0)
