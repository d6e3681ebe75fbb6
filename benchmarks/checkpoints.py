"""What a checkpoint costs: `python -m benchmarks.checkpoints [--out FILE]`.

A sheared gas, a sweep of eight with derivatives, and a slab run for a given time with and without a
checkpoint each second, in turns; then the seconds one writing takes, the size of the file, and the
seconds from `jdsmc.resume` to a session that can go on (in a process that has compiled).
"""

import argparse
import statistics
import tempfile
import time
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.running.checkpoint import Keeper
from jdsmc.scenarios import ShearedSlab, UniformShear

from .timing import machine

GAS = InelasticHardSpheres(0.7)
CASES = {
    "shear, N = 20000": (UniformShear(GAS, 4.0), {"collisions": 300.0}),
    "shear, 8 points, derivatives": (
        UniformShear(InelasticHardSpheres(np.linspace(0.5, 0.9, 8)), 4.0),
        {"n_particles": 1024, "collisions": 40.0, "sensitivity": ("restitution",)},
    ),
    "sheared slab, N = 5000": (
        ShearedSlab(GAS, 4.0, 2.5),
        {"n_particles": 5000, "collisions": 20.0},
    ),
}
REPEATS = 3
EVERY = 1.0


def measure(scene, options: dict) -> dict[str, float]:
    """Medians of CPU seconds with and without; seconds to write and to resume; megabytes."""
    times: dict[bool, list[float]] = {False: [], True: []}
    written: list[float] = []
    usual = Keeper.keep

    def keep(self, *arguments):
        began = time.perf_counter()
        usual(self, *arguments)
        written.append(time.perf_counter() - began)

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.h5"
        jdsmc.run(scene, progress=False, **options)  # compiles
        Keeper.keep = keep
        for _ in range(REPEATS):
            for kept, taken in times.items():
                path.unlink(missing_ok=True)
                extra = {"checkpoint": path, "every": EVERY} if kept else {}
                began = time.process_time()
                jdsmc.run(scene, progress=False, **options, **extra)
                taken.append(time.process_time() - began)
        Keeper.keep = usual
        began = time.perf_counter()
        jdsmc.resume(path, progress=False)
        resumed = time.perf_counter() - began
        size = path.stat().st_size / 1e6
    plain, kept = (statistics.median(times[name]) for name in (False, True))
    return {
        "run": plain,
        "more": 100 * (kept / plain - 1),
        "writing": statistics.median(written),
        "size": size,
        "resumed": resumed,
    }


def main() -> None:
    """Measure and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("benchmarks/results/checkpoints.md"))
    given = parser.parse_args()
    lines = [
        "# Checkpoints",
        "",
        f"Made by `python -m benchmarks.checkpoints`; do not edit. {machine()['processor']}, "
        f"{machine()['cores']} cores. A checkpoint each {EVERY:g} s (300 s by default), or as "
        "seldom as makes a hundredth of the time; medians of three runs each, in turns. "
        "Resuming includes assembling the result of a run that had ended.",
        "",
        "| run | CPU (s) | with checkpoints (%) | one writing (s) | file (MB) | resumed in (s) |",
        "|---|---|---|---|---|---|",
    ]
    for name, (scene, options) in CASES.items():
        found = measure(scene, options)
        lines.append(
            f"| {name} | {found['run']:.1f} | {found['more']:+.1f} | {found['writing']:.2f} | "
            f"{found['size']:.1f} | {found['resumed']:.1f} |"
        )
        print(lines[-1], flush=True)
    given.out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
