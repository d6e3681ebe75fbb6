"""Homogeneous cooling state of inelastic hard disks and the linear Boltzmann-Langevin equation.

The moments of the transverse mode are a_p = N^(-1/2) sum_i psi_p(c_i) exp(i k y_i), with
c = w / sqrt(2 T / m) in the frame of the stationary representation (Costantini and Puglisi, Phys.
Rev. E 82, 011305 (2010), Eqs. (6), (7)) and psi_p = sqrt(2) times the imaginary part of the
orthonormal h_{m+j,j} of `disk_collisions`: m >= 1, the angle counted from k, m + 2 j <= degree.
The first is psi = sqrt(2) c_x. With i^m taken into a_p everything is real.

    da_p/ds = sum_q A_pq a_q + noise,   A = collisions + mu c . d/dc + i k c_y.

The stationary covariance X = <a a^+> is M + Y: M_pq = <psi_p psi_q> over the cooling state, one
particle with itself, and the correlation Y of pairs made by collisions,

    A Y + Y A^+ + R = 0,
    R_pq = int int f f dc1 dc2 int db g [psi_p(c1') psi_q(c2') - psi_p(c1) psi_q(c2)].

A pair source is used and not the matrix of the noise, which is the same in exact arithmetic: that
one holds high moments of the overpopulated tail, which the expansion of f does not give.

Units: n sigma = 1 and sqrt(2 T / m) = 1; rates are per n sigma sqrt(2 T / m).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag
from scipy.special import roots_genlaguerre

from jdsmc.theory.disk_collisions import laguerre, linear_elements, pair_sources, relative_matrix

Floats = NDArray[np.float64]
HIGHEST_DEGREE = 40  # with order 8 the integers of `rotation` still fit a double
ITERATIONS = 60


@dataclass(frozen=True)
class Moments:
    """The equations of all wave numbers, of `size` moments ordered by m, then j.

    A = `local` + k `streaming`; `source` is R, `single` is M, all of shape (size, size).
    `growth_rate` is mu, in n sigma sqrt(2 T / m).
    """

    local: Floats
    streaming: Floats
    source: Floats
    single: Floats
    growth_rate: float


@lru_cache(maxsize=32)
def cooling_distribution(restitution: float, order: int) -> tuple[Floats, float]:
    """Coefficients f_0 ... f_order of f = Gaussian sum f_p h_pp, and mu of the stationary state.

    h_pp = (-1)^p L_p(c^2), so the Sonine coefficients are a_p = (-1)^p f_p. They solve

        0 = 2 p mu (f_p + f_{p-1}) + int int f f int db g Delta h_pp / 2,   p = 1 ... order,

    with f_0 = 1 and f_1 = 0, which makes T the temperature and the first line the one for mu.
    RuntimeError if Newton's method does not converge, or to what no distribution has: 2 (1 + a2) =
    <c^4> >= <c^2>^2 = 1.
    """
    coefficients = np.zeros(order + 1)
    coefficients[0] = 1.0
    if restitution == 1:
        return coefficients, 0.0
    table = relative_matrix(restitution, order, 2 * order, order)
    gain = 0.5 * linear_elements(table, 0, order, order, order)
    index = np.arange(order + 1)
    for _ in range(ITERATIONS):
        by_first = np.einsum("ijk,k->ji", gain, coefficients)
        slope = by_first + np.einsum("ijk,i->jk", gain, coefficients)
        rate = by_first @ coefficients
        mu = -rate[1] / 2
        drag = 2 * index * (coefficients + np.concatenate([[0.0], coefficients[:-1]]))
        jacobian = slope - np.outer(drag, slope[1]) / 2
        jacobian += 2 * mu * (np.diag(index) + np.diag(index[1:], -1))
        step = np.linalg.solve(jacobian[2:, 2:], -(rate + mu * drag)[2:])
        coefficients[2:] += step
        if np.max(np.abs(step)) < 1e-14 * (1 + np.max(np.abs(coefficients))):
            if coefficients[2] < -0.5:
                break
            return coefficients, float(-(gain[:, 1] @ coefficients) @ coefficients / 2)
    raise RuntimeError(f"No cooling state of Sonine order {order} at restitution {restitution:g}.")


@lru_cache(maxsize=40)  # at most 6 MB each
def moments(restitution: float, degree: int, order: int) -> Moments:
    """The linear equations of the moments m + 2 j <= degree about f of Sonine order `order`."""
    coefficients, mu = cooling_distribution(restitution, order)
    before = max(2 * order, order + degree // 2)
    table = relative_matrix(restitution, degree, before, degree)
    sources = pair_sources(table, coefficients, degree)
    local, source, single = [], [], []
    for m in range(1, degree + 1):
        highest = (degree - m) // 2
        collisions = linear_elements(table, m, highest, highest, order)
        local.append(np.einsum("i,ijk->jk", coefficients, collisions) + mu * _drag(m, highest))
        j = np.arange(highest + 1)
        source.append([[sources[m + a + b][m + a, a] for b in j] for a in j])
        single.append(_covariance(m, highest, coefficients))
    return Moments(
        local=np.asarray(block_diag(*local)),
        streaming=_streaming(degree),
        source=np.asarray(block_diag(*source)),
        single=np.asarray(block_diag(*single)),
        growth_rate=mu,
    )


def _drag(m: int, highest: int) -> Floats:
    """Elements of c . d/dc on one m: (p + q) h_pq + 2 sqrt(p q) h_{p-1,q-1}, p = m + j, q = j."""
    j = np.arange(highest + 1)
    below = 2 * np.sqrt(j[1:] * (m + j[1:]))
    return np.asarray(np.diag(m + 2.0 * j) + np.diag(below, -1), dtype=float)


def _covariance(m: int, highest: int, coefficients: Floats) -> Floats:
    """M on one m: the Gaussian rule is exact for the two polynomials and that of f."""
    square, weight = roots_genlaguerre(highest + len(coefficients) // 2 + 1, m)
    values = laguerre(highest, m, square)
    state = coefficients @ laguerre(len(coefficients) - 1, 0, square)
    return (values * (weight * state)) @ values.T


def _streaming(degree: int) -> Floats:
    """i c_y per unit wave number, real because a_p carries i^m: antisymmetric.

    c_y = (z + z*) / 2, z h_pq = sqrt(p+1) h_{p+1,q} + sqrt(q) h_{p,q-1} and the conjugate.
    """
    labels = [(m, j) for m in range(1, degree + 1) for j in range((degree - m) // 2 + 1)]
    position = {label: at for at, label in enumerate(labels)}
    matrix = np.zeros((len(labels), len(labels)))
    for (m, j), row in position.items():
        for column, value in (((m + 1, j), m + j + 1), ((m + 1, j - 1), j)):
            if column in position:
                matrix[row, position[column]] = -np.sqrt(value) / 2
                matrix[position[column], row] = np.sqrt(value) / 2
    return matrix
