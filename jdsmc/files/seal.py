"""A seal at the end of a file: the digest of everything before it, looked at before it is parsed.

HDF5 checks chunks of data at most, and its metadata not at all; a flipped byte there may crash the
library or give other numbers. So the digest of the whole stands in a line after the last byte that
HDF5 knows of, where every reader of HDF5 ignores it.
"""

import contextlib
import glob
import hashlib
import os
import secrets
import shutil
import time
from collections.abc import Callable
from pathlib import Path

MARK = b"\njdsmc seal 1 blake2b "
LENGTH = len(MARK) + 64 + 1
"""Bytes of a seal: the mark, 32 bytes in hexadecimal, a line end."""

PIECE = 1 << 24

DEAD = 3600.0
"""Seconds after which nobody still writes to a file put aside: its process was killed."""


def write(
    path: Path, fill: Callable[[Path], object], *, overwrite: bool, previous: Path | None = None
) -> None:
    """Make a sealed file in one step: at any instant the path holds a whole file or what it held.

    Arguments: the path; what writes a file to the path that it is given (bytes that are ready: HDF5
    itself, writing to a disk that fills, may bring the program down later); False to raise
    FileExistsError rather than replace a file; where to keep the file that is replaced, if any.
    Raises what `fill` raises and OSError; nothing is left behind then.
    """
    path = path.resolve() if overwrite else path  # what a link stands for is replaced, not the link
    aside = beside(path)
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
        _remove(aside)
        _remove_dead(path)


def beside(path: Path) -> Path:
    """A name in the same folder that nobody has, short enough wherever the path's own is."""
    return path.with_name(f"{_start(path)}{os.getpid()}-{secrets.token_hex(4)}.partial")


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
    aside = beside(other)
    try:
        try:
            os.link(path, aside)
        except OSError:
            shutil.copyfile(path, aside)
        os.replace(aside, other)
    finally:  # it stays if both names were those of one file already
        _remove(aside)


def _place(aside: Path, path: Path) -> None:
    """Give a file its name; FileExistsError if another has it, also one that came meanwhile."""
    try:
        try:
            os.link(aside, path)
        except FileExistsError:
            raise
        except OSError:  # a disk without links: hold the name, then fill it
            with path.open("xb"):
                pass
            try:
                os.replace(aside, path)
            except OSError:
                _remove(path)
                raise
    except FileExistsError:
        raise FileExistsError(f"{path} exists; choose another name or delete it first.") from None


def _start(path: Path) -> str:
    """How the names of files put aside for this path begin."""
    return f".{path.name[:40]}."


def _remove(path: Path) -> None:
    """Delete a file if it is there; what cannot be deleted hides no other error."""
    with contextlib.suppress(OSError):
        path.unlink(missing_ok=True)


def _remove_dead(path: Path) -> None:
    """Delete what writers of this path have left that were killed."""
    with contextlib.suppress(OSError):
        for old in path.parent.glob(f"{glob.escape(_start(path))}*.partial"):
            if old.stat().st_mtime < time.time() - DEAD:
                _remove(old)


def _sync_folder(folder: Path) -> None:
    """Wait until the disk has the names too, where a system can."""
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
