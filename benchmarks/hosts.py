"""Scaling over processes and parts: `python -m benchmarks.hosts [--out FILE]`.

One run of a sheared gas by one process, and by two on the loopback address, one core each; then the
same realizations in 1 to 8 parts, which are runs of their own with other seeds, merged. Programs
were compiled before. Seconds of the clock, and of CPU time of the process that takes most: the
clock means little where other programs run, and what processes wait for each other counts as CPU
time in part.
"""

import argparse
import json
import os
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.running.hosts import BY_HAND
from jdsmc.scenarios import UniformShear

from .report import grid
from .timing import machine, summary

SCENE = UniformShear(InelasticHardSpheres(0.7), 4.0)
OPTIONS = {"n_particles": 5120, "collisions": 40.0, "progress": False}
REALIZATIONS = 64
PARTS = (1, 2, 4, 8)
REPEATS = 3


def timed(work) -> tuple[float, float]:
    """Seconds of the clock and of CPU time."""
    begin = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - begin[0], time.process_time() - begin[1]


def one_run(n_realizations: int = REALIZATIONS, seed: int = 0) -> jdsmc.Result:
    """The run, or a part of it."""
    return jdsmc.run(SCENE, n_realizations=n_realizations, seed=seed, **OPTIONS)


def worker() -> None:
    """What every process does: run once to compile, then so many times; a line of JSON."""
    jdsmc.join_hosts()
    one_run()
    print(json.dumps([timed(one_run) for _ in range(REPEATS)]))


def processes(count: int, programs: str) -> list[list[float]]:
    """For each repeat, seconds of the clock and CPU time of the process that took most."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{free.getsockname()[1]}"
    started = []
    for rank in range(count):
        told = dict(zip(BY_HAND, (address, str(count), str(rank)), strict=True))
        one_core = {"NPROC": "1", "OPENBLAS_NUM_THREADS": "1", "JDSMC_COMPILATION_CACHE": programs}
        command = [sys.executable, "-m", "benchmarks.hosts", "--worker"]
        environment = os.environ | one_core | (told if count > 1 else {})
        started.append(subprocess.Popen(command, env=environment, stdout=subprocess.PIPE))
    found = [json.loads(one.communicate()[0].splitlines()[-1]) for one in started]
    return [
        [max(values) for values in zip(*each, strict=True)] for each in zip(*found, strict=True)
    ]


def parts(count: int) -> list[float]:
    """CPU time of the longest of so many parts, and of merging them."""
    results: list[jdsmc.Result] = []
    taken = [
        timed(lambda s=seed: results.append(one_run(REALIZATIONS // count, s)))[1]
        for seed in range(count)
    ]
    return [max(taken), timed(lambda: jdsmc.merge(results))[1] if count > 1 else 0.0]


def row(name: str, columns: list, first: float) -> list:
    """Medians and ranges, and how much faster than the first."""
    medians = [summary(column) for column in columns]
    texts = [f"{m['median']:.2f} ({m['least']:.2f}–{m['largest']:.2f})" for m in medians]
    return [name, *texts, f"{first / medians[-1]['median']:.2f}"]


def report() -> str:
    """Measure, and write it down."""
    told = machine()
    with tempfile.TemporaryDirectory() as programs:
        times = {count: processes(count, programs) for count in (1, 2)}
    clock, cpu = ({n: [x[k] for x in times[n]] for n in times} for k in (0, 1))
    first = summary(cpu[1])["median"]
    by_process = [row(str(n), [clock[n], cpu[n]], first) for n in times]
    one_run(REALIZATIONS)
    found = {count: [parts(count) for _ in range(REPEATS)] for count in PARTS}
    whole = summary([sum(one) for one in found[1]])["median"]
    by_part = []
    for count, times_of in found.items():
        longest, merging = ([one[k] for one in times_of] for k in (0, 1))
        both = [sum(one) for one in times_of]
        by_part.append(row(str(count), [longest, merging, both], whole))
    load = ", ".join(map(str, told["load_at_start"] or []))
    head = (
        "# Scaling over processes and parts\n\n"
        "Made by `python -m benchmarks.hosts`; do not edit. "
        f"{told['processor']}, {told['cores']} cores, load {load} at the start (1, 5, 15 minutes). "
        f"A sheared gas, {REALIZATIONS} realizations of {OPTIONS['n_particles']} particles, "
        f"{OPTIONS['collisions']:g} collisions per particle, one core a process; medians of "
        f"{REPEATS}, in brackets the range."
    )
    seconds = ["clock (s)", "CPU time of one (s)", "speed by CPU time"]
    merged = ["CPU time of the longest part (s)", "merging (s)", "both (s)", "speed"]
    return "\n\n".join(
        [
            head,
            "## Processes that share a run\n\n" + grid(["processes", *seconds], by_process),
            "## Parts, one after the other, merged\n\n" + grid(["parts", *merged], by_part),
        ]
    )


def main() -> None:
    """Measure and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("benchmarks/results/hosts.md"))
    parser.add_argument("--worker", action="store_true", help="as a process that is measured")
    given = parser.parse_args()
    if given.worker:
        worker()
    else:
        given.out.write_text(report() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
