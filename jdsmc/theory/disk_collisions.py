"""Collision integrals of inelastic hard disks between orthonormal moments, all exact.

Basis. A velocity c = w / sqrt(2 T / m) is read as the complex number z, with weight
exp(-|z|^2) / pi. The complex Hermite polynomials of Ito (Jpn. J. Math. 22, 63, 1952) are

    h_pq(z) = (-1)^q sqrt(q! / p!) z^(p - q) L_q^(p - q)(|z|^2)    for p >= q,

and h_qp is its complex conjugate. They are orthonormal, of degree p + q and of angular number
m = p - q: apart from the normalization, the moments c^m L_j^(m)(c^2) exp(i m theta) with j = q.

Pairs. With C = (c1 + c2) / sqrt 2 and r = (c1 - c2) / sqrt 2 a product of two of them turns into
products h(C) h(r) by `rotation`, once for the indices p and once for the indices q. A collision
leaves C alone and multiplies r by the complex number 1 - (1 + restitution) cos(psi) exp(i psi),
where sin(psi) is the impact parameter b / sigma, uniform in (-1, 1). So every collision integral
is a finite sum over the `relative_matrix` of r alone, which is a polynomial times a Gaussian times
g = sqrt(2) r and is integrated exactly by generalized Gauss-Laguerre and Gauss-Legendre rules.

Rates are in units of n sigma sqrt(2 T / m).
"""

from functools import lru_cache

import numpy as np
from scipy.special import gammaln, roots_genlaguerre


def laguerre(highest: int, order: int, argument: np.ndarray) -> np.ndarray:
    """(-1)^k sqrt(k! / (k + order)!) L_k^(order)(argument), k = 0..highest, on a new first axis."""
    values = np.empty((highest + 1, *argument.shape))
    values[0] = np.exp(-0.5 * gammaln(order + 1))
    if highest:
        values[1] = (argument - 1 - order) / np.sqrt(order + 1) * values[0]
    for k in range(1, highest):
        ahead, behind = np.sqrt((k + 1) * (k + 1 + order)), np.sqrt(k * (k + order))
        values[k + 1] = (
            (argument - 2 * k - 1 - order) * values[k] - behind * values[k - 1]
        ) / ahead
    return values


@lru_cache(maxsize=256)
def rotation(total: int) -> np.ndarray:
    """Orthogonal matrix U[p1, a] from indices (p1, total - p1) of c1, c2 to (total - a, a) of C, r.

    U = sqrt((total - a)! a! / (p1! p2!)) 2^(-total / 2) [x^a] (1 + x)^p1 (1 - x)^p2; the integer
    coefficients are exact in floating point up to total = 50.
    """
    index = np.arange(total + 1)
    half_log = 0.5 * (gammaln(index + 1) + gammaln(total - index + 1))
    matrix = np.empty((total + 1, total + 1))
    for first in index:
        coefficients = np.ones(1)
        for step in range(total):
            coefficients = np.convolve(coefficients, [1.0, 1.0 if step < first else -1.0])
        matrix[first] = coefficients * np.exp(half_log - half_log[first])
    return matrix * 2 ** (-total / 2)


@lru_cache(maxsize=8)
def relative_matrix(restitution: float, after: int, before: int, angular: int) -> np.ndarray:
    """G[l, k, k'] = <g int db [h_{k+l,k}(r')^* - h_{k+l,k}(r)^*] h_{k'+l,k'}(r)> over the Gaussian.

    Shape (angular + 1, after + 1, before + 1).
    """
    result = np.empty((angular + 1, after + 1, before + 1))
    for m in range(angular + 1):
        radius, weight = roots_genlaguerre((after + before) // 2 + 1, m + 0.5)
        nodes, impact_weight = np.polynomial.legendre.leggauss(2 * ((m + after) // 2 + 1))
        kept = nodes > 0
        impact, impact_weight = nodes[kept], 2 * impact_weight[kept]
        cosine = np.sqrt(1 - impact**2)
        factor = 1 - (1 + restitution) * cosine * (cosine + 1j * impact)
        scattered = laguerre(after, m, np.multiply.outer(radius, np.abs(factor) ** 2))
        gain = scattered @ (impact_weight * (factor**m).real)
        change = gain - 2 * laguerre(after, m, radius)
        result[m] = np.sqrt(2) * (change * weight) @ laguerre(before, m, radius).T
    return result


def scattered_pairs(table: np.ndarray, a: np.ndarray, b: np.ndarray, shift: int) -> np.ndarray:
    """G between (a, b) after and (a + shift, b + shift) before; zero where an index is negative."""
    lower = np.minimum(a, b)
    there = lower + shift >= 0
    source = np.where(there, lower + shift, 0)
    return np.where(there, table[np.abs(a - b), lower, source], 0.0)


def linear_elements(table: np.ndarray, m: int, rows: int, columns: int, partners: int):
    """K[i, j, j'] = int int h_ii(c1) h_{j'+m,j'}(c2) int db g [Delta h_{j+m,j}]^*.

    Both velocities have the Gaussian weight; Delta is the sum over both particles, after minus
    before. Shape (partners + 1, rows + 1, columns + 1). For m = 0 symmetric in i and j'.
    """
    result = np.zeros((partners + 1, rows + 1, columns + 1))
    for j in range(rows + 1):
        a, b = np.indices((j + m + 1, j + 1))
        # h(c1) + h(c2): odd powers of r cancel and even ones double
        even = 2.0 * ((a + b) % 2 == 0)
        left = even * np.outer(rotation(j + m)[j + m], rotation(j)[j])
        scattering = {}
        for i in range(partners + 1):
            for column in range(columns + 1):
                shift = i + column - j
                if shift not in scattering:
                    scattering[shift] = left * scattered_pairs(table, a, b, shift)
                right_a = _shifted(rotation(i + column + m)[i], shift, j + m + 1)
                right_b = _shifted(rotation(i + column)[i], shift, j + 1)
                result[i, j, column] = right_a @ scattering[shift] @ right_b
    return result


def _shifted(vector: np.ndarray, shift: int, length: int) -> np.ndarray:
    """vector[shift : shift + length], zero where the index is negative."""
    if shift >= 0:
        return vector[shift : shift + length]
    return np.concatenate([np.zeros(min(-shift, length)), vector[: max(length + shift, 0)]])


def pair_sources(table: np.ndarray, coefficients: np.ndarray, highest: int) -> list[np.ndarray]:
    """S_n[p, q] = int int f f int db g [h_{p,q}(c1') h_{n-p,n-q}(c2') - before], n = 0..highest.

    f = Gaussian times sum_i coefficients[i] h_ii. With p = m + j, q = j and n = m + j + j' this is
    the product of the moment (m, j) of one particle with the conjugate of (m, j') of the other.
    """
    order = len(coefficients) - 1
    state = []
    for total in range(2 * order + 1):
        first = np.arange(max(0, total - order), min(order, total) + 1)
        weight = coefficients[first] * coefficients[total - first]
        state.append(rotation(total)[first].T @ (weight[:, None] * rotation(total)[first]))
    result = []
    for n in range(highest + 1):
        a, b = np.indices((n + 1, n + 1))
        source = np.zeros((n + 1, n + 1))
        for total, amplitude in enumerate(state):
            shift = total - n
            low = max(0, -shift)
            part = np.s_[low:, low:]
            elements = scattered_pairs(table, a[part], b[part], shift)
            source[part] += elements * amplitude[low + shift :, low + shift :]
        result.append(rotation(n) @ source @ rotation(n).T)
    return result
