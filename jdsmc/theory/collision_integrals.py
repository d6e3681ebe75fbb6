r"""Collision integrals of inelastic hard spheres between Laguerre functions, by exact Gauss rules.

Units: n = v0 = lambda = 1, so that n sigma^2 = 1/(sqrt(2) pi); phi_k from `laguerre_basis`. In a
collision c1' = c1 - (1+alpha)/2 (g.s) s, s = sigma^ with g.s > 0, and for any tensor psi

    int psi(c) J[f, h] dc = (sqrt(2) pi)^{-1} int dc1 dc2 f(c1) h(c2)
                            int ds (g.s)_+ {psi(c1') - psi(c1)}.

Turn the frame so that s lies along z: int ds becomes 4 pi, and the average over all rotations of
a product of two tensors of rank l is R_l(a, b) = |a|^l |b|^l P_l(a^.b^). With x, y the z
components of c1 and c2, u and v their squared transverse parts, and q = (1-alpha)/2,

    c1' has the components z = q x + (1-q) y along s and the same transverse part as c1.

So the six velocities reduce to x, y, u, v, and v, of which c1' knows nothing, enters through the
marginals of h alone. Terms without a change of velocity (loss) are the case q = 1. The integrand is
a polynomial times exp(-(x^2 + y^2 + z^2 + 2u)/theta): with g = x - y and the h that makes the
exponent a sum of squares, Gauss-Hermite (h), Gauss-Laguerre (g^2) and Gauss-Laguerre (u) rules are
exact. (Only even powers of g survive the integral over h.)
"""

from math import pi, sqrt

import numpy as np
from scipy.special import roots_genlaguerre, roots_hermite

from .laguerre_basis import Floats, LaguerreBasis, axial_harmonic, transverse_rule

RATE = 4 * pi / (sqrt(2) * pi)
CHUNK = 2_000_000  # doubles in the largest temporary array


def cooling_tensor(basis: LaguerreBasis, restitution: float) -> Floats:
    """T_kij = int phi_k J[phi_i, phi_j] dc for a `basis` of rank 0, shape (order, order, order)."""
    return _scattered_tensor(basis, (1 - restitution) / 2) - _scattered_tensor(basis, 1.0)


def linear_operator(
    basis: LaguerreBasis, restitution: float, cooling_basis: LaguerreBasis, cooling: Floats
) -> Floats:
    """Matrix of L f1 = -J[f0, f1] - J[f1, f0] for f1 = phi_i times a tensor of rank l = 1 or 2.

    Rows are projections on phi_k times the same tensor, contracted to R_l: shape (order, order).
    f0 has the coefficients `cooling` in `cooling_basis`, of rank 0 and the same theta.
    """
    arguments = basis, cooling_basis, cooling
    gain = _scattered_matrix((1 - restitution) / 2, *arguments)
    return _scattered_matrix(1.0, *arguments) - gain


