"""Simulations on disk: made once, saved as they come, reused if they are what is asked for."""

import ast
import hashlib
import json
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path

import jdsmc
from jdsmc import Result, load

PACKAGE = Path(jdsmc.__file__).parent

OUTSIDE = (
    "views",
    "cli",
    "results",
    "files",
    "check.py",
    "running/progress.py",
    "running/provenance.py",
)
"""Sources that decide no number; nor do those that only they import."""


def obtain(case, folder: Path, fresh: bool = False) -> Result:
    """The result of a case: from FOLDER/<name>.h5 if made with the same request and program.

    A case has a `name`; `request()`, all that decides the result but the program, as text;
    `sources()`, modules that the simulation starts from; and `simulate()`.
    Raises KeyboardInterrupt if the run was interrupted (nothing is saved then), and what `simulate`
    raises.
    """
    path = folder / f"{case.name}.h5"
    asked = {"request": case.request(), "program": program(*case.sources())}
    if path.exists() and not fresh:
        try:
            result = load(path)
        except ValueError as error:
            print(error, flush=True)
        else:
            if all(result.attrs.get(name) == value for name, value in asked.items()):
                print(f"{case.name}: reused from {path}", flush=True)
                return result
    print(f"{case.name}: running", flush=True)
    start = time.perf_counter()
    result = case.simulate()
    if result.interrupted:
        raise KeyboardInterrupt(result.attrs["stopped"])
    seconds = time.perf_counter() - start
    result.to_xarray().attrs.update(asked, seconds=seconds)
    result.save(path, overwrite=True)
    print(f"{case.name}: {seconds:.1f} s, {result.attrs['stopped']}", flush=True)
    return result


def kept(path: Path, asked: dict, compute: Callable[[], dict], fresh: bool = False) -> dict:
    """What a computation without `Result` returns (plain data): from a JSON file if as asked."""
    if path.exists() and not fresh:
        found = json.loads(path.read_text())
        if found["asked"] == json.loads(json.dumps(asked)):
            return found["values"]
    print(f"{path.stem}: running", flush=True)
    values = compute()
    path.write_text(json.dumps({"asked": asked, "values": values}, indent=1))
    return values


@cache
def program(*sources: Path) -> str:
    """A fingerprint of some modules and of every module of `jdsmc` that their imports reach."""
    found: set[Path] = set()
    waiting = list(sources)
    while waiting:
        path = waiting.pop()
        if path not in found and not any(path.is_relative_to(PACKAGE / o) for o in OUTSIDE):
            found.add(path)
            waiting += _imported(path)
    text = b"".join(path.read_bytes() for path in sorted(found))
    return hashlib.sha256(text).hexdigest()[:16]


def _imported(path: Path) -> list[Path]:
    """Modules of `jdsmc` that a module imports, anywhere in it.

    `from .ops import collide` means the module `ops/collide.py`, or else whatever `ops/__init__.py`
    re-exports it from: then all that the latter imports.
    """
    sources = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom):
            base = _base(path, node)
            if base is None:
                continue
            for alias in node.names:
                inner = _file(base / alias.name)
                sources.append(inner if inner else _file(base))
        elif isinstance(node, ast.Import):
            parts = [alias.name.split(".") for alias in node.names]
            sources += [_file(PACKAGE.joinpath(*p[1:])) for p in parts if p[0] == PACKAGE.name]
    return [source for source in sources if source]


def _base(path: Path, node: ast.ImportFrom) -> Path | None:
    """What `from ... import` names, without suffix; None outside `jdsmc`."""
    parts = (node.module or "").split(".") if node.module else []
    if node.level:
        base = path.parents[node.level - 1].joinpath(*parts)
        return base if base.is_relative_to(PACKAGE) else None
    return PACKAGE.joinpath(*parts[1:]) if parts[:1] == [PACKAGE.name] else None


def _file(base: Path) -> Path | None:
    """The source of a module or package."""
    return next((p for p in (base.with_suffix(".py"), base / "__init__.py") if p.is_file()), None)
