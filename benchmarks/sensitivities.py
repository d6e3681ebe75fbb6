"""Derivatives from one run against differences of two, at equal CPU time.

    python -m benchmarks.sensitivities        # writes benchmarks/results/sensitivities.md

d(-P_xy/nT)/dα and da*/dα of a sheared gas. Each way is compiled by a short run, then timed: CPU
seconds of one process with its warm-up. Differences are central, of runs of the same kind, over the
step that makes their total error least at this cost: what they are off by themselves grows as its
square (2% of -P_xy/nT over ±0.05 at α = 0.85), their noise falls with it. What counts is variance
times time, of twelve seeds each: the mean square of the errors that are printed, and the scatter of
the values, which is known to 20%, a ratio of two variances to a factor of 1.8. The printed errors
are larger than the scatter where one very fast particle decides the averages of high degree.
"""

import time
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import UniformShear

from .timing import facts, say

RESULTS = Path(__file__).parent / "results" / "sensitivities.md"
STEPS = {0.6: 0.035, 0.7: 0.03, 0.85: 0.02}
"""α, and the step either way of differences at it."""
OPTIONS = {"n_particles": 10_240, "n_realizations": 24, "progress": False}
SEEDS = 12
NAMES = {"shear_stress": "-P_xy/nT", "reduced_shear_rate": "a*"}


def scene(alpha) -> UniformShear:
    """A sheared gas, or two."""
    return UniformShear(InelasticHardSpheres(alpha), 1.5)


def measured(what, collisions: float, **options) -> tuple[list, float]:
    """Runs with several seeds after a short one that compiles, and the CPU seconds of one.

    Without a given time, since that would ask for derivatives along the series too.
    """
    jdsmc.run(what, rtol=0.1, **OPTIONS, **options)
    begin = time.process_time()
    runs = [
        jdsmc.run(what, budget=collisions, rtol=1e-7, seed=seed, **OPTIONS, **options)
        for seed in range(1, SEEDS + 1)
    ]
    return runs, (time.process_time() - begin) / SEEDS


def difference(result, name: str, step: float) -> tuple[float, float, float]:
    """The derivative from two points of a sweep, its error, and no truncation."""
    value, error = result[name]
    return (value[1] - value[0]) / (2 * step), float(np.hypot(*error)) / (2 * step), 0.0


def main() -> None:
    """One table."""
    rows = []
    for alpha, step in STEPS.items():
        warm_up = 12.0 / (1 - alpha**2)
        ours, seconds = measured(scene(alpha), warm_up + 120.0, sensitivity="restitution")
        pairs, of_two = measured(scene([alpha - step, alpha + step]), warm_up + 200.0)
        for name, symbol in NAMES.items():
            each = [run.sensitivity[name]["restitution"] for run in ours]
            one = summary([(s.value, s.error, s.truncation) for s in each])
            two = summary([difference(run, name, step) for run in pairs])
            gains = [(two[k] / one[k]) ** 2 * of_two / seconds for k in ("error", "scatter")]
            rows.append(
                f"| {alpha:g} | {symbol} | {numbers(one)} | {one['truncation']:.4f} "
                f"| {seconds:.0f} | {numbers(two)} | {of_two:.0f} | {gains[0]:.0f} "
                f"| {gains[1]:.0f} |"
            )
            say(rows[-1])
    head = (
        "# Derivatives with respect to α: one run against central differences\n\n"
        f"Made by `python -m benchmarks.sensitivities`. {OPTIONS['n_particles']} particles, "
        f"{OPTIONS['n_realizations']} realizations; {facts()}. {SEEDS} seeds: their mean, the "
        "error that is printed (root of its mean square), their scatter, and the CPU seconds of "
        "one. Gain: ratio of variance times CPU time, by printed errors and by scatter.\n\n"
        "| α | of | derivative | error | scatter | truncation | CPU s | difference | error "
        "| scatter | CPU s | gain | by scatter |\n"
        f"{'|---' * 13}|\n"
    )
    RESULTS.write_text(head + "\n".join(rows) + "\n")


def summary(each: list[tuple[float, float, float]]) -> dict[str, float]:
    """Of several seeds: mean value, root mean squared error, scatter, mean truncation."""
    value, error, truncation = np.transpose(np.asarray(each, dtype=float))
    return {
        "value": float(np.mean(value)),
        "error": float(np.sqrt(np.mean(error**2))),
        "scatter": float(np.std(value, ddof=1)),
        "truncation": float(np.mean(truncation)),
    }


def numbers(found: dict[str, float]) -> str:
    """Three columns."""
    return " | ".join(f"{found[name]:.4f}" for name in ("value", "error", "scatter"))


if __name__ == "__main__":
    main()
