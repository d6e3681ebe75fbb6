"""Derivatives from one run against differences of two, at equal CPU time.

    python -m benchmarks.sensitivities        # writes benchmarks/results/sensitivities.md

d(-P_xy/nT)/dα and da*/dα of a sheared gas. Each way is compiled by a short run, then timed: CPU
seconds of one process with its warm-up. Differences are central, of runs of the same kind, over the
step that makes their total error least at this cost: what they are off by themselves grows as its
square (2% of -P_xy/nT over ±0.05 at α = 0.85), their noise falls with it. What counts is variance
times time. The error of 24 realizations is known to 15%.
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
NAMES = {"shear_stress": "-P_xy/nT", "reduced_shear_rate": "a*"}


def scene(alpha) -> UniformShear:
    """A sheared gas, or two."""
    return UniformShear(InelasticHardSpheres(alpha), 1.5)


def timed(what, collisions: float, **options):
    """A run after a short one that compiles, and its CPU seconds.

    Without a given time, since that would ask for derivatives along the series too.
    """
    jdsmc.run(what, rtol=0.1, **OPTIONS, **options)
    begin = time.process_time()
    result = jdsmc.run(what, budget=collisions, rtol=1e-7, seed=1, **OPTIONS, **options)
    return result, time.process_time() - begin


def main() -> None:
    """One table."""
    rows = []
    for alpha, step in STEPS.items():
        warm_up = 12.0 / (1 - alpha**2)
        one, seconds = timed(scene(alpha), warm_up + 120.0, sensitivity="restitution")
        two, of_two = timed(scene([alpha - step, alpha + step]), warm_up + 200.0)
        for name, symbol in NAMES.items():
            ours = one.sensitivity[name]["restitution"]
            value, error = two[name]
            difference = (value[1] - value[0]) / (2 * step)
            its_error = float(np.hypot(*error)) / (2 * step)
            gain = (its_error**2 * of_two) / (ours.error**2 * seconds)
            rows.append(
                f"| {alpha:g} | {symbol} | {ours.value:.4f} | {ours.error:.4f} "
                f"| {ours.truncation:.4f} | {seconds:.0f} | {difference:.4f} | {its_error:.4f} "
                f"| {of_two:.0f} | {gain:.0f} |"
            )
            say(rows[-1])
    head = (
        "# Derivatives with respect to α: one run against central differences\n\n"
        f"Made by `python -m benchmarks.sensitivities`. {OPTIONS['n_particles']} particles, "
        f"{OPTIONS['n_realizations']} realizations; {facts()}. The last column is the ratio of "
        "variance times CPU time.\n\n"
        "| α | of | derivative | error | truncation | CPU s | difference | error | CPU s "
        "| gain |\n|---|---|---|---|---|---|---|---|---|---|\n"
    )
    RESULTS.write_text(head + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
