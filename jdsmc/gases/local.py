"""Local equilibrium of any gas, by quadrature over pairs of a Maxwellian. On the host.

The relative speed g of two particles at temperature T (m = 1) has the density
∝ g^{d-1} exp(-g²/4T). N particles of a homogeneous gas collide, per pair, at `rate`/(√2 N).
"""

import math

import numpy as np
from scipy.special import gamma

from ..units import INITIAL_TEMPERATURE

NODES, FASTEST = 64, 8.0
"""Speeds, up to 8 √(4T) (a share of e^{-64} is beyond): 1e-12 for any smooth function of g, 1e-6 or
better for a power of it."""

DIRECTIONS = 33
"""Impact parameters, by Gauss-Legendre; exact for polynomials, to 1e-6 for rough ones."""

ROUNDING = 1e-6
"""Share of the energy that a gas which computes in float32 may seem to lose by rounding."""

PROBES = np.geomspace(1e-9, 1e4, 27)
"""Relative speeds (v0) at which a power law is looked for: a gas that cools for long has slow ones
only."""

TEMPERATURES = INITIAL_TEMPERATURE * np.geomspace(1e-6, 1e6, 25)
"""Temperatures (m v0²) at which a gas is asked whether it loses energy."""


def relative_speeds(temperature, dimension: int, number: int = NODES):
    """Speeds of shape (..., nodes) for temperatures of shape (...), and weights that sum to one.

    With x = g/√(4T) the weight is 2 x^{d-1} e^{-x²}/Γ(d/2); Gauss-Legendre in x takes rates that
    are odd or even in g alike (hard spheres, Maxwell molecules).
    """
    nodes, weights = np.polynomial.legendre.leggauss(number)
    nodes, weights = 0.5 * FASTEST * (1.0 + nodes), 0.5 * FASTEST * weights
    speeds = 2.0 * np.sqrt(np.asarray(temperature, dtype=float)[..., None]) * nodes
    density = 2.0 * nodes ** (dimension - 1) * np.exp(-(nodes**2)) / gamma(0.5 * dimension)
    return speeds, weights * density


def mean_over_pairs(gas, function, temperature):
    """Average of a function of the relative speed over pairs of a Maxwellian at T."""
    speeds, weights = relative_speeds(temperature, gas.dimension)
    values = np.broadcast_to(np.asarray(function(speeds), dtype=float), speeds.shape)
    return np.sum(values * weights, axis=-1)


def collision_rate(gas, temperature):
    """Collisions per particle and time: half of ⟨rate⟩/√2, since two particles share each."""
    return mean_over_pairs(gas, gas.rate, temperature) / (2.0 * math.sqrt(2.0))


def energy_loss_rate(gas, temperature):
    """Energy lost per particle and time; exactly zero if it is within rounding of that."""

    def loss(speeds):
        return np.asarray(gas.rate(speeds), dtype=float) * energy_lost(gas, speeds)

    def all_of_it(speeds):
        return np.asarray(gas.rate(speeds), dtype=float) * speeds**2 / 4.0

    lost, most = (mean_over_pairs(gas, f, temperature) for f in (loss, all_of_it))
    return np.where(np.abs(lost) > ROUNDING * most, lost, 0.0) / (2.0 * math.sqrt(2.0))


def energy_lost(gas, speeds) -> np.ndarray:
    """Mean kinetic energy (m v0²) that a pair of a relative speed loses in one collision.

    With a transfer t the loss is t·(g - t), averaged over the impact parameters of hard spheres
    (d = 3: outgoing directions of uniform cosine) or disks (uniform sine of the impact angle).
    """
    cosine, weights = directions(gas.dimension)
    relative, transfer = transfers_of(gas, speeds, cosine)
    pieces = [t * (g - t) for t, g in zip(transfer, relative, strict=True)]
    return np.sum(sum(pieces) * weights, axis=-1)


def directions(dimension: int, number: int = DIRECTIONS) -> tuple[np.ndarray, np.ndarray]:
    """Cosines of the angle by which an elastic collision turns g, and weights that sum to one."""
    nodes, weights = np.polynomial.legendre.leggauss(number)
    return (nodes if dimension == 3 else 2.0 * nodes**2 - 1.0), 0.5 * weights


def transfers_of(gas, speeds, cosine):
    """Relative velocities along x and what the gas transfers: components (speeds, directions)."""
    speed, cosine = np.broadcast_arrays(np.asarray(speeds, dtype=float)[..., None], cosine)
    zero = np.zeros_like(speed)
    rest = (zero,) * (gas.dimension - 2)
    outgoing = (speed * cosine, speed * np.sqrt(np.maximum(1.0 - cosine**2, 0.0)), *rest)
    relative = (speed, zero, *rest)
    transfer = gas.momentum_transfer(relative, outgoing)
    return relative, [np.broadcast_to(np.asarray(t, dtype=float), speed.shape) for t in transfer]


def speed_exponent(gas) -> float | None:
    """The exponent of a rate that is a power of the speed, if the transfer is linear in speed."""
    with np.errstate(over="ignore", under="ignore"):
        rates = np.broadcast_to(np.asarray(gas.rate(PROBES), dtype=float), PROBES.shape)
    if not np.all((rates > 0) & np.isfinite(rates)):
        return None
    exponents = np.diff(np.log(rates)) / np.diff(np.log(PROBES))
    if np.ptp(exponents) > 1e-4:  # float32 rounding over the smallest ratio of two probes: 1e-6
        return None
    shares = _transfer_shares(gas)
    if not np.max(np.abs(shares - shares[0])) < 1e-5:  # not a number, neither
        return None
    return float(np.round(np.mean(exponents), 5))


def transfers(gas, share) -> bool:
    """True if the transfer is `share` of g - g' for every pair, as far as float32 can tell."""
    cosine = np.cos(np.array([0.3, 1.1, 2.0, 2.9]))
    relative, transfer = transfers_of(gas, PROBES, cosine)
    across = PROBES[:, None] * np.sqrt(1.0 - cosine**2)
    change = [
        relative[0] - PROBES[:, None] * cosine,
        -across,
        *(0.0 * across for _ in transfer[2:]),
    ]
    off = [t - share * c for t, c in zip(transfer, change, strict=True)]
    return bool(np.max(np.abs(off) / PROBES[:, None]) < 1e-5)


def _transfer_shares(gas) -> np.ndarray:
    """Transfer over speed for a few directions, at every probed speed: (speeds, numbers)."""
    _, transfer = transfers_of(gas, PROBES, np.cos(np.array([0.3, 1.1, 2.0, 2.9])))
    return np.concatenate([t / PROBES[:, None] for t in transfer], axis=1)
