"""Navier-Stokes coefficients from pairs of a cooling gas: its linearised generator, solved.

First-order distributions are sought as f0 Σ_l c_l φ_l, with the Sonine functions about T0

    φ_k = V_x L_k^{(3/2)}(c²) of the heat flux,   φ_k = V_x V_y L_k^{(5/2)}(c²) of the stress.

Collisions of sampled pairs give B_kl = (1/2√2) E[g Δφ_k (φ_l(1) + φ_l(2))], particles give
G_kl = ⟨φ_k φ_l⟩, and V·∂φ_k/∂V = Σ_j D_kj φ_j is known. The equations of docs/impulse_response.md,
(Λ + shift) f1 = source with Λ = L + (ζ/2) ∂/∂V·V, become

    [-B - (ζ/2) D G + shift G] c = s,   s_k = ⟨K·∂φ_k/∂V⟩,

K being the displacement that makes each source there: κ' has the shift 0, κ -ζ/2, η +ζ/2. The heat
flux carries no momentum: φ_0 is taken out of the trial functions, and the mean out of K.
"""

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..theory.transport import elastic_viscosity
from ..types import Particles, Scalar, Velocity
from ..units import CONDUCTIVITY

ORDER = 4
"""Functions of either kind."""

Matrix = Float[Array, "order order"]


class Generator(eqx.Module):
    """Sums over particles and pairs: B and G of both kinds, and `loss`, energy lost per time.

    `radial` (3, order): ⟨L_k^{(3/2)}⟩, ⟨V² L_k^{(3/2)}⟩ and ⟨V² L_k^{(5/2)}⟩.
    """

    heat_change: Matrix
    heat_overlap: Matrix
    stress_change: Matrix
    stress_overlap: Matrix
    radial: Float[Array, "3 order"]
    loss: Scalar


def laguerre(square, upper: float) -> list:
    """L_k^{(upper)} of k = 0 ... ORDER - 1 at c² = `square`."""
    before, here = jnp.zeros_like(square), jnp.ones_like(square)
    found = []
    for k in range(ORDER):
        found.append(here)
        after = ((2 * k + 1 + upper - square) * here - (k + upper) * before) / (k + 1)
        before, here = here, after
    return found


def functions(velocity: Particles) -> tuple[Array, Array]:
    """Heat and stress functions (order, 3 n) of particles at T0, for three directions each."""
    x, y, z = (v.reshape(-1) for v in velocity)
    square = x * x + y * y + z * z
    kinds = []
    for parts, upper in (((x, y, z), 1.5), ((x * y, y * z, z * x), 2.5)):
        whole = jnp.concatenate(parts)
        kinds.append(jnp.stack([whole * jnp.tile(f, 3) for f in laguerre(square, upper)]))
    return kinds[0], kinds[1]


def generator(
    velocity: Velocity, left: Particles, right: Particles, rate, transfers: tuple[Particles, ...]
) -> Generator:
    """Sums over the particles of a sample at T0 and over pairs of them.

    Arguments: pairs, the `rate` of each (collisions per particle and time, over the pairs), and
    what they transfer in equally likely collisions.
    """
    own = functions(velocity)
    before = [a + b for a, b in zip(functions(left), functions(right), strict=True)]
    after, loss = [jnp.zeros_like(f) for f in before], jnp.zeros_like(rate)
    share = 1.0 / len(transfers)
    for transfer in transfers:
        sides = [
            functions(tuple(v + sign * t for v, t in zip(side, transfer, strict=True)))
            for side, sign in ((left, -1.0), (right, 1.0))
        ]
        after = [f + share * (a + b) for f, a, b in zip(after, *sides, strict=True)]
        parts = zip(transfer, left, right, strict=True)
        loss = loss + share * sum(t * (a - b - t) for t, a, b in parts)
    weight = jnp.tile(rate.reshape(-1), 3)
    changes = [(weight * (b - a)) @ a.T / weight.size for a, b in zip(before, after, strict=True)]
    overlaps = [f @ f.T / f.shape[1] for f in own]
    square = sum(v * v for v in velocity)
    slow, fast = laguerre(square, 1.5), laguerre(square, 2.5)
    radial = [
        [jnp.mean(f) for f in slow],
        *([jnp.mean(square * f) for f in g] for g in (slow, fast)),
    ]
    return Generator(
        *(changes[0], overlaps[0], changes[1], overlaps[1]),
        jnp.stack([jnp.stack(row) for row in radial]),
        jnp.mean(rate * loss),
    )


def coefficients(means: dict, order: int = ORDER) -> dict[str, Any]:
    """Coefficients over the elastic first Sonine ones, from `Generator` by its names (..., ).

    κ/κ0, κ'/κ0, nμ/(Tκ0) = 2 (κ - κ')/κ0 (2.38), and η/η0, with `order` functions.
    """
    zeta = np.asarray(means["loss"])[..., None, None] / 0.75
    first, second, fourth = np.moveaxis(means["radial"][..., :order], -2, 0)
    # the heat flux
    change, overlap = (means[f"heat_{n}"][..., :order, :order] for n in ("change", "overlap"))
    share = overlap[..., :1, :] / overlap[..., :1, :1]
    change = (change - change[..., :, :1] * share)[..., 1:, 1:]
    rates = _scaling(order, 1)
    reduced = overlap - overlap[..., :, :1] * share
    flow = 0.5 * zeta * (rates @ reduced)[..., 1:, 1:]
    reduced = reduced[..., 1:, 1:]
    slopes = np.eye(order) + (rates - np.eye(order)) / 3.0  # of ∂φ_k/∂V_x, over directions

    def heat(along, along_square, by, shift):
        """Of the displacement (along + along_square V²) x̂ + by V_x V."""
        along = along - (along + 1.5 * along_square + 0.5 * by)
        source = (
            along * first @ slopes.T
            + along_square * second @ slopes.T
            + by / 3.0 * second @ rates.T
        )
        return _first(-change - flow + shift * reduced, reduced, source[..., 1:]) / CONDUCTIVITY

    modified = heat(0.25, 0.0, -0.5, 0.0)
    plain = heat(0.5, -0.25, -0.25, -0.5 * zeta)
    # the stress
    change, overlap = (means[f"stress_{n}"][..., :order, :order] for n in ("change", "overlap"))
    rates = _scaling(order, 2)
    source = -(fourth / 3.0 + fourth @ (rates - 2.0 * np.eye(order)).T / 15.0)
    matrix = -change - 0.5 * zeta * (rates @ overlap) + 0.5 * zeta * overlap
    return {
        "conductivity": plain,
        "modified_conductivity": modified,
        "density_coefficient": 2.0 * (plain - modified),
        "viscosity": -_first(matrix, overlap, source) / elastic_viscosity(),
    }


def _scaling(order: int, rank: int) -> np.ndarray:
    """D: V·∂φ_k/∂V = (rank + 2k) φ_k - 2 (k + rank + 1/2) φ_{k-1}."""
    k = np.arange(order)
    return np.diag(rank + 2.0 * k) - np.diag(2.0 * (k[1:] + rank + 0.5), -1)


def _first(matrix, overlap, source) -> Any:
    """The first moment of the response."""
    found = np.linalg.solve(matrix, source[..., None])
    return (overlap[..., :1, :] @ found)[..., 0, 0]
