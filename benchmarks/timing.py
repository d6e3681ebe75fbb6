"""What all parts share: a clock, medians with their ranges, and a description of the machine."""

import json
import os
import platform
import statistics
import time
from collections.abc import Callable, Sequence
from importlib import metadata
from pathlib import Path

PACKAGES = ("jdsmc", "jax", "jaxlib", "equinox", "numba", "llvmlite", "numpy")


def seconds(work: Callable[[], object]) -> float:
    """Wall time of one call, which must wait for its own results."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def summary(values: Sequence[float]) -> dict:
    """Median and range of repeated measurements, and the measurements."""
    numbers = [float(value) for value in values]
    return {
        "median": statistics.median(numbers),
        "least": min(numbers),
        "largest": max(numbers),
        "values": numbers,
    }


def say(text: str) -> None:
    """Progress, at once even through a pipe."""
    print(text, flush=True)


def machine() -> dict:
    """Processor and versions, without the name of the host."""
    return {
        "processor": _processor(),
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else None,
        "load_at_start": [round(x, 2) for x in os.getloadavg()] if os.name == "posix" else None,
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        **{name: _version(name) for name in PACKAGES},
    }


def facts() -> str:
    """The same in one line."""
    return ", ".join(f"{name} {value}" for name, value in machine().items())


def _processor() -> str:
    table = Path("/proc/cpuinfo")
    if table.exists():
        for line in table.read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or "unknown"


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def write_json(path: Path, data: dict) -> None:
    """Write under another name first, so that an interrupted run leaves the old file."""
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps(data, indent=1) + "\n")
    partial.replace(path)
