r"""Sonine approximations of any order for elastic hard spheres in three dimensions.

Source of the problem: Montanero, Santos and Garzo, Physica A 376, 75 (2007), Eqs. (2.28), (2.44)
and (2.45) at alpha = 1; the bracket integrals are derived here. The first-order distribution is

    A(V)    = lambda f_M(V) c sum_{k>=1} b_k L_k^{(3/2)}(c^2),             heat flux, rank r = 1
    C_ij(V) = (lambda/v0) f_M(V) [c c]_ij sum_{k>=0} c_k L_k^{(5/2)}(c^2), stress,    rank r = 2

where L_k are Laguerre (Sonine) polynomials, [..] is the traceless part and (2.44) is read with the
factors c and lambda that its Eq. (A.1) has. Let Phi_k = L_k(c^2) times c or [c c]. The moments of
(2.28) with Phi_k read, when the sum is cut off,

    sum_l M_kl b_l = (15/4) delta_k1,    M_kl = (lambda/v0) int Phi_k . L(f_M Phi_l) dc / n.

Let a colliding pair have c1 = (C + w)/sqrt(2), c2 = (C - w)/sqrt(2), and S_k = Phi_k(c1) +
Phi_k(c2). A collision of elastic spheres leaves C and w = |w| and makes the direction of w
isotropic. Its rate is n pi sigma^2 sqrt(2) w v0 = (v0/lambda) w. The bracket therefore is a
covariance over that direction,

    M_kl = (1/2) <w (<S_k . S_l>_dir - <S_k>_dir . <S_l>_dir)>,

with <..> over the Maxwellian of C and w, and <S_k>_dir along C (or [C C]). With R_r(a, b) = |a|^r
|b|^r P_r(a^.b^), P_r the Legendre polynomials, Phi_k(c1) . Phi_l(c2) = L_k L_l R_r(c1, c2) up to a
constant. What is averaged is w times a polynomial in C^2, w^2 and the squared cosine of the
angle between them: Gauss rules give it exactly, but for rounding.
"""

from math import sqrt
from operator import index

import numpy as np
from numpy.typing import NDArray
from scipy.special import eval_genlaguerre, roots_genlaguerre

from ..units import CONVERGED_ORDER

Floats = NDArray[np.float64]
HIGHEST_ORDER = 30  # checked for rounding up to here


def conductivity_ratio(order: int) -> float:
    """kappa over its first Sonine approximation kappa0 (2.47), from `order` Sonine polynomials.

    ValueError unless `order` is an integer in 1 ... 30. Increases with it to 1.025218.
    """
    return float(_solution(order, rank=1)[0] / _solution(1, rank=1)[0])


def viscosity_ratio(order: int) -> float:
    """eta over its first Sonine approximation, from `order` Sonine polynomials.

    ValueError unless `order` is an integer in 1 ... 30. Increases with it to 1.016034.
    """
    return float(_solution(order, rank=2)[0] / _solution(1, rank=2)[0])


def sonine_coefficients(order: int) -> Floats:
    """b_1, ..., b_order of Eq. (2.44) at alpha = 1, where b_k = b'_k; shape (order,).

    From `order` Sonine polynomials, in the units of the paper's Eq. (3.10), eps* = lambda eps.
    ValueError unless `order` is an integer in 1 ... 30. b_1 = 15 sqrt(pi)/16 at order 1.
    """
    return 15 / 4 * _solution(order, rank=1)


def sonine_ratios(order: int) -> Floats:
    """b_k / b_1 for k = 1, ..., order: `sonine_coefficients` over its first; shape (order,)."""
    coefficients = sonine_coefficients(order)
    return coefficients / coefficients[0]


