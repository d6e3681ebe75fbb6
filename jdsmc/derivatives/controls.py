"""Noise of sampled pairs taken out by what is known of them: in a steady state collisions undo the
flow.

C_k, the sampled collisional change of φ_k and the flow's together, is zero in the mean, at any
number of particles, and its noise is that of the pairs and particles of which all other sums are
made. So every sum is regressed on the C over all blocks of all realizations, and what follows from
the mean of C, which ought to be zero, is subtracted. Any quantity that is linear in the sums for
small noise then has the noise left that its own best regression leaves.
"""

import numpy as np

from ..scenarios.homogeneous import AbstractHomogeneous
from .response import drift_of
from .sampling import Sampler

BLOCKS_PER_CONTROL = 10
"""Fewer would fit noise: the error is understated by half of the inverse of this at most."""

HIGHEST = 4
"""Degree of the φ whose C are used: degree 6 gains nothing more."""

SMALLEST = 1e-6
"""Scatter of a C relative to its terms below which it is rounding: the energy where the
temperature is held. Momentum, of degree 1, is held always."""


def controlled(
    scene: AbstractHomogeneous,
    sampler: Sampler,
    means: dict[str, np.ndarray],
    weights: np.ndarray,
) -> dict[str, np.ndarray]:
    """The averages (realizations, blocks, ...) of a steady state with that noise taken out.

    Arguments: averages and the share of time of each block. As many C are used as there are blocks
    for, those of the lowest degrees.
    """
    known = imbalance(scene, sampler, means)
    most = weights.size // BLOCKS_PER_CONTROL
    scatter = np.std(known, axis=(0, 1))
    size = np.std(means["source"][..., :-1], axis=(0, 1)) + 1e-300
    degrees = np.array([sampler.symmetry.degree(powers) for powers in sampler.basis])
    used = (degrees > 1) & (degrees <= HIGHEST)
    kept = np.flatnonzero((scatter > SMALLEST * size) & used)[:most]
    # a block with one very fast particle would decide slopes alone: it counts less
    rare = np.mean((known / np.where(scatter > 0, scatter, 1.0)) ** 2, axis=-1)
    known = known[..., kept] / scatter[kept]
    share = np.sqrt(weights / np.mean(weights) / np.maximum(1.0, rare) ** 2)[..., None]
    own = share[..., 0] ** 2
    inverse = np.linalg.pinv((share * (known - _mean(known, own))).reshape(weights.size, -1))
    found = {}
    for name, values in means.items():
        flat = values.reshape(*weights.shape, -1)
        slopes = inverse @ (share * (flat - _mean(flat, own))).reshape(weights.size, -1)
        found[name] = (flat - known @ slopes).reshape(values.shape)
    return found


def _mean(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Over realizations and blocks."""
    return np.tensordot(weights, values, 2) / np.sum(weights)


def imbalance(scene: AbstractHomogeneous, sampler: Sampler, means: dict) -> np.ndarray:
    """C of every block: arrays (..., trial)."""
    moments, cubed = np.moveaxis(means["moments"], -1, 0), means["cubed"]
    trial = len(sampler.basis)
    source = np.moveaxis(means["source"], -1, 0)[:trial]
    whole = source + drift_of(scene, sampler, trial, moments, cubed)
    if sampler.held:
        squares = [sampler.rows.index(powers) for powers in sampler.symmetry.squares]
        pace = -0.5 * np.sum(whole[squares], axis=0) / np.sum(moments[squares], axis=0)
        degrees = np.array([sampler.symmetry.degree(powers) for powers in sampler.basis])
        whole = whole + pace * (moments[:trial].T * degrees).T
    return np.moveaxis(whole, 0, -1)
