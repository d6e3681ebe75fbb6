"""What is done with results: saved first, whatever happens; then shown and drawn.

A simulation may have taken days: nothing that can fail stands between its end and the file, and
what fails after that says so in a sentence.
"""

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from ..files.look import is_hdf5
from ..files.writable import check_writable
from ..results.join import join_gases
from ..results.result import Result
from ..running.checkpoint import previous
from ..running.hosts import is_first
from ..running.progress import interruptible

PICTURES = (".png", ".pdf", ".svg")
RESULTS = (".h5", ".hdf5", ".nc")
SPARE_NAMES = 100


INTERRUPTED = 130
"""Exit status after a signal, as shells have it."""


def check_files(out: str | None, plot: str | None, kept: str | None = None) -> None:
    """Raise ValueError or OSError, before a run, unless all files can be written.

    `kept` is the checkpoint of the run, beside which lies the one before it.
    """
    if out is not None:
        check_writable(out)
    if plot is not None:
        check_picture(plot)
    if out is not None and plot is not None and Path(out).resolve() == Path(plot).resolve():
        raise ValueError(f"--out and --plot are the same file {out}; give two names.")
    for file in (kept, previous(Path(kept))) if kept is not None else ():
        if out is not None and Path(out).resolve() == Path(file).resolve():
            raise ValueError(f"--out is {out}, which keeps the run; give another name.")


def check_picture(path: str | Path) -> Path:
    """The path, if a picture may be written there (an older one is replaced, but no data)."""
    path = Path(path)
    if path.suffix not in PICTURES:
        raise ValueError(f"the name of a picture ends in {', '.join(PICTURES)}; got {path}.")
    if path.is_file() and is_hdf5(path):
        raise FileExistsError(f"{path} holds data, not a picture; choose another name.")
    return check_writable(path, overwrite=True)


def picture_of(file: Path) -> Path:
    """The picture of a result file: .png instead of its own suffix, if that is one of results."""
    return file.with_suffix(".png") if file.suffix in RESULTS else Path(f"{file}.png")


def keep(
    results: dict[str, Result], out: str | None, plot: str | None, *, join: bool, spare: str
) -> int:
    """Save, show and draw results by gas; the exit status: 1 if any of that failed, else 130 if a
    signal ended a run, so that what follows in a script does not take it for whole.

    Of several processes that share a run, the first does it.

    Arguments: the files asked for; `join` puts the gases side by side; `spare` names the file of a
    result that nobody asked to save and that cannot be shown.
    """
    if not is_first():
        return 0
    parts = {"": next(iter(results.values()))}
    failed = False
    if join:
        try:
            parts = {"": join_gases(results)}
        except Exception as error:
            parts = {f"-{gas}": result for gas, result in results.items()}
            failed = complain("the gases cannot be put side by side, each is kept alone", error)
    if out is not None:
        with interruptible():  # one Ctrl-C too many does not lose a result
            for suffix, result in parts.items():
                failed |= save(result, extended(out, suffix))
    for suffix, result in parts.items():
        failed |= show(result, None if out else Path(f"{spare}{suffix}.h5"))
        if plot is not None:
            failed |= draw(result, extended(plot, suffix))
    ended = any(one.interrupted for one in results.values())
    return 1 if failed else INTERRUPTED * ended


def save(result: Result, path: Path) -> bool:
    """Write a result, under another name if that one cannot be written; True if all names fail."""
    problem: Exception | None = None
    full: set[Path] = set()  # folders where no other name will do
    for other in (path, *spare_paths(path)):
        if other.parent.resolve() in full:
            continue
        try:
            result.save(other)
        except FileExistsError as error:
            problem = problem or error
            continue
        except Exception as error:  # a full disk, a folder that is gone, data that HDF5 refuses
            problem = problem or error
            full.add(other.parent.resolve())
            continue
        if problem is not None:
            complain(f"{path} could not be written, saved as {other} instead", problem)
        print(f"Results: {other}")
        return False
    return complain("the results could not be saved", problem)


def spare_paths(path: Path) -> Iterator[Path]:
    """Names beside a path, in the current folder, in that of temporary files."""
    if path.parent.is_dir():
        for number in range(2, SPARE_NAMES):
            yield path.with_name(f"{path.stem}-{number}{path.suffix}")
    for folder in (Path.cwd(), Path(tempfile.gettempdir())):
        for number in range(1, SPARE_NAMES):
            yield folder / (path.name if number == 1 else f"{path.stem}-{number}{path.suffix}")


def draw(result: Result, path: Path) -> bool:
    """Write a picture; True if that failed."""
    import matplotlib  # noqa: PLC0415 - slow to import

    matplotlib.use("agg")
    try:
        result.plot(path)
    except Exception as error:
        return complain(f"the picture {path} could not be drawn", error)
    print(f"Picture: {path}")
    return False


def show(result: Result, otherwise: Path | None = None) -> bool:
    """Print the table; True if that failed, in which case the result is saved `otherwise`."""
    try:
        table = result.table()
    except Exception as error:
        failed = complain("the table could not be made", error)
        return failed | (otherwise is not None and save(result, otherwise))
    print(table)
    return False


def extended(path: str, suffix: str) -> Path:
    """`sweep.h5` as `sweep-ihs.h5`."""
    return Path(path).with_name(f"{Path(path).stem}{suffix}{Path(path).suffix}")


def complain(what: str, error: Exception | None) -> bool:
    """One sentence on what failed and why; True, so that it can be returned."""
    why = " ".join(str(error).split()) or type(error).__name__
    print(f"jdsmc: {what}: {why.rstrip('.')}.", file=sys.stderr)
    return True
