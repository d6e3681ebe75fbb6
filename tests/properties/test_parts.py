"""Whatever is cut over processes, kept in a file or merged comes back whole, or is refused."""

import functools
import io
from unittest import mock

import h5py
import jax
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import jdsmc
from jdsmc.files import tree
from jdsmc.running import hosts

from .effort import cases, refused
from .test_bad_input import is_sentence

KINDS = st.sampled_from(["f8", "f4", "i8", "i4", "u4", "u1", "b1"])
SHAPES = arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=3)
ARRAYS = arrays.arrays(KINDS, SHAPES)
LEAVES = st.one_of(
    *(ARRAYS, st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5)),
)
TREES = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text(max_size=4), inner, max_size=3)
    ),
    max_leaves=8,
)


def same(one, other) -> bool:
    """True if plain data agree to the bit, kinds and signs of zero included."""
    if isinstance(one, dict | list):
        if type(one) is not type(other) or len(one) != len(other):
            return False
        if isinstance(one, list):
            return all(map(same, one, other))
        return list(one) == list(other) and all(same(one[name], other[name]) for name in one)
    if isinstance(one, np.ndarray):
        alike = isinstance(other, np.ndarray) and one.dtype == other.dtype
        return alike and one.shape == other.shape and one.tobytes() == other.tobytes()
    return type(one) is type(other) and (repr(one) == repr(other))


@cases(1500, 30)
@given(TREES)
def test_a_state_in_a_checkpoint(state):
    """Plain data and arrays of any kind and shape are read as they were written."""
    content = io.BytesIO()
    with h5py.File(content, "w") as file:
        tree.write(file, state)
    with h5py.File(content, "r") as file:
        assert same(state, tree.read(file))


@cases(1500, 30)
@given(st.data(), st.integers(1, 9), st.integers(1, 9))
def test_gases_cut_over_processes(data, total, count):
    """Every process has all parts in order, to the bit, whatever their numbers."""
    kinds = data.draw(st.lists(st.tuples(KINDS, SHAPES), min_size=1, max_size=3))
    parts = [[data.draw(arrays.arrays(kind, shape)) for kind, shape in kinds] for _ in range(total)]
    sent = []
    with mock.patch.object(jax, "process_count", lambda: count):

        def of(rank, gathered):
            with (
                mock.patch.object(jax, "process_index", lambda: rank),
                mock.patch.object(hosts, "_gathered", gathered),
            ):
                return hosts.everywhere([parts[n] for n in hosts.own(total)], total)

        for rank in range(count):
            of(rank, lambda text: sent.append(text) or [text] * count)
        for rank in range(count):
            assert same(parts, of(rank, lambda text: sent))


@functools.cache
def one_run(restitution: float, seed: int, realizations: int) -> jdsmc.Result:
    """A small run; there are few of them."""
    scene = jdsmc.scenarios.HomogeneousCooling(jdsmc.InelasticHardSpheres(restitution))
    return jdsmc.run(
        scene,
        seed=seed,
        n_realizations=realizations,
        **{"collisions": 4.0, "n_particles": 64, "progress": False},
    )


RUNS = st.tuples(st.sampled_from([0.8, 0.9]), st.integers(1, 3), st.sampled_from([8, 12]))


@cases(400, 12)
@given(st.lists(RUNS, min_size=1, max_size=4), st.randoms())
def test_runs_merged(asked, order):
    """Refused, or every realization counts once, in whatever order they came."""
    runs, points = [one_run(*one) for one in asked], [one[:2] for one in asked]
    try:
        merged = jdsmc.merge(runs)
    except ValueError as error:
        assert is_sentence(error)
        refused(error)
        return
    assert len(set(points)) == len(points)
    again = jdsmc.merge(order.sample(runs, len(runs)))
    if len({alpha for alpha, _ in points}) == 1:
        assert merged.attrs["n_realizations"] == sum(many for _, _, many in asked)
        length = merged.series.sizes["sample"]
        each = [one.series["temperature"].values[:length] for one in runs]
        whole = np.average(each, axis=0, weights=[many for _, _, many in asked])
        for one in (merged, again):  # sums of four numbers of order one, in another order
            np.testing.assert_allclose(one.series["temperature"], whole, rtol=1e-14)
        return
    assert set(np.atleast_1d(merged.attrs["seed"])) == {seed for _, seed in points}
    for one, (alpha, _) in zip(runs, points, strict=True):
        for part in (merged, again):
            found = part.at(restitution=alpha).series["temperature"].values
            np.testing.assert_array_equal(found, one.series["temperature"].values[: len(found)])


def test_what_differs_is_seen():
    """Else the properties above could not fail."""
    assert same({"a": np.float32(1) * np.ones(2, "f4")}, {"a": np.ones(2, "f4")})
    for other in (1, 1.0, True, "1", [1], np.ones(1), np.ones((), "f4"), None):
        assert not same(np.ones(()), other)
    assert not same(-0.0, 0.0) and not same([1, 2], [2, 1]) and not same({"a": 1}, {"b": 1})


@pytest.mark.parametrize("bad", [object(), {1, 2}, 1j])
def test_what_a_checkpoint_cannot_keep(bad):
    with h5py.File(io.BytesIO(), "w") as file, pytest.raises(TypeError, match="cannot be kept"):
        tree.write(file, [bad])
