r"""Laguerre functions of the velocity: a basis that holds exponential tails.

With l = 0, 1, 2 the rank of the tensor that a function multiplies, and theta a squared width,

    phi_k(c^2) = N_k exp(-c^2/theta) L_k^{(l+1/2)}(2 c^2/theta),    k = 0, 1, ..., order - 1,

where N_k makes int_0^inf x^{l+1/2} phi_k^2 dx = 1 in x = 2 c^2/theta. They are orthogonal *without*
any weight besides the volume element: what is square integrable, an exponential tail for
instance, has a convergent expansion. The Sonine functions exp(-c^2) L_k(c^2) span the same space
when theta = 1, but projecting on polynomials needs int f^2 exp(+c^2) dc, which an exponential tail
makes infinite. That is why the plain Sonine series of a granular gas diverges.

Velocities are in units of v0 = sqrt(2T/m), in three dimensions.
"""

from dataclasses import dataclass
from math import gamma, pi, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.special import roots_genlaguerre

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LaguerreBasis:
    """phi_k of the module docstring: `order` functions for tensors of `rank`, width^2 `theta`."""

    order: int
    rank: int
    theta: float

    def values(self, square: Floats) -> Floats:
        """phi_k at c^2 = `square`, any shape; shape (order, *shape). Stable recurrence in k."""
        x = 2 * square / self.theta
        upper = self.rank + 0.5
        functions = np.empty((self.order, *x.shape))
        before, here = np.zeros_like(x), np.exp(-x / 2) / sqrt(gamma(upper + 1))
        for k in range(self.order):
            functions[k] = here
            rise = (2 * k + 1 + upper - x) * here - sqrt(k * (k + upper)) * before
            before, here = here, rise / sqrt((k + 1) * (k + 1 + upper))
        return functions

    def slopes(self, square: Floats) -> Floats:
        """c^2 dphi_k/d(c^2), shaped as `values`; from x L_k' = k L_k - (k + l + 1/2) L_{k-1}."""
        functions = self.values(square)
        degree = np.arange(self.order).reshape(-1, *[1] * square.ndim)
        slopes = (degree - square / self.theta) * functions
        descent = np.sqrt(degree * (degree + self.rank + 0.5))
        slopes[1:] -= descent[1:] * functions[:-1]
        return slopes

    def moments(self, power: int) -> Floats:
        """int c^{2 power} phi_k dc over all velocities, shape (order,)."""
        square, weight = radial_rule(self.order + power, self.theta)
        return self.values(square) @ (weight * square**power)

    def marginals(self, component: Floats) -> Floats:
        """int d^2c_perp phi_k `axial_harmonic` at c_z = `component`, shape (order, points)."""
        transverse, weight = transverse_rule(self.order + self.rank, self.theta)
        square = transverse[:, None] + component**2
        harmonic = axial_harmonic(self.rank, transverse[:, None], component)
        return np.einsum("v,kvp->kp", weight, self.values(square) * harmonic)


def axial_harmonic(rank: int, transverse: Floats, component: Floats) -> Floats:
    """|c|^l P_l(c_z/|c|), that is 1, c_z or c_z^2 - c_perp^2/2, from c_perp^2 and c_z."""
    if rank == 0:
        return np.ones(np.broadcast_shapes(transverse.shape, component.shape))
    return component + 0 * transverse if rank == 1 else component**2 - transverse / 2


def radial_rule(nodes: int, theta: float) -> tuple[Floats, Floats]:
    """c^2 and weights of int dc over all velocities, for exp(-c^2/theta) times polynomials in c^2.

    Exact to degree 2 nodes - 1 of the polynomial. The exponential belongs to the integrand, not to
    the weights.
    """
    t, weight = roots_genlaguerre(nodes, 0.5)
    return t * theta, weight * np.exp(t) * theta**1.5 * 2 * pi


def transverse_rule(nodes: int, theta: float) -> tuple[Floats, Floats]:
    """c_perp^2 and weights of int d^2c_perp; otherwise as `radial_rule`."""
    t, weight = roots_genlaguerre(nodes, 0.0)
    return t * theta, weight * np.exp(t) * theta * pi
