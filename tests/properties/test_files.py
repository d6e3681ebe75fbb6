"""Whatever a result may hold comes back from its file to the bit; whatever is cut is refused."""

import warnings

import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import jdsmc
from jdsmc.files import seal
from jdsmc.results import Result

from .effort import cases

NAMES = st.from_regex(r"[a-z][a-z0-9_]{0,8}", fullmatch=True)
TEXTS = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=30)
KINDS = st.sampled_from(["f8", "f4", "i8", "i4", "u1", "b1"])
SIZES = arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4)
ATTRIBUTES = st.one_of(
    TEXTS,
    st.integers(-(2**63), 2**63 - 1),
    st.floats(),
    arrays.arrays("f8", st.integers(2, 20)),
)


@st.composite
def datasets(draw, group, attrs):
    """Arrays of any kind and shape, along axes of their own."""
    found = {}
    for name in draw(st.lists(NAMES, max_size=3, unique=True)):
        shape = draw(SIZES)
        values = draw(st.one_of(arrays.arrays(draw(KINDS), shape), labels(shape)))
        axes = tuple(f"{group}_{name}_axis_{k}" for k in range(len(shape)))
        described = draw(st.dictionaries(st.sampled_from(["long_name", "symbol"]), TEXTS))
        found[name] = (axes, values, described)
    return xr.Dataset(found, attrs=attrs)


def labels(shape):
    """Names, as of gases."""
    length = shape[0] if len(shape) else 1
    return arrays.arrays(
        object, (length,) if len(shape) == 1 else shape, elements=TEXTS, fill=TEXTS
    )


@st.composite
def trees(draw):
    """A result of any content."""
    attrs = draw(st.dictionaries(NAMES, ATTRIBUTES, max_size=5))
    attrs |= {"jdsmc_version": "0.1.0", "swept": ""}
    groups = {"/": draw(datasets("root", attrs))}
    for name in draw(st.sets(st.sampled_from(["series", "distribution", "left_out"]))):
        groups[f"/{name}"] = draw(datasets(name, {}))
    return xr.DataTree.from_dict(groups)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """One folder for all cases."""
    return tmp_path_factory.mktemp("files")


@cases(1000, 25)
@given(trees(), st.data())
def test_saved_and_loaded(folder, tree, data):
    """Without a warning; and no longer, once a byte is another or the end is cut."""
    path = Result(tree).save(folder / "x.h5", overwrite=True)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = jdsmc.load(path).to_xarray()
    xr.testing.assert_identical(again, tree)
    for one, other in zip(again.subtree, tree.subtree, strict=True):
        for name, values in other.to_dataset(inherit=False).variables.items():
            kinds = {one[str(name)].dtype.kind, values.dtype.kind}
            assert len(kinds) == 1 or kinds == {"O", "U"} or not values.size, name
    written = path.read_bytes()
    place = data.draw(st.integers(0, len(written) - seal.LENGTH - 1), label="place")
    flipped = bytes([written[place] ^ 1 << data.draw(st.integers(0, 7), label="bit")])
    for broken in (written[:place] + flipped + written[place + 1 :], written[:place]):
        path.write_bytes(broken)
        with pytest.raises(ValueError, match=r"was changed|can be read"):
            jdsmc.load(path)
    path.unlink()
    assert not list(folder.iterdir())
