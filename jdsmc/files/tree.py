"""A pytree of dictionaries, lists, numbers and NumPy arrays in an HDF5 file, without pickle."""

import json
from typing import Any

import h5py
import numpy as np

PLAIN = (bool, int, float, str, type(None))


def write(group: h5py.Group, tree: Any) -> None:
    """Put a tree into an empty group: its structure as text, its arrays with checksums."""
    arrays: list[np.ndarray] = []
    group.attrs["structure"] = np.bytes_(json.dumps(_flat(tree, arrays)))
    for number, array in enumerate(arrays):
        chunked = {"fletcher32": True, "chunks": True} if array.size else {}
        group.create_dataset(str(number), data=np.atleast_1d(array), **chunked)


def read(group: Any) -> Any:
    """The tree that `write` put there."""
    return _built(json.loads(bytes(group.attrs["structure"])), group)


def _flat(tree: Any, arrays: list) -> Any:
    if isinstance(tree, np.ndarray):
        arrays.append(tree)
        return {"array": len(arrays) - 1, "shape": tree.shape}
    if isinstance(tree, np.generic):
        return _flat(np.asarray(tree), arrays)
    if isinstance(tree, dict):
        return {"keys": list(tree), "values": [_flat(value, arrays) for value in tree.values()]}
    if isinstance(tree, list | tuple):
        return [_flat(value, arrays) for value in tree]
    if isinstance(tree, PLAIN):
        return tree
    raise TypeError(f"a {type(tree).__name__} cannot be kept in a file.")


def _built(text: Any, group: h5py.Group) -> Any:
    if isinstance(text, list):
        return [_built(value, group) for value in text]
    if not isinstance(text, dict):
        return text
    if "array" in text:
        return np.asarray(group[str(text["array"])]).reshape(text["shape"])
    return {
        key: _built(value, group) for key, value in zip(text["keys"], text["values"], strict=True)
    }
