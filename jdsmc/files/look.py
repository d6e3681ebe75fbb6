"""A look at the structure of an HDF5 file before anything is read from it, and in another process.

HDF5 can hold what eats memory or leads elsewhere: links to other files, arrays that are declared
and not there, a megabyte that unpacks to gigabytes, groups without end, objects of any kind.
`structure` refuses these with a reason. The library itself may crash or hang over bytes that are
not as written, so a file without a seal is looked at, and read, in a process of its own first.

This module is also the program of that process, so it imports nothing of jdsmc.
"""

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator
from math import ceil, prod
from pathlib import Path
from typing import Any

import h5py
import numpy as np

LEAST_BYTES = 1 << 28
"""Memory that any file may take."""

GROWTH = 8
"""Larger ones take at most so many times their own size: text and attributes grow when read."""

FILTERS = (h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32)
PACKED = (h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_LZF)

MOST_AXES = 32
MOST_ATTRIBUTES = 1000

SIGNATURE = b"\x89HDF\r\n\x1a\n"
END_OF_FILE = {0: 40, 1: 44, 2: 28, 3: 28}
"""Place of the address in superblocks of each version, addresses having 8 bytes."""

WITHOUT_VALUES = b"This is a netCDF dimension but not"
"""So does netCDF call an axis of which only the length is declared."""

SECONDS = 120.0
"""Longest wait for the other process; its own time is limited more narrowly."""

SECONDS_OF_CPU = 20
BYTES_PER_SECOND = 20_000_000
ROOM = 1 << 30
"""Memory for libraries and for what they make of a file."""


def structure(
    file: h5py.File,
    *,
    most_bytes: int | None = None,
    most_objects: int = 10_000,
    deepest: int = 8,
    packed: bool = False,
) -> None:
    """Raise ValueError, with a reason, unless an open file is plain data that fits in memory.

    Plain: groups in groups, arrays of numbers, truth values and text, all there in this file.

    Arguments: most bytes that all arrays and attributes take in memory, by default some times the
    size of the file; most groups and arrays; most groups in one another; True to allow compression,
    of which a library unpacks what it finds (read such a file in another process first).
    """
    size = os.path.getsize(os.fsdecode(file.filename))
    most = most_bytes if most_bytes is not None else allowed(size)
    try:
        _Look(size, most, packed).at(file, most_objects, deepest)
    except _Refused as reason:
        raise ValueError(str(reason)) from None
    except Exception as error:  # whatever the library says of bytes that make no sense
        why = " ".join(str(error).split())
        raise ValueError(f"the HDF5 library finds fault with it ({why})") from None


def allowed(size: int) -> int:
    """Bytes of memory that a file of this size may take."""
    return max(LEAST_BYTES, GROWTH * size)


class _Refused(Exception):
    """Why a file is not read."""


