"""What is refused of an HDF5 file before it is read, with a reason; and what is not."""

import re
import signal
import zlib

import h5py
import numpy as np
import pytest

from jdsmc.files import look


def structure(path, **options):
    with h5py.File(path) as file:
        look.structure(file, **options)


@pytest.fixture
def made(tmp_path):
    """A function: the path of a file that a function fills."""

    def make(fill):
        path = tmp_path / "x.h5"
        with h5py.File(path, "w") as file:
            fill(file)
        return path

    return make


def honest(file):
    """Everything that a result or a checkpoint may hold."""
    file["numbers"] = np.arange(6.0).reshape(2, 3)
    file["narrow"] = np.arange(6, dtype=np.uint8)
    file["complex"] = np.ones(3, complex)
    file["truth"] = np.array([True, False])
    file["scalar"] = 3
    file["nothing"] = np.zeros((0, 4))
    file["text"] = ["ihs", "ehs"]
    file["one text"] = "ihs"
    file["table of texts"] = np.array([["a", "b"], ["c", ""]], h5py.string_dtype())
    file["group/in/group"] = 1.0
    file["name of a type"] = np.dtype(complex)
    options = {"fletcher32": True, "chunks": (7, 5)}
    file.create_dataset("checked", data=np.ones((20, 20)), **options)
    file.attrs.update({"text": "η", "none": h5py.Empty("f4"), "row": np.arange(3), "yes": True})
    file.attrs["texts"] = ["a", "b"]


def test_honest(made):
    """Also within the limits of its own size, and from within."""
    path = made(honest)
    structure(path)
    structure(path, most_bytes=path.stat().st_size)
    look.start(path)


def link_outside(file):
    file["x"] = h5py.ExternalLink("/etc/other.h5", "/x")


def soft_link(file):
    file["x"] = h5py.SoftLink("/y")


def circle(file):
    file["a/b"] = 1.0
    file["a/again"] = file["a"]


def deep(file):
    file["/".join("abcdefghijkl")] = 1.0


def many(file):
    for number in range(300):
        file.create_group(str(number))


def huge_and_absent(file):
    file.create_dataset("x", (10**12,), "f8")


def huge_in_chunks(file):
    file.create_dataset("x", (10**12,), "f8", chunks=(10**6,))


def small_in_a_huge_chunk(file):
    file.create_dataset("x", (1,), "f8", chunks=(2**28,), maxshape=(None,))


def absent(file):
    file.create_dataset("x", (10,), "f8")


def partly_absent(file):
    file.create_dataset("x", (10,), "f8", chunks=(5,))[:5] = 1.0


def elsewhere(file):
    file.create_dataset("x", (10,), "f8", external=[("other.bin", 0, 80)])


def virtual(file):
    layout = h5py.VirtualLayout((10,), "f8")
    layout[:] = h5py.VirtualSource("other.h5", "x", (10,))
    file.create_virtual_dataset("x", layout)


def compressed(file):
    file.create_dataset("x", data=np.zeros(10**6), compression="gzip", chunks=(10**6,))


def opaque(file):
    file["x"] = np.zeros(3, "V8")


def record(file):
    file["x"] = np.zeros(3, [("a", "f8"), ("b", "i4")])


def references(file):
    file["x"] = np.array([file.ref], h5py.ref_dtype)


def ragged(file):
    file.create_dataset("x", (2,), h5py.vlen_dtype(np.int32))[0] = [1, 2]


def named_type(file):
    file["x"] = np.dtype("V8")


def attribute_of_objects(file):
    file.attrs["x"] = np.array([file.ref], h5py.ref_dtype)


def attribute_of_records(file):
    file.attrs["x"] = np.zeros(3, [("a", "f8")])


def many_attributes(file):
    for number in range(look.MOST_ATTRIBUTES + 1):
        file.attrs[str(number)] = number


def scales_of_a_group(file):
    file.attrs.create("DIMENSION_LIST", np.zeros(3))


