"""Memory of a run by its number of particles, each size in a process of its own.

    python -m benchmarks.memory        # writes benchmarks/results/memory.md

Eight realizations; what a process needs without particles is taken off. A run holds all states and
the work space of as many gases as there are cores.
"""

import resource
import subprocess
import sys
from pathlib import Path

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import FourierFlow, ShearedSlab, UniformShear

from .timing import facts

RESULTS = Path(__file__).parent / "results" / "memory.md"
REALIZATIONS = 8
SCENES = {
    "uniform shear": UniformShear(InelasticHardSpheres(0.7), 4.0),
    "sheared slab": ShearedSlab(InelasticHardSpheres(0.7), 4.0),
    "Fourier flow": FourierFlow(InelasticHardSpheres(1.0), 0.5, length=10.0),
}
SIZES = (10_000, 125_000, 1_250_000)
"""Particles of a realization; the first tells what a process needs anyway."""


def peak(name: str, n_particles: int) -> float:
    """Largest memory (bytes) of a short run in another process."""
    line = [sys.executable, "-m", "benchmarks.memory", name, str(n_particles)]
    return float(subprocess.run(line, capture_output=True, check=True, text=True).stdout)


def of_this_process(name: str, n_particles: int) -> float:
    """The same here, after a run of a record."""
    sizes = {"n_particles": n_particles, "n_realizations": REALIZATIONS, "steps_per_record": 1}
    jdsmc.run(SCENES[name], duration=1e-3, progress=False, **sizes)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024.0


def main() -> None:
    """One table."""
    rows = []
    for name in SCENES:
        first, *others = (peak(name, size) for size in SIZES)
        each = [
            f"{(found - first) / (REALIZATIONS * (size - SIZES[0])):.0f}"
            for found, size in zip(others, SIZES[1:], strict=True)
        ]
        rows.append(f"| {name} | {' | '.join(each)} |")
        print(rows[-1], flush=True)
    heads = [f"{REALIZATIONS * size:.0e} particles" for size in SIZES[1:]]
    text = [
        "# Memory, in bytes a particle",
        "",
        f"Made by `python -m benchmarks.memory`. {REALIZATIONS} realizations; {facts()}.",
        "",
        f"| scene | {' | '.join(heads)} |",
        "|---" * (len(heads) + 1) + "|",
        *rows,
    ]
    RESULTS.write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(of_this_process(sys.argv[1], int(sys.argv[2])))
    else:
        main()
