"""What to run: every simulation of the reproduction (`sizes.toml`)."""

from jdsmc import InelasticHardDisks
from jdsmc.scenarios import CoolingDisks, MolecularDynamics

from ..case import Case

METHODS = {"dynamics": "molecular dynamics", "monte_carlo": "DSMC"}

SOUGHT = ("viscosity_ratio", "noise_viscosity_ratio")
"""Observables that decide when a run of no given length ends."""


def cases(size) -> list[Case]:
    """Every simulation of a size, the cheapest first."""
    alpha, number = size.studied
    found = []
    for per_cell, copies, duration, step in size.coarse:
        scene = CoolingDisks(
            InelasticHardDisks(alpha),
            density=size.density,
            copies=copies,
            real_per_cell=float(per_cell or number),
        )
        options = _options(size, number, duration)
        options |= {"time_step": step, "steps_per_record": round(0.7 / step)}
        found.append(Case(coarse_name(per_cell, copies), scene, options))
    for alpha, number, duration in size.dynamics:
        scene = MolecularDynamics(InelasticHardDisks(alpha), density=size.density)
        name = case_name("dynamics", alpha, number)
        found.append(Case(name, scene, _options(size, number, duration)))
    for alpha, number, duration in size.monte_carlo:
        cells = size.fine if alpha < 0.85 else size.cells
        scene = CoolingDisks(InelasticHardDisks(alpha), density=size.density, **cells)
        name = case_name("monte_carlo", alpha, number)
        found.append(Case(name, scene, _options(size, number, duration)))
    return found


def case_name(method: str, alpha: float, number: int) -> str:
    """Of a simulation at N disks."""
    return f"{method}_{alpha:g}_{number}"


def coarse_name(per_cell: float, copies: int) -> str:
    """Of a simulation with cells and copies of its own."""
    return f"cells_{per_cell:g}_{copies}"


def _options(size, number: int, duration: float) -> dict:
    options = {"n_particles": number, "n_realizations": 8}
    if duration:
        return options | {"duration": float(duration)}
    return options | {"observable": SOUGHT, "rtol": tuple(size.rtol), "budget": float(size.budget)}
