"""A result file is read as it was written, or refused with a sentence."""

import os
import re
import subprocess
import sys
import warnings

import h5py
import numpy as np
import pytest
import xarray as xr

import jdsmc
from jdsmc.files import seal
from jdsmc.results import Result, stored

ATTRS = {"jdsmc_version": "0.1.0", "scene": "UniformShear", "stopped": "all was done", "swept": ""}


def small() -> Result:
    """A result of a few numbers."""
    data = {"a2": 0.1, "a2_error": 0.01, "profile": ("z", np.arange(5.0))}
    series = xr.Dataset({"temperature": ("sample", [1.0, np.nan])})
    return Result(xr.DataTree.from_dict({"/": xr.Dataset(data, attrs=ATTRS), "/series": series}))


@pytest.fixture
def path(tmp_path):
    """The file of a small result."""
    return small().save(tmp_path / "x.h5")


def without_seal(path):
    """Cut the seal off, as a program does that opens an HDF5 file for writing."""
    path.write_bytes(path.read_bytes()[: -seal.LENGTH])
    return path


def test_what_is_loaded_is_what_was_saved(path):
    """Without a warning, and with the attributes that it had; the file tells its schema."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        xr.testing.assert_identical(jdsmc.load(path).to_xarray(), small().to_xarray())
    with h5py.File(path) as file:
        assert file.attrs["schema"] == stored.SCHEMA


def test_others_read_it(path):
    """The line of the README, and groups; the seal is no hindrance."""
    with xr.open_dataset(path) as data:
        assert data["a2"] == 0.1 and data.attrs["jdsmc_version"] == "0.1.0"
    with xr.open_datatree(path) as tree:
        assert tree["series/temperature"][0] == 1.0


def test_every_byte_flipped(path):
    """A change that is told before a library sees it; the mark of the seal is tested below."""
    length = path.stat().st_size
    mark = range(length - seal.LENGTH, length - seal.LENGTH + len(seal.MARK))
    with path.open("r+b", buffering=0) as file:

        def flip(place):
            (byte,) = os.pread(file.fileno(), 1, place)
            os.pwrite(file.fileno(), bytes([byte ^ 0x10]), place)

        for place in set(range(length)) - set(mark):
            flip(place)
            with pytest.raises(ValueError, match=r"x\.h5 was changed after it was written"):
                jdsmc.load(path)
            flip(place)
    assert jdsmc.load(path)["a2"].value == 0.1


def test_truncated(path):
    """At a hundred lengths, told without the library."""
    written = path.read_bytes()
    for length in np.linspace(0, len(written) - seal.LENGTH - 1, 100).astype(int):
        path.write_bytes(written[:length])
        with pytest.raises(ValueError, match=r"x\.h5 is not a result file that can be read: it"):
            jdsmc.load(path)


def test_a_flipped_mark(path):
    """There is no seal then: the numbers are right, and it is told that nobody knows."""
    written = bytearray(path.read_bytes())
    written[-seal.LENGTH + 3] ^= 1
    path.write_bytes(written)
    with pytest.warns(UserWarning, match=r"x\.h5 has no seal"):
        assert jdsmc.load(path)["a2"].value == 0.1


def test_written_by_another_program(tmp_path, path):
    """Its numbers are those of its file, with a warning."""
    other = tmp_path / "other.h5"
    with xr.open_datatree(path, engine="h5netcdf") as tree:
        packed = {"a2": {"zlib": True}} | {}
        tree.load()["profile"] = tree["profile"] + 1.0
        tree.to_netcdf(
            other, engine="h5netcdf", encoding={"/": {"profile": {"zlib": True}} | packed}
        )
    with pytest.warns(UserWarning, match=r"other\.h5 has no seal"):
        loaded = jdsmc.load(other)
    np.testing.assert_array_equal(loaded.steady["profile"], np.arange(1.0, 6.0))


def sealed(path, change):
    """A file that somebody has changed, and sealed again."""

    def fill(aside):
        aside.write_bytes(path.read_bytes()[: -seal.LENGTH])
        with h5py.File(aside, "r+") as file:
            change(file)

    seal.write(path, fill, overwrite=True)
    return path


REFUSED = {
    "of schema 2, and this version of jdsmc reads 1": lambda f: f.attrs.modify("schema", 2),
    "of schema [2 3]": lambda f: f.attrs.update(schema=[2, 3]),
    "before its files had a schema": lambda f: f.attrs.__delitem__("schema"),
    "was not written by jdsmc": lambda f: f.attrs.__delitem__("jdsmc_version"),
    "/x is a link to elsewhere": lambda f: f.update(x=h5py.ExternalLink("/etc/x.h5", "/")),
    "declares more than": lambda f: f.create_dataset("x", (10**11,), "f8"),
    "/x is compressed": lambda f: f.create_dataset("x", data=np.zeros(99), compression="gzip"),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_sealed_and_refused(reason, path):
    """A seal is no signature: what it holds is looked at all the same."""
    with pytest.raises(ValueError, match=rf"x\.h5 .*{re.escape(reason)}"):
        jdsmc.load(sealed(path, REFUSED[reason]))


def test_no_seal_and_refused(path):
    """The reason comes back from the other process."""
    with h5py.File(without_seal(path), "r+") as file:
        file["x"] = h5py.SoftLink("/profile")
    with pytest.raises(ValueError, match="that can be read: /x is a link to elsewhere"):
        jdsmc.load(path)


def test_not_a_file(tmp_path):
    """A folder, and what cannot be read by anybody."""
    with pytest.raises(FileNotFoundError, match="there is no file"):
        jdsmc.load(tmp_path)
    empty, text = tmp_path / "empty.h5", tmp_path / "text.h5"
    empty.touch()
    seal.write(text, lambda aside: aside.write_text("not HDF5"), overwrite=False)
    for one in (empty, text):
        with pytest.raises(ValueError, match=f"{one.name} is not a result file that can be read"):
            jdsmc.load(one)


FULL = """
import resource, signal, sys
import jdsmc
result = jdsmc.load(sys.argv[1])
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
for size in (100, 3000, 8200):
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
    try:
        result.save(sys.argv[2])
    except OSError as error:
        print(type(error).__name__)
"""


def test_a_disk_that_fills(path):
    """An OSError and no file, not half a one; and the program goes on, and ends as it should."""
    out = path.with_name("out.h5")
    assert path.stat().st_size > 8200
    program = [sys.executable, "-c", FULL, str(path), str(out)]
    done = subprocess.run(program, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["OSError"] * 3, done.stderr
    assert sorted(one.name for one in path.parent.iterdir()) == ["x.h5"]


def test_a_sweep_of_one_point(tmp_path):
    """Its numbers stay arrays, which NetCDF does not tell from numbers."""
    attrs = ATTRS | {"swept": "restitution", "parameter_restitution": np.array([0.7])}
    data = xr.Dataset(coords={"restitution": [0.7]}, attrs=attrs)
    loaded = jdsmc.load(Result(xr.DataTree(data)).save(tmp_path / "x.h5"))
    assert loaded.attrs["parameter_restitution"].shape == (1,)
