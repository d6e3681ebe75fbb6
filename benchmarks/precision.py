"""Wall time until -P_xy/nT is known to 0.1%, and how wrong it then is (alpha = 0.7, a tau0 = 4).

jdsmc: `jdsmc.run` at its defaults (until its own standard error is 0.1%), with several seeds, on
one core and on all; the first run of a process compiles, the others do not. Other time steps and
the first-order splitting likewise, on one core.

Peer: eight seeds one after the other on one core, N = 1e4, at the paper's time step 0.001 tau and
at larger ones. It has no test of its own for the steady state: it is given, free of charge, the
number of collisions per particle after which jdsmc (median of its runs) began to measure. Then it
measures for a fixed stretch; its error comes from 8 seeds x 8 blocks (jackknife of a ratio of
means, as in jdsmc).

Common measure: with error e (relative) after m seconds of measurement, a method needs
`cost` = e^2 m seconds for 100%, hence time(0.1%) = warm-up + cost / 0.001^2. This extrapolates as
1/sqrt(time) from the errors reached. jdsmc stops when its estimate of the error is small enough,
so that its cost is, if anything, somewhat underestimated.

Bias: difference from the reference, jdsmc at dt = 0.0125 tau; a discretization error of second
order there is 64 times smaller than at the default step. The peer at 0.001 tau checks it: other
code, other splitting.
"""

import numpy as np

from jdsmc import run, sweep
from jdsmc.running.engine import Engine
from jdsmc.scenarios.options import TIME_STEP
from jdsmc.stats import jackknife

from . import flow
from .peer_numba import simulate
from .timing import say, seconds, summary
from .worker import call

RESTITUTION = 0.7
TARGET = 1e-3
BLOCKS = 8
OUR_STEPS = [
    *((dt, "strang") for dt in (0.025, 0.05, 0.1, 0.2)),
    *((dt, "lie") for dt in (0.025, 0.05, 0.1)),
]
PEER_STEPS = [
    (0.001, "every_step"),
    (0.001, "deferred"),
    (0.01, "deferred"),
    (0.1, "deferred"),
]


def measure(quick: bool) -> dict:
    """Everything; the reference first."""
    ours = {"n_particles": 1_000 if quick else 20_000, "rtol": 1e-2 if quick else TARGET}
    repeats, stretch = (2, 20.0) if quick else (5, 400.0)
    reference = _reference(ours, quick)
    defaults = {
        name: call("precision:ours", cores=cores, repeats=repeats, **ours)
        for name, cores in (("one core", 1), ("all cores", None))
    }
    methods = []
    for time_step, splitting in OUR_STEPS[2::4] if quick else OUR_STEPS:
        kind = {"time_step": time_step, "splitting": splitting}
        if (time_step, splitting) == (TIME_STEP, "strang"):
            runs = defaults["one core"]
        else:
            runs = call("precision:ours", cores=1, repeats=repeats, **ours, **kind)
        methods.append(_judged(_ours_summary(runs) | kind, reference))
    warm_up = float(np.median(defaults["one core"]["warm_up"]))
    for time_step, streaming in PEER_STEPS[1::2] if quick else PEER_STEPS:
        case = {"time_step": time_step, "streaming": streaming, "warm_up": warm_up}
        case |= {"n_particles": 1_000 if quick else 10_000}
        result = call("precision:peer", cores=1, stretch=stretch, **case)
        methods.append(_judged(result, reference))
    return {
        "target": TARGET,
        "warm_up": warm_up,
        "reference": reference,
        "defaults": {name: _default_summary(runs) for name, runs in defaults.items()},
        "methods": methods,
    }


def _reference(case: dict, quick: bool) -> dict:
    precise = case | {"rtol": 5e-3 if quick else 2e-4, "time_step": 0.05 if quick else 0.0125}
    runs = call("precision:ours", repeats=0, **precise)
    return {"value": runs["value"][0], "error": runs["error"][0]}


def ours(
    n_particles: int,
    rtol: float,
    repeats: int,
    time_step: float = TIME_STEP,
    splitting: str = "strang",
) -> dict:
    """`jdsmc.run` in a fresh process: one run that compiles and `repeats` that do not."""
    numerics = {"n_particles": n_particles, "time_step": time_step, "splitting": splitting}
    runs: dict[str, list] = {
        name: []
        for name in ("seconds", "value", "error", "warm_up", "collisions", "mean_step", "chunks")
    }
    for seed in range(repeats + 1):
        results = []

        def work(seed=seed, results=results):
            gas = flow.sheared_gas(RESTITUTION)
            results.append(run(gas, seed=seed, rtol=rtol, progress=False, **numerics))

        runs["seconds"].append(seconds(work))
        tree = results[0].to_xarray()
        value, error = results[0]["shear_stress"]
        collisions = tree["series"]["collisions"].values
        found = {
            "value": value,
            "error": error,
            "warm_up": float(tree["steady_from_collisions"]),
            "collisions": float(collisions[-1]),
            "mean_step": results[0]["time_step"].value,
            "chunks": len(collisions) // flow.RECORDS_PER_CHUNK,
        }
        for name, number in found.items():
            runs[name].append(number)
    say(
        f"precision: jdsmc {splitting}, dt = {time_step:g} τ: "
        f"{np.median(runs['seconds'][1:] or runs['seconds']):.2f} s a run, -P_xy/nT = {value:.5f}"
    )
    chunk = (
        _engine_seconds(n_particles) if (time_step, splitting) == (TIME_STEP, "strang") else np.nan
    )
    return runs | {"n_particles": n_particles, "engine_seconds_per_chunk": chunk}


