"""One writer of a file at a time."""

import contextlib
import os
from pathlib import Path

try:
    import fcntl
except ImportError:  # not a POSIX system: nothing is locked
    fcntl = None


class Lock:
    """Held until `release`, or until the process ends in whatever way.

    Arguments: the file; a hidden one beside it is what is locked, as the file itself is replaced.
    Raises BlockingIOError if another process holds it.
    """

    def __init__(self, path: Path):
        self._path = path.with_name(f".{path.name}.lock")
        self._file = None
        if fcntl is None:
            return
        while self._file is None:
            file = self._path.open("a")
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                file.close()
                raise BlockingIOError(
                    f"another process writes {path}; wait for it, or choose another name."
                ) from None
            except OSError:  # a disk without locks
                file.close()
                return
            if _is(file, self._path):
                self._file = file
            else:  # it was let go and taken away between the two lines above
                file.close()

    def release(self) -> None:
        """Let others write."""
        if self._file is not None:
            with contextlib.suppress(OSError):
                os.unlink(self._path)
            self._file.close()
            self._file = None


def _is(file, path: Path) -> bool:
    """True if a path still leads to an open file."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), path.stat())
    except FileNotFoundError:
        return False
