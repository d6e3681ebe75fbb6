"""Speed on an accelerator: particle-steps per second and the share of the memory's bandwidth.

Bytes a step must move at least, for one particle in float32, if everything were done in one pass
over the state: the shear reads V_x and V_y of every particle and writes V_x (12 bytes); the
collisions read V_z and write V_y and V_z of the particles in the rows they take (12 bytes times
the share of rows taken, 3/8 at the default step). Random numbers and indices are made from
counters and permutations of rows and need not touch the memory. That is 16.5 bytes; what XLA moves
is more (copies of the rows taken, two half-steps of shear that it may not fuse), so that the share
says how far the step is from the best possible, not how busy the memory is.

The bandwidth is measured here: the best of 10 passes of x + 1 over 1 GiB (2 GiB moved).

Flow: alpha = 0.9, a tau0 = 4, steady. `bare step` and `run machinery` as in `throughput`; one gas,
and the same particles in eight. On a machine without an accelerator there is nothing to measure.
"""

import jax
import jax.numpy as jnp
import numpy as np

from jdsmc import sweep
from jdsmc.running.engine import Engine
from jdsmc.scenarios import Options

from . import flow
from .timing import say, seconds, summary
from .worker import call

RESTITUTION = 0.9
STEPS = flow.STEPS_PER_RECORD * flow.RECORDS_PER_CHUNK


def measure(quick: bool) -> dict:
    """Everything in one process that may use the accelerator."""
    totals = [80_000] if quick else [10**k for k in (5, 6, 7, 8)]
    return call("gpu:on_accelerator", on_cpu=False, totals=totals, repeats=3 if quick else 7)


def on_accelerator(totals: list[int], repeats: int, even_on_cpu: bool = False) -> dict:
    """All sizes, or the word that there is no accelerator. Runs in a fresh process."""
    device = jax.devices()[0]
    if device.platform == "cpu" and not even_on_cpu:
        say("gpu: no accelerator")
        return {"device": None, "rows": []}
    bandwidth = copy_bandwidth(2**20 if even_on_cpu else 2**30)
    say(f"gpu: {device.device_kind}, {bandwidth / 1e9:.0f} GB/s")
    rows = []
    for total in totals:
        for gases in (1, 8):
            rows += _size(total // gases, gases, repeats, bandwidth)
    return {"device": device.device_kind, "bytes_per_second": bandwidth, "rows": rows}


def copy_bandwidth(size: int) -> float:
    """Bytes per second of a kernel that reads and writes an array of `size` bytes."""
    values = jnp.zeros(size // 4, jnp.float32)
    add = jax.jit(lambda x: x + 1.0)
    add(values).block_until_ready()
    return 2 * size / min(seconds(lambda: add(values).block_until_ready()) for _ in range(10))


def least_bytes(options: Options) -> float:
    """Bytes that a step must move for one particle (see above)."""
    plan = options.rows
    taken = (2 * plan.first + plan.second) / plan.rows
    return 12.0 + 12.0 * taken


def _size(n_particles: int, gases: int, repeats: int, bandwidth: float) -> list[dict]:
    rows = []
    for name, make in (("bare step", _bare), ("run machinery", _machinery)):
        advance = make(n_particles, gases)
        times = summary([seconds(advance) for _ in range(repeats)])
        speed = n_particles * gases * STEPS / times["median"]
        moved = speed * least_bytes(flow.options(n_particles))
        say(f"gpu: {name}, N = {n_particles} x {gases}: {speed:.3g} particle-steps/s")
        rows.append(
            {
                "name": name,
                "n_particles": n_particles,
                "gases": gases,
                "seconds_per_chunk": times,
                "particle_steps_per_second": speed,
                "share_of_bandwidth": moved / bandwidth,
            }
        )
    return rows


def _bare(n_particles: int, gases: int):
    """A chunk of bare steps, compiled; ends when its sums are on the host."""
    gas = flow.BareGas(n_particles, gases, seed=1, restitution=RESTITUTION)
    gas.advance(STEPS)
    return lambda: gas.advance(STEPS)


def _machinery(n_particles: int, gases: int):
    """A chunk of the engine, compiled; the gas has settled."""
    scenes, _ = sweep.points(flow.sheared_gas(RESTITUTION))
    engine = Engine(scenes, gases, 1, flow.options(n_particles))
    chunks = flow.SETTLING_RECORDS // flow.RECORDS_PER_CHUNK + 1
    for _ in range(chunks):
        records, _ = engine.advance()
    if not np.all(np.isfinite(records.moments.xx)):
        raise RuntimeError("the velocities are not finite")
    return engine.advance
