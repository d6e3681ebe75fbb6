"""Measure plane Couette flow and write docs/couette_flow.md: minutes of CPU time.

Run it as `python docs/make_couette_flow.py` with the library installed.
"""

from math import pi, sqrt
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import CouetteFlow
from jdsmc.theory import boltzmann

HERE = Path(__file__).parent
PAGE, TEMPLATE = HERE / "couette_flow.md", HERE / "couette_flow.template.md"

SONE = {0.1: 0.2030, 0.3: 0.4354, 1.0: 0.7374, 4.0: 0.9779, 10.0: 1.0578}
"""k = (√π/2) λ0/L, and the stress of hard spheres of which 2/√π is free-molecular: Sone, Takata
and Ohwada (1990)."""

SLIP = 1.1113
"""Viscous slip of hard spheres in λ0: 1.2540 √π/2, Ohwada, Sone and Aoki (1989)."""

SLOW, FAST = 0.3, 0.8
"""Velocities U from which the stress over U is extrapolated to zero, linear in U²."""

RTOL = 0.004
"""Relative error of a stress that ends a run."""


def flow(length: float, velocity: float, alpha=1.0, cold=1.0, share=1.0):
    """A run: steps and layers whose errors (docs/method.md) are below 0.1% of the stress."""
    layers = max(8, round(10 * length))
    gas = InelasticHardSpheres(alpha)
    scene = CouetteFlow(gas, velocity, cold, share, length=length, layers=layers)
    step = min(0.1, length / 8)
    return jdsmc.run(
        scene,
        n_particles=max(2000, 50 * layers),
        time_step=step,
        rtol=RTOL,
        seed=1,
        progress=False,
    )


def over_free(result, velocity: float) -> tuple[float, float]:
    """Stress and its error over that of a free-molecular gas, U/2√π."""
    free = velocity / (2.0 * sqrt(pi))
    stress = result["shear_stress"]
    return float(stress.value) / free, float(stress.error) / free


def extrapolated(length: float) -> tuple[float, float]:
    """Stress over the free-molecular one and its error, as U tends to zero."""
    weight = FAST**2 / (FAST**2 - SLOW**2)
    slow, fast = (over_free(flow(length, u), u) for u in (SLOW, FAST))
    error = np.hypot(weight * slow[1], (weight - 1.0) * fast[1])
    return weight * slow[0] - (weight - 1.0) * fast[0], float(error)


def cell(value: float, error: float) -> str:
    """A value with its error in the last digits."""
    return jdsmc.estimate.format_estimate(value, error)


def against_knudsen_number(found: dict) -> str:
    """Rows: k, L, jdsmc, published, relative difference. Fills `found` with L: value, error."""
    rows = []
    for k, published in SONE.items():
        length = sqrt(pi) / 2.0 / k
        value, error = found[length] = extrapolated(length)
        known = published * sqrt(pi) / 2.0
        change, spread = 100 * (value / known - 1.0), 100 * error / known
        parts = (f"{k:g}", f"{length:.4g}", cell(value, error), f"{known:.4f}")
        rows.append(f"| {' | '.join(parts)} | {change:+.2f} ± {spread:.2f} |")
        print(rows[-1], flush=True)
    return "\n".join(rows)


def continuum(found: dict) -> str:
    """Viscosity and slip length b from U/stress = (L + 2b)/η at the two widest slabs.

    Errors of the two stresses are independent: each is moved by its own in turn.
    """
    (far, stress), (near, other) = list(found.items())[:2]

    def solved(one: float, two: float) -> np.ndarray:
        free = 2.0 * sqrt(pi)
        viscosity = (far - near) / (free / one - free / two)
        return np.array([viscosity, 0.5 * (viscosity * free / one - far)])

    value = solved(stress[0], other[0])
    moved = solved(sum(stress), other[0]) - value, solved(stress[0], sum(other)) - value
    error = np.hypot(*moved)
    known = boltzmann.navier_stokes(1.0).viscosity * 5.0 * sqrt(pi) / 16.0
    rows = [
        f"| η in n̄ m v0 λ0 | {cell(value[0], error[0])} | {known:.4f} |",
        f"| slip length in λ0 | {cell(value[1], error[1])} | {SLIP} |",
    ]
    print(*rows, sep="\n", flush=True)
    return "\n".join(rows)


def balance() -> str:
    """Energy of granular gases: what goes in at the walls, and what collisions lose."""
    rows = []
    for alpha, velocity, cold, share in (
        (0.9, 0.0, 1.0, 1.0),
        (0.9, 1.0, 0.5, 0.7),
        (0.7, 2.0, 1.0, 1.0),
    ):
        result = flow(4.0, velocity, alpha, cold, share)
        heat = result["heat_flux_lower_wall"] - result["heat_flux_upper_wall"]
        given, lost = heat + result["wall_work"], result["dissipation"]
        left = given - lost
        parts = [f"{alpha}", f"{velocity:g}", f"{cold:g}", f"{share:g}"]
        parts += [
            cell(float(x.value), float(x.error)) for x in (heat, result["wall_work"], lost, left)
        ]
        rows.append(f"| {' | '.join(parts)} |")
        print(rows[-1], flush=True)
    return "\n".join(rows)


def main() -> None:
    """The whole page."""
    text = TEMPLATE.read_text(encoding="utf-8")
    found: dict = {}
    made = {"STRESS": against_knudsen_number(found), "BALANCE": balance()}
    made["CONTINUUM"] = continuum(found)
    for name, part in made.items():
        text = text.replace(f"@{name}@", part)
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
