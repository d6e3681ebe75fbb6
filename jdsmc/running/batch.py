"""What both engines share: arrays of a batch, and the cores they may use."""

import os

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


def cores() -> int:
    """Cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
