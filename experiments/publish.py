"""Where simulations are kept, and tables and figures beside the code that made them."""

import shutil
from collections.abc import Iterable
from pathlib import Path


def output_folder(experiment: str, size: str, out: Path | None) -> Path:
    """The folder of simulations, made if it is missing: OUT or output/<experiment>/<size>."""
    folder = out or Path("output") / experiment / size
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def results_folder(results: Path, size: str) -> Path:
    """The folder of a size, made if it is missing: RESULTS itself (small) or RESULTS/<size>."""
    folder = results if size == "small" else results / size
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def keep(paths: Iterable[Path], results: Path, size: str) -> None:
    """Copy files to the folder of a size."""
    folder = results_folder(results, size)
    for path in paths:
        shutil.copy(path, folder / path.name)
