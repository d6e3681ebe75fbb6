"""Sixty cheap runs of every scene held to the truth: `python -m tests.coverage FOLDER [--docs]`.

Every run ends by itself at a modest precision, as those of users do. The truth is deterministic
theory where there is some, else one run some twenty times as long, with other seeds, whose own
error is counted. Rows are kept in FOLDER/coverage.csv, and a second call goes on where the first
ended; the page has the scores z = (value - truth)/error of every number that is printed: their
mean, the share within two errors, χ² = ⟨z²⟩, and the share of 95% intervals that hold the truth.

With seven degrees of freedom t-distributed scores have 91.4% within two and χ² = 1.4; the printed
error is the larger of two, which makes more of them lie within.
"""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres
from jdsmc.scenarios import (
    CouetteFlow,
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    NavierStokes,
    ShearedSlab,
    UniformShear,
    WhiteNoiseThermostat,
)
from jdsmc.theory import boltzmann

from .rows import Rows

SEEDS = 60
TRUTH_SEED = 1_000_003
GAS, ELASTIC = InelasticHardSpheres(0.7), InelasticHardSpheres(1.0)


class Case(NamedTuple):
    """A scene, the precision asked for, how long the true run is, and what theory knows."""

    make: Callable[[], Any]
    rtol: float
    longer: dict[str, float]
    sizes: dict[str, int] | None = None
    theory: dict[str, float] | None = None


def cases() -> dict[str, Case]:
    """Every scene."""
    known = boltzmann.navier_stokes(0.7)
    coefficients = ("conductivity", "modified_conductivity", "viscosity")
    return {
        "shear": Case(lambda: UniformShear(GAS, 4.0), 2e-3, {"collisions": 4000}),
        "shear, from near": Case(
            lambda: UniformShear(GAS, 4.0, initial_state="steady"), 2e-3, {"collisions": 4000}
        ),
        "shear, frictional": Case(
            lambda: UniformShear(ElasticHardSpheres(0.7), 4.0), 2e-3, {"collisions": 4000}
        ),
        "cooling": Case(
            lambda: HomogeneousCooling(InelasticHardSpheres(0.5)),
            1e-3,
            {"collisions": 4000},
            theory={"a2": boltzmann.navier_stokes(0.5).a2},
        ),
        "white-noise": Case(
            lambda: WhiteNoiseThermostat(InelasticHardSpheres(0.4), 0.1), 0.05, {"collisions": 4000}
        ),
        "heat-flux": Case(lambda: HeatFluxForce(GAS, 0.05), 5e-2, {"collisions": 4000}),
        "heat-flux, field 0.1": Case(lambda: HeatFluxForce(GAS, 0.1), 3e-2, {"collisions": 4000}),
        "navier-stokes": Case(
            lambda: NavierStokes(GAS),
            3e-2,
            {},
            {"n_particles": 5120},
            {name: getattr(known, name) for name in coefficients},
        ),
        "sheared-slab": Case(
            lambda: ShearedSlab(GAS, shear_rate=4.0, length=2.5, layers=25),
            1e-2,
            {"duration": 600},
            {"n_particles": 5000},
        ),
        "fourier": Case(
            lambda: FourierFlow(ELASTIC, cold_temperature=0.5, length=4.0, layers=24),
            2e-2,
            {"duration": 6000},
            {"n_particles": 2400},
        ),
        "couette": Case(
            lambda: CouetteFlow(ELASTIC, wall_velocity=0.8, length=4.0, layers=24),
            2e-2,
            {"duration": 6000},
            {"n_particles": 2400},
        ),
    }


COLUMNS = ("scene", "seed", "observable", "value", "error", "low", "high")


def run(case: Case, seed: int):
    """A cheap one; or the true one."""
    length: dict[str, Any] = case.longer if seed == TRUTH_SEED else {"rtol": case.rtol}
    result = jdsmc.run(case.make(), seed=seed, progress=False, **(case.sizes or {}), **length)
    if result.interrupted:
        raise KeyboardInterrupt
    return result


def rows_of(name: str, case: Case, seed: int) -> list[dict]:
    """What a run prints, number by number."""
    result, rows = run(case, seed), []
    for one in case.make().reports:
        if one.dims or one.name not in result or one.setting:
            continue
        found = result[one.name]
        low, high = found.interval()
        numbers = [f"{float(x):.9g}" for x in (found.value, found.error, low, high)]
        rows.append(dict(zip(COLUMNS, (name, seed, one.name, *numbers), strict=True)))
    return rows


