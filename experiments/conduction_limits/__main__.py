"""`python -m experiments.conduction_limits [--full]`: conductivity and temperature jump.

Hard spheres: κ over its first Sonine approximation is 1.025218, and the jump at a Maxwell wall is
2.4001 (√π/2) λ dT/dn (Sone, Ohwada and Aoki 1989, k = (√π/2) λ), or 1.89 μ v0/p dT/dn. Maxwell
molecules, whose conductivity is known exactly: 1.
"""

import math
from pathlib import Path

import numpy as np
import tyro

from jdsmc import InelasticHardSpheres, MaxwellMolecules, run
from jdsmc.result import format_estimate
from jdsmc.scenarios import FourierFlow
from jdsmc.theory import sonine_elastic

from .analysis import coefficients

RESULTS = Path(__file__).parent / "results"
JUMP = 2.4001 * math.sqrt(math.pi) / 2.0
GASES = {"hard spheres": InelasticHardSpheres(1.0), "Maxwell molecules": MaxwellMolecules()}
SMALL = {"n_particles": 4_000, "n_realizations": 16, "duration": 700.0}
FULL = {"n_particles": 10_000, "n_realizations": 16, "duration": 3_000.0}
COLD = np.array([0.25, 0.5])
LENGTH, LAYERS = 20.0, 160
"""Layers of λ0/8: their error of κ, (32/225π)(Δz/λ)² (Alexander, Garcia and Alder 1998), is 0.07%
at the mean density; it is taken off, as is that of the time step (Hadjiconstantinou 2000)."""


def main(full: bool = False):
    """Measure the coefficients of both gases and write table.md.

    Args:
        full: a tenth of the variance; about ten minutes on two cores.
    """
    lines = [
        "# Heat conduction at small gradients\n",
        f"L = {LENGTH:g} λ0, Maxwell walls, coefficients from the middle half of the slab; one "
        "standard error in brackets. The expected values are those of vanishing gradient.\n",
        "| gas | T_-/T_+ | ε | κ/κ0 | expected | jump, cold | jump, hot | mean jump | expected |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for number, (name, gas) in enumerate(GASES.items()):
        scene = FourierFlow(gas, COLD, length=LENGTH, layers=LAYERS)
        options = {"steps_per_record": 8, "seed": number, "progress": False}
        result = run(scene, **(FULL if full else SMALL), **options)
        lines += _rows(name, result)
    text = "\n".join(lines) + "\n"
    folder = RESULTS / "full" if full else RESULTS
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "table.md").write_text(text)
    print(text)


def _rows(name: str, result) -> list[str]:
    """One row a wall temperature."""
    found = coefficients(result)
    spheres = name == "hard spheres"
    expected = sonine_elastic.conductivity_ratio(10) if spheres else 1.0
    correction = _discretization(result) if spheres else np.ones_like(COLD)
    rows = []
    for k, cold in enumerate(COLD):
        value, error = (x[k] / correction[k] for x in found["conductivity"])
        cells = [
            *(name, f"{cold:g}", f"{0.94 * found['mean_gradient'][0][k]:.3f}"),
            *(format_estimate(value, error), f"{expected:.6f}"),
            *(_cell(found, n, k) for n in ("jump_cold", "jump_hot", "jump")),
            f"{JUMP:.3f}" if spheres else "",
        ]
        rows.append("| " + " | ".join(cells) + " |")
    return rows


def _cell(found, name: str, k: int) -> str:
    value, error = (float(x[k]) for x in found[name])
    return format_estimate(value, error)


def _discretization(result) -> np.ndarray:
    """1 + (32/225π)(Δz/λ)² + (64/675π)(v0 dt/λ)² in the middle of the slab."""
    steady = result.to_xarray().to_dataset()
    middle = steady.isel(z=steady.sizes["z"] // 2)
    density, temperature = middle["density"].values, middle["temperature"].values
    width, step = LENGTH / LAYERS, result.attrs["time_step"]
    cells = 32.0 / (225.0 * math.pi) * (width * density) ** 2
    return 1.0 + cells + 64.0 / (675.0 * math.pi) * temperature * (step * density) ** 2


if __name__ == "__main__":
    tyro.cli(main)
