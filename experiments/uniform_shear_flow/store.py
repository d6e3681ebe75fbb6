"""Simulations on disk: made once, saved as they come, reused if they are what is asked for."""

import hashlib
import time
from dataclasses import replace
from functools import cache
from pathlib import Path

import jdsmc
from jdsmc import Result, load, run

from .systems import Case


def obtain(case: Case, folder: Path, fresh: bool = False) -> Result:
    """The result of a case: from FOLDER/<name>.h5 if made with the same request and program.

    Raises KeyboardInterrupt if the run was interrupted (nothing is saved then), and what `run`
    raises.
    """
    path = folder / f"{case.name}.h5"
    if path.exists() and not fresh:
        result = load(path)
        made = (result.attrs.get("request"), result.attrs.get("program"))
        if made == (case.request(), program()):
            print(f"{case.name}: reused from {path}", flush=True)
            return result
    print(f"{case.name}: running", flush=True)
    start = time.perf_counter()
    result = run(case.scene(), progress=False, **case.options)
    if result.attrs["stopped"].startswith("interrupted"):
        raise KeyboardInterrupt(result.attrs["stopped"])
    seconds = time.perf_counter() - start
    result.to_xarray().attrs.update(request=case.request(), program=program(), seconds=seconds)
    _save(result, path)
    print(f"{case.name}: {seconds:.1f} s, {result.attrs['stopped']}", flush=True)
    return result


def obtain_steady(case: Case, folder: Path, fresh: bool = False) -> tuple[Case, Result]:
    """A case of given length that ends with steady values, made longer until there are some."""
    result = obtain(case, folder, fresh)
    while not result.is_steady:
        options = {**case.options, "collisions": 1.5 * case.options["collisions"]}
        case = replace(case, name=f"{case.name}_longer", options=options)
        result = obtain(case, folder, fresh)
    return case, result


@cache
def program() -> str:
    """A fingerprint of the sources of `jdsmc` that decide a result."""
    folder = Path(jdsmc.__file__).parent
    files = [*sorted(folder.glob("*.py")), folder / "scenarios" / "uniform_shear.py"]
    outside = ("__init__.py", "cli.py", "result.py")
    text = b"".join(path.read_bytes() for path in files if path.name not in outside)
    return hashlib.sha256(text).hexdigest()[:16]


def _save(result: Result, path: Path) -> None:
    """Write under another name first, so that a half-written file is never taken for a result."""
    partial = path.with_suffix(".partial.h5")
    result.save(partial, overwrite=True)
    partial.replace(path)
