"""`python -m experiments.conduction_limits [--full]`: conductivity and temperature jump.

Hard spheres: κ over its first Sonine approximation is 1.025218, and the jump at a Maxwell wall is
2.4001 (√π/2) λ dT/dn (Sone, Ohwada and Aoki 1989, k = (√π/2) λ), or 1.89 μ v0/p dT/dn. Maxwell
molecules, whose conductivity is known exactly: 1.
"""

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import tyro
from jdsmc.result import format_estimate

from jdsmc import InelasticHardSpheres, MaxwellMolecules, Result, run
from jdsmc.scenarios import FourierFlow
from jdsmc.theory import sonine_elastic

from ..publish import output_folder, results_folder
from ..store import obtain
from .analysis import coefficients, discretization, small_gradient_limit

RESULTS = Path(__file__).parent / "results"
JUMP = 2.4001 * math.sqrt(math.pi) / 2.0
GASES = {"hard spheres": InelasticHardSpheres(1.0), "Maxwell molecules": MaxwellMolecules()}
SMALL = {"n_particles": 4_000, "n_realizations": 16, "duration": 700.0}
FULL = {"n_particles": 10_000, "n_realizations": 16, "duration": 3_000.0}
COLD = np.array([0.25, 0.5])
LENGTH, LAYERS = 20.0, 160
"""Layers of λ0/8: their error of κ, (32/225π)(Δz/λ)² (Alexander, Garcia and Alder 1998), is 0.07%
at the mean density; it is taken off, as is that of the time step (Hadjiconstantinou 2000)."""


@dataclass(frozen=True)
class Case:
    """One gas between walls at each of the temperatures `COLD`."""

    name: str
    gas: str
    options: dict
    module: str = "scenarios/fourier_flow.py"

    def request(self) -> str:
        """Everything that decides the result, as text to compare with a file's."""
        return json.dumps([asdict(self), COLD.tolist(), LENGTH, LAYERS], sort_keys=True)

    def simulate(self) -> Result:
        """Run it."""
        scene = FourierFlow(GASES[self.gas], COLD, length=LENGTH, layers=LAYERS)
        return run(scene, steps_per_record=8, progress=False, **self.options)


def main(full: bool = False, out: Path | None = None, fresh: bool = False):
    """Measure the coefficients of both gases and write table.md.

    Args:
        full: a tenth of the variance; about ten minutes on two cores.
        out: folder for simulations (*.h5, reused if they are what is asked for); by default
            output/conduction_limits/small or full.
        fresh: run every simulation again.
    """
    size = "full" if full else "small"
    store = output_folder("conduction_limits", size, out)
    lines = [
        "# Heat conduction at small gradients\n",
        f"L = {LENGTH:g} λ0, Maxwell walls, coefficients from the middle half of the slab; one "
        "standard error in brackets. The expected values are those of vanishing gradient; the rows "
        "with ε = 0 are extrapolated with ε².\n",
        "| gas | T_-/T_+ | ε | κ/κ0 | expected | jump, cold | jump, hot | mean jump | expected |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for number, name in enumerate(GASES):
        options = (FULL if full else SMALL) | {"seed": number}
        lines += _rows(name, obtain(Case(name.replace(" ", "_"), name, options), store, fresh))
    text = "\n".join(lines) + "\n"
    (results_folder(RESULTS, size) / "table.md").write_text(text)
    print(text)


def _rows(name: str, result) -> list[str]:
    """One row a wall temperature, and the limit of both."""
    found = coefficients(result)
    spheres = name == "hard spheres"
    expected = sonine_elastic.conductivity_ratio(10) if spheres else 1.0
    correction = _discretization(result) if spheres else np.ones_like(COLD)
    found["conductivity"] = tuple(x / correction for x in found["conductivity"])
    gradient = 0.94 * found["mean_gradient"][0]
    limit = {name: small_gradient_limit(gradient, *found[name]) for name in COLUMNS}
    rows = []
    for k, cold in enumerate(COLD):
        values = {column: tuple(float(x[k]) for x in found[column]) for column in COLUMNS}
        rows.append(_row(name, f"{cold:g}", f"{gradient[k]:.3f}", values, expected))
    return [*rows, _row(name, "", "0", limit, expected)]


COLUMNS = ("conductivity", "jump_cold", "jump_hot", "jump")


def _row(name: str, cold: str, gradient: str, values: dict, expected: float) -> str:
    conductivity, *jumps = (format_estimate(*values[column]) for column in COLUMNS)
    known = f"{JUMP:.3f}" if name == "hard spheres" else ""
    cells = [name, cold, gradient, conductivity, f"{expected:.6f}", *jumps, known]
    return "| " + " | ".join(cells) + " |"


def _discretization(result) -> np.ndarray:
    """1 + its relative error of κ, in the middle of the slab."""
    steady = result.to_xarray().to_dataset()
    middle = steady.isel(z=steady.sizes["z"] // 2)
    density, temperature = middle["density"].values, middle["temperature"].values
    return 1.0 + discretization(density, temperature, LENGTH / LAYERS, result.attrs["time_step"])


if __name__ == "__main__":
    tyro.cli(main)
