"""Measure flow between walls and write docs/couette_flow.md: an hour on two cores.

Run it as `python docs/make_couette_flow.py` with the library installed.
"""

from math import pi, sqrt
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.measure.conduction import CONDUCTIVITY
from jdsmc.scenarios import CouetteFlow, FourierFlow
from jdsmc.theory import boltzmann

HERE = Path(__file__).parent
PAGE, TEMPLATE = HERE / "couette_flow.md", HERE / "couette_flow.template.md"

SONE = {0.1: 0.2030, 0.3: 0.4354, 1.0: 0.7374, 4.0: 0.9779, 10.0: 1.0578}
"""k = (√π/2) λ0/L, and the stress of hard spheres of which 2/√π is free-molecular: Sone, Takata
and Ohwada (1990)."""

SLIP = 1.1113
"""Viscous slip of hard spheres in λ0: 1.2540 √π/2, Ohwada, Sone and Aoki (1989)."""

SLOW, FAST = 0.5, 1.2
"""Velocities U from which the stress over U is extrapolated to zero, linear in U²: the work of the
walls warms the gas by 0.07 U² T0 at most, and what U⁴ adds is below 0.03%."""

RTOL = 0.001
"""Relative error of a stress that ends a run."""

TIME_STEP, PER_LAYER = 0.05, 100
"""Steps that overestimate the stress by (ν dt)²/12, 0.02% (0.07% at 0.1). And
particles a layer, few of which lower a flux by 6% over their number."""

NARROW = 5.0 * sqrt(pi) / 2.0
"""Width (λ0) of the slab that tells slip and jump: k = 0.2. Knudsen layers overlap by less than
0.1% there, going by the published stress at k = 0.3 and 0.1."""

JUMP = 2.127
"""Temperature jump of hard spheres in λ0: 2.4001 √π/2, Sone, Ohwada and Aoki (1989)."""

WARM, COOL = (0.75, 0.0015), (0.5, 0.001)
"""T_-/T_+ from which conduction is extrapolated to equal walls, and relative errors asked."""

SECOND = 0.31
"""Second coefficient of slip, Knudsen layers included: Hadjiconstantinou (2003)."""

DRIVEN = 0.25
"""Mean velocity (v0) of Poiseuille flow, about, from which forces follow; half of it too."""


