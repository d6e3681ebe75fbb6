"""Collisions per second on one core, jdsmc against the sequential peer, in the steady state.

Flow: alpha = 0.9, a tau0 = 4. All contestants live in one process that is pinned to one core. For
each mode of the peer, jdsmc and the peer take turns (A B A B ...), about `collisions` collisions a
turn; a ratio is that of neighbouring turns, so that slow changes of the machine cancel. Compiling
and settling come before the first turn. The peer's clock stops outside its compiled loop; ours
includes the calls from Python.

Contestants of jdsmc: `bare step` scans `scene.step` without measurement, `run machinery` calls
`Engine.advance` at the default `steps_per_record` (moments every 8 steps, histograms every 64,
transfer to the host), both with 1 or more realizations in one batch. A candidate is a pair that is
tried against the majorant; jdsmc's machinery does not report their number. The peer starts every
turn with the majorant 5 v0(T) and never gets to carry the larger one of a long run.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from jdsmc import sweep
from jdsmc.running.engine import Engine

from . import flow
from .peer_numba import simulate
from .timing import say, seconds, summary
from .worker import call

RESTITUTION = 0.9
SETTLING_TIME = 12.0  # τ0; the steady state is reached in about 9
PEER_MODES = [(dt, mode) for dt in (0.1, 0.001) for mode in ("deferred", "every_step")]


class Turn(NamedTuple):
    """One measurement of a contestant; `candidates` is NaN where it is not known."""

    seconds: float
    accepted: float
    candidates: float


class Contestant(NamedTuple):
    """A name and a way to take a turn."""

    code: str
    name: str
    turn: Callable[[], Turn]


def measure(quick: bool) -> dict:
    """Both sizes, each in a process of its own."""
    repeats, collisions = (2, 1e5) if quick else (7, 2e6)
    cases = [(10_000, [1, 8]), (250_000, [1])]
    if quick:
        cases = [(1_000, [1, 8])]
    common = {"repeats": repeats, "collisions": collisions}
    return {
        "sizes": [
            call("throughput:compare", cores=1, n_particles=n, batches=batches, **common)
            for n, batches in cases
        ]
    }


def compare(n_particles: int, batches: list[int], repeats: int, collisions: float) -> dict:
    """All contestants at one number of particles. Runs in the pinned process."""
    say(f"throughput: N = {n_particles}, settling and compiling")
    ours = [make(n_particles, gases, collisions) for make in (bare, machinery) for gases in batches]
    turns: dict[str, list[Turn]] = {one.name: [] for one in ours}
    peers, pairs = [], []
    for time_step, streaming in PEER_MODES:
        rival = peer(n_particles, time_step, streaming, collisions)
        rounds = [_round([*ours, rival], turns) for _ in range(repeats)]
        peers.append(_row(rival, [each[rival.name] for each in rounds]))
        pairs += [_pair(one, rival, rounds) for one in ours]
        say(f"throughput: N = {n_particles}, against {rival.name}: {_median(pairs[-len(ours)])}")
    rows = [_row(one, turns[one.name]) for one in ours] + peers
    return {"n_particles": n_particles, "rows": rows, "pairs": pairs}


def _round(contestants: list[Contestant], turns: dict[str, list[Turn]]) -> dict[str, Turn]:
    """One turn of each, ours also added to `turns`."""
    done = {one.name: one.turn() for one in contestants}
    for name, earlier in turns.items():
        earlier.append(done[name])
    return done


def _row(contestant: Contestant, turns: list[Turn]) -> dict:
    times, accepted, candidates = (np.array(column) for column in zip(*turns, strict=True))
    row = {
        "code": contestant.code,
        "name": contestant.name,
        "collisions_per_second": summary(accepted / times),
        "ns_per_collision": summary(1e9 * times / accepted),
    }
    if np.all(candidates > 0):
        row["ns_per_candidate"] = summary(1e9 * times / candidates)
        row["acceptance"] = float(np.sum(accepted) / np.sum(candidates))
    return row


def _pair(one: Contestant, rival: Contestant, rounds: list[dict[str, Turn]]) -> dict:
    """Collisions per second of ours over those of the peer, round by round."""
    ratios = [
        (r[one.name].accepted / r[one.name].seconds)
        / (r[rival.name].accepted / r[rival.name].seconds)
        for r in rounds
    ]
    return {"ours": one.name, "peer": rival.name, "speed_ratio": summary(ratios)}


def _median(pair: dict) -> str:
    return f"{pair['ours']} is {pair['speed_ratio']['median']:.2f} times as fast"


def bare(n_particles: int, gases: int, collisions: float) -> Contestant:
    """The step alone; the number of steps that makes `collisions` is found by trying."""
    gas = flow.BareGas(n_particles, gases, seed=1)
    accepted, _ = gas.advance(16)
    steps = max(1, round(16 * collisions / accepted))
    gas.advance(steps)  # compiles

    def turn() -> Turn:
        counts: list[float] = []
        elapsed = seconds(lambda: counts.extend(gas.advance(steps)))
        return Turn(elapsed, *counts)

    return Contestant("jdsmc", f"bare step, {_number(gases)}", turn)


def machinery(n_particles: int, gases: int, collisions: float) -> Contestant:
    """Chunks of the engine as `jdsmc.run` makes them."""
    engine = started_engine(n_particles, gases, flow.options(n_particles))

    def turn() -> Turn:
        accepted, elapsed = 0.0, 0.0
        while accepted < collisions:
            records = []
            elapsed += seconds(lambda records=records: records.append(engine.advance()[0]))
            accepted += float(np.sum(records[0].tally.accepted))
        return Turn(elapsed, accepted, np.nan)

    return Contestant("jdsmc", f"run machinery, {_number(gases)}", turn)


def started_engine(n_particles: int, gases: int, options) -> Engine:
    """An engine whose gases are steady."""
    scenes, _ = sweep.points(flow.sheared_gas(RESTITUTION))
    engine, time = Engine(scenes, gases, 1, options), 0.0
    while time < SETTLING_TIME:
        record, _ = engine.advance()
        time += float(np.mean(np.sum(record.elapsed, axis=2)))
    return engine


def peer(n_particles: int, time_step: float, streaming: str, collisions: float) -> Contestant:
    """The sequential code, continued from its own steady state with a new seed at every turn."""
    gas = (n_particles, RESTITUTION, flow.SHEAR_RATE)
    settings = {"record_every": 16, "streaming": streaming}
    start = simulate(*gas, SETTLING_TIME, 1, time_step=0.1, **settings).velocity
    trial = simulate(*gas, 0.05, 2, time_step=time_step, start=start, **settings)
    duration = float(trial.time[-1] * collisions / trial.accepted)
    seeds = iter(range(3, 10_000))

    def turn() -> Turn:
        run = simulate(*gas, duration, next(seeds), time_step=time_step, start=start, **settings)
        return Turn(run.seconds, run.accepted, run.candidates)

    return Contestant("peer", f"{streaming}, dt = {time_step:g} τ", turn)


def _number(gases: int) -> str:
    return f"{gases} realization{'s' if gases > 1 else ''}"
