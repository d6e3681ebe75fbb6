"""Sweeps: every array among a scene's numbers is a dimension; the run covers their product."""

import equinox as eqx
import jax
import numpy as np


def is_number(leaf) -> bool:
    """True of the traced leaves of a scene: arrays of NumPy or JAX, not names or switches."""
    return isinstance(leaf, np.ndarray | jax.Array)


def parameters(scene) -> dict[str, np.ndarray]:
    """The physical numbers of a scene by field name, in field order (gas first)."""
    numbers, _ = eqx.partition(scene, is_number)
    leaves = jax.tree_util.tree_flatten_with_path(numbers)[0]
    return {path[-1].name: np.asarray(leaf) for path, leaf in leaves}


def dimensions(scene) -> dict[str, np.ndarray]:
    """The swept parameters: name and values of every one-dimensional number."""
    return {name: value for name, value in parameters(scene).items() if value.ndim == 1}


def flatten(scene):
    """The scene with every number expanded to one value for each point of the sweep.

    Returns: scene whose leaves have shape (points,), and the shape of the sweep.
    """
    swept = dimensions(scene)
    shape = tuple(len(values) for values in swept.values())
    mesh = dict(zip(swept, np.meshgrid(*swept.values(), indexing="ij"), strict=True))
    numbers, rest = eqx.partition(scene, is_number)
    points = int(np.prod(shape))

    def expand(path, leaf):
        name = path[-1].name
        return mesh[name].ravel() if name in mesh else np.full(points, float(leaf))

    return eqx.combine(jax.tree_util.tree_map_with_path(expand, numbers), rest), shape


def take(scene, index):
    """The scene with every number indexed: `take(flat, (slice(None), None))` adds an axis."""
    numbers, rest = eqx.partition(scene, is_number)
    return eqx.combine(jax.tree.map(lambda leaf: leaf[index], numbers), rest)
