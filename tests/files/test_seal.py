"""A seal tells of every change, and a file is there whole or not at all."""

import errno
import os
import subprocess
import sys
import time

import pytest

from jdsmc.files import seal
from jdsmc.files.writable import check_writable

CONTENT = bytes(range(256))


def fill(path):
    path.write_bytes(CONTENT)


@pytest.fixture
def path(tmp_path):
    """A name in an empty folder."""
    return tmp_path / "x.h5"


@pytest.fixture
def sealed(path):
    """A sealed file."""
    seal.write(path, fill, overwrite=False)
    return path


def names(path) -> set[str]:
    return set(os.listdir(path.parent))


def test_what_was_written_is_there(sealed):
    """Followed by the seal and nothing else; no other file is left."""
    assert seal.is_sealed(sealed) and seal.is_whole(sealed)
    written = sealed.read_bytes()
    assert written.startswith(CONTENT) and len(written) == len(CONTENT) + seal.LENGTH
    assert names(sealed) == {"x.h5"}


def test_every_flipped_bit_is_seen(sealed):
    """In the content and in the digest as a change; in the mark there is no seal then."""
    written = bytearray(sealed.read_bytes())
    mark = range(len(CONTENT), len(CONTENT) + len(seal.MARK))
    for place in range(len(written)):
        bit = 1 << (place % 8)
        written[place] ^= bit
        sealed.write_bytes(written)
        assert seal.is_sealed(sealed) == (place not in mark) and not seal.is_whole(sealed)
        written[place] ^= bit


def test_every_truncation_is_seen(sealed):
    """Nothing that is shorter or longer has a right seal."""
    written = sealed.read_bytes()
    for length in range(len(written)):
        sealed.write_bytes(written[:length])
        assert not seal.is_whole(sealed)
    sealed.write_bytes(written + b"x")
    assert not seal.is_whole(sealed)
    sealed.write_bytes(CONTENT[1:] + written[len(CONTENT) :])
    assert seal.is_sealed(sealed) and not seal.is_whole(sealed)


@pytest.mark.parametrize("overwrite", [False, True])
def test_a_crash_of_what_writes(path, overwrite):
    """Half a file, and then an error, or Ctrl-C: nothing is left, and what was there stays."""
    if overwrite:
        seal.write(path, fill, overwrite=False)
    before, there = names(path), path.exists() and path.read_bytes()

    def crash(aside):
        aside.write_bytes(CONTENT[:100])
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        seal.write(path, crash, overwrite=overwrite, previous=path.with_suffix(".old"))
    assert names(path) == before and (path.exists() and path.read_bytes()) == there


@pytest.mark.parametrize("links", [True, False])
def test_a_file_that_comes_meanwhile(path, links, monkeypatch):
    """It stays as it is, on a disk without links too."""
    if not links:
        no_links(monkeypatch)

    def late(aside):
        fill(aside)
        path.write_text("precious")

    with pytest.raises(FileExistsError, match=r"x\.h5 exists; choose another name"):
        seal.write(path, late, overwrite=False)
    assert path.read_text() == "precious" and names(path) == {"x.h5"}


def no_links(monkeypatch):
    """A disk that knows no links."""

    def refuse(*_):
        raise OSError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr(os, "link", refuse)


def test_a_disk_without_links(path, monkeypatch):
    no_links(monkeypatch)
    seal.write(path, fill, overwrite=False)
    old = path.with_suffix(".old")
    seal.write(path, lambda aside: aside.write_bytes(b"new"), overwrite=True, previous=old)
    assert seal.is_whole(path) and path.read_bytes().startswith(b"new")
    assert seal.is_whole(old) and old.read_bytes().startswith(CONTENT)
    assert names(path) == {"x.h5", "x.old"}


def test_the_name_is_given_back(path, monkeypatch):
    """Where a disk without links fails at the last moment, no empty file holds the name."""
    no_links(monkeypatch)

    def refuse(*_):
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(OSError, match="Input/output"):
        seal.write(path, fill, overwrite=False)
    assert names(path) == set()


def test_the_previous_one_is_kept(path):
    """Each write moves on by one; also after a crash between the two steps of a write."""
    old = path.with_suffix(".old")
    for number in range(3):
        content = f"number {number}".encode()
        seal.write(
            path, lambda aside, c=content: aside.write_bytes(c), overwrite=True, previous=old
        )
    assert path.read_bytes().startswith(b"number 2") and old.read_bytes().startswith(b"number 1")
    old.unlink()
    os.link(path, old)  # so it is after such a crash
    seal.write(path, fill, overwrite=True, previous=old)
    assert old.read_bytes().startswith(b"number 2") and names(path) == {"x.h5", "x.old"}


def test_a_link_is_followed(path):
    """The file that a symbolic link stands for is replaced, the link stays."""
    real = path.with_name("real.h5")
    real.write_text("old")
    path.symlink_to(real)
    seal.write(path, fill, overwrite=True)
    assert path.is_symlink() and seal.is_whole(real) and names(path) == {"x.h5", "real.h5"}


def test_what_was_killed_leaves_no_files_for_long(path):
    """The next write deletes what is older than an hour, and leaves that of a live process."""
    dead, alive, other = (
        path.with_name(f".{n}.partial") for n in ("x.h5.1-a", "x.h5.2-b", "y.3-c")
    )
    for one in (dead, alive, other):
        one.touch()
    for one in (dead, other):
        os.utime(one, (time.time() - 2 * seal.DEAD,) * 2)
    seal.write(path, fill, overwrite=False)
    assert names(path) == {"x.h5", alive.name, other.name}


def test_the_longest_name(tmp_path):
    """As long as the system allows, of letters that take several bytes."""
    path = tmp_path / ("η" * 126 + ".h5")
    check_writable(path)
    seal.write(path, fill, overwrite=False)
    assert seal.is_whole(path)
    with pytest.raises(PermissionError, match="too long"):
        check_writable(tmp_path / ("η" * 127 + ".h5"))


FULL = """
import resource, signal, sys
from pathlib import Path
import seal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
for size in sys.argv[2:]:
    try:
        content = bytes(int(size))
        seal.write(Path(sys.argv[1]), lambda aside: aside.write_bytes(content), overwrite=True)
    except OSError as error:
        print(size, error.strerror)
"""
"""The seal alone, so that nothing else of jdsmc need be imported."""


def test_a_disk_that_fills(sealed):
    """During the content, and during the seal after it: what was there stays, nothing else does."""
    sizes = [5000, 1001, 1000, 1000 - seal.LENGTH + 1]
    done = subprocess.run(
        [sys.executable, "-c", FULL, str(sealed), *map(str, sizes)],
        env={**os.environ, "PYTHONPATH": os.path.dirname(seal.__file__)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines() == [f"{size} File too large" for size in sizes]
    assert seal.is_whole(sealed) and sealed.read_bytes().startswith(CONTENT)
    assert names(sealed) == {"x.h5"}


def test_a_probe_touches_no_file(path, tmp_path):
    """Nothing is left; a link that leads nowhere is a name that is taken, a folder is no file."""
    check_writable(path)
    assert names(path) == set()
    path.symlink_to(tmp_path / "nowhere")
    with pytest.raises(FileExistsError, match="exists; choose"):
        check_writable(path)
    (tmp_path / "folder.h5").mkdir()
    with pytest.raises(FileExistsError, match="is no file"):
        check_writable(tmp_path / "folder.h5", overwrite=True)
