"""A pytree of dictionaries, lists, numbers and NumPy arrays in an HDF5 file, without pickle.

All arrays of one kind stand one after the other in one dataset, with checksums: a long run has
thousands of them. The structure is text in another, as an attribute would be limited to 64 kB.
"""

import json
import math
from typing import Any

import h5py
import numpy as np

PLAIN = (bool, int, float, str, type(None))
STRUCTURE = "structure"


def write(group: h5py.Group, tree: Any) -> None:
    """Put a tree into an empty group; TypeError for what is neither plain nor an array."""
    flat = _Flat()
    text = json.dumps(flat.of(tree))
    put_text(group, STRUCTURE, text)
    for kind, parts in flat.arrays.items():
        _put(group, kind, np.concatenate([part.ravel() for part in parts]))


def read(group: Any) -> Any:
    """The tree that `write` put there."""
    flat = {kind: data[()] for kind, data in group.items() if kind != STRUCTURE}
    return _built(json.loads(get_text(group, STRUCTURE)), flat)


def put_text(group: h5py.Group, name: str, text: str) -> None:
    """Text of any length, as bytes."""
    _put(group, name, np.frombuffer(text.encode(), np.uint8))


def get_text(group: Any, name: str) -> str:
    """The text that `put_text` put there."""
    return group[name][()].tobytes().decode()


def _put(group: h5py.Group, name: str, values: np.ndarray) -> None:
    checked = {"fletcher32": True, "chunks": True} if values.size else {}
    group.create_dataset(name, data=values, **checked)


class _Flat:
    """Arrays by kind, and how many elements there are of each."""

    def __init__(self):
        self.arrays: dict[str, list[np.ndarray]] = {}
        self.sizes: dict[str, int] = {}

    def of(self, tree: Any) -> Any:
        """A tree as plain data, its arrays taken out."""
        if isinstance(tree, np.ndarray | np.generic):
            array = np.asarray(tree)
            kind = array.dtype.name
            first = self.sizes.get(kind, 0)
            self.arrays.setdefault(kind, []).append(array)
            self.sizes[kind] = first + array.size
            return {"array": kind, "first": first, "shape": array.shape}
        if isinstance(tree, dict):
            return {"keys": list(tree), "values": [self.of(value) for value in tree.values()]}
        if isinstance(tree, list | tuple):
            return [self.of(value) for value in tree]
        if isinstance(tree, PLAIN):
            return tree
        raise TypeError(f"a {type(tree).__name__} cannot be kept in a file.")


def _built(text: Any, flat: dict[str, np.ndarray]) -> Any:
    if isinstance(text, list):
        return [_built(value, flat) for value in text]
    if not isinstance(text, dict):
        return text
    if "array" in text:
        shape, first = text["shape"], text["first"]
        return flat[text["array"]][first : first + math.prod(shape)].reshape(shape)
    return {
        key: _built(value, flat) for key, value in zip(text["keys"], text["values"], strict=True)
    }
