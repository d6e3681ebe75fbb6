"""Collision integrals: brute-force Monte Carlo, conservation, and exactness of the rules."""

from math import gamma, pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import eval_genlaguerre

from jdsmc.theory.collision_integrals import cooling_tensor, linear_operator, loss_of_energy
from jdsmc.theory.laguerre_basis import LaguerreBasis, radial_rule

THETA = 1.1
SAMPLES = 400_000


def laguerre_function(k, rank, square):
    """phi_k as its definition has it, normalisation included."""
    x = 2 * square / THETA
    norm = sqrt(gamma(k + 1) / gamma(k + rank + 1.5))
    return norm * np.exp(-x / 2) * eval_genlaguerre(k, rank + 0.5, x)


def contracted(rank, a, b):
    """|a|^l |b|^l P_l(cos), for vectors on the first axis."""
    product = np.sum(a * b, axis=0)
    if rank == 2:
        return (3 * product**2 - np.sum(a**2, axis=0) * np.sum(b**2, axis=0)) / 2
    return product**rank


@pytest.fixture(scope="module")
def collisions():
    """Random velocities, c1 after a collision at alpha = 0.4, and weights of the collision term.

    Velocities from Gaussians of unit variance per component, wider than the functions, sigma^
    uniform. The weight is 4 pi (g.sigma^)_+ / (sqrt(2) pi) over the density of the velocities.
    """
    random = np.random.default_rng(1)
    first, second = random.normal(size=(2, 3, SAMPLES))
    normal = random.normal(size=(3, SAMPLES))
    normal /= np.linalg.norm(normal, axis=0)
    approach = np.sum((first - second) * normal, axis=0)
    after = first - 0.7 * approach * normal
    density = np.exp(-(np.sum(first**2, axis=0) + np.sum(second**2, axis=0)) / 2)
    density /= (2 * pi) ** 3
    weight = 4 * pi * np.maximum(approach, 0) / (sqrt(2) * pi) / density
    return first, second, after, weight


def mean_and_error(samples):
    return samples.mean(), samples.std() / sqrt(len(samples))


@pytest.mark.parametrize("k,i,j", [(0, 0, 0), (1, 0, 2), (2, 2, 1), (3, 3, 1)])
def test_cooling_tensor_agrees_with_random_collisions(collisions, k, i, j):
    first, second, after, weight = collisions
    squares = [np.sum(v**2, axis=0) for v in (first, second, after)]
    kept, partner, change = (
        laguerre_function(i, 0, squares[0]),
        laguerre_function(j, 0, squares[1]),
        laguerre_function(k, 0, squares[2]) - laguerre_function(k, 0, squares[0]),
    )
    mean, error = mean_and_error(weight * kept * partner * change)
    exact = cooling_tensor(LaguerreBasis(5, 0, THETA), 0.4)[k, i, j]
    assert abs(mean - exact) < 4 * error  # one false alarm in 1e4
    assert error < 0.1 * abs(exact)  # the comparison means something


@pytest.mark.parametrize("rank", [1, 2])
@pytest.mark.parametrize("k,i", [(0, 0), (1, 0), (0, 2), (1, 3)])
def test_linear_operator_agrees_with_random_collisions(collisions, rank, k, i):
    first, second, after, weight = collisions
    cooling = np.array([1.0, 0.3, -0.2, 0.1, 0.0])
    squares = [np.sum(v**2, axis=0) for v in (first, second, after)]
    background = [
        sum(a * laguerre_function(n, 0, square) for n, a in enumerate(cooling))
        for square in squares[:2]
    ]
    disturbance = [laguerre_function(i, rank, square) for square in squares[:2]]
    total = 0
    for sign, scattered, square in ((-1, after, squares[2]), (1, first, squares[0])):
        test = sign * laguerre_function(k, rank, square)
        total += test * disturbance[0] * background[1] * contracted(rank, scattered, first)
        total += test * disturbance[1] * background[0] * contracted(rank, scattered, second)
    mean, error = mean_and_error(weight * total)
    matrix = linear_operator(
        LaguerreBasis(5, rank, THETA), 0.4, LaguerreBasis(5, 0, THETA), cooling
    )
    assert abs(mean - matrix[k, i]) < 4 * error  # one false alarm in 1e4
    assert error < 0.1 * abs(matrix[k, i])  # the comparison means something


def test_loss_of_energy_agrees_with_random_collisions(collisions):
    """zeta = -(2/3) int c^2 J over (1 - alpha^2), for two functions that are not alike."""
    first, second, after, weight = collisions
    squares = [np.sum(v**2, axis=0) for v in (first, second, after)]
    energy = weight * (squares[0] - squares[2]) / 1.5 / (1 - 0.4**2)
    exact = loss_of_energy(LaguerreBasis(3, 0, THETA))
    forward = laguerre_function(0, 0, squares[0]) * laguerre_function(2, 0, squares[1])
    backward = laguerre_function(2, 0, squares[0]) * laguerre_function(0, 0, squares[1])
    mean, error = mean_and_error(energy * (forward + backward) / 2)
    assert abs(mean - exact[0, 2]) < 4 * error
    # In closed form for a Maxwellian (theta = 1): 2/(3 sqrt(pi)) at n = 1.
    function = LaguerreBasis(1, 0, 1.0)
    norm = function.moments(0)[0]
    assert_allclose(loss_of_energy(function)[0, 0] / norm**2, 2 / (3 * sqrt(pi)), rtol=1e-12)


def test_rules_are_exact():
    """Entries do not change with the order of the basis, that is with the number of nodes."""
    small, large = (LaguerreBasis(order, 0, THETA) for order in (4, 7))
    tensor = cooling_tensor(large, 0.6)
    assert_allclose(cooling_tensor(small, 0.6), tensor[:4, :4, :4], rtol=0, atol=1e-12)
    # Entries of order 100 here, sums over thousands of nodes throughout.
    assert_allclose(loss_of_energy(small), loss_of_energy(large)[:4, :4], rtol=0, atol=1e-11)
    cooling = np.array([1.0, 0.3, -0.2, 0.1])
    padded = np.concatenate([cooling, np.zeros(3)])
    for rank in (1, 2):
        few = linear_operator(LaguerreBasis(4, rank, THETA), 0.6, small, cooling)
        many = linear_operator(LaguerreBasis(7, rank, THETA), 0.6, large, padded)
        # Entries of order 10 from sums over a few thousand nodes.
        assert_allclose(few, many[:4, :4], rtol=0, atol=1e-11)


@pytest.mark.parametrize("rank", [0, 1, 2])
def test_functions_slopes_and_norms(rank):
    basis = LaguerreBasis(6, rank, THETA)
    square = np.linspace(0.05, 30, 40).reshape(8, 5)
    expected = [laguerre_function(k, rank, square) for k in range(6)]
    assert_allclose(basis.values(square), expected, rtol=0, atol=1e-13)
    step = 1e-5
    numerical = (basis.values(square + step) - basis.values(square - step)) / (2 * step)
    # Second-order differences: step^2 times third derivatives of order 10, and rounding/step.
    assert_allclose(basis.slopes(square), square * numerical, rtol=0, atol=1e-8)
    # Orthonormal in x = 2 c^2/theta with x^{l+1/2} dx.
    nodes, weight = radial_rule(6 + rank, THETA / 2)
    x = 2 * nodes / THETA
    measure = weight * x**rank / ((THETA / 2) ** 1.5 * 2 * pi)
    values = basis.values(nodes)
    assert_allclose((values * measure) @ values.T, np.eye(6), rtol=0, atol=1e-12)
