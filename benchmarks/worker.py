"""Call one function of the benchmarks in a fresh process, on one core or on all.

A thread pool is sized when it is made, so the process limits itself to its cores before it imports
anything: XLA, numba and BLAS then see no others. Answers travel through a file, progress through
the standard output. Run as `python -m benchmarks.worker MODULE:FUNCTION ARGUMENTS CORES FILE`.
"""

import importlib
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def call(function: str, *, cores: int | None = None, on_cpu: bool = True, **arguments):
    """The answer of "module:function" to `arguments`, from a fresh process.

    `cores`: how many the process may use, all if None; `on_cpu`: keep JAX off accelerators.
    """
    environment = dict(os.environ)
    environment.pop("JAX_COMPILATION_CACHE_DIR", None)  # else a compile time may be a read
    if on_cpu:
        environment["JAX_PLATFORMS"] = "cpu"
    with tempfile.TemporaryDirectory() as folder:
        answer = Path(folder) / "answer.json"
        request = [f"benchmarks.{function}", json.dumps(arguments), str(cores or 0), str(answer)]
        command = [sys.executable, "-m", "benchmarks.worker", *request]
        subprocess.run(command, env=environment, cwd=ROOT, check=True)
        return json.loads(answer.read_text())


def limit_cores(number: int) -> None:
    """Keep this process on the last `number` of its cores (0: on all), where the system can."""
    if number and hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[-number:])


def main() -> None:
    """Do what `call` asked."""
    function, arguments, cores, answer = sys.argv[1:]
    limit_cores(int(cores))
    module, name = function.split(":")
    result = getattr(importlib.import_module(module), name)(**json.loads(arguments))
    Path(answer).write_text(json.dumps(result))


if __name__ == "__main__":
    main()
