"""Navier-Stokes coefficients three ways at equal cost: pairs at zero field, kicks, a force.

    python -m benchmarks.linear_response            # writes benchmarks/results/linear_response.md

Each way is compiled by a short run, then timed: CPU seconds of one process with its warm-up. What
counts is variance times time: the ratio to that of the pairs is how much longer another way must
run for the same error.
"""

import time
from pathlib import Path

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import HeatFluxForce
from jdsmc.theory import boltzmann
from jdsmc.transport import linear_response, navier_stokes

RESULTS = Path(__file__).parent / "results" / "linear_response.md"
RESTITUTIONS = (0.5, 0.7, 0.9)
NAMES = ("modified_conductivity", "conductivity", "density_coefficient", "viscosity")
PARTICLES = 20_480
COMMON = {"n_particles": PARTICLES, "progress": False}
FIELD = 0.05


def pairs(gas, collisions: float):
    return linear_response(gas, collisions=collisions, **COMMON)


def kicks(gas, number: float):
    return navier_stokes(gas, n_kicks=int(number), kick=0.14, duration=10.0, **COMMON)


def force(gas, collisions: float):
    return jdsmc.run(HeatFluxForce(gas, FIELD), collisions=collisions, time_step=0.1, **COMMON)


WAYS = {
    "pairs": (pairs, 12.0, 60.0),
    "kicks": (kicks, 1, 3),
    f"force, ε = {FIELD:g}": (force, 12.0, 120.0),
}
"""Function, length of the run that compiles, length of the run that is timed."""


def line(alpha: float, way: str, name: str, result, seconds: float, best: dict) -> str:
    """One row of the table."""
    value, error = result[name]
    exact = getattr(boltzmann.navier_stokes(alpha), name)
    merit = error**2 * seconds
    best.setdefault(name, merit)
    shown = f"{100 * (value / exact - 1):+.2f} | {100 * error / exact:.2f}"
    return f"| {alpha:g} | {way} | {name} | {shown} | {seconds:.1f} | {merit / best[name]:.1f} |"


def main() -> None:
    rows = []
    for alpha in RESTITUTIONS:
        gas, best = InelasticHardSpheres(alpha), {}
        for way, (function, short, long) in WAYS.items():
            function(gas, short)
            start = time.process_time()
            result = function(gas, long)
            seconds = time.process_time() - start
            for name in NAMES:
                if name in result:
                    rows.append(line(alpha, way, name, result, seconds, best))
                    print(rows[-1], flush=True)
    RESULTS.write_text(
        "\n".join(
            [
                "# Navier-Stokes coefficients: pairs at zero field, kicks, a force",
                "",
                f"{PARTICLES} particles, 8 realizations, one CPU thread; error and CPU seconds of "
                "one run each.",
                "`off`: from `theory.boltzmann`, in %; `error`: one standard error, in %; `times`: "
                "variance x seconds over that of the pairs, whose error bars (8 realizations) are "
                "known to 25%, so that a ratio is good to a factor of 2. The force is not "
                "extrapolated to zero field. Kicks are followed for 10 τ0: the noise of κ, and "
                "of μ with it, grows with that.",
                "",
                "| α | way | coefficient | off | error | CPU s | times |",
                "|---|---|---|---|---|---|---|",
                *rows,
                "",
            ]
        )
    )


if __name__ == "__main__":
    main()
