"""Collision integrals of disks: random collisions, closed forms, equilibrium."""

from math import factorial, pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import eval_genlaguerre

from jdsmc.theory.disk_collisions import linear_elements, relative_matrix, rotation
from jdsmc.theory.disk_moments import cooling_distribution, moments


def velocity_moment(m, j, velocity):
    """sqrt(2) Im h_{m+j,j} of complex velocities, from SciPy's Laguerre polynomials."""
    scale = (-1) ** j * sqrt(2 * factorial(j) / factorial(m + j))
    return scale * (velocity**m).imag * eval_genlaguerre(j, m, np.abs(velocity) ** 2)


@pytest.fixture(scope="module")
def collisions():
    """Pairs of Gaussian disks before and after a collision at alpha = 0.8, and 2 g f f / Gaussian.

    The factor 2 makes the mean over b an integral from -1 to 1.
    """
    rng = np.random.default_rng(20)
    parts = rng.normal(scale=sqrt(0.5), size=(4, 400_000))
    first, second = parts[0] + 1j * parts[1], parts[2] + 1j * parts[3]
    relative = first - second
    impact = rng.uniform(-1, 1, len(relative))
    normal = relative / np.abs(relative) * (np.sqrt(1 - impact**2) + 1j * impact)
    kick = 0.9 * (relative * normal.conj()).real * normal
    coefficients, _ = cooling_distribution(0.8, 6)

    def density(velocity):
        square = np.abs(velocity) ** 2
        return sum(
            (-1) ** p * value * eval_genlaguerre(p, 0, square)
            for p, value in enumerate(coefficients)
        )

    return (first, second), (first - kick, second + kick), 2 * np.abs(relative), density


def index(m, j, degree):
    """Position of a moment in the order of `moments`."""
    return sum((degree - each) // 2 + 1 for each in range(1, m)) + j


def assert_mean(samples, exact):
    """Within four standard errors: one of 30 checks fails in 500 seeds."""
    error = samples.std() / sqrt(len(samples))
    assert abs(samples.mean() - exact) < 4 * error
    # an element that would pass at any value tests nothing
    assert error < 0.1


@pytest.mark.parametrize(
    ("m", "row", "column"), [(1, 1, 1), (1, 1, 0), (1, 0, 1), (2, 0, 0), (2, 0, 1), (3, 1, 0)]
)
def test_elements_by_random_collisions(collisions, m, row, column):
    before, after, rate, density = collisions
    equations = moments(0.8, 8, 6)
    here, there = index(m, row, 8), index(m, column, 8)
    psi = [[velocity_moment(m, j, each) for each in (*before, *after)] for j in (row, column)]
    change = psi[0][2] + psi[0][3] - psi[0][0] - psi[0][1]
    drag = {0: (m + 2 * row), 1: 2 * sqrt(row * (m + row))}.get(row - column, 0)
    exact = equations.local[here, there] - equations.growth_rate * drag
    if (m, row) != (1, 0):
        assert_mean(density(before[0]) * psi[1][1] * rate * change, exact)
    else:
        assert_allclose(exact, 0, atol=1e-12)  # momentum: rounding
    source = psi[0][2] * psi[1][3] - psi[0][0] * psi[1][1]
    pair = density(before[0]) * density(before[1])
    assert_mean(pair * rate * source, equations.source[here, there])
    alone = density(before[0]) * psi[0][0] * psi[1][0]
    assert_mean(alone, equations.single[here, there])


def test_stress_relaxation_in_closed_form():
    # nu_eta / nu0 = (1 + alpha) (7 - 3 alpha) / 8 over a Gaussian; nu0 = sqrt(2 pi) n sigma v0
    for restitution in (1.0, 0.8, 0.3):
        table = relative_matrix(restitution, 4, 4, 4)
        element = linear_elements(table, 2, 1, 1, 1)[0, 0, 0]
        frequency = (1 + restitution) * (7 - 3 * restitution) / 8
        assert_allclose(element, -sqrt(2 * pi) * frequency, rtol=1e-12)


def test_elastic_collisions_keep_equilibrium():
    equations = moments(1.0, 16, 6)
    # detailed balance: symmetric, no source of pairs, M = 1; sums of some 1000 terms of order 10
    assert_allclose(equations.local, equations.local.T, atol=1e-11)
    assert_allclose(equations.source, 0, atol=1e-11)
    assert_allclose(equations.single, np.eye(len(equations.single)), atol=1e-11)
    assert np.max(np.linalg.eigvalsh(equations.local)) < 1e-11


@pytest.mark.parametrize("total", [1, 7, 48])
def test_rotation_of_pairs_is_orthogonal(total):
    matrix = rotation(total)
    assert_allclose(matrix @ matrix.T, np.eye(total + 1), atol=1e-12)  # rounding
