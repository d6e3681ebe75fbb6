"""Wall time and memory as the particles and the realizations grow, and what a sweep costs.

Every size runs in a fresh process on all cores. Time: `Engine.advance`, one chunk of 64 steps with
its measurements, after two chunks that compile and warm up; expected to grow in proportion to the
number of particles of all gases together. Memory: the peak of the resident set size of the process
(getrusage), compiler and Python included; per particle: its growth from the smallest size of the
series over the growth of the number of particles.

Sweep: points of restitution in one batch. The compiler's own clock (jax.monitoring) counts what is
compiled and for how long: one program for any number of points, none for other values of alpha.
"""

import resource
import sys

import numpy as np
from jax import monitoring

from jdsmc.running.engine import Engine
from jdsmc.running.run import LEAST_REALIZATIONS
from jdsmc.sweep import points as points_of

from . import flow
from .timing import say, seconds, summary
from .worker import call

RESTITUTION = 0.9
COMPILING = (
    "/jax/core/compile/jaxpr_trace_duration",
    "/jax/core/compile/jaxpr_to_mlir_module_duration",
    "/jax/core/compile/backend_compile_duration",
)


def measure(quick: bool) -> dict:
    """Both series and the sweep."""
    sizes = [10**k for k in ((3, 4) if quick else (3, 4, 5, 6))]
    copies = [8, 40] if quick else [8, 40, 400, 4000]
    points = [1, 2] if quick else [1, 2, 4, 8, 16]
    repeats = 3 if quick else 5
    return {
        "particles": _series([(n, LEAST_REALIZATIONS) for n in sizes], repeats),
        "realizations": _series([(1_000, r) for r in copies], repeats),
        "sweep": call("scaling:sweep", points=points, repeats=repeats),
    }


def _series(sizes: list[tuple[int, int]], repeats: int) -> list[dict]:
    rows = [call("scaling:chunk", n_particles=n, realizations=r, repeats=repeats) for n, r in sizes]
    first = rows[0]
    for row in rows[1:]:
        particles = row["particles"] - first["particles"]
        row["bytes_per_particle"] = (row["peak_bytes"] - first["peak_bytes"]) / particles
    return rows


def chunk(n_particles: int, realizations: int, repeats: int) -> dict:
    """Time and memory of chunks of one size. Runs in a fresh process."""
    engine = _engine(RESTITUTION, realizations, n_particles)
    for _ in range(2):
        engine.advance()
    particles = n_particles * realizations
    repeats = repeats if particles > 50_000 else 5 * repeats  # short ones scatter more
    times = summary([seconds(engine.advance) for _ in range(repeats)])
    steps = particles * flow.STEPS_PER_RECORD * flow.RECORDS_PER_CHUNK
    say(f"scaling: N = {n_particles} x {realizations}: {times['median']:.4f} s a chunk")
    return {
        "n_particles": n_particles,
        "realizations": realizations,
        "particles": particles,
        "seconds_per_chunk": times,
        "ns_per_particle_step": {
            name: 1e9 * times[name] / steps for name in ("median", "least", "largest")
        },
        "peak_bytes": peak_bytes(),
    }


def peak_bytes() -> int:
    """Peak of the resident set size of this process so far."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else 1024 * peak


def sweep(points: list[int], repeats: int) -> list[dict]:
    """Compiling and running as points are added, then with other values at the last number."""
    compiled: list[tuple[str, float]] = []
    monitoring.register_event_duration_secs_listener(
        lambda name, duration, **_: compiled.append((name, duration))
    )
    cases = [(n, np.linspace(0.5, 0.95, n)) for n in points]
    cases.append((points[-1], np.linspace(0.55, 0.9, points[-1])))
    rows = []
    for number, alphas in cases:
        compiled.clear()
        engines = []

        def start(engines=engines, alphas=alphas):
            engines.append(_engine(alphas, LEAST_REALIZATIONS, 1_000))
            engines[0].advance()

        first = seconds(start)
        spent = [duration for name, duration in compiled if name in COMPILING]
        programs = sum(name == COMPILING[-1] for name, _ in compiled)
        times = [seconds(engines[0].advance) for _ in range(3 * repeats)]
        rows.append(
            {
                "points": number,
                "same_shape_as_before": len(rows) > 0 and rows[-1]["points"] == number,
                "first_chunk_seconds": first,
                "compile_seconds": float(sum(spent)),
                "programs": programs,
                "seconds_per_chunk": summary(times),
            }
        )
        say(f"scaling: sweep of {number} points: {sum(spent):.2f} s compiling")
    return rows


def _engine(restitution, realizations: int, n_particles: int) -> Engine:
    scenes, _ = points_of(flow.sheared_gas(restitution))
    return Engine(scenes, realizations, 0, flow.options(n_particles))
