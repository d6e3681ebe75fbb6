"""Elastic Sonine approximations: known fractions and limits, and brackets by other integrals."""

from math import factorial, pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import eval_genlaguerre, roots_genlaguerre

from jdsmc.theory.sonine_elastic import (
    bracket_matrix,
    conductivity_ratio,
    sonine_coefficients,
    sonine_ratios,
    viscosity_ratio,
)

# Sums over a few thousand nodes and small linear systems: double rounding, with a margin.
ROUNDING = 1e-12


def direct_bracket(order, rank):
    """-(1/n) int Phi_k . (J[f_M, f_M Phi_l] + J[f_M Phi_l, f_M]), as it stands, lambda = v0 = 1.

    No use of what a collision conserves: quadrature over C, w and its directions before and after,
    of (v0/lambda) w Phi_k(c1) . [sum of Phi_l before - sum of Phi_l after].
    """
    centre, centre_weight = roots_genlaguerre(order + 3, 0.5)
    relative, relative_weight = roots_genlaguerre(order + 3, 1.0)
    cosine, cosine_weight = np.polynomial.legendre.leggauss(order + 4)
    azimuth = 2 * pi * np.arange(2 * order + 6) / (2 * order + 6)
    grid = np.ix_(np.sqrt(centre), np.sqrt(relative), cosine, cosine, azimuth)
    weight = np.einsum(
        "a,b,c,d,e->abcde",
        centre_weight / (sqrt(pi) / 2),
        relative_weight / (sqrt(pi) / 2),
        cosine_weight / 2,
        cosine_weight / 2,
        np.full(len(azimuth), 1 / len(azimuth)),
    )
    c, w, before, after, turn = grid
    transverse = w * np.sqrt(1 - after**2)
    middle = vector(weight.shape, 0, 0, c)
    pre = vector(weight.shape, w * np.sqrt(1 - before**2), 0, w * before)
    post = vector(weight.shape, transverse * np.cos(turn), transverse * np.sin(turn), w * after)
    first, second, *scattered = (
        (middle + sign * v) / sqrt(2) for v in (pre, post) for sign in (1, -1)
    )
    degrees = np.arange(order) + (2 - rank)
    bracket = np.empty((order, order))
    for column, degree in enumerate(degrees):
        kept = sum(contracted(first, v, rank, degree) for v in (first, second))
        lost = sum(contracted(first, v, rank, degree) for v in scattered)
        for row, other in enumerate(degrees):
            polynomial = eval_genlaguerre(other, rank + 0.5, np.sum(first**2, axis=0))
            bracket[row, column] = np.sum(weight * polynomial * (kept - lost))
    return bracket


def vector(shape, *components):
    return np.stack([np.broadcast_to(component, shape) for component in components])


def contracted(tensor_of, v, rank, degree):
    """L_degree(v^2) times u.v, or (3/2) [u u] : [v v], with u = `tensor_of`."""
    square = np.sum(v**2, axis=0)
    product = np.sum(tensor_of * v, axis=0)
    if rank == 2:
        product = 1.5 * product**2 - 0.5 * square * np.sum(tensor_of**2, axis=0)
    return eval_genlaguerre(degree, rank + 0.5, square) * product


@pytest.mark.parametrize("rank", [1, 2])
def test_brackets_agree_with_the_collision_integral_as_it_stands(rank):
    order = 4
    matrix = bracket_matrix(order, rank)
    # Entries are of order 10; the direct sums cancel two digits over 2e5 nodes.
    assert_allclose(matrix, direct_bracket(order, rank), rtol=1e-10, atol=1e-10)