def _engine_seconds(n_particles: int) -> float:
    """Wall time of a chunk in the engine alone, what is left are history and tests on the host."""
    scenes, _ = sweep.points(flow.sheared_gas(RESTITUTION))
    engine = Engine(scenes, 8, 0, flow.options(n_particles))
    engine.advance()
    return float(np.median([seconds(engine.advance) for _ in range(40)]))


def _default_summary(runs: dict) -> dict:
    """Wall times of the defaults, with and without compiling."""
    later = np.array(runs["seconds"][1:])
    chunks = np.array(runs["chunks"][1:])
    return {
        "first_seconds": runs["seconds"][0],
        "seconds": summary(later),
        "relative_error": summary(np.array(runs["error"]) / np.array(runs["value"])),
        "warm_up_collisions": summary(runs["warm_up"]),
        "collisions": summary(runs["collisions"]),
        "share_outside_engine": summary(1 - chunks * runs["engine_seconds_per_chunk"] / later),
    }


def _ours_summary(runs: dict) -> dict:
    """Warm-up and cost of a method from its runs without compiling; the value from all."""
    wall, value, error, warm_up, total = (
        np.array(runs[name]) for name in ("seconds", "value", "error", "warm_up", "collisions")
    )
    warm_share = (warm_up / total)[1:]
    running = np.median(wall[1:] / total[1:]) * total[0]
    measuring = wall[1:] * (1 - warm_share)
    return {
        "code": "jdsmc",
        "n_particles": runs["n_particles"],
        "mean_step": float(np.mean(runs["mean_step"])),
        "value": float(np.mean(value)),
        "error": float(np.sqrt(np.sum(error**2)) / len(error)),
        "scatter": float(np.std(value, ddof=1) / np.sqrt(len(value))),
        "compile_seconds": float(wall[0] - running),
        "warm_up_seconds": float(np.median(wall[1:] * warm_share)),
        "cost": float(np.mean((error / value)[1:] ** 2 * measuring)),
        "extrapolated_from": float(np.mean(error / value)),
    }


def peer(
    n_particles: int, time_step: float, streaming: str, warm_up: float, stretch: float
) -> dict:
    """Eight seeds of the peer: `warm_up`, then `stretch` collisions per particle of measurement."""
    gas = (n_particles, RESTITUTION, flow.SHEAR_RATE)
    settings = {
        "time_step": time_step,
        "streaming": streaming,
        "record_every": max(8, round(0.16 / time_step)),
    }
    compiling = seconds(lambda: simulate(64, RESTITUTION, flow.SHEAR_RATE, 0.01, 0, **settings))
    parts, warm, measuring = [], 0.0, 0.0
    for seed in range(1, 9):
        begin = simulate(*gas, _duration(gas, warm_up, settings), seed, **settings)
        rest = stretch / _rate(begin)
        run_on = simulate(*gas, rest, 100 + seed, start=begin.velocity, **settings)
        warm, measuring = warm + begin.seconds, measuring + run_on.seconds
        parts.append(_block_means(run_on))
    means = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    value, error, _ = jackknife(means, lambda m: {"stress": m["xy"] / m["temperature"]}, axis=0)
    relative = float(error["stress"] / value["stress"])
    say(
        f"precision: peer {streaming}, dt = {time_step:g} τ: {warm:.2f} s warm-up, "
        f"{measuring:.2f} s measurement, -P_xy/nT = {value['stress']:.5f}"
    )
    return {
        "code": "peer",
        "time_step": time_step,
        "splitting": f"lie, {streaming}",
        "n_particles": n_particles,
        "mean_step": time_step,
        "value": float(value["stress"]),
        "error": float(error["stress"]),
        "compile_seconds": compiling,
        "warm_up_seconds": warm,
        "cost": relative**2 * measuring,
        "extrapolated_from": relative,
    }


def _rate(result) -> float:
    """Collisions per particle and time in the last quarter of a run."""
    first = 3 * len(result.time) // 4
    elapsed = result.time[-1] - result.time[first]
    return float((result.collisions[-1] - result.collisions[first]) / elapsed)


def _duration(gas: tuple, collisions: float, settings: dict) -> float:
    """Time in which a gas at T0 makes so many collisions per particle (a trial run, not timed)."""
    trial_settings = settings | {"time_step": 0.1, "record_every": 8, "streaming": "deferred"}
    trial = simulate(*gas, 2.0 * collisions, 0, **trial_settings)
    return float(np.interp(collisions, trial.collisions, trial.time))


def _block_means(result) -> dict[str, np.ndarray]:
    """Means of -P_xy/n and T over blocks of equal length; ratios come last."""
    edges = np.linspace(0, len(result.time), BLOCKS + 1).astype(int)[:-1]
    lengths = np.diff([*edges, len(result.time)])
    columns = {
        "temperature": result.temperature,
        "xy": result.shear_stress * result.temperature,
    }
    return {name: np.add.reduceat(x, edges) / lengths for name, x in columns.items()}


def _judged(method: dict, reference: dict) -> dict:
    """A method with its bias against the reference and its time until the target."""
    error = np.hypot(method["error"], reference["error"]) / reference["value"]
    return method | {
        "bias": method["value"] / reference["value"] - 1,
        "bias_error": float(error),
        "seconds_to_target": method["warm_up_seconds"] + method["cost"] / TARGET**2,
    }
