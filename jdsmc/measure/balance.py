"""The noise of collisions taken out of steady second moments, exactly.

ψ stands for the sums of v_x², v_y², v_z² and v_x v_y over the particles, m for their averages. Of
every candidate pair the expected change is known: it collides with the probability p, and then the
mean E[Δψ] over the directions of a collision follows from its relative velocity. So

    C = (1/N) Σ over candidate pairs (what ψ changed by - p E[Δψ | pair])

has the mean zero at any time, in any state, and m changes in a record by Δm = C + its drift, which
moments of the state itself tell: Δm - C ≈ A ∫m dt + b t. Whatever A is, Δm - C summed over a steady
run is zero in the mean but for Δm, which stays finite; so

    m* = ⟨m⟩ - A⁻¹ (Δm - C)/t

is as right as the time average ⟨m⟩, and free of the noise of collisions; through Δm it is also free
of what is left of a start, as far as this is linear. A and b are fitted to all records.

What is kept adds up over records, realizations, blocks and runs that are merged, as every average
does: for each record the eight numbers u = (∫m dt, Δm - C)/t (`balance`), and for a window the
products of u with its first four (`balance_squares`), of which the covariances give A. Nothing is
fitted before the observables are made: errors by leave-one-out know of the fit.

Within a record m is not measured. From one end to the other it goes in a straight line, but for the
noise of collisions, whose integral about such a line is summed in the steps (`path`).
"""

from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax
from jaxtyping import Array, Float

from ..collisions.meet import Candidates, Watch
from ..motion.drive import centred
from ..sums import mean, total
from ..types import Particles, Scalar, Velocity

FOUR = ((0, 0), (1, 1), (2, 2), (0, 1))
"""Components of the moments: xx, yy, zz, xy."""

NAMES = ("xx", "yy", "zz", "xy")

LEAST = 8
"""Records of a realization, or of a block of it, from which on the balance is used: fewer leave too
few, of eight realizations, to fit five numbers to."""


class Balance(eqx.Module):
    """Of a record, for xx, yy, zz, xy (v0²): the moments at its end; C; and the mean over time of
    C as it grows, less that of a straight line."""

    after: Float[Array, "4"]
    noise: Float[Array, "4"]
    path: Float[Array, "4"]


def noise_of(gas) -> Watch:
    """Sums over candidate pairs of what their moments changed by, less what was expected: (4,)."""

    def watch(met: Candidates) -> Float[Array, "4"]:
        relative = tuple(a - b for a, b in zip(met.left, met.right, strict=True))
        chance = jnp.minimum(met.probability, 1.0)
        changed = changes(met.transfer, relative)
        expected = mean_changes(gas, relative, met.outgoing)
        noise = [x - chance * e for x, e in zip(changed, expected, strict=True)]
        return jnp.stack([total(x) for x in lax.optimization_barrier(noise)])

    return watch


def changes(transfer: Particles, relative: Particles) -> list:
    """What v_a v_b of both particles changes by if the first gives this to the second."""
    t, g = transfer, relative
    return [2.0 * t[a] * t[b] - t[a] * g[b] - t[b] * g[a] for a, b in FOUR]


def mean_changes(gas, relative: Particles, outgoing: Particles) -> list:
    """Its mean over the directions of a collision.

    With the transfer s (g - g') of spheres, g' isotropic: 2 s (s-1) g_a g_b + (2/3) s² g² δ_ab. Any
    other transfer is averaged over six directions, ± those of a trihedron turned at random (one of
    them is `outgoing`): right in the mean for any, and exact for each pair if the transfer is
    linear in g'.
    """
    share = gas.transfer_share()
    if share is None:
        each = [changes(gas.momentum_transfer(relative, e), relative) for e in trihedron(outgoing)]
        return [sum(x) / 6.0 for x in zip(*each, strict=True)]
    square = sum(g * g for g in relative)
    isotropic = (2.0 / 3.0 * share * share) * square
    deviatoric = 2.0 * share * (share - 1.0)
    return [
        deviatoric * relative[a] * relative[b] + (isotropic if a == b else 0.0) for a, b in FOUR
    ]


