"""What a file tells of the run that made it, so that the run can be made again."""

import contextlib
import dataclasses
import hashlib
import json
import os
import platform
import subprocess
import tomllib
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

import equinox as eqx
import jax
import numpy as np

from .. import sweep
from ..fields import ingredients
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options


def provenance(scene: AbstractScene, options: Options) -> dict:
    """Parameters, switches, options, versions and commit, as attributes of a file."""
    numbers = {
        f"parameter_{name}": value if value.ndim else float(value)
        for name, value in sweep.parameters(scene).items()
    }
    switches = {
        f"option_{path.removeprefix('gas.')}": value if _fits_a_file(value) else str(value)
        for path, value in sweep.statics(scene).items()
    }
    return {
        "jdsmc_version": version(),
        "jax_version": jax.__version__,
        "numpy_version": np.__version__,
        "equinox_version": eqx.__version__,
        "python_version": platform.python_version(),
        "commit": own_commit(),
        "backend": jax.default_backend(),
        "scene": type(scene).__name__,
        "gas_model": type(scene.gas).__name__,
        "specification": json.dumps(specification(scene)),
        **numbers,
        **switches,
        "n_particles": options.n_particles,
        "time_step": options.time_step,
        "steps_per_record": options.steps,
        "splitting": options.splitting,
        "dtype": str(options.dtype),
    }


def _fits_a_file(value) -> bool:
    """True for numbers that NetCDF has: no truth values, no integers of more than 64 bits."""
    if isinstance(value, bool):
        return False
    return isinstance(value, float) or (isinstance(value, int) and abs(value) < 2**63)


def specification(module: Any) -> Any:
    """A scene or gas as plain data: class and fields, enough to build it again."""
    if dataclasses.is_dataclass(module) and not isinstance(module, type):
        return {
            "class": f"{type(module).__module__}:{type(module).__qualname__}",
            "fields": {name: specification(value) for name, value in ingredients(module).items()},
        }
    if isinstance(module, np.ndarray | np.generic | jax.Array):
        return np.asarray(module).tolist()
    if isinstance(module, tuple | list):
        return [specification(one) for one in module]
    if isinstance(module, dict):
        return {name: specification(one) for name, one in module.items()}
    return module


def run_name(scene: AbstractScene, options: Options, seed: int) -> str:
    """A name that results share only if they are of one run, however far it had come."""
    text = json.dumps([specification(scene), repr(options), seed])
    return hashlib.blake2b(text.encode(), digest_size=12).hexdigest()


def version() -> str:
    """Of the installed package; "unknown" in a bare checkout."""
    try:
        return metadata.version("jdsmc")
    except metadata.PackageNotFoundError:
        return "unknown"


@cache
def processor() -> str:
    """A word for the kind of processor: the same program rounds differently on another kind."""
    kind = platform.machine()
    with contextlib.suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        told = next((line for line in lines if line.startswith(("flags", "Features"))), "")
        kind += "-" + hashlib.blake2b(told.encode(), digest_size=4).hexdigest()
    return kind


@cache
def own_commit() -> str:
    """The same of this process, asked once: its code does not change after."""
    return commit()


def commit() -> str:
    """The git commit of the package's own checkout, "+" if changed, or "unknown"."""
    root = Path(__file__).parents[2]
    if not _is_checkout(root):
        return "unknown"
    # a user's GIT_DIR, GIT_INDEX_FILE and the like speak of another repository
    own = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}

    def git(*arguments):
        return subprocess.run(
            ["git", f"--git-dir={root / '.git'}", f"--work-tree={root}", *arguments],
            env=own,
            capture_output=True,
            text=True,
            check=True,
            timeout=5,
        ).stdout.strip()

    try:
        changed = git("status", "--porcelain", "--", str(root / "jdsmc"))
        return git("rev-parse", "HEAD") + ("+" if changed else "")
    except (OSError, subprocess.SubprocessError):
        return "unknown"


def _is_checkout(root: Path) -> bool:
    """True for this project's own, not for a user's that has a copy of the package in it."""
    try:
        project = tomllib.loads((root / "pyproject.toml").read_text())["project"]["name"]
    except (OSError, ValueError, LookupError, TypeError):
        return False
    return project == "jdsmc" and (root / ".git").exists()
