"""Sweeps: every array among a scene's numbers is a dimension; the run covers their product.

Numbers are found by their full path (`gas.restitution`), so that two of the same name stay two. A
field made by `fields.number(axes=1)` is a vector of the physics, and swept only if it has two axes.
"""

import dataclasses
import hashlib
from typing import Any

import equinox as eqx
import jax
import numpy as np

from .fields import held


def is_number(leaf) -> bool:
    """True of the traced leaves of a scene: numbers and arrays, not names."""
    kinds = np.ndarray | np.number | jax.Array | float | int
    return isinstance(leaf, kinds) and not isinstance(leaf, bool)


def numbers(scene) -> dict[str, np.ndarray]:
    """The physical numbers of a scene by their path, in field order."""
    return {path: np.asarray(leaf) for path, leaf in _leaves(scene)}


def _leaves(scene) -> list[tuple[str, Any]]:
    found = jax.tree_util.tree_flatten_with_path(eqx.filter(scene, is_number))[0]
    return [(path_of(path), leaf) for path, leaf in found]


def path_of(keys) -> str:
    """The path of a leaf as a string, from the keys that JAX gives."""
    return ".".join(_step(key) for key in keys)


def _step(key) -> str:
    if isinstance(key, jax.tree_util.GetAttrKey):
        return key.name
    if isinstance(key, jax.tree_util.SequenceKey):
        return str(key.idx)
    return str(key.key) if isinstance(key, jax.tree_util.DictKey) else str(key)


def facts(scene, path: str) -> dict:
    """What the nearest field on a path says of itself (see `fields`)."""
    here, known = scene, {}
    for step in path.split("."):
        if dataclasses.is_dataclass(here):
            field, here = {f.name: (f, value) for f, value in held(here)}[step]
            known = dict(field.metadata)
        else:
            here = here[step] if isinstance(here, dict) else here[int(step)]
    return known


def labels(scene) -> dict[str, str]:
    """A short name for every path: its last step, or the whole path where that is not unique."""
    paths = list(numbers(scene))
    lasts = [path.split(".")[-1] for path in paths]
    return {
        path: last if lasts.count(last) == 1 else path.replace(".", "_")
        for path, last in zip(paths, lasts, strict=True)
    }


def parameters(scene) -> dict[str, np.ndarray]:
    """The physical numbers of a scene by their short names."""
    short = labels(scene)
    return {short[path]: value for path, value in numbers(scene).items()}


def swept_paths(scene) -> dict[str, np.ndarray]:
    """The swept numbers by path: those with one axis more than their physics has.

    ValueError for a value that is there twice: equal points have equal random numbers, and would
    pass for independent ones.
    """
    swept = {
        path: value
        for path, value in numbers(scene).items()
        if value.ndim > facts(scene, path).get("axes", 0)
    }
    for path, value in swept.items():
        seen = value.astype(np.float32)  # as `fingerprint` has them
        _, first, often = np.unique(seen, axis=0, return_index=True, return_counts=True)
        if np.any(often > 1):
            twice = value[first[np.argmax(often)]]
            raise ValueError(
                f"{path.split('.')[-1]} = {twice} is there twice; points of a sweep must differ, "
                "by more than the digits of float32: for more statistics take n_realizations, or "
                "another seed."
            )
    return swept


def dimensions(scene) -> dict[str, np.ndarray]:
    """The swept parameters: short name and values."""
    short = labels(scene)
    return {short[path]: value for path, value in swept_paths(scene).items()}


def points(scene) -> tuple[list, tuple[int, ...]]:
    """The scene at every point of its sweep, numbers being scalars; and the shape of the sweep."""
    swept = swept_paths(scene)
    shape = tuple(len(values) for values in swept.values())
    order = list(swept)

    def at(index):
        def pick(path, leaf):
            name = path_of(path)
            value = np.asarray(leaf, dtype=float)
            return value[index[order.index(name)]] if name in swept else value[()]

        return eqx.combine(jax.tree_util.tree_map_with_path(pick, chosen), rest)

    chosen, rest = eqx.partition(scene, is_number)
    return [at(index) for index in np.ndindex(*shape)], shape


def stack(scenes: list):
    """One scene whose numbers have a first axis, from scenes of single points."""
    split = [eqx.partition(scene, is_number) for scene in scenes]
    stacked = jax.tree.map(lambda *leaves: np.stack(leaves), *(part for part, _ in split))
    return eqx.combine(stacked, split[0][1])


def fingerprint(scene) -> tuple[int, int]:
    """Two words that depend on the class and values of one point, and on nothing else.

    Values count as float32, so that 0.7 and the 0.7000000000000001 of a range are the same.
    """
    names = [type(scene).__qualname__, type(scene.gas).__qualname__, repr(statics(scene))]
    digest = hashlib.blake2b("|".join(names).encode(), digest_size=8)
    for path, value in numbers(scene).items():
        digest.update(path.encode() + np.asarray(value, dtype="<f4").tobytes())
    words = np.frombuffer(digest.digest(), dtype="<u4")
    return int(words[0]), int(words[1])


def statics(module, prefix: str = "") -> dict[str, Any]:
    """Everything of a scene that is no number, by path: switches, sizes, names."""
    found: dict[str, Any] = {}
    for field, value in held(module):
        path = prefix + field.name
        if dataclasses.is_dataclass(value):
            found |= statics(value, path + ".")
        elif field.metadata.get("static", False) or not _holds_numbers(value):
            found[path] = value
    return found


def _holds_numbers(value) -> bool:
    return any(is_number(leaf) for leaf in jax.tree.leaves(value))
