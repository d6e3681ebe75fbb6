"""Polynomials in 1/N and their limit."""

import numpy as np
import pytest

from jdsmc.measure.extrapolation import extrapolate

NUMBERS = np.array([1000.0, 1500.0, 2000.0, 3000.0])


@pytest.mark.parametrize("order", [0, 1, 2])
def test_exact_polynomials(order):
    """Values of a polynomial come back to rounding (inverse of a matrix of condition 1e3)."""
    truth = np.array([1.02, -70.0, 3e4])[: order + 1]
    values = np.polynomial.polynomial.polyval(1 / NUMBERS, truth)
    fit = extrapolate(NUMBERS, values, np.array([0.01, 0.02, 0.02, 0.01]), order)
    np.testing.assert_allclose(fit.coefficients, truth, rtol=1e-9)
    assert fit.limit == pytest.approx(float(fit(np.inf)), rel=1e-12)
    assert fit.chi_squared == pytest.approx(0.0, abs=1e-15)
    assert fit.freedom == 4 - order - 1


def test_error_of_a_line_through_two_points():
    """Limit = (N2 y2 - N1 y1)/(N2 - N1), its error by propagation."""
    fit = extrapolate([1000, 3000], [0.90, 0.96], [0.01, 0.02], 1)
    assert fit.limit == pytest.approx((3 * 0.96 - 0.90) / 2, rel=1e-12)
    assert fit.error == pytest.approx(np.hypot(3 * 0.02, 0.01) / 2, rel=1e-12)


@pytest.mark.parametrize("order", [1, 2])
def test_error_is_the_scatter(order):
    """4000 experiments: variance of the score 1 within 4.5 √(2/n), mean within 4.5/√n."""
    rng, errors = np.random.default_rng(1), np.array([0.02, 0.01, 0.01, 0.015])
    truth = np.array([1.02, -70.0, 3e4])[: order + 1]
    exact = np.polynomial.polynomial.polyval(1 / NUMBERS, truth)
    fits = [
        extrapolate(NUMBERS, exact + errors * rng.normal(size=4), errors, order)
        for _ in range(4000)
    ]
    score = np.array([(fit.limit - truth[0]) / fit.error for fit in fits])
    assert abs(np.mean(score)) < 4.5 / np.sqrt(4000)
    assert abs(np.var(score) - 1) < 4.5 * np.sqrt(2 / 4000)
    freedom = 3 - order  # mean of chi squared, variance 2 freedom
    chi = np.mean([fit.chi_squared for fit in fits])
    assert abs(chi - freedom) < 4.5 * np.sqrt(2 * freedom / 4000)


def test_higher_order_costs_error():
    values, errors = np.array([0.95, 0.97, 0.98, 0.99]), np.full(4, 0.01)
    line, parabola = (extrapolate(NUMBERS, values, errors, order) for order in (1, 2))
    assert parabola.error > 2 * line.error


def test_bad_input():
    with pytest.raises(ValueError, match="at least 3 different N"):
        extrapolate([1000, 2000, 2000], [1, 1, 1], [1, 1, 1], 2)
    with pytest.raises(ValueError, match="same length"):
        extrapolate([1000, 2000], [1], [1], 1)
    with pytest.raises(ValueError, match="positive"):
        extrapolate([1000, 2000], [1, 1], [0, 1], 1)
    with pytest.raises(TypeError, match="order"):
        extrapolate([1000, 2000], [1, 1], [1, 1], 1.5)  # pyright: ignore[reportArgumentType]