def loss_of_energy(basis: LaguerreBasis) -> Floats:
    """Z_ij with zeta = (1 - alpha^2) sum_ij Z_ij a_i a_j for f0 = sum_i a_i phi_i (rank 0).

    A pair loses (1-alpha^2) (g.s)^2/2 of c1^2 + c2^2, and <c^2> = 3/2: Z = (sqrt(2)/3) <(x-y)_+^3>
    with the marginals of x and y. Exact, symmetric, shape (order, order).
    """
    nodes = 2 * basis.order + 2
    h, h_weight = roots_hermite(nodes)
    t, t_weight = roots_genlaguerre(nodes // 2, 1.0)  # t = g^2/(2 theta), dg g^3 = 2 theta^2 t dt
    centre = sqrt(basis.theta / 2) * h[:, None]
    relative = np.sqrt(2 * basis.theta * t)
    first = basis.marginals((centre + relative / 2).ravel())
    second = basis.marginals((centre - relative / 2).ravel())
    weight = np.outer(h_weight * np.exp(h**2), t_weight * np.exp(t)).ravel()
    weight *= sqrt(basis.theta / 2) * 2 * basis.theta**2 * sqrt(2) / 3
    product = (first * weight) @ second.T
    return (product + product.T) / 2


def _scattered_tensor(basis: LaguerreBasis, persistence: float) -> Floats:
    """RATE int (x-y)_+ phi_k(c1') phi_i(c1) phi_j(c2), with c1' by q = `persistence`."""
    x, y, z, weight = _pair_rule(basis, persistence)
    transverse, transverse_weight = transverse_rule(basis.order, basis.theta / 2)
    u = transverse[:, None]
    tensor = np.zeros((basis.order**2, basis.order))
    for part in _parts(len(x), basis.order * max(basis.order, len(u))):
        before = basis.values(u + x[part] ** 2) * transverse_weight[:, None]
        after = basis.values(u + z[part] ** 2)
        pairs = np.matmul(after.transpose(2, 0, 1), before.transpose(2, 1, 0))
        partner = basis.marginals(y[part]) * weight[part]
        tensor += pairs.reshape(len(partner.T), -1).T @ partner.T
    return RATE * tensor.reshape(3 * (basis.order,))


def _scattered_matrix(
    persistence: float, basis: LaguerreBasis, cooling_basis: LaguerreBasis, cooling: Floats
) -> Floats:
    """RATE int (x-y)_+ phi_k(c1') {phi_i(c1) f0(c2) R_l(c1', c1) + f0(c1) phi_i(c2) R_l(c1', c2)}.

    In the second term R_l(c1', c2) averages over the azimuth of c2 to the product of the harmonics
    of c1' and c2 about z (addition theorem).
    """
    x, y, z, weight = _pair_rule(basis, persistence)
    transverse, transverse_weight = transverse_rule(basis.order + basis.rank, basis.theta / 2)
    u = transverse[:, None]
    matrix = np.zeros((basis.order, basis.order))
    for part in _parts(len(x), basis.order * len(u)):
        before, after = u + x[part] ** 2, u + z[part] ** 2
        test = basis.values(after) * transverse_weight[:, None]
        product = u + x[part] * z[part]
        contraction = product if basis.rank == 1 else (3 * product**2 - before * after) / 2
        background = (cooling @ cooling_basis.marginals(y[part])) * weight[part]
        trial = basis.values(before) * (contraction * background)
        matrix += test.reshape(basis.order, -1) @ trial.reshape(basis.order, -1).T

        partner = np.tensordot(cooling, cooling_basis.values(before), 1)
        turned = np.einsum("kup,up->kp", test, partner * axial_harmonic(basis.rank, u, z[part]))
        matrix += turned @ (basis.marginals(y[part]) * weight[part]).T
    return RATE * matrix


def _pair_rule(basis: LaguerreBasis, persistence: float) -> tuple[Floats, Floats, Floats, Floats]:
    """x, y, z = q x + (1-q) y and the weights of int dx dy (x-y)_+, each of shape (points,).

    x = h + a g, y = h + (a-1) g, z = h + e g. The sum of squares has no term h g if the three
    factors of g add up to nothing: a = (2-q)/3.
    """
    highest = 3 * basis.order + basis.rank
    a = (2 - persistence) / 3
    b, e = a - 1, a - (1 - persistence)
    h, h_weight = roots_hermite(highest)
    t, t_weight = roots_genlaguerre(highest // 2 + 1, 0.0)
    narrow, slope = sqrt(basis.theta / 3), basis.theta / (a**2 + b**2 + e**2)  # g^2 = slope t
    centre = narrow * h[:, None]
    relative = np.sqrt(slope * t)
    weight = np.outer(h_weight * np.exp(h**2) * narrow, t_weight * np.exp(t) * slope / 2)
    x, y, z = ((centre + factor * relative).ravel() for factor in (a, b, e))
    return x, y, z, weight.ravel()


def _parts(points: int, doubles_per_point: int) -> list[slice]:
    """Slices of the points that keep temporary arrays near CHUNK doubles."""
    size = max(1, CHUNK // doubles_per_point)
    return [slice(start, start + size) for start in range(0, points, size)]
