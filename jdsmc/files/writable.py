"""Whether a file can be written, asked before any work is done for it."""

import os
import stat
from pathlib import Path

from .. import check
from .seal import beside


def check_writable(path: str | Path, overwrite: bool = False) -> Path:
    """The path, if a file may be made there; nothing is changed.

    Raises FileExistsError unless `overwrite`, FileNotFoundError without the folder, PermissionError
    for what the system refuses.
    """
    path = check.path("path", path)
    try:
        there = stat.S_IFMT(os.lstat(path).st_mode)
    except (FileNotFoundError, NotADirectoryError):
        there = None
    except OSError as error:
        raise PermissionError(f"cannot write {path}: {error.strerror}.") from None
    if there is not None and not overwrite:
        raise FileExistsError(f"{path} exists; choose another name or delete it first.")
    if there is not None and not path.is_file():
        raise FileExistsError(f"{path} exists and is no file; choose another name.")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"the folder {path.parent} of the output file does not exist.")
    trial = beside(path)  # never the name itself: another program may make it just now
    try:
        if there is not None:
            with path.open("ab"):
                pass
        with trial.open("xb"):
            pass
        trial.unlink()
    except OSError as error:
        raise PermissionError(f"cannot write {path}: {error.strerror}.") from None
    return path