def flow(length: float, velocity: float, alpha=1.0, cold=1.0, share=1.0, force=0.0, rtol=RTOL):
    """A run: steps and layers whose errors (docs/method.md) are below 0.07% of the stress."""
    layers = max(8, round(16 * length))
    gas = InelasticHardSpheres(alpha)
    scene = CouetteFlow(gas, velocity, cold, share, 0.0, length, force, layers)
    return jdsmc.run(
        scene,
        n_particles=max(2000, PER_LAYER * layers),
        time_step=min(TIME_STEP, length / 8),
        rtol=rtol,
        budget=1e5,
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


def resisting(length: float) -> tuple[float, float]:
    """κ0 (2/3)(T_+^{3/2} - T_-^{3/2})/q of a slab and its error, as T_- tends to T_+.

    It is (L + 2b)/(κ/κ0) with jump length b; what unequal walls add is taken as quadratic in their
    difference over their mean.
    """
    layers, found = round(16 * length), []
    for cold, rtol in (WARM, COOL):
        scene = FourierFlow(InelasticHardSpheres(1.0), cold, length=length, layers=layers)
        sizes = {"n_particles": PER_LAYER * layers, "time_step": TIME_STEP, "budget": 1e5}
        q = jdsmc.run(scene, rtol=rtol, seed=1, progress=False, **sizes)["mean_heat_flux"]
        value = CONDUCTIVITY * 2.0 / 3.0 * (1.0 - cold**1.5) / abs(float(q.value))
        spread = abs(float(q.error / q.value)) * value
        found.append((((1.0 - cold) / (1.0 + cold)) ** 2, value, spread))
    (near, warm, warm_error), (far, cool, cool_error) = found
    weight = far / (far - near)
    error = np.hypot(weight * warm_error, (weight - 1.0) * cool_error)
    return weight * warm - (weight - 1.0) * cool, float(error)


def slope(far: float, first: tuple, near: float, second: tuple) -> tuple[float, float]:
    """Coefficient c of y = (L + 2b)/c and its error, from y and its error at two lengths."""
    rise = first[0] - second[0]
    value = (far - near) / rise
    return value, value * float(np.hypot(first[1], second[1])) / rise


def depth(coefficient: float, length: float, y: tuple[float, float]) -> tuple[float, float]:
    """b of y = (L + 2b)/c and its error."""
    return 0.5 * (coefficient * y[0] - length), 0.5 * coefficient * y[1]


def yielding(stress: tuple[float, float]) -> tuple[float, float]:
    """U over the stress and its error, from the stress over the free-molecular one."""
    free = 2.0 * sqrt(pi)
    return free / stress[0], free * stress[1] / stress[0] ** 2


def continuum(found: dict) -> str:
    """Viscosity and conductivity from two slabs; slip and jump from one, and known coefficients."""
    far = max(found)
    known = boltzmann.navier_stokes(1.0)
    viscosity, kappa = known.viscosity * 5.0 * sqrt(pi) / 16.0, known.conductivity
    flows = yielding(found[far]), yielding(extrapolated(NARROW))
    heats = resisting(far), resisting(NARROW)
    rows = [
        f"| η in n̄ m v0 λ0 | {cell(*slope(far, flows[0], NARROW, flows[1]))} | {viscosity:.4f} |",
        f"| slip length in λ0 | {cell(*depth(viscosity, NARROW, flows[1]))} | {SLIP} |",
        f"| κ/κ0 | {cell(*slope(far, heats[0], NARROW, heats[1]))} | {kappa:.4f} |",
        f"| temperature jump in λ0 | {cell(*depth(kappa, NARROW, heats[1]))} | {JUMP} |",
    ]
    print(*rows, sep="\n", flush=True)
    return "\n".join(rows)


def poiseuille() -> str:
    """Rows: Kn, L, mean velocity over f as f tends to zero, published, relative difference."""
    viscosity = boltzmann.navier_stokes(1.0).viscosity * 5.0 * sqrt(pi) / 16.0
    rows = []
    for length in (4.0, 6.0, 10.0):
        kn = 1.0 / length
        slipping = 1.0 / 6.0 + 1.11 * kn + 2.0 * SECOND * kn**2
        known = length**2 / (2.0 * viscosity) * slipping
        forces = DRIVEN / known, 0.5 * DRIVEN / known
        runs = [flow(length, 0.0, force=f, rtol=0.002)["mean_velocity"] for f in forces]
        fast, slow = ((float(x.value), float(x.error)) for x in runs)
        value = (4.0 * slow[0] / forces[1] - fast[0] / forces[0]) / 3.0
        error = np.hypot(4.0 * slow[1] / forces[1], fast[1] / forces[0]) / 3.0
        change, spread = 100 * (value / known - 1.0), 100 * error / known
        parts = (f"{kn:.3g}", f"{length:g}", cell(value, error), f"{known:.2f}")
        rows.append(f"| {' | '.join(parts)} | {change:+.2f} ± {spread:.2f} |")
        print(rows[-1], flush=True)
    return "\n".join(rows)


def balance() -> str:
    """Energy of granular gases: what goes in at the walls, and what collisions lose."""
    rows = []
    for alpha, velocity, cold, share in (
        (0.9, 0.0, 1.0, 1.0),
        (0.9, 1.0, 0.5, 0.7),
        (0.7, 2.0, 1.0, 1.0),
    ):
        result = flow(4.0, velocity, alpha, cold, share, rtol=0.004)
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
    made = {"BALANCE": balance(), "STRESS": against_knudsen_number(found)}
    made |= {"CONTINUUM": continuum(found), "POISEUILLE": poiseuille()}
    for name, part in made.items():
        text = text.replace(f"@{name}@", part)
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
