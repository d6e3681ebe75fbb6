"""How fast a gas forgets: its linearised collision operator, by quadrature over pairs. On the host.

A distribution M (1 + Σ a_k ψ_k) about the Maxwellian M has da/dt = -R a by collisions, with
ψ_k = H(c) S_k(c²), c = V/√(2T), Sonine polynomials S_k of index α = rank + d/2 - 1 and H = 1, c_x
or c_x c_y of rank 0, 1 or 2. Any pair rate and collision rule; R is that of one order of
polynomials in the sense of Chapman and Cowling, `The Mathematical Theory of Non-Uniform Gases`,
chapter 9, whose viscosity and conductivity are inverses of R.
"""

from functools import reduce
from math import pi
from typing import NamedTuple

import numpy as np
import scipy
from scipy.special import genlaguerre, roots_genlaguerre

from ..units import INITIAL_TEMPERATURE
from . import local
from .hard_spheres import ElasticHardSpheres, InelasticHardSpheres

ORDERS = {0: (2, 3), 1: (1, 2), 2: (0, 1)}
"""Sonine polynomials of each rank: the first two that no conservation law holds at zero."""

CENTRES, ANGLES, AZIMUTHS = 7, 7, 7
"""Nodes for the centre of mass of a pair: exact for polynomials of c up to degree 12."""

SPEEDS, DIRECTIONS = 16, 8
"""Nodes for the relative speed (1e-4 for powers of it) and for the direction after a collision."""

ELASTIC_DECAY = 8.0 / (5.0 * np.sqrt(pi))
"""Decay rate (1/τ0) of the stress of elastic hard spheres at T0, in first approximation."""

HIGHEST = 200.0
"""Powers of the speed up to which the tail of a distribution is looked for."""


class Relaxation(NamedTuple):
    """R (1/τ0), and what stretching all velocities does to the a_k: da/dt = rate · `stretch` a."""

    collisions: np.ndarray
    stretch: np.ndarray

    def slowest(self, cooling_rate: float = 0.0) -> float:
        """Least decay rate of c held at its temperature, with ζ of the cooling gas (1/τ0).

        Negative if a disturbance grows beside the cooling Maxwellian.
        """
        modes = np.linalg.eigvals(self.collisions - 0.5 * cooling_rate * self.stretch)
        return float(np.min(modes.real))


def relaxation(gas, temperature: float, rank: int) -> Relaxation:
    """R of one gas at T (m v0²), by functions of one rank: 0 isotropic, 1 heat flux, 2 stress."""
    dimension, orders = gas.dimension, ORDERS[rank]
    weights, before, after, speeds = _pairs(gas, temperature)
    rates = np.broadcast_to(np.asarray(gas.rate(speeds), dtype=float), speeds.shape)
    index = rank + 0.5 * dimension - 1.0
    coefficients = [np.asarray(genlaguerre(k, index).coef)[::-1] for k in orders]

    def sonine(velocity) -> np.ndarray:
        square = np.sum(velocity * velocity, axis=0)
        return np.stack([sum(a * square**n for n, a in enumerate(one)) for one in coefficients])

    polynomials = [sonine(c) for c in before]
    found = np.zeros((len(orders), len(orders)))
    for sign, ends in ((1.0, after), (-1.0, before)):
        for end in ends:
            later = sonine(end)
            for start, earlier in zip(before, polynomials, strict=True):
                angular = sign * weights * rates * _angular(start, end, rank)
                found += np.einsum("ln,kn,n->kl", earlier, later, angular)
    own = weights * _angular(before[0], before[0], rank)
    norms = np.einsum("kn,n->k", polynomials[0] ** 2, own)
    collisions = -found / norms[:, None] / (2.0 * np.sqrt(2.0))
    stretch = np.diag([float(rank + 2 * k) for k in orders])
    for row in range(1, len(orders)):
        lower = -2.0 * (orders[row] + index) * norms[row - 1] / norms[row]
        stretch[row, row - 1] = lower
    return Relaxation(collisions, stretch)


def mean_free_paths(gas, temperature: float) -> float:
    """Mean free paths of a gas in one λ0 at T (m v0²), by the decay of its stress.

    1 for elastic hard spheres, f for a gas that collides f times as often: what matters to layers
    and to diffusion across a slab, whose rules are made for hard spheres: 1 for all of these.
    """
    if isinstance(gas, InelasticHardSpheres | ElasticHardSpheres):
        return 1.0
    decay = float(relaxation(gas, temperature, 2).collisions[0, 0])
    return max(decay, 0.0) / (ELASTIC_DECAY * np.sqrt(temperature / INITIAL_TEMPERATURE))


