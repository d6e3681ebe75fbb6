"""Wall time until κ'(0.5) is known to 0.5% on two cores, ours and the paper's way; throughput.

Ours: two fields at the defaults of `jdsmc.run`, extrapolated to ε* -> 0 with ε*². The fields and
the shares of the time are those of `FIELDS`; the measured times are of real runs, from the call to
the result, with compiling and without. The kicks of `jdsmc.transport.navier_stokes`, which give κ,
μ and η as well, are timed one by one.

The paper's: 2e5 particles, 200 realizations, dt = 0.003 τ, the explicit step (4.1), ε* = 0.025, by
the same code. A short piece with few of the realizations is timed in the steady state, steps and
realizations are multiplied up. It must reach the steady state (10 τ) and then average until the
statistical error is 0.5%, by the noise measured in our own run at that field: error = A/√(N T), T
at least 0. Bias of the field and of the step is not held against it here (see
experiments/heat_flux_force for both).
"""

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres, sweep
from jdsmc.running.engine import Engine
from jdsmc.scenarios import HeatFluxForce, Options
from jdsmc.scenarios.options import STEPS_PER_RECORD, TIME_STEP
from jdsmc.transport import navier_stokes

from .timing import say, seconds, summary
from .worker import call

RESTITUTION, CORES = 0.5, 2
TARGET = 5e-3
FIELDS = {0.05: 0.9, 0.1: 0.1}
"""Fields of the extrapolation and their shares of the time: near the best shares, which are as the
weight of a field in the limit times its noise, 4/3 / 0.05 to 1/3 / 0.1."""
PAPER = {"field": 0.025, "time_step": 0.003, "particles": 200_000, "realizations": 200}
APPROACH = 10.0
"""Time to the steady state, in τ0: the paper's."""


def measure(quick: bool) -> dict:
    """All parts, each in a process of its own."""
    ours = {"n_particles": 500 if quick else 20_000, "n_realizations": 8}
    ours |= {"duration": 1_000.0, "repeats": 1 if quick else 3}
    kick = {"n_particles": 2_000 if quick else 100_000, "repeats": 1 if quick else 3}
    piece = {"n_particles": 2_000 if quick else 200_000, "repeats": 2 if quick else 7}
    return {
        "target": TARGET,
        "throughput": [
            call("conductivity:throughput", cores=CORES, scheme=scheme, time_step=step, **piece)
            for scheme, step in (("exact", TIME_STEP), ("paper", PAPER["time_step"]))
        ],
        "ours": call("conductivity:extrapolated", cores=CORES, **ours),
        "noise": call("conductivity:paper_noise", cores=CORES, **ours),
        "kicks": call("conductivity:kicks", cores=CORES, rtol=0.05 if quick else TARGET, **kick),
    }


def throughput(n_particles: int, repeats: int, scheme: str, time_step: float) -> dict:
    """Particle-steps per second of the engine in the steady state, two realizations."""
    gas = InelasticHardSpheres(RESTITUTION)
    scenes, _ = sweep.points(HeatFluxForce(gas, PAPER["field"], scheme))
    options = Options.checked(n_particles, time_step, "strang", "float32", STEPS_PER_RECORD)
    engine = Engine(scenes, CORES, 1, options)
    say(f"throughput: {scheme}, dt = {time_step:g} τ, N = {n_particles}")
    steps = STEPS_PER_RECORD * options.records
    for _ in range(3):  # compiles; a Gaussian costs what the steady state does
        engine.advance()
    times = np.array([seconds(engine.advance) for _ in range(repeats)])
    return {
        "scheme": scheme,
        "time_step": time_step,
        "n_particles": n_particles,
        "particle_steps_per_second": summary(n_particles * CORES * steps / times),
    }


def extrapolated(n_particles: int, n_realizations: int, duration: float, repeats: int) -> dict:
    """Both fields run and extrapolated; the first run compiles.

    `approach`: the share of the time that the approach to the steady states took.
    """
    weights = _weights()
    runs = {"seconds": [], "value": [], "error": [], "approach": []}
    for seed in range(repeats + 1):
        wall, value, variance, approach = 0.0, 0.0, 0.0, 0.0
        for field, share in FIELDS.items():
            sizes = {"n_particles": n_particles, "n_realizations": n_realizations}
            taken, result = _timed(field, duration=share * duration, seed=seed, **sizes)
            ratio = result["modified_conductivity"]
            wall += taken
            approach += float(result.to_xarray()["steady_from_time"]) / duration
            value += weights[field] * ratio.value
            variance += (weights[field] * ratio.error) ** 2
        found = wall, value, variance**0.5, approach
        for name, number in zip(runs, found, strict=True):
            runs[name].append(number)
        say(f"extrapolated: {wall:.1f} s, κ'/κ0 = {value:.4f} ± {variance**0.5:.4f}")
    return runs


def _weights() -> dict[float, float]:
    """Of each field in the limit: v = (x2 v1 - x1 v2)/(x2 - x1), x = ε*²."""
    one, two = (field**2 for field in FIELDS)
    return dict(zip(FIELDS, (two / (two - one), -one / (two - one)), strict=True))


def _timed(field: float, **options):
    results = []
    scene = HeatFluxForce(InelasticHardSpheres(RESTITUTION), field)
    taken = seconds(lambda: results.append(jdsmc.run(scene, progress=False, **options)))
    return taken, results[0]


def paper_noise(n_particles: int, n_realizations: int, duration: float, repeats: int) -> dict:
    """A of the relative error A/√(N T) at the paper's field, from steady runs at the defaults."""
    sizes = {"n_particles": n_particles, "n_realizations": n_realizations}
    squares = []
    for seed in range(repeats + 1):
        _, result = _timed(PAPER["field"], duration=duration, seed=100 + seed, **sizes)
        value, error = result["modified_conductivity"]
        end = float(result.series["time"].values[-1])
        measured = end - float(result.to_xarray()["steady_from_time"])
        squares.append((error / value) ** 2 * n_particles * n_realizations * measured)
    return {"noise": float(np.sqrt(np.mean(squares)))}


def kicks(n_particles: int, rtol: float, repeats: int) -> dict:
    """Single kicks of eight realizations and the error that each leaves in κ'.

    More kicks average; each comes with an approach of its own here, which is counted.
    """
    runs = {"seconds": [], "value": [], "error": [], "approach": []}
    for seed in range(repeats + 1):
        results = []

        def work(seed=seed, results=results):
            gas = InelasticHardSpheres(RESTITUTION)
            options = {"n_particles": n_particles, "n_kicks": 1, "progress": False}
            results.append(navier_stokes(gas, seed=seed, duration=10.0, **options))

        taken = seconds(work)
        value, error = results[0]["modified_conductivity"]
        needed = (error / value / rtol) ** 2
        for name, number in zip(runs, (taken, value, error, 0.0), strict=True):
            runs[name].append(number)
        say(f"kicks: {taken:.1f} s a kick, κ'/κ0 = {value:.4f} ± {error:.4f}, {needed:.1f} needed")
    return runs
