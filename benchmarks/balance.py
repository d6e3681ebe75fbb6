"""What it gains to take the noise of collisions out of the sheared gas's second moments.

    python -m benchmarks.balance        # writes benchmarks/results/balance.md

Variance: of one run of many realizations, analysed with the balance of its moments and without it.
Time: CPU seconds of a whole record, steps of both kinds in turn. Gain: the product of both ratios.
Then whole runs of `jdsmc.run(scene)` at all defaults, until 0.1%, each compiled before.
"""

import time
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres, sweep
from jdsmc.running.engine import Engine
from jdsmc.running.estimates import averages_to_print, estimates_of
from jdsmc.scenarios import Options, UniformShear

from .timing import facts, say

RESULTS = Path(__file__).parent / "results" / "balance.md"
RESTITUTIONS = (0.5, 0.7, 0.9)
NAMES = {"shear_stress": "-P_xy/nT", "normal_stress_xy": "(P_xx-P_yy)/nT", "temperature": "T"}
REALIZATIONS, PARTICLES = 64, 2_560
ROUNDS, SEEDS = 16, 7


class Plain(UniformShear):
    """The same gas with its time averages as they are."""

    balanced = False


def gain_of_variance(alpha: float) -> dict[str, float]:
    """Variance without over variance with the balance, by observable."""
    result = jdsmc.run(
        UniformShear(InelasticHardSpheres(alpha), 4.0),
        n_particles=PARTICLES,
        n_realizations=REALIZATIONS,
        collisions=12.0 / (1 - alpha**2) + 100.0,
        progress=False,
    )
    assert result.under_way is not None
    session = result.under_way.session
    means, blocks = averages_to_print(session.history, 0, int(session.tracker.start[0]))
    assert blocks is not None
    kinds = [(means, blocks), tuple(_plain(averages) for averages in (means, blocks))]
    scene = session.history.scenes[0]
    ours, plain = (estimates_of(scene, *kind, tuple(NAMES))[1] for kind in kinds)
    return {name: float((plain[name] / ours[name]) ** 2) for name in NAMES}


def _plain(averages: dict) -> dict:
    return {name: x for name, x in averages.items() if not name.startswith("balance")}


def ratio_of_time(alpha: float, n_particles: int) -> float:
    """CPU time of a chunk with the balance over that without: the median of rounds."""
    sizes = Options.checked(n_particles, 0.05, "strang", "float32", 16)
    engines = [
        Engine(sweep.points(kind(InelasticHardSpheres(alpha), 4.0))[0], 8, 0, sizes)
        for kind in (Plain, UniformShear)
    ]
    rounds = [[_cpu_seconds(one.advance) for one in engines] for _ in range(ROUNDS)]
    plain, ours = np.array(rounds[ROUNDS // 4 :]).T
    return float(np.median(ours / plain))


def _cpu_seconds(work) -> float:
    begin = time.process_time()
    work()
    return time.process_time() - begin


def whole_runs(alpha: float) -> list[tuple[float, float]]:
    """CPU seconds until 0.1%, and collisions per particle, medians: plain averages from T0, those
    without noise from T0, and from the kinetic model's steady state."""
    found = []
    for kind, start in (
        *((Plain, "equilibrium"), (UniformShear, "equilibrium")),
        (UniformShear, "steady"),
    ):
        scene = kind(InelasticHardSpheres(alpha), 4.0, start)
        jdsmc.run(scene, collisions=1.0, progress=False)
        each = []
        for seed in range(SEEDS):
            begin = time.process_time()
            result = jdsmc.run(scene, seed=seed, progress=False)
            last = float(result.series["collisions"].values[-1])
            each.append((time.process_time() - begin, last))
        found.append(tuple(np.median(each, axis=0)))
    return found


def main() -> None:
    """Two tables."""
    gains, runs = [], []
    for alpha in RESTITUTIONS:
        variance = gain_of_variance(alpha)
        cost = ratio_of_time(alpha, 20_000)
        small = ratio_of_time(alpha, 5_120)
        each = " | ".join(f"{variance[name]:.1f}" for name in NAMES)
        gain = variance["shear_stress"] / small
        gains.append(f"| {alpha:g} | {each} | {cost:.2f} | {small:.2f} | {gain:.1f} |")
        parts = [f"{x:.2f} | {c:.0f}" for x, c in whole_runs(alpha)]
        runs.append(f"| {alpha:g} | {' | '.join(parts)} |")
        say(gains[-1] + "\n" + runs[-1])
    columns = " | ".join(f"variance of {symbol}" for symbol in NAMES.values())
    text = [
        "# The noise of collisions taken out of a sheared gas",
        "",
        f"Made by `python -m benchmarks.balance`; {facts()}.",
        "",
        "Variance of the plain time averages over that without the noise (one run of "
        f"{REALIZATIONS} realizations, {PARTICLES} particles: good to 20%); CPU time of a record "
        "with the balance over that without, for 20000 and 5120 particles; the gain for -P_xy/nT "
        "at 5120, the default.",
        "",
        f"| α | {columns} | time, 20000 | time, 5120 | gain |",
        "|---|---|---|---|---|---|---|",
        *gains,
        "",
        "`jdsmc.run(scene)` at its defaults, until -P_xy/nT is known to 0.1%: CPU seconds with the "
        "warm-up, and collisions per particle; of plain averages, without the noise, and so from "
        '`initial_state = "steady"`. Half of such a run is warm-up, which no estimator shortens.',
        "",
        "| α | plain: CPU s | collisions | without noise: CPU s | collisions "
        "| and from near: CPU s | collisions |",
        "|---|---|---|---|---|---|---|",
        *runs,
        "",
    ]
    RESULTS.write_text("\n".join(text))


if __name__ == "__main__":
    main()
