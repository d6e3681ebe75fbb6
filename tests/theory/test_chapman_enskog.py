"""First-order distributions: their fluxes balance as exact moments of the Boltzmann equation."""

from math import pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose

from jdsmc.theory.chapman_enskog import heat_flux_expansion, stress_expansion
from jdsmc.theory.cooling_expansion import solve_cooling
from jdsmc.theory.laguerre_basis import LaguerreBasis


def colliding_pairs(restitution):
    """c1, c2 before and after, shape (3, ...), and weights of dc1 dc2 ds (g.s)_+, s = sigma^.

    Nodes: both speeds by Gauss-Legendre, g from |c1 - c2| to c1 + c2, and s about g^, the z axis,
    by rules that are exact for the polynomials below; a common rotation is left out.
    """
    node, node_weight = np.polynomial.legendre.leggauss(48)
    reach = 5.5  # speeds up to 11, where exp(-4 c), the slowest decay, is below 1e-19
    short, short_weight = np.polynomial.legendre.leggauss(6)
    turn = 2 * pi * np.arange(5) / 5
    speed = reach * (1 + node)
    c1, c2, place, cosine, azimuth = np.ix_(speed, speed, short, (1 + short) / 2, turn)
    half_range = np.minimum(c1, c2)
    g = np.maximum(c1, c2) + half_range * place
    weights = [reach * node_weight] * 2 + [short_weight, short_weight / 2, np.full(5, 2 * pi / 5)]
    weight = np.einsum("a,b,c,d,e->abcde", *weights)
    # dc1 dc2 = 8 pi^2 c1^2 c2^2 dc1 dc2 d(cos), where c1 c2 d(cos) = g dg; the rate is g cosine.
    weight *= 8 * pi**2 * c1 * c2 * g * half_range * g * cosine

    along = (c1**2 - c2**2 - g**2) / (2 * g)  # c2 along g = c1 - c2
    across = np.sqrt(np.maximum(c2**2 - along**2, 0))
    sine = np.sqrt(1 - cosine**2)
    first = stacked(weight.shape, across, 0, along + g)
    second = stacked(weight.shape, across, 0, along)
    normal = stacked(weight.shape, sine * np.cos(azimuth), sine * np.sin(azimuth), cosine)
    kick = (1 + restitution) / 2 * g * cosine * normal
    return first, second, first - kick, second + kick, weight


def flux_production(pairs, cooling, response, rank):
    """The moment of L A with the flux psi = (c^2 - 5/2) c or [c c], A with coefficients `response`.

    That is -(sqrt(2) pi)^{-1} int f0(c1) A(c2) {sum of psi after - before} over collisions.
    """
    first, second, *after, weight = pairs
    basis = LaguerreBasis(len(response), rank, cooling.basis.theta)
    # Speeds vary along the first two axes only.
    square1, square2 = (np.sum(v[..., :1, :1, :1] ** 2, axis=0) for v in (first, second))
    density = cooling.distribution(square1) * np.tensordot(response, basis.values(square2), 1)
    lost, gained = (
        sum(flux_contraction(v, second, rank) for v in pair) for pair in ((first, second), after)
    )
    return np.sum(weight * density * (lost - gained)) / (sqrt(2) * pi)


def stacked(shape, *components):
    return np.stack([np.broadcast_to(component, shape) for component in components])


def flux_contraction(v, partner, rank):
    """psi(v) times the tensor of the partner: R_1 or R_2."""
    square, product = np.sum(v**2, axis=0), np.sum(v * partner, axis=0)
    if rank == 1:
        return (square - 2.5) * product
    return (3 * product**2 - square * np.sum(partner**2, axis=0)) / 2


@pytest.mark.parametrize("restitution", [0.4, 0.8])
def test_fluxes_balance_as_moments_of_the_boltzmann_equation(restitution):
    """Projections of (2.28), (2.30) and of the equation for C on S and D, as in (2.41), (2.42).

    These polynomials are no test functions of the expansion, and nothing of its integrals is used:
    the production - 2 zeta flux = -(15/4)(1 + 2 a2), - (3/2) zeta and 3 a2/2 for A', and
    the production - zeta/2 flux = -15/2 for C.
    """
    cooling, pairs = solve_cooling(restitution, 24), colliding_pairs(restitution)
    a2, rate = 4 / 15 * cooling.moment(2) - 1, cooling.rate
    responses = heat_flux_expansion(restitution, cooling)
    basis = LaguerreBasis(24, 1, cooling.basis.theta)
    # Left are the truncation at order 24, some 1e-7 of terms of order 5, and the cusp at c1 = c2.
    for name, growth, factor in (("conductivity", 2, 2), ("modified_conductivity", 1.5, 1.5)):
        flux = (basis.moments(2) - 2.5 * basis.moments(1)) @ responses[name]
        production = flux_production(pairs, cooling, responses[name], 1)
        assert_allclose(production - growth * rate * flux, -3.75 * (1 + factor * a2), rtol=1e-6)
    response = stress_expansion(restitution, cooling)
    flux = LaguerreBasis(24, 2, cooling.basis.theta).moments(2) @ response
    production = flux_production(pairs, cooling, response, 2)
    assert_allclose(production - rate / 2 * flux, -7.5, rtol=1e-6)
