"""Whether a file can be read, said in a sentence."""

from pathlib import Path


def check_readable(path: str | Path, hint: str = "") -> Path:
    """The path, if a file is there and may be read.

    Raises FileNotFoundError, and PermissionError for what the system refuses; `hint` is said too.
    """
    path = Path(path)
    try:
        there = path.is_file()
        if there:
            with path.open("rb"):
                pass
    except OSError as error:
        raise PermissionError(f"cannot read {path}: {error.strerror}.{hint}") from None
    if not there:
        raise FileNotFoundError(f"there is no file {path}.{hint}")
    return path