REFUSED = {
    link_outside: "/x is a link to elsewhere",
    soft_link: "/x is a link to elsewhere",
    circle: "nested more than 8 deep",
    deep: "nested more than 8 deep",
    many: "more than 200 objects",
    huge_and_absent: "declares more than",
    huge_in_chunks: "declares more than",
    small_in_a_huge_chunk: "declares more than",
    absent: "/x is declared and not there",
    partly_absent: "/x is declared and not all there",
    elsewhere: "/x lies in another file",
    virtual: "/x lies in another file",
    compressed: "/x is compressed",
    opaque: "/x holds objects",
    record: "/x holds objects",
    references: "/x holds objects",
    ragged: "/x holds objects",
    named_type: "/x holds objects",
    attribute_of_objects: "/, x holds objects",
    attribute_of_records: "/, x holds objects",
    many_attributes: "/ has more than 1000 attributes",
    scales_of_a_group: "/, DIMENSION_LIST does not fit",
}


@pytest.mark.parametrize("fill", REFUSED, ids=lambda fill: fill.__name__)
def test_refused(fill, made):
    with pytest.raises(ValueError, match=REFUSED[fill]):
        structure(made(fill), most_objects=200)


def test_compression_may_be_allowed(made):
    """By what reads in another process; a filter that is not known never is."""
    structure(made(compressed), packed=True)
    with pytest.raises(ValueError, match="filtered in a way"):
        structure(
            made(lambda f: f.create_dataset("x", data=np.arange(9), scaleoffset=0)), packed=True
        )


def test_text_that_is_told_many_times(made):
    """A thousand elements that are one megabyte each, of which the file has one."""

    def fill(file):
        texts = file.create_dataset("x", (1000,), h5py.string_dtype())
        texts[0] = "x" * 2**20

    path = made(fill)
    written = bytearray(path.read_bytes())
    with h5py.File(path) as file:
        place = file["x"].id.get_offset()
    written[place : place + 16 * 1000] = written[place : place + 16] * 1000
    path.write_bytes(written)
    with pytest.raises(ValueError, match="declares more than"):
        structure(path)


def test_flipped_bytes_without_a_seal(made):
    """Whatever the library says of them in a look is a ValueError; most are not even seen here."""
    path = made(lambda file: file.update({"x": np.arange(3.0), "y/z": "text"}))
    written = bytearray(path.read_bytes())
    refused = 0
    for place in range(0, 800, 7):
        written[place] ^= 0xFF
        path.write_bytes(written)
        try:
            look.start(path)
            with h5py.File(path) as file:
                look.structure(file)
        except (ValueError, OSError):
            refused += 1
        written[place] ^= 0xFF
    assert refused > 20


def test_cut(made):
    """At a hundred lengths; told without the library."""
    path = made(honest)
    written = path.read_bytes()
    for length in np.linspace(0, len(written) - 1, 100).astype(int):
        path.write_bytes(written[:length])
        with pytest.raises(ValueError, match=r"it is cut|no HDF5|not an HDF5|no sense"):
            look.start(path)
    path.write_bytes(written + b"more")
    look.start(path)


PROGRAMS = {
    "signal 11": f"import os; os.kill(os.getpid(), {int(signal.SIGSEGV)})",
    "takes more than": "import time; time.sleep(60)",
    "a reason of its own": "print('a reason of its own'); raise SystemExit(1)",
    "it could not be read": "raise SystemExit(1)",
}


@pytest.mark.parametrize("reason", PROGRAMS)
def test_a_process_that_fails(reason, made, tmp_path, monkeypatch):
    """As over a file at which the library crashes or hangs."""
    path, program = made(honest), tmp_path / "program.py"
    program.write_text(PROGRAMS[reason])
    monkeypatch.setattr(look, "__file__", str(program))
    monkeypatch.setattr(look, "SECONDS", 0.2 if "time" in PROGRAMS[reason] else 60.0)
    with pytest.raises(ValueError, match=reason):
        look.in_another_process(path)


@pytest.mark.slow
def test_a_chunk_that_unpacks_to_gigabytes(made):
    """Of a declared kilobyte: the memory of the other process ends it."""
    packer = zlib.compressobj(1, zlib.DEFLATED, -15)
    block = packer.compress(bytes(1 << 24)) + packer.flush(zlib.Z_FULL_FLUSH)

    def fill(file):
        x = file.create_dataset("x", (128,), "f8", chunks=(128,), compression="gzip")
        x.id.write_direct_chunk((0,), b"\x78\x01" + block * 200)

    path = made(fill)
    with pytest.raises(ValueError, match=re.compile("memory|read|filter", re.I)):
        look.in_another_process(path)