def bracket_matrix(order: int, rank: int) -> Floats:
    """M_kl of the module docstring, shape (order, order), symmetric and positive definite.

    `rank` 1 is the heat flux, with k, l = 1 ... order; `rank` 2 the stress, with k, l = 0 ...
    order - 1 and Phi_k . Phi_l counted as R_2, that is 3/2 times the product of the tensors.
    ValueError unless `order` is an integer in 1 ... 30 and `rank` 1 or 2.
    """
    order = _checked_order(order)
    if rank not in (1, 2):
        raise ValueError(f"rank must be 1 (heat flux) or 2 (stress), got {rank!r}.")
    centre, relative, cosine, weight = _pair_rule(order)
    overlap = np.sqrt(centre * relative) * cosine
    square1 = (centre + relative) / 2 + overlap  # c1^2
    square2 = (centre + relative) / 2 - overlap  # c2^2
    degrees = np.arange(order) + (2 - rank)
    sonine1, sonine2 = (
        np.stack([eval_genlaguerre(k, rank + 0.5, square) for k in degrees])
        for square in (square1, square2)
    )
    # R_r of c1 with itself, with c2, and with the unit vector along C.
    alone = square1**rank
    mixed = _solid_legendre(rank, (centre - relative) / 2, square1 * square2)
    along = _solid_legendre(rank, (np.sqrt(centre) + np.sqrt(relative) * cosine) / sqrt(2), square1)

    fluctuating = np.einsum("kxyz,lxyz,xyz->kl", sonine1, alone * sonine1, weight)
    fluctuating += np.einsum("kxyz,lxyz,xyz->kl", sonine1, mixed * sonine2, weight)
    direction = weight.sum(axis=2)
    mean = 2 * np.einsum("kxyz,xyz->kxy", sonine1 * along, weight) / direction
    return fluctuating - np.einsum("kxy,lxy,xy->kl", mean, mean, direction) / 2


def _solution(order: int, rank: int) -> Floats:
    """M^{-1} applied to the first unit vector, shape (order,)."""
    matrix = bracket_matrix(order, rank)
    return np.linalg.solve(matrix, np.eye(len(matrix))[0])


def _solid_legendre(rank: int, product: Floats, squares: Floats) -> Floats:
    """R_r of two vectors from their scalar product and the product of their squares."""
    return product if rank == 1 else (3 * product**2 - squares) / 2


def _pair_rule(order: int) -> tuple[Floats, Floats, Floats, Floats]:
    """Gauss rule over C^2, w^2 and the cosine between C and w; weights include the rate w.

    Returns C^2, w^2 and the cosine, which broadcast to the shape (k, k, k) of the weights. Phi_k
    is of degree 2 order + 1 in the velocities at most, products of two of them therefore of degree
    2 order + 1 in C^2, w^2 and the cosine, where k nodes suffice up to 2 k - 1.
    """
    nodes = order + 2
    centre, centre_weight = roots_genlaguerre(nodes, 0.5)  # C^2 exp(-C^2) dC
    relative, relative_weight = roots_genlaguerre(nodes, 1.0)  # w^2 w exp(-w^2) dw
    cosine, cosine_weight = np.polynomial.legendre.leggauss(nodes)
    # Norms of C^2 exp(-C^2) and w^2 exp(-w^2), sqrt(pi)/2 each in the rules' variables; cosine: 2.
    scale = 1 / (sqrt(np.pi) / 2) ** 2 / 2
    weight = scale * np.einsum("x,y,z->xyz", centre_weight, relative_weight, cosine_weight)
    return centre[:, None, None], relative[None, :, None], cosine[None, None, :], weight


def _checked_order(order: int) -> int:
    try:
        value = index(order)
    except TypeError:
        value = 0
    if not 1 <= value <= HIGHEST_ORDER:
        raise ValueError(f"order must be an integer in 1 ... {HIGHEST_ORDER}, got {order!r}.")
    return value


def converged(name: str) -> float:
    """An elastic coefficient by its name in `transport.navier_stokes`, converged in the order."""
    if name == "density_coefficient":
        return 0.0
    return (viscosity_ratio if name == "viscosity" else conductivity_ratio)(CONVERGED_ORDER)
