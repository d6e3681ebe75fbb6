"""Sixty cheap derivatives held to the truth: `python -m tests.blind_sensitivity FOLDER`.

Twenty seeds at each of three restitutions of the sheared inelastic gas. The mean of (s - truth)
over the total error must be within 0.5, and at least 88% must be within two of them, for each
observable; the total error is that of the derivative, truncation counted in, and the truth's own.
The truth knows nothing of the method: `tests.truth_sensitivity`. Results are appended to a table:
a second call goes on where the first was ended.
"""

import argparse
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import UniformShear

from .rows import Rows
from .truth_sensitivity import OBSERVABLES, RESTITUTIONS, slopes

SEEDS = range(400, 420)
SHEAR_RATE = 0.5
"""Near that of T_s = T0; reduced values do not depend on it."""

LARGEST_MEAN, LEAST_COVERED = 0.5, 0.88


def outcome(alpha: float, seed: int) -> list[dict]:
    """Rows of the table of one run."""
    scene = UniformShear(InelasticHardSpheres(alpha), SHEAR_RATE)
    options = {"n_particles": 4096, "rtol": 0.005, "time_step": 0.05, "progress": False}
    s = jdsmc.sensitivity(scene, wrt="restitution", seed=seed, **options)
    rows = []
    for name in OBSERVABLES:
        d = s[name]["restitution"]
        numbers = {"value": d.value, "error": d.error, "truncation": d.truncation}
        rows.append({"restitution": alpha, "seed": seed, "observable": name, **numbers})
    return rows


COLUMNS = ("restitution", "seed", "observable", "value", "error", "truncation")


def report(rows: list[dict], known: dict) -> bool:
    """Print mean and coverage of every observable and restitution; True if all is well."""
    good = True
    print("observable          α     truth        mean of s    z mean  within 2   truncation/error")
    every = []
    for name in OBSERVABLES:
        pooled = []
        for alpha in RESTITUTIONS:
            mine = [r for r in rows if r["observable"] == name and float(r["restitution"]) == alpha]
            if not mine:
                continue
            value, error, truncation = (
                np.array([float(r[k]) for r in mine]) for k in ("value", "error", "truncation")
            )
            right, doubt = known[name][alpha]
            z = (value - right) / np.sqrt(error**2 + truncation**2 + doubt**2)
            pooled.extend(z)
            mean, covered = float(np.mean(z)), float(np.mean(np.abs(z) < 2.0))
            ratio = float(np.mean(truncation / error))
            print(
                f"{name:18s} {alpha:.2f} {right:9.4f}({doubt:.4f}) {np.mean(value):9.4f}"
                f" {mean:8.2f} {covered:8.2f} {ratio:10.1f}"
            )
        mean, covered = float(np.mean(pooled)), float(np.mean(np.abs(pooled) < 2.0))
        good &= abs(mean) <= LARGEST_MEAN and covered >= LEAST_COVERED
        print(f"{name:18s} all{'':38s} {mean:8.2f} {covered:8.2f}")
        every.extend(pooled)
    print(f"all: mean {np.mean(every):.2f}, within 2: {np.mean(np.abs(every) < 2.0):.3f}")
    return good


def main() -> None:
    """Run what the table lacks; report."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path, help="where the table is kept")
    given = parser.parse_args()
    table = Rows(given.folder / "blind_sensitivity.csv", COLUMNS)
    done = {(float(row["restitution"]), int(row["seed"])) for row in table.all()}
    for seed in SEEDS:
        for alpha in RESTITUTIONS:
            if (alpha, seed) not in done:
                table.add(outcome(alpha, seed))
    good = report(table.all(), slopes())
    print("as it should be" if good else "WRONG")


if __name__ == "__main__":
    main()
