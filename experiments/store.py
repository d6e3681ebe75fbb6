"""Simulations on disk: made once, saved as they come, reused if they are what is asked for."""

import ast
import hashlib
import time
from functools import cache
from pathlib import Path
from typing import Protocol

import jdsmc
from jdsmc import Result, load

PACKAGE = Path(jdsmc.__file__).parent

OUTSIDE = ("__init__.py", "cli.py", "result.py", "check.py")
"""Sources that decide no number."""


class Case(Protocol):
    """One simulation: its name, what decides its result, and how to make it."""

    @property
    def name(self) -> str:
        """Name of the file, without suffix."""
        ...

    @property
    def module(self) -> str:
        """Source of the simulation in `jdsmc`, e.g. scenarios/uniform_shear.py."""
        ...

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        ...

    def simulate(self) -> Result:
        """Run it."""
        ...


def obtain(case: Case, folder: Path, fresh: bool = False) -> Result:
    """The result of a case: from FOLDER/<name>.h5 if made with the same request and program.

    Raises KeyboardInterrupt if the run was interrupted (nothing is saved then), and what `simulate`
    raises.
    """
    path = folder / f"{case.name}.h5"
    made_by = program(case.module)
    if path.exists() and not fresh:
        result = load(path)
        made = (result.attrs.get("request"), result.attrs.get("program"))
        if made == (case.request(), made_by):
            print(f"{case.name}: reused from {path}", flush=True)
            return result
    print(f"{case.name}: running", flush=True)
    start = time.perf_counter()
    result = case.simulate()
    if result.attrs["stopped"].startswith("interrupted"):
        raise KeyboardInterrupt(result.attrs["stopped"])
    seconds = time.perf_counter() - start
    result.to_xarray().attrs.update(request=case.request(), program=made_by, seconds=seconds)
    _save(result, path)
    print(f"{case.name}: {seconds:.1f} s, {result.attrs['stopped']}", flush=True)
    return result


@cache
def program(module: str) -> str:
    """A fingerprint of a source of `jdsmc`, of `run`, and of all that they import from it."""
    found: set[Path] = set()
    waiting = [PACKAGE / module, PACKAGE / "run.py"]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += _imported(path)
    text = b"".join(path.read_bytes() for path in sorted(found) if path.name not in OUTSIDE)
    return hashlib.sha256(text).hexdigest()[:16]


def _imported(path: Path) -> list[Path]:
    """Sources that the relative imports of a source name."""
    sources = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = path.parents[node.level - 1].joinpath(*(node.module or "").split("."))
            names = [base, *(base / alias.name for alias in node.names)]
            sources += [p for p in (n.with_suffix(".py") for n in names) if p.is_file()]
    return sources


def _save(result: Result, path: Path) -> None:
    """Write under another name first, so that a half-written file is never taken for a result."""
    partial = path.with_suffix(".partial.h5")
    result.save(partial, overwrite=True)
    partial.replace(path)
