r"""First-order Chapman-Enskog distributions of a granular gas, expanded in Laguerre functions.

Equation numbers: Montanero, Santos and Garzo, Physica A 376, 75 (2007). In units n = v0 = lambda =
1 (T/m = 1/2), with Lambda = L + (zeta/2) d/dc.c, docs/impulse_response.md arrives at

    (Lambda - zeta/2) A = A_source (2.28)        Lambda A' = A'_source (2.30)
    Lambda B = B_source + zeta A   (2.29)        (Lambda + zeta/2) C = C_source,

and writes each source as -d/dc.(G f0) with a displacement field G. The unknowns are sums of
phi_i(c^2) c (rank 1) or phi_i(c^2) [c c] (rank 2). All equations are projected on phi_k times the
same tensor and contracted to R_l = c^{2l}: 3 times an x component, 15 times an xy component of
c_x c_y. By parts the projection of a source is int f0 G.d/dc(phi_k c_x) dc. With p = phi_k, s = c^2
dphi_k/d(c^2) these are the averages over f0 of

    A:  (3/2 - c^2) p + (1 - c^2) s          A': (3/4 - c^2/2) p + (1/2 - c^2) s
    B:  (3/2 - c^2) p + s                    C:  -5 c^2 p - 2 c^2 s.

Momentum is conserved: int c A dc = 0, and the same for A' and B, takes the place of the last
projection of rank 1. Fluxes follow from (2.24), (2.25), (2.44) and (3.10):

    b_k = 2 Gamma(5/2) k!/Gamma(k + 5/2) int (c^2/3) L_k^{(3/2)}(c^2) A(c) dc,   kappa/kappa0 =
    16/(15 sqrt(pi)) b_1, b'_k and B likewise, eta/eta0 = -16/(5 sqrt(pi)) int (c^4/15) C(c) dc.
"""

from math import factorial, gamma, pi, sqrt

import numpy as np
from scipy.special import eval_genlaguerre

from .collision_integrals import linear_operator
from .cooling_expansion import CoolingExpansion
from .laguerre_basis import Floats, LaguerreBasis, radial_rule

SONINE_COUNT = 3


def heat_flux_response(
    restitution: float, cooling: CoolingExpansion, drag: float = 0.0
) -> dict[str, Floats]:
    """Coefficients of the heat flux over the elastic first Sonine ones, and b'_1, b'_2, b'_3.

    Keys as in `heat_flux_expansion`, and `sonine`, of shape (3,).
    """
    expansions = heat_flux_expansion(restitution, cooling, drag)
    sonine = _sonine_projection(LaguerreBasis(cooling.basis.order, 1, cooling.basis.theta))
    to_ratio = 16 / (15 * sqrt(pi))  # kappa/kappa0 over b_1, Eqs. (2.45) and (2.47)
    ratios = {name: to_ratio * (sonine[0] @ vector) for name, vector in expansions.items()}
    return {**ratios, "sonine": sonine @ expansions["modified_conductivity"]}


def stress_response(restitution: float, cooling: CoolingExpansion, drag: float = 0.0) -> float:
    """eta over the elastic first Sonine viscosity."""
    basis = LaguerreBasis(cooling.basis.order, 2, cooling.basis.theta)
    flux = basis.moments(2) / 15 @ stress_expansion(restitution, cooling, drag)
    return float(-16 / (5 * sqrt(pi)) * flux)


def heat_flux_expansion(
    restitution: float, cooling: CoolingExpansion, drag: float = 0.0
) -> dict[str, Floats]:
    """Coefficients of A', A and B in functions of rank 1, each of shape (order,).

    Keys `modified_conductivity`, `conductivity` and `density_coefficient`, which they determine. B
    comes from its own equation, not from 2 (A - A'). `drag`: ζτ of a drag besides the collisions
    (`jdsmc.theory.frictional`): it changes T, hence the shifts, and drops out of Lambda.
    """
    basis = LaguerreBasis(cooling.basis.order, 1, cooling.basis.theta)
    operator, mass = _lambda_and_mass(restitution, cooling, basis)
    square, value, slope = _weighted_by_cooling(cooling, basis)
    source_a = value @ (1.5 - square) + slope @ (1 - square)
    source_b = value @ (1.5 - square) + slope.sum(axis=1)
    momentum = basis.moments(1)

    def solved(matrix: Floats, source: Floats) -> Floats:
        return np.linalg.solve(np.vstack([matrix[:-1], momentum]), np.append(source[:-1], 0.0))

    shift = cooling.rate + drag
    temperature = solved(operator - shift / 2 * mass, source_a)
    return {
        "modified_conductivity": solved(operator, source_a - source_b / 2),
        "conductivity": temperature,
        "density_coefficient": solved(operator, source_b + shift * mass @ temperature),
    }


def stress_expansion(restitution: float, cooling: CoolingExpansion, drag: float = 0.0) -> Floats:
    """Coefficients of C in functions of rank 2, shape (order,)."""
    basis = LaguerreBasis(cooling.basis.order, 2, cooling.basis.theta)
    operator, mass = _lambda_and_mass(restitution, cooling, basis)
    square, value, slope = _weighted_by_cooling(cooling, basis)
    source = -(5 * value + 2 * slope) @ square
    return np.linalg.solve(operator + (cooling.rate + drag) / 2 * mass, source)


def _lambda_and_mass(
    restitution: float, cooling: CoolingExpansion, basis: LaguerreBasis
) -> tuple[Floats, Floats]:
    """Lambda and int phi_k phi_i c^{2l} dc. By parts (zeta/2) d/dc.c is -(zeta/2) (2 s + l p)."""
    collisions = linear_operator(basis, restitution, cooling.basis, cooling.coefficients)
    square, weight = radial_rule(basis.order + basis.rank + 1, basis.theta / 2)
    values, contraction = basis.values(square), weight * square**basis.rank
    mass = (values * contraction) @ values.T
    drift = (2 * basis.slopes(square) * contraction) @ values.T + basis.rank * mass
    return collisions - cooling.rate / 2 * drift, mass


def _weighted_by_cooling(
    cooling: CoolingExpansion, basis: LaguerreBasis
) -> tuple[Floats, Floats, Floats]:
    """c^2 at nodes, and phi_k and its slope times f0 and the weights, both (order, nodes)."""
    square, weight = radial_rule(basis.order + 3, basis.theta / 2)
    measure = weight * cooling.distribution(square)
    return square, basis.values(square) * measure, basis.slopes(square) * measure


def _sonine_projection(basis: LaguerreBasis) -> Floats:
    """b_k of each phi_i c: shape (3, order)."""
    square, weight = radial_rule(basis.order + SONINE_COUNT, basis.theta)
    values = basis.values(square)
    return np.stack(
        [
            2
            * gamma(2.5)
            * (factorial(k) / gamma(k + 2.5))
            * (values @ (weight * square / 3 * eval_genlaguerre(k, 1.5, square)))
            for k in range(1, SONINE_COUNT + 1)
        ]
    )
