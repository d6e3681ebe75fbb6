"""Speed of the Fourier flow: particle-steps, and wall time until κ* is known to 1%.

Throughput is that of the engine on one core in the steady state, at the paper's size (5000
particles, 100 layers, dt = 0.004) and at 5e5 particles, at the paper's step and at ours; the layers
are summed up after every step, or after every 64.

Ways to find partners in a layer are compared in `pairing.py`.

The time to κ* is that of T_- = 0.05, walls of type I, without gravity, at the point with
𝒩(z0) = 5. Ours: `jdsmc.run` at its defaults on two cores, from the call to the result; the error
reached is scaled to 1% as 1/√(time of the measurement), the warm-up staying as it is. The paper's:
5000 particles, dt = 0.004, collisions after the flight, 200 τ0 of approach and a sample each
0.36 τ0, by the same code; the time of a short piece is multiplied up to the 200 τ0 and to the
measurement that our own noise, error = A/√(N T), says it needs for 1%.
"""

from dataclasses import replace

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres, sweep
from jdsmc.results.gravity_effect import at_equal_gradient
from jdsmc.running.engine import Engine
from jdsmc.scenarios import FourierFlow, Options
from jdsmc.scenarios.options import TIME_STEP

from .pairing import WAYS
from .timing import say, seconds, summary
from .worker import call

CORES, TARGET = 2, 0.01
COLD = 0.05
PAPER = {"particles": 5_000, "time_step": 0.004, "approach": 200.0, "interval": 0.36}
RARE = 64
"""Steps between samples where sampling is not what is timed."""


def measure(quick: bool) -> dict:
    """All parts, each in a process of its own."""
    large = 20_000 if quick else 500_000
    sizes = [(PAPER["particles"], 1), (PAPER["particles"], 8), (large, 1)]
    common = {"repeats": 2 if quick else 7}
    cases = [
        {"n_particles": n, "realizations": r, "time_step": step, "steps": steps}
        for n, r in sizes
        for step in (PAPER["time_step"], TIME_STEP)
        for steps in (RARE, 1)
    ]
    ours = {"duration": 400.0 if quick else 1_600.0, "repeats": 1 if quick else 3}
    piece = {"duration": 0.5 if quick else 4.0, "repeats": 1 if quick else 3}
    return {
        "target": TARGET,
        "throughput": [call("slab:throughput", cores=1, **common, **case) for case in cases],
        "pairing": [
            call("pairing:measure", cores=1, way=way, n_particles=n, **common)
            for n in (PAPER["particles"], large)
            for way in WAYS
        ],
        "ours": call("slab:conductivity", cores=CORES, **ours),
        "paper": call("slab:paper_piece", cores=CORES, **piece),
    }


def _scene():
    return FourierFlow(InelasticHardSpheres(1.0), COLD, np.array([0.0]), layers=100)


def _options(n_particles: int, time_step: float, splitting: str, steps: int) -> Options:
    """One record a chunk, whatever its steps."""
    sizes = (n_particles, time_step, splitting, "float32", steps)
    return replace(Options.checked(*sizes, in_space=True), records=1)


def throughput(
    n_particles: int, realizations: int, time_step: float, steps: int, repeats: int
) -> dict:
    """Time of a particle-step, with a sample after every `steps`."""
    scenes, _ = sweep.points(_scene())
    options = _options(n_particles, time_step, "strang", steps)
    engine = Engine(scenes, realizations, 1, options)
    engine.advance()
    times = np.array([seconds(engine.advance) for _ in range(repeats)])
    made = n_particles * realizations * steps * FourierFlow.samples_per_record
    say(f"N = {n_particles}, {realizations} realizations, dt = {time_step}, every {steps} steps")
    return {
        "n_particles": n_particles,
        "realizations": realizations,
        "time_step": time_step,
        "steps": steps,
        "nanoseconds": summary(1e9 * times / made),
    }


def conductivity(duration: float, repeats: int) -> dict:
    """Runs at the defaults; the first one compiles."""
    runs = {"seconds": [], "value": [], "error": [], "warm_up": [], "noise": []}
    for seed in range(repeats + 1):
        results = []

        def work(seed=seed, results=results):
            options = {"duration": duration, "seed": seed, "progress": False}
            results.append(jdsmc.run(_scene(), **options))

        taken = seconds(work)
        effect = at_equal_gradient(results[0])
        value, error = float(effect["kappa_star"][0]), float(effect["kappa_star_error"][0])
        end = float(results[0].series["time"].values.max())
        start = float(results[0].to_xarray()["steady_from_time"][0])
        attrs = results[0].attrs
        particles = attrs["n_particles"] * attrs["n_realizations"]
        noise = error / value * np.sqrt(particles * (end - start))
        found = taken, value, error, start / end, noise
        for name, number in zip(runs, found, strict=True):
            runs[name].append(float(number))
        say(f"ours: {taken:.1f} s, κ* = {value:.4f} ± {error:.4f}")
    return runs


def paper_piece(duration: float, repeats: int) -> dict:
    """Seconds per particle and τ0 with the paper's parameters; two realizations on two cores."""
    steps = round(PAPER["interval"] / PAPER["time_step"])
    scenes, _ = sweep.points(_scene())
    options = _options(PAPER["particles"], PAPER["time_step"], "lie", steps)
    engine = Engine(scenes, CORES, 1, options)
    engine.advance()
    chunk = FourierFlow.samples_per_record * steps * PAPER["time_step"]
    count = max(1, round(duration / chunk))
    times = [seconds(lambda: [engine.advance() for _ in range(count)]) for _ in range(repeats)]
    each = np.array(times) / (count * chunk * PAPER["particles"] * CORES)
    say(f"paper's parameters: {1e6 * np.median(each):.2f} µs per particle and τ0")
    return {"seconds": summary(each)}