def test_brackets_agree_with_the_omega_integrals_of_chapman_and_cowling():
    """The Mathematical Theory of Non-uniform Gases, Sec. 9.6 (one gas), in units of Omega^(2)(2).

    a11 = 4 W(2), a12 = 7 W(2) - 2 W(3), a22 = (77/4) W(2) - 7 W(3) + W(4);
    b11 = 4 W(2), b12 = 7 W(2) - 2 W(3), b22 = (301/12) W(2) - 7 W(3) + W(4);
    hard spheres: W(r) proportional to (r + 1)!.
    """
    two, three, four = (factorial(r + 1) / factorial(3) for r in (2, 3, 4))
    off = 7 * two - 2 * three
    for rank, diagonal in ((1, 77 / 4), (2, 301 / 12)):
        matrix = bracket_matrix(2, rank)
        expected = [[4 * two, off], [off, diagonal * two - 7 * three + four]]
        assert_allclose(4 * matrix / matrix[0, 0], expected, rtol=ROUNDING)


def test_second_approximations_are_known_fractions():
    """1 / (1 - a12^2/(a11 a22)) with the entries of the previous test."""
    assert_allclose(conductivity_ratio(2), 45 / 44, rtol=ROUNDING)
    assert_allclose(viscosity_ratio(2), 205 / 202, rtol=ROUNDING)


def test_first_approximation_is_one():
    assert conductivity_ratio(1) == 1
    assert viscosity_ratio(1) == 1
    assert_allclose(sonine_coefficients(1), [15 * sqrt(pi) / 16], rtol=ROUNDING)


@pytest.mark.parametrize(
    ("ratio", "limit"), [(conductivity_ratio, 1.025218), (viscosity_ratio, 1.016034)]
)
def test_approximations_rise_to_the_published_limits(ratio, limit):
    """1.025218 stands in the paper (Fig. 3); 1.016034 comes with it in its Ref. [37].

    Each approximation maximises a quadratic form over a larger space: it can only grow.
    """
    values = np.array([ratio(order) for order in range(1, 13)])
    steps = np.diff(values)
    assert np.all(steps > 0)
    # Steps shrink at least three-fold each up to order 6, so that less than half the last is left.
    assert np.all(steps[1:5] < steps[:4] / 3)
    assert abs(values[5] - limit) < steps[4] / 2
    # Published limits are rounded to six decimals; order 12 is converged beyond that.
    assert_allclose(values[-1], limit, atol=5.5e-7)


def test_high_orders_lose_no_digits():
    # Steps are positive and below 1e-10 here, as their trend says; rounding must not exceed them.
    for ratio in (conductivity_ratio, viscosity_ratio):
        assert 0 <= ratio(30) - ratio(24) < 1e-10


@pytest.mark.parametrize("order", [1, 2, 6])
def test_first_coefficient_is_the_conductivity(order):
    """Eq. (2.45): kappa is proportional to b_1, exactly."""
    coefficients = sonine_coefficients(order)
    assert coefficients.shape == (order,)
    first = 15 * sqrt(pi) / 16
    assert_allclose(coefficients[0] / first, conductivity_ratio(order), rtol=ROUNDING)
    assert_allclose(sonine_ratios(order), coefficients / coefficients[0], rtol=ROUNDING)


def test_second_coefficient_ratio_at_second_order():
    """The second row of the 2 x 2 system: b_2/b_1 = -a12/a22 = 4/45."""
    assert_allclose(sonine_ratios(2), [1, 4 / 45], rtol=ROUNDING)


@pytest.mark.parametrize("rank", [1, 2])
def test_bracket_matrix_is_symmetric_positive_and_nested(rank):
    matrix = bracket_matrix(6, rank)
    assert_allclose(matrix, matrix.T, rtol=ROUNDING, atol=ROUNDING)
    assert np.all(np.linalg.eigvalsh(matrix) > 0)
    # The same entries come from rules with other numbers of nodes.
    assert_allclose(bracket_matrix(3, rank), matrix[:3, :3], rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("order", [0, -1, 31, 2.5, "2"])
def test_bad_order_is_refused(order):
    for function in (conductivity_ratio, viscosity_ratio, sonine_coefficients, sonine_ratios):
        with pytest.raises(ValueError, match=r"order must be an integer in 1 \.\.\. 30"):
            function(order)


def test_bad_rank_is_refused():
    with pytest.raises(ValueError, match="rank must be 1"):
        bracket_matrix(2, 3)
