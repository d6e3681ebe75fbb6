"""What is put into a file as a tree comes back as it was."""

import h5py
import numpy as np
import pytest

from jdsmc.files import tree


def test_there_and_back(tmp_path):
    """Kinds, shapes and bits, empty arrays, names that are no identifiers, more than 64 kB of
    structure."""
    rng = np.random.default_rng(1)
    given = {
        "many": [rng.normal(size=k % 5) for k in range(3000)],
        "kinds": {"a": np.float32(1 / 3), "b": np.arange(6, dtype=np.uint32).reshape(2, 3)},
        "truth": np.array([True, False]),
        "complex": np.array([1 + 2j]),
        "plain": [None, True, 3, 0.1, "a/b", float("inf")],
        "nan": np.array([np.nan, -0.0]),
        "empty": np.empty((0, 4)),
    }
    with h5py.File(tmp_path / "tree.h5", "w") as file:
        tree.write(file.create_group("state"), given)
    with h5py.File(tmp_path / "tree.h5") as file:
        found = tree.read(file["state"])
    assert found["plain"] == given["plain"]
    pairs = [*zip(given["many"], found["many"], strict=True)]
    pairs += [(given[n], found[n]) for n in ("truth", "complex", "nan", "empty")]
    pairs += [(given["kinds"][n], found["kinds"][n]) for n in "ab"]
    for one, other in [(np.asarray(before), after) for before, after in pairs]:
        assert one.dtype == other.dtype and one.shape == other.shape
        assert one.tobytes() == other.tobytes()


def test_objects_are_refused(tmp_path):
    with h5py.File(tmp_path / "tree.h5", "w") as file, pytest.raises(TypeError, match="set"):
        tree.write(file, {"a": {1, 2}})