def tail_exponent(gas, exponent: float) -> float:
    """Largest p for which a freely cooling gas of a pair rate ∝ g^γ can have averages of c^p.

    Infinite for γ > 0, where fast particles collide more. For γ = 0 stretching wins over collisions
    with slow partners from the p on at which λ_p = p ζ/2, λ_p = rate ⟨1 - |v'|^p - |w'|^p⟩ for a
    particle of speed 1 (Ernst and Brito, J. Stat. Phys. 109, 407 (2002), section 5): a tail of
    that power. For γ < 0 nothing holds the fast particles of a gas that cools: 2.
    """
    if exponent > 0 or not gas.energy_loss_rate(INITIAL_TEMPERATURE) > 0:
        return np.inf
    if exponent < 0:
        return 2.0
    cosine, weights = local.directions(gas.dimension)
    _, transfer = local.transfers_of(gas, np.ones(1), cosine)
    along, across = (t[0] for t in transfer[:2])
    first, second = np.hypot(1.0 - along, across), np.hypot(along, across)

    def excess(power: float) -> float:
        lost = np.sum(weights * (1.0 - first**power - second**power))
        least = np.sum(weights * (1.0 - first**2 - second**2))
        return float(lost - 0.5 * power * least)

    powers = np.geomspace(2.01, HIGHEST, 200)
    below = [p for p in powers if excess(p) <= 0]
    if not below:
        return np.inf
    if below[0] == powers[0]:
        return 2.0
    return float(scipy.optimize.root_scalar(excess, bracket=(2.01, below[0]), xtol=1e-3).root)


class _Grid(NamedTuple):
    """Pairs of a Maxwellian before and after a collision: velocities c of shape (d, pairs)."""

    weights: np.ndarray
    before: tuple[np.ndarray, np.ndarray]
    after: tuple[np.ndarray, np.ndarray]
    speeds: np.ndarray


def _pairs(gas, temperature: float) -> _Grid:
    """All combinations of nodes: of g along x, of the direction after, and of the centre of mass.

    Weights sum to one.
    """
    dimension, unit = gas.dimension, np.sqrt(2.0 * temperature)
    speed, speed_weight = local.relative_speeds(temperature, dimension, SPEEDS)
    cosine, cosine_weight = local.directions(dimension, DIRECTIONS)
    square, centre_weight = roots_genlaguerre(CENTRES, 0.5 * dimension - 1.0)
    if dimension == 3:
        inclined, angle_weight = np.polynomial.legendre.leggauss(ANGLES)
        upwards, turned = np.sqrt(1.0 - inclined**2), 2.0 * pi * np.arange(AZIMUTHS) / AZIMUTHS
    else:
        angle = pi * (np.arange(2 * ANGLES) + 0.5) / ANGLES
        inclined, upwards, angle_weight = np.cos(angle), np.sin(angle), np.ones(2 * ANGLES)
        turned = np.array([0.0, pi])
    each = speed_weight, cosine_weight, np.ones(turned.size), centre_weight, angle_weight
    weights = reduce(np.multiply.outer, each)
    i, j, k, m, n = np.unravel_index(np.arange(weights.size), weights.shape)
    along, across = (t[i, j] / unit for t in local.transfers_of(gas, speed, cosine)[1][:2])
    exchanged = np.stack([along, across * np.cos(turned)[k], across * np.sin(turned)[k]])
    centre = np.sqrt(0.5 * square)[m]
    middle = np.stack([centre * inclined[n], centre * upwards[n], 0.0 * centre])
    half = np.stack([0.5 * speed[i] / unit, 0.0 * centre, 0.0 * centre])
    first, second, exchanged = (x[:dimension] for x in (middle + half, middle - half, exchanged))
    after = first - exchanged, second + exchanged
    return _Grid(np.ravel(weights) / np.sum(weights), (first, second), after, speed[i])


def _angular(one: np.ndarray, other: np.ndarray, rank: int) -> np.ndarray:
    """H(c) H(c') averaged over rotations of both, up to a factor."""
    if rank == 0:
        return np.ones(one.shape[1])
    product = np.sum(one * other, axis=0)
    if rank == 1:
        return product
    squares = np.sum(one * one, axis=0) * np.sum(other * other, axis=0)
    return product**2 - squares / one.shape[0]
