"""Collisions per second of event-driven molecular dynamics, sampling and rescaling included.

    python -m benchmarks.molecular_dynamics [--density 0.01] [--seconds 3]

Each thread runs realizations of its own in the stationary representation (α = 0.9, a sample every
0.7 τ0, rescaled every 8). Compiling and 20 samples come before the clock. `per wall second` counts
all threads together; `per processor second` is what a core does when it has one to itself, and is
the one to compare on a busy machine. A sequential C++ program: 3.8 to 4.9e5 per processor second.
"""

import argparse
import time
from concurrent.futures import ThreadPoolExecutor

from jdsmc import events
from jdsmc.events import system as at

from .timing import facts, say

RESTITUTION, GROWTH_RATE, INTERVAL = 0.9, 0.0419, 0.7  # μ = ζ(T0)/2 by eqs. 12 and 13


def run(system: events.System, n_samples: int) -> events.System:
    """The system after some samples."""
    return events.advance_scaled(system, RESTITUTION, GROWTH_RATE, INTERVAL, n_samples)[0]


def measure(n_particles: int, density: float, n_threads: int, seconds: float) -> dict:
    """Rates of one realization per thread, for about the given time at 4e5 collisions a second."""
    n_samples = max(int(seconds * 4e5 / (0.44 * INTERVAL * n_particles)), 1)
    begin = [run(events.start(n_particles, density, seed), 20) for seed in range(n_threads)]
    wall, processor = time.perf_counter(), time.process_time()
    with ThreadPoolExecutor(n_threads) as pool:
        end = list(pool.map(lambda system: run(system, n_samples), begin))
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    counts = sum(after.counts - before.counts for before, after in zip(begin, end, strict=True))
    collisions = counts[at.COLLISIONS]
    return {
        "per_wall_second": collisions / wall,
        "per_processor_second": collisions / processor,
        "crossings_per_collision": counts[at.CROSSINGS] / collisions,
        "outdated_per_collision": counts[at.OUTDATED] / collisions,
        "faults": sum(sum(events.faults(system).values()) for system in end),
    }


def main() -> None:
    """Print one line per number of disks and of threads."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--density", type=float, default=0.01, help="nσ²")
    parser.add_argument("--seconds", type=float, default=3.0, help="of each measurement, about")
    options = parser.parse_args()
    say(facts())
    say("disks  threads  per wall second  per processor second  crossings  outdated  faults")
    for n_particles in (1000, 3000):
        for n_threads in (1, 2):
            rates = measure(n_particles, options.density, n_threads, options.seconds)
            say(
                f"{n_particles:5d}  {n_threads:7d}  {rates['per_wall_second']:15.3g}  "
                f"{rates['per_processor_second']:20.3g}  {rates['crossings_per_collision']:9.2f}  "
                f"{rates['outdated_per_collision']:8.2f}  {rates['faults']:6d}"
            )


if __name__ == "__main__":
    main()
