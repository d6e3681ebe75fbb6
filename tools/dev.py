"""Set up and run the project: `python3 tools/dev.py demo`, `... test`, `... docs`.

Needs nothing but Python 3.11 or newer. Makes a virtual environment in .venv with the newest Python
that works (newer Pythons get a newer, faster JAX), installs the project into it, and runs the task.
"""

import argparse
import glob
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OLDEST = (3, 11)
NEWEST = 20
"""Minor versions to look for, up to this one."""


def main() -> int:
    """Parse the task, set up, run it; the exit status of the task."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=("demo", "test", "docs", "install"))
    parser.add_argument("--oldest", action="store_true", help="use the oldest Python that works")
    options, rest = parser.parse_known_args()
    extra = {"demo": "", "docs": "[docs]"}.get(options.task, "[dev]")
    python = environment(ROOT / (".venv-oldest" if options.oldest else ".venv"), extra, options)
    tests = pytest if options.oldest else test
    tasks = {"demo": demo, "test": tests, "docs": docs, "install": lambda *_: 0}
    return tasks[options.task](python, rest)


def demo(python: Path, rest: list[str]) -> int:
    """A sheared granular gas until it is steady: table and picture."""
    (ROOT / "output").mkdir(exist_ok=True)
    picture = str(ROOT / "output" / "sheared_gas.png")
    command = [python, "-m", "jdsmc", "run", "shear", "--plot", picture]
    return call([*command, "--restitution", "0.9", "--shear-rate", "4", *rest])


def test(python: Path, rest: list[str]) -> int:
    """Style, types and tests; the first failure ends it."""
    steps = [
        ["-m", "ruff", "check", "."],
        ["-m", "ruff", "format", "--check", "."],
        ["-m", "pyright", "--pythonpath", python],
    ]
    failed = next((status for step in steps if (status := call([python, *step]))), 0)
    return failed or pytest(python, rest)


def docs(python: Path, rest: list[str]) -> int:
    """The pages as HTML in site/; a warning is an error."""
    shutil.rmtree(ROOT / "docs" / "made", ignore_errors=True)
    strict = ["--quiet", "--fail-on-warning", "--keep-going", "--fresh-env"]
    failed = call([python, "-m", "sphinx", *strict, *rest, "docs", "site"])
    print("Failed." if failed else f"Open {ROOT / 'site' / 'index.html'} in a browser.")
    return failed


def pytest(python: Path, rest: list[str]) -> int:
    """The tests alone (style and types were checked with the newest Python), a process a core."""
    side_by_side = ["-n", "auto", "--maxprocesses", "4"]
    side_by_side += ["--dist", "loadscope", "--no-loadscope-reorder"]
    return call([python, "-m", "pytest", "-q", "-m", "not slow", *side_by_side, *rest])


def call(command) -> int:
    """Run in the project's folder; Ctrl-C reaches the command, which answers it."""
    print("$", *(os.path.relpath(c, ROOT) if Path(c).is_absolute() else c for c in command))
    sys.stdout.flush()
    process = subprocess.Popen(command, cwd=ROOT)
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:
            continue


def environment(folder: Path, extra: str, options) -> Path:
    """The Python of a virtual environment with the project and an extra installed."""
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    stamp = folder / "installed"
    project = hashlib.sha256((ROOT / "pyproject.toml").read_bytes()).hexdigest()
    wanted = extra + project
    present = stamp.read_text() if stamp.exists() else ""
    enough = present.endswith(project) and present.startswith((extra, "[dev]"))
    if enough and version(python):
        return python
    if version(python) and present and install(python, extra):
        stamp.write_text(wanted)
        return python
    for interpreter in interpreters(oldest_first=options.oldest):
        print(f"Setting up {folder.name} with Python {'.'.join(map(str, version(interpreter)))}")
        shutil.rmtree(folder, ignore_errors=True)
        made = subprocess.run([interpreter, "-m", "venv", folder], check=False).returncode == 0
        if made and install(python, extra):
            stamp.write_text(wanted)
            return python
    sys.exit("No Python of version 3.11 or newer could install the project; see the errors above.")


def install(python: Path, extra: str) -> bool:
    """Install the project in place, with an extra."""
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    return subprocess.run([*pip, "-e", f"{ROOT}{extra}"], check=False).returncode == 0


def interpreters(*, oldest_first: bool) -> list[str]:
    """Python interpreters of version 3.11 or newer that run, best first, one for each version.

    A name on the PATH may be a shim that does not run, so each is tried.
    """
    names = [f"python3.{minor}" for minor in range(NEWEST, OLDEST[1] - 1, -1)] + ["python3"]
    found = [path for name in names if (path := shutil.which(name))]
    pyenv = os.environ.get("PYENV_ROOT", str(Path.home() / ".pyenv"))
    found += [sys.executable, *glob.glob(f"{pyenv}/versions/3.*/bin/python3")]
    working = {v: path for path in reversed(found) if (v := version(path)) and v >= OLDEST}
    return [working[v] for v in sorted(working, reverse=not oldest_first)]


def version(python) -> tuple[int, int] | None:
    """Major and minor version of a released interpreter, or None if it does not run."""
    code = "import sys; v = sys.version_info; print(v[0], v[1], v[3] == 'final')"
    try:
        run = subprocess.run(
            [python, "-c", code], capture_output=True, text=True, timeout=60, check=True
        )
    except (OSError, subprocess.SubprocessError):
        return None
    major, minor, final = run.stdout.split()
    return (int(major), int(minor)) if final == "True" else None


if __name__ == "__main__":
    sys.exit(main())