class _Look:
    """What has been seen of a file."""

    def __init__(self, size: int, most: int, packed: bool):
        self.size, self.most, self.packed = size, most, packed
        self.taken, self.at_once = 0, max(most, LEAST_BYTES)

    def at(self, root: h5py.Group, most_objects: int, deepest: int) -> None:
        """Look at everything from the root on."""
        waiting, seen = [(root, 0)], 1
        while waiting:
            group, depth = waiting.pop()
            self.attributes(group)
            seen += len(group)
            if seen > most_objects:
                raise _Refused(f"it holds more than {most_objects} objects")
            if depth == deepest and len(group):
                raise _Refused(f"its groups are nested more than {deepest} deep")
            for one in members(group):
                if isinstance(one, h5py.Dataset):
                    self.attributes(one)
                    self.dataset(one)
                else:
                    waiting.append((one, depth + 1))

    def take(self, count: int) -> None:
        """Count bytes that reading will take."""
        self.taken += count
        if self.taken > self.most:
            raise _Refused(
                f"it declares more than {self.most} bytes, its own size being {self.size}"
            )

    def attributes(self, one: h5py.Group | h5py.Dataset) -> None:
        """Few, plain, and small."""
        if len(one.attrs) > MOST_ATTRIBUTES:
            raise _Refused(f"{one.name} has more than {MOST_ATTRIBUTES} attributes")
        for name in one.attrs:
            found = one.attrs.get_id(name)
            count, where = _count(found.shape), f"{one.name}, {name}"
            if name == "REFERENCE_LIST":  # of netCDF, never read
                continue
            self.take(count * found.get_type().get_size())
            if name == "DIMENSION_LIST":
                self.scales(one, where)
            elif h5py.check_string_dtype(found.dtype) is None:
                _check_plain(found.dtype, where)
            elif found.dtype.kind == "O":
                if count * self.size > self.at_once:
                    raise _Refused(f"{where} has {count} texts")
                self.take(_length(one.attrs[name]))

    def scales(self, one: Any, where: str) -> None:
        """One reference, at most, for each axis of an array."""
        if not isinstance(one, h5py.Dataset) or one.attrs.get_id("DIMENSION_LIST").shape != (
            one.ndim,
        ):
            raise _Refused(f"{where} does not fit")
        scales: Any = one.attrs["DIMENSION_LIST"]
        if any(len(scale) > 1 for scale in scales):
            raise _Refused(f"{where} has several scales along one axis")

    def dataset(self, one: h5py.Dataset) -> None:
        """Plain, in this file, as much of it as is declared."""
        if one.ndim > MOST_AXES:
            raise _Refused(f"{one.name} has more than {MOST_AXES} axes")
        made = one.id.get_create_plist()
        if made.get_external_count() or made.get_layout() == h5py.h5d.VIRTUAL:
            raise _Refused(f"{one.name} lies in another file")
        count = _count(one.shape)
        declared = count * one.id.get_type().get_size()
        if _has_no_values(one):
            return
        self.take(declared)
        _check_plain(one.dtype, str(one.name))
        if one.chunks is not None:
            self.chunks(one, made)
        elif made.get_layout() == h5py.h5d.CONTIGUOUS and one.id.get_storage_size() < declared:
            raise _Refused(f"{one.name} is declared and not there")
        if one.dtype.kind == "O":
            self.texts(one, count)

    def chunks(self, one: h5py.Dataset, made) -> None:
        """All of them are there, and go through filters that are known."""
        may = (*FILTERS, *(PACKED if self.packed else ()))
        used = [made.get_filter(k)[0] for k in range(made.get_nfilters())]
        if not set(used) <= set(may):
            raise _Refused(f"{one.name} is compressed, or filtered in a way that is not known here")
        shape, chunk = tuple(one.shape), tuple(one.chunks or ())
        self.take(prod(chunk) * one.id.get_type().get_size())
        needed = prod(ceil(n / m) for n, m in zip(shape, chunk, strict=True))
        if one.id.get_num_chunks() != needed:
            raise _Refused(f"{one.name} is declared and not all there")

    def texts(self, one: h5py.Dataset, count: int) -> None:
        """Their length: many may stand for one and the same piece of a file."""
        step = max(1, self.at_once // max(self.size, 1))
        if one.ndim > 1 and count > step:
            raise _Refused(f"{one.name} is much text of several axes")
        for start in range(0, count, step):
            self.take(_length(one[slice(start, start + step) if one.ndim == 1 else ()]))


def members(group: h5py.Group) -> Iterator[h5py.Group | h5py.Dataset]:
    """What a group holds, if that is groups and arrays of this file."""
    for name in group:
        where = f"{str(group.name).rstrip('/')}/{name}"
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise _Refused(f"{where} is a link to elsewhere")
        one = group[name]
        if isinstance(one, h5py.Datatype):  # as netCDF has one for complex numbers
            _check_plain(one.dtype, where)
        else:
            yield one


def _check_plain(dtype: np.dtype, where: str) -> None:
    """Numbers, truth values, text."""
    text = h5py.check_string_dtype(dtype) is not None
    if not (text or (dtype.kind in "biufc" and dtype.subdtype is None)):
        raise _Refused(f"{where} holds objects that are neither numbers nor text")


def _count(shape: tuple[int, ...] | None) -> int:
    return 0 if shape is None else prod(shape)


def _length(texts: Any) -> int:
    """Bytes of a text, or of an array of texts."""
    flat = np.ravel(texts) if isinstance(texts, np.ndarray) else [texts]
    return sum(len(one) + sys.getsizeof("") for one in flat)


def _has_no_values(one: h5py.Dataset) -> bool:
    """True for an axis of netCDF of which only the length is declared."""
    name = one.attrs.get("NAME", b"")
    return h5py.h5ds.is_scale(one.id) and bytes(name).startswith(WITHOUT_VALUES)


def is_hdf5(path: Path) -> bool:
    """True if a file begins as HDF5 does."""
    with path.open("rb") as file:
        return file.read(len(SIGNATURE)) == SIGNATURE


def start(path: Path) -> None:
    """Raise ValueError unless a file begins as HDF5 does and is as long as it says there.

    HDF5 specification 3.0, section II.A: where the end of the file stands in its superblock.
    """
    if not is_hdf5(path):
        raise ValueError("it is not an HDF5 file")
    with path.open("rb") as file:
        head, size = file.read(52), file.seek(0, os.SEEK_END)
    place = END_OF_FILE.get(head[8] if len(head) > 8 else -1)
    if place is None or len(head) < place + 8:
        raise ValueError("its first bytes make no sense")
    length = int.from_bytes(head[place : place + 8], "little")
    if size < length:
        raise ValueError(f"it is cut: of {length} bytes it has {size}")


def in_another_process(path: Path) -> None:
    """Read a file there, in limited time and memory; ValueError, with a reason, if that failed."""
    start(path)
    command = [sys.executable, "-P", __file__, str(path)]
    one_thread = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    try:
        done = subprocess.run(
            command,
            env={**os.environ, **one_thread},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise ValueError(f"reading it takes more than {SECONDS:g} s") from None
    if done.returncode < 0:
        raise ValueError(f"the HDF5 library fails over it (signal {-done.returncode})")
    if done.returncode:
        said = done.stdout.decode(errors="replace").strip().splitlines()
        raise ValueError(said[-1] if said else "it could not be read")


def _main(path: str) -> int:
    """Look at a file and read all of it, in little memory and time; what is wrong is printed."""
    import xarray  # noqa: PLC0415 - not needed where a look is all

    _limit(os.path.getsize(path))
    try:
        with h5py.File(path) as file:
            structure(file, packed=True)
        with xarray.open_datatree(
            path, engine="h5netcdf", decode_times=False, decode_timedelta=False
        ) as tree:
            tree.load()
    except MemoryError:
        print("reading it takes more memory than it may")
        return 1
    except Exception as error:
        print(" ".join(str(error).split()) or type(error).__name__)
        return 1
    return 0


def _limit(size: int) -> None:
    """Let this process take only so much time and memory, where a system can."""
    with contextlib.suppress(ImportError):
        import resource  # noqa: PLC0415 - not on every system

        seconds = SECONDS_OF_CPU + size // BYTES_PER_SECOND
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        with contextlib.suppress(OSError, ValueError):
            pages = int(Path("/proc/self/statm").read_text().split()[0])
            memory = pages * os.sysconf("SC_PAGE_SIZE") + allowed(size) + ROOM
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))


if __name__ == "__main__":
    sys.exit(_main(sys.argv[1]))
