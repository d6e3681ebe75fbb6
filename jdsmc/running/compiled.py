"""Compiled programs are kept on disk, so that a new process need not compile them again.

JAX's persistent compilation cache, in the user's cache folder. What is read from it is the program
that was compiled before, with the same results to the bit. Set `JDSMC_COMPILATION_CACHE` to `off`
for none, or to a folder of your own; a cache that was set up in JAX itself is left as it is.
"""

import contextlib
import os
import sys
from pathlib import Path

import jax

from .provenance import processor

VARIABLE = "JDSMC_COMPILATION_CACHE"
"""Environment variable: `off`, or a folder."""

SILENT = (0, 11)
"""First version of JAX that reads a program of its own without pages of warnings of XLA: with older
ones (those for Python 3.11) programs are kept only if asked for."""

WORTH_KEEPING = 0.1
"""Seconds of compiling from which on a program is kept (JAX's own default, 1, keeps too few)."""

ROOM = 2**29
"""Bytes of the folder beyond which the programs that were written first are deleted: thousands."""


def keep_programs() -> None:
    """Have JAX keep compiled programs, unless the user turned it off or has set it up himself.

    A folder that cannot be written to means no cache: JAX warns and compiles, as it does where a
    file is damaged.
    """
    chosen = os.environ.get(VARIABLE, "")
    if not chosen and tuple(map(int, jax.__version__.split(".")[:2])) < SILENT:
        return
    ours = jax.config.jax_compilation_cache_dir is None
    if chosen.lower() == "off" or not ours or not jax.config.jax_enable_compilation_cache:
        return
    folder = Path(chosen) if chosen else cache_folder() / "jdsmc" / f"programs-{processor()}"
    with contextlib.suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
        make_room(folder)
        jax.config.update("jax_compilation_cache_dir", str(folder))
        if "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS" not in os.environ:
            jax.config.update("jax_persistent_cache_min_compile_time_secs", WORTH_KEEPING)


def cache_folder() -> Path:
    """Where programs of this user keep what can be made again, as the platform has it."""
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local")
    if sys.platform == "darwin":
        return home / "Library" / "Caches"
    return Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache")


def make_room(folder: Path, room: int = ROOM) -> None:
    """Delete the programs of a folder that were written first, until `room` bytes are left."""
    files = [(path, path.stat()) for path in folder.glob("*-cache")]
    files.sort(key=lambda one: one[1].st_mtime)
    excess = sum(told.st_size for _, told in files) - room
    for path, told in files:
        if excess <= 0:
            return
        path.unlink(missing_ok=True)
        excess -= told.st_size