def trihedron(first: Particles) -> list[Particles]:
    """A vector, two perpendicular to it and to each other, of its length; and their opposites."""
    x, y, z = lax.optimization_barrier(first)
    across = jnp.sqrt(x * x + y * y)
    length = jnp.sqrt(x * x + y * y + z * z)
    some = across > 0.0
    divisor = jnp.where(some, across, 1.0)
    cosine, sine = jnp.where(some, x / divisor, 1.0), jnp.where(some, y / divisor, 0.0)
    second = (z * cosine, z * sine, -across)
    third = (-length * sine, length * cosine, jnp.zeros_like(length))
    three = [(x, y, z), second, third]
    return three + [tuple(-v for v in one) for one in three]


def balance_of(
    noise: Float[Array, "steps 4"], durations: Float[Array, " steps"], velocity: Velocity
) -> Balance:
    """The balance of a record from the sums over the pairs of each step, and the velocities after.

    Collisions are in the middle of their step.
    """
    noise = noise / velocity[0].size
    elapsed = jnp.sum(durations)
    middle = (jnp.cumsum(durations) - 0.5 * durations) / elapsed
    after = jnp.stack(second_moments(centred(velocity)))
    return Balance(after, jnp.sum(noise, axis=0), jnp.sum((0.5 - middle)[:, None] * noise, axis=0))


def second_moments(velocity: Velocity) -> list[Scalar]:
    """⟨v_a v_b⟩, xx, yy, zz, xy."""
    return [mean(velocity[a] * velocity[b]) for a, b in FOUR]


# On the host, in float64.


def balances(m, balance: Balance, elapsed) -> dict[str, np.ndarray]:
    """The eight numbers of every record: arrays (..., 8) from its moments before, and so on."""
    before = np.stack([np.asarray(x) for x in (m.xx, m.yy, m.zz, m.xy)], axis=-1)
    middle = 0.5 * (before + balance.after) + balance.path
    drift = (balance.after - before - balance.noise) / np.asarray(elapsed)[..., None]
    return {"balance": np.concatenate([middle, drift], axis=-1)}


def squares(balance: np.ndarray, weights: np.ndarray) -> dict[str, np.ndarray]:
    """Of a window of records (realizations, records, 8): means of products, and their number."""
    share = weights / np.sum(weights, axis=1, keepdims=True)
    products = np.einsum("rn,rni,rnj->rij", share, balance, balance[..., :4])
    count = np.full(len(balance), float(balance.shape[1]))
    return {"balance_squares": products.reshape(len(balance), 32), "balance_records": count}


def without_noise(means: dict[str, Any]) -> dict[str, Any]:
    """Averages whose second moments and temperature are the m* of a window.

    As they are where there are no products: of single records. Leading axes of any shape.
    """
    rest = {name: x for name, x in means.items() if not name.startswith("balance")}
    if "balance_squares" not in means:
        return rest
    balance = means["balance"]
    moment, drift = balance[..., :4], balance[..., 4:]
    products = means["balance_squares"].reshape(*balance.shape, 4)
    spread = products - balance[..., :, None] * moment[..., None, :]
    enough = means["balance_records"] >= LEAST
    response = np.where(enough[..., None, None], spread[..., 4:, :], np.eye(4))
    # A = response spread⁻¹
    off = spread[..., :4, :] @ _solved(response, drift[..., None])
    steady = moment - off[..., 0]
    plain = np.stack([means[name] for name in NAMES], axis=-1)
    chosen = np.where(enough[..., None], steady, plain)
    seconds = {name: chosen[..., k] for k, name in enumerate(NAMES)}
    return rest | seconds | {"temperature": np.mean(chosen[..., :3], axis=-1)}


def _solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """The solution; where a moment never changes (no collisions), the one that leaves it alone.

    NaN where there is one in the matrix, of a point without steady values: the others stay.
    """
    known = np.all(np.isfinite(matrix), axis=(-2, -1), keepdims=True)
    matrix = np.where(known, matrix, np.eye(matrix.shape[-1]))
    try:
        found = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        found = np.linalg.pinv(matrix) @ right
    return np.where(known, found, np.nan)