class Score(NamedTuple):
    """Of one observable of one scene."""

    scene: str
    observable: str
    truth: str
    runs: int
    mean: float
    within: float
    square: float
    covered: float


def scores(rows: list[dict]) -> list[Score]:
    """Of all rows; what is conserved, up to rounding, or is no number of the gas, is left out."""
    groups: dict[tuple[str, str], list[np.ndarray]] = {}
    true: dict[tuple[str, str], tuple[float, float]] = {}
    for row in rows:
        where = row["scene"], row["observable"]
        numbers = np.array([float(row[name]) for name in COLUMNS[3:]])
        if int(row["seed"]) == TRUTH_SEED:
            true[where] = numbers[0], numbers[1]
        else:
            groups.setdefault(where, []).append(numbers)
    found, known = [], cases()
    for (scene, name), all_numbers in groups.items():
        theory = (known[scene].theory or {}).get(name)
        if theory is None and (scene, name) not in true:
            continue
        truth, uncertain = (theory, 0.0) if theory is not None else true[scene, name]
        value, error, low, high = np.array(all_numbers).T
        if not np.median(error) > 1e-6 * abs(truth):
            continue
        score = (value - truth) / np.hypot(error, uncertain)
        spare = np.hypot(1.0, uncertain / error)
        reach = 0.5 * (high - low) * spare
        found.append(
            Score(
                *(scene, name, "long run" if theory is None else "theory", len(value)),
                *(float(np.mean(score)), float(np.mean(np.abs(score) < 2))),
                *(float(np.mean(score**2)), float(np.mean(np.abs(value - truth) < reach))),
            )
        )
    return found


def page(found: list[Score]) -> str:
    """A table with a line for all at the end."""
    lines = [
        "# Error bars held to the truth",
        "",
        "Made by `python -m tests.coverage FOLDER --docs`. Cheap runs of every scene, each ended "
        "by its own precision, against deterministic theory or one much longer run (whose own "
        "error is counted). z = (value - truth)/error. With the seven degrees of freedom of eight "
        "realizations 91.4% of z lie within 2 and ⟨z²⟩ = 1.4; the printed error is the larger of "
        "two estimates and so somewhat safer. The last column is the share of 95% intervals "
        "(`Estimate.interval`) that hold the truth; of 60 runs it has a standard error of 2.8%. "
        "Numbers of one run are correlated: a row that is off takes its neighbours with it. Under "
        "a heat-flux force of 0.1 a2 and a3 hang on rare fast particles, as the results of such a "
        "run remark; at 0.05 they do not.",
        "",
        "| scene | observable | truth | runs | mean z | within 2 | ⟨z²⟩ | 95% interval |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for s in found:
        lines.append(
            f"| {s.scene} | {s.observable} | {s.truth} | {s.runs} | {s.mean:+.2f} | {s.within:.1%} "
            f"| {s.square:.2f} | {s.covered:.1%} |"
        )
    weights = np.array([s.runs for s in found])
    means = {
        name: float(np.average([getattr(s, name) for s in found], weights=weights))
        for name in ("mean", "within", "square", "covered")
    }
    lines.append(
        f"| all |  |  | {weights.sum()} | {means['mean']:+.2f} | {means['within']:.1%} "
        f"| {means['square']:.2f} | {means['covered']:.1%} |"
    )
    return "\n".join(lines) + "\n"


def main() -> None:
    """Run what the table lacks, and write the page."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path, help="where the table is kept")
    parser.add_argument("--only", default="", help="scenes whose name contains this")
    parser.add_argument("--seeds", type=int, default=SEEDS)
    parser.add_argument("--docs", action="store_true", help="put the page into docs/")
    given = parser.parse_args()
    table = Rows(given.folder / "coverage.csv", COLUMNS)
    done = {(row["scene"], int(row["seed"])) for row in table.all()}
    for name, case in cases().items():
        truths = [TRUTH_SEED] if case.longer else []
        for seed in [*truths, *range(given.seeds)]:
            if given.only in name and (name, seed) not in done:
                table.add(rows_of(name, case, seed))
        print(name, flush=True)
    text = page(scores(table.all()))
    print(text)
    folders = [given.folder] + [Path(__file__).parents[1] / "docs"] * given.docs
    for folder in folders:
        (folder / "coverage.md").write_text(text)


if __name__ == "__main__":
    main()
