"""Twenty cheap runs of cooling disks held to theory: `python -m tests.blind_modes FOLDER`.

DSMC and molecular dynamics at N n σ² = 20, elastic and at α = 0.8. Scores are (value - theory)/
error of C(0), η and η1: their mean over the seeds must be within 0.5, and 88% of them within 2. A
second call goes on where the first was ended.

What a run differs in from the theory must be small against its error of some 4%: cells of
0.22 λ0 with five fictive particles, which add 0.7% to η; disks at n σ² = 0.02, with Enskog's theory
on the other side.
"""

import argparse
import time
import warnings
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardDisks
from jdsmc.scenarios import CoolingDisks, MolecularDynamics
from jdsmc.theory import langevin

from .rows import Rows

REDUCED = 20.0
DENSE = 0.02
"""n σ² of molecular dynamics."""

SEEDS = 20
NAMES = ("mode_amplitude", "viscosity_ratio", "noise_viscosity_ratio")
DURATIONS = {0.8: 380.0, 1.0: 180.0}
"""Of each of 8 realizations, warm-up included: some 150 decay times are measured."""
COLUMNS = ("scene", "alpha", "seed", "observable", "value", "error", "truth", "score", "seconds")


def scene_of(kind: str, alpha: float):
    """The scene and its number of disks."""
    gas = InelasticHardDisks(alpha)
    if kind == "dynamics":
        return MolecularDynamics(gas, density=DENSE), 1000
    return CoolingDisks(gas, density=0.2, copies=160, real_per_cell=0.03125), 100


def theory_of(kind: str, alpha: float) -> dict[str, float]:
    """Values of the theory by the names of the observables.

    Disks of finite size collide χ times as often, and their viscosity is f = 1/χ + π n σ²/2 + ...
    times the dilute one (Enskog's theory of elastic disks, Gass, J. Chem. Phys. 54, 1898 (1971)).
    What counts for the noise is ν k²/ζ, so that they are like dilute disks at N n σ² χ/f.
    """
    chi, factor = 1.0, 1.0
    if kind == "dynamics":
        packing = np.pi * DENSE / 4
        chi = (1 - 7 * packing / 16) / (1 - packing) ** 2
        factor = 1 / chi + 2 * packing + 0.8729 * chi * (2 * packing) ** 2
    mode = langevin.transverse_mode(alpha, REDUCED * chi / factor)
    viscosity = factor * mode.viscosity_ratio
    values = (mode.amplitude, viscosity, viscosity * mode.noise_over_viscosity)
    return dict(zip(NAMES, map(float, values), strict=True))


def outcome(kind: str, alpha: float, seed: int) -> list[dict]:
    """Rows of the table: one for each observable."""
    scene, number = scene_of(kind, alpha)
    began = time.monotonic()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        result = jdsmc.run(
            scene,
            **{"n_particles": number, "duration": DURATIONS[alpha], "seed": seed},
            **{"time_step": 0.07, "steps_per_record": 10, "progress": False},
        )
    seconds = round(time.monotonic() - began, 1)
    rows = []
    for name, truth in theory_of(kind, alpha).items():
        value, error = result[name]
        score = {"value": value, "error": error, "truth": truth, "score": (value - truth) / error}
        where = {"scene": kind, "alpha": alpha, "seed": seed, "observable": name}
        rows.append(where | score | {"seconds": seconds})
    return rows


def campaign(table: Path, kinds=("cells", "dynamics"), alphas=(0.8, 1.0), seeds=SEEDS) -> list:
    """Run what the table lacks, one seed after another of all cases; all its rows."""
    kept = Rows(table, COLUMNS)
    done = {(row["scene"], float(row["alpha"]), int(row["seed"])) for row in kept.all()}
    for seed in range(seeds):
        for kind in kinds:
            for alpha in alphas:
                if (kind, alpha, seed) not in done:
                    kept.add(outcome(kind, alpha, seed))
    return kept.all()


def summary(rows: list[dict]) -> dict[tuple, tuple[int, float, float, float]]:
    """Number, mean score, share within 2 and spread of the scores, by scene, α and observable."""
    groups: dict[tuple, list[float]] = {}
    for row in rows:
        where = (row["scene"], float(row["alpha"]), row["observable"])
        groups.setdefault(where, []).append(float(row["score"]))
    return {
        where: (
            len(scores),
            float(np.mean(scores)),
            float(np.mean(np.abs(scores) < 2)),
            float(np.std(scores, ddof=1)) if len(scores) > 1 else np.nan,
        )
        for where, scores in groups.items()
    }


def main() -> None:
    """Run what the table lacks; print means and coverages."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path, help="where the table is kept")
    parser.add_argument("--kinds", nargs="+", default=["cells", "dynamics"])
    parser.add_argument("--seeds", type=int, default=SEEDS)
    given = parser.parse_args()
    rows = campaign(given.folder / "blind_modes.csv", tuple(given.kinds), seeds=given.seeds)
    for where, (number, mean, covered, spread) in summary(rows).items():
        print(
            *where, f"{number} runs: mean {mean:+.2f}, within 2: {covered:.0%}, spread {spread:.2f}"
        )


if __name__ == "__main__":
    main()
