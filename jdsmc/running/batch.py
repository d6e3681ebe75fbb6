"""Arrays of a batch: one point of the records of all."""

import jax
import numpy as np


def point_of(tree, point: int):
    """What a pytree of arrays (points, ...) holds of one point."""
    return jax.tree.map(lambda x: x[point], tree)


def gathered(parts: list, shape: tuple[int, int]):
    """Pytrees of arrays (gases, ...) of consecutive parts as one of (points, realizations, ...).

    Gases beyond the last (which fill a part up) are dropped.
    """
    count = shape[0] * shape[1]
    return jax.tree.map(
        lambda *arrays: np.concatenate(arrays)[:count].reshape(shape + arrays[0].shape[1:]), *parts
    )
