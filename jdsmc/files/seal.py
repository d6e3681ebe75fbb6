"""A seal at the end of a file: the digest of everything before it, looked at before it is parsed.

HDF5 checks chunks of data at most, and its metadata not at all; a flipped byte there may crash the
library or give other numbers. So the digest of the whole stands in a line after the last byte that
HDF5 knows of, where every reader of HDF5 ignores it.
"""

import contextlib
import hashlib
import os
import secrets
import shutil
from collections.abc import Callable
from pathlib import Path

MARK = b"\njdsmc seal 1 blake2b "
LENGTH = len(MARK) + 64 + 1
"""Bytes of a seal: the mark, 32 bytes in hexadecimal, a line end."""

PIECE = 1 << 24


def write(
    path: Path, fill: Callable[[Path], None], *, overwrite: bool, previous: Path | None = None
) -> None:
    """Make a sealed file in one step: at any instant the path holds a whole file or what it held.

    Arguments: the path; what writes a file to the path that it is given; False to raise
    FileExistsError rather than replace a file; where to keep the file that is replaced, if any.
    Raises what `fill` raises and OSError; nothing is left behind then.
    """
    aside = path.with_name(f".{path.name}.{os.getpid()}-{secrets.token_hex(4)}.partial")
    try:
        fill(aside)
        _close(aside)
        if previous is not None and path.exists():
            _same_file(path, previous)
        if overwrite:
            os.replace(aside, path)
        else:
            _place(aside, path)
        _sync_folder(path.parent)
    finally:
        aside.unlink(missing_ok=True)


def is_sealed(path: Path) -> bool:
    """True if the file has a seal, whether or not it is the right one."""
    return _last(path).startswith(MARK)


def is_whole(path: Path) -> bool:
    """True if the file has a seal and is to the bit what was sealed."""
    last = _last(path)
    return last.startswith(MARK) and last == _seal(path, path.stat().st_size - LENGTH)


def _last(path: Path) -> bytes:
    """The last bytes, as many as a seal has."""
    with path.open("rb") as file:
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - LENGTH))
        return file.read()


def _seal(path: Path, length: int) -> bytes:
    """The seal of the first bytes of a file."""
    digest, left = hashlib.blake2b(digest_size=32), length
    with path.open("rb") as file:
        while left > 0 and (piece := file.read(min(PIECE, left))):
            digest.update(piece)
            left -= len(piece)
    return MARK + digest.hexdigest().encode() + b"\n"


def _close(path: Path) -> None:
    """Seal a file, and wait until the disk has it."""
    seal = _seal(path, path.stat().st_size)
    with path.open("ab") as file:
        file.write(seal)
        file.flush()
        os.fsync(file.fileno())


def _same_file(path: Path, other: Path) -> None:
    """Let a second name stand for a file, in one step; a copy where there are no links."""
    aside = other.with_name(f".{other.name}.{os.getpid()}.partial")
    aside.unlink(missing_ok=True)
    try:
        os.link(path, aside)
    except OSError:
        shutil.copyfile(path, aside)
    os.replace(aside, other)


def _place(aside: Path, path: Path) -> None:
    """Give a file its name; FileExistsError if another has it, also one that came meanwhile."""
    try:
        os.link(aside, path)
    except FileExistsError:
        raise FileExistsError(f"{path} exists; choose another name or delete it first.") from None
    except OSError:  # a disk without links
        with path.open("xb"):
            pass
        os.replace(aside, path)


def _sync_folder(folder: Path) -> None:
    """Wait until the disk has the names too, where a system can."""
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
