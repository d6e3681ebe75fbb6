"""From nothing to a result: importing, compiling, first result, each in fresh processes.

`process`: wall time of a whole Python process that imports jdsmc, runs a sheared gas at the
defaults of `jdsmc.run` until its own standard error is 0.1%, and ends (alpha = 0.9, a tau0 = 4).
The stages are timed inside it. `compile`: what the compiler's clock (jax.monitoring) counts in it.
The peer's compilation, also without a cache, is measured in the part on precision.
"""

import subprocess
import sys
from time import perf_counter

from .timing import say, seconds, summary
from .worker import call


def measure(quick: bool) -> dict:
    """Median of three processes (quick: one)."""
    size = {"n_particles": 1_000, "rtol": 0.05} if quick else {"n_particles": 20_000, "rtol": 1e-3}
    processes = []
    for _ in range(1 if quick else 3):
        begin = perf_counter()
        stages = call("startup:first_result", **size)
        processes.append(stages | {"process": perf_counter() - begin})
        say(f"startup: first result after {processes[-1]['process']:.1f} s")
    empty = [seconds(_start_python) for _ in range(len(processes))]
    table = {name: summary([one[name] for one in processes]) for name in processes[0]}
    return table | {"python": summary(empty)}


def _start_python() -> None:
    subprocess.run([sys.executable, "-c", "pass"], check=True)


def first_result(n_particles: int, rtol: float) -> dict:
    """Stages of a fresh process; this module imports nothing of jdsmc before."""
    begin = perf_counter()
    import jdsmc  # noqa: PLC0415 - timed

    imported = perf_counter()
    from jax import monitoring  # noqa: PLC0415 - loaded by jdsmc

    compiled: list[float] = []
    monitoring.register_event_duration_secs_listener(
        lambda name, duration, **_: compiled.append(duration) if "/compile/" in name else None
    )
    gas = jdsmc.InelasticHardSpheres(0.9)
    scene = jdsmc.scenarios.UniformShear(gas, 4.0)
    jdsmc.run(scene, n_particles=n_particles, rtol=rtol, progress=False)
    return {
        "import": imported - begin,
        "run": perf_counter() - imported,
        "compile": sum(compiled),
    }
