r"""The homogeneous cooling state as a Galerkin expansion in Laguerre functions.

Eq. (2.8) of Montanero, Santos and Garzo, Physica A 376, 75 (2007), in units n = v0 = lambda = 1:

    (zeta/2) d/dc.(c f0) = J[f0, f0],    int f0 dc = 1,    int c^2 f0 dc = 3/2.

With f0 = sum_i a_i phi_i(c^2), the projections on phi_k are

    sum_ij T_kij a_i a_j + zeta sum_i D_ki a_i = 0,    D_ki = int phi_i c^2 dphi_k/d(c^2) dc,

and zeta = (1 - alpha^2) sum_ij Z_ij a_i a_j is the loss of energy of the same expansion, so that
number and energy are balanced exactly. The two norms take the place of the last two projections.
Newton's method, started from the Maxwellian.
"""

from dataclasses import dataclass

import numpy as np

from .collision_integrals import cooling_tensor, loss_of_energy
from .laguerre_basis import Floats, LaguerreBasis, radial_rule

TOLERANCE = 1e-11  # of the last Newton step; coefficients are of order 1
MOST_STEPS = 20


@dataclass(frozen=True)
class CoolingExpansion:
    """f0 = sum of `coefficients` times the functions of `basis`; `rate` is zeta tau."""

    basis: LaguerreBasis
    coefficients: Floats
    rate: float

    def moment(self, power: int) -> float:
        """<c^{2 power}>."""
        return float(self.coefficients @ self.basis.moments(power))

    def distribution(self, square: Floats) -> Floats:
        """f0 at c^2 = `square`, any shape."""
        return np.tensordot(self.coefficients, self.basis.values(square), 1)


def squared_width(restitution: float) -> float:
    """theta of the basis: tails grow as alpha falls. Found by trial; results do not depend on it.

    At order 24 the sixth digit is stable between 0.8 and 1 at alpha = 1, 1 and 1.3 at alpha = 0.3.
    """
    return 1.4 - 0.6 * restitution


def solve_cooling(restitution: float, order: int) -> CoolingExpansion:
    """The cooling state from `order` functions. RuntimeError if Newton's method does not converge.

    Not restricted to `restitution` <= 1: derivatives at 1 use points on both sides.
    """
    return _solved(restitution, order, heated=False)


def solve_heated(restitution: float, order: int) -> CoolingExpansion:
    """The steady state under white noise, as `solve_cooling`: van Noije and Ernst (1998).

    J[f, f] + (xi^2/2) d^2f/dc^2 = 0 with xi^2 = zeta/2 at T = 1/2, so that D_ki becomes
    -int c^2 dphi_i/d(c^2) dphi_k/d(c^2) dc.
    """
    return _solved(restitution, order, heated=True)


def _solved(restitution: float, order: int, *, heated: bool) -> CoolingExpansion:
    """Newton's method for what either drive, the dilation or the noise, balances."""
    basis = LaguerreBasis(order, 0, squared_width(restitution))
    tensor = cooling_tensor(basis, restitution)
    loss = (1 - restitution**2) * loss_of_energy(basis)
    square, weight = radial_rule(order + 1, basis.theta / 2)
    values = basis.values(square)
    slopes = basis.slopes(square) * weight
    drive = -(slopes / square) @ basis.slopes(square).T if heated else slopes @ values.T
    norms = np.stack([basis.moments(0), basis.moments(1)])
    maxwellian = np.exp(-square) / np.pi**1.5
    a = np.linalg.solve((values * weight) @ values.T, (values * weight) @ maxwellian)
    for _ in range(MOST_STEPS):
        rate = a @ loss @ a
        first, second = tensor @ a, np.einsum("kij,i->kj", tensor, a)
        residual = (first + rate * drive) @ a
        slope = first + second + rate * drive + 2 * np.outer(drive @ a, loss @ a)
        step = np.linalg.solve(
            np.vstack([slope[:-2], norms]),
            np.concatenate([residual[:-2], norms @ a - [1.0, 1.5]]),
        )
        a = a - step
        if np.abs(step).max() < TOLERANCE:
            return CoolingExpansion(basis, a, float(a @ loss @ a))
    raise RuntimeError(
        f"the distribution at restitution = {restitution}, order = {order} did not converge in "
        f"{MOST_STEPS} Newton steps; use an order of at least 12 and a restitution in [0.3, 1]."
    )
