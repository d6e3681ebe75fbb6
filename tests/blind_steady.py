"""A hundred cheap runs whose steady values are held to the truth: `python -m tests.blind_steady`.

No printed value may be wrong by more than 5 standard errors and 3%, and no more than a tenth of the
runs may be refused at their generous budget. The truth is that of long runs, whose last half is
averaged without asking the tracker; for hard spheres it is one for all shear rates (reduced values
do not depend on it, T_s goes as its square). Results are appended to a table: a second call goes
on where the first was ended.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres
from jdsmc.scenarios import (
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    ShearedSlab,
    UniformShear,
)
from jdsmc.theory.bgk_shear_flow import steady_state

from .rows import Rows

SHEARED = ("temperature", "shear_stress", "normal_stress_xy", "reduced_viscosity")
OBSERVABLES = {
    "shear": SHEARED,
    "slab": ("mean_temperature", *SHEARED[1:]),
    "cooling": ("relative_speed_cubed", "a2"),
    "force": ("modified_conductivity",),
    "fourier": ("mean_heat_flux", "heat_flux_cold_wall", "heat_flux_hot_wall"),
}
GASES = {"ihs": InelasticHardSpheres, "ehs": ElasticHardSpheres}
SLOWEST = {0.9999: 128, 0.999: 256}
"""Largest number of particles of the slowest gases, which need 10³ to 10⁴ times as many collisions
as the fastest."""

ELASTIC = 0.95
"""From here on the kinetic model is the truth: it is off by a part of 1-α."""


def cases() -> list[dict]:
    """Every case: what, gas, restitution, shear rate over that of T_s = T0, N, R, seed."""
    rng = np.random.default_rng(20)
    out = []
    for number in range(100):
        what = ("shear", "shear", "shear", "slab", "shear", "cooling", "shear", "force", "shear")[
            number % 9
        ]
        what = "fourier" if number % 12 == 11 else what
        sheared = what in ("shear", "slab")
        alphas = (0.5, 0.7, 0.9, 0.99, 0.999, 0.9999) if sheared else (0.5, 0.7, 0.9)
        chances = (0.2, 0.2, 0.25, 0.2, 0.1, 0.05) if what == "shear" else None
        alphas = alphas[:4] if what == "slab" else alphas
        alpha = float(rng.choice(alphas, p=chances))
        n = int(rng.choice((256, 1024, 4096) if what == "shear" else (1024, 2048)))
        case = {
            "case": number,
            "what": what,
            "gas": str(rng.choice(("ihs", "ehs"))) if sheared else "ihs",
            "alpha": alpha if what != "fourier" else 1.0,
            "strength": float(rng.choice((0.3, 0.7, 0.95, 1.05, 2.0, 10.0))) if sheared else 0.1,
            "n": min(n, SLOWEST.get(alpha, n)),
            "realizations": int(rng.choice((8, 8, 16))),
            "cold": float(rng.choice((0.05, 0.5))) if what == "fourier" else 0.0,
            "rtol": float(rng.choice((0.1, 0.02, 0.005))),
        }
        out.append(case)
    return out


def critical_rate(alpha: float) -> float:
    """Shear rate of T_s = T0, to a few percent."""
    return float(np.sqrt(0.5013 * (1 - alpha**2)))


def scene_of(case: dict):
    """The scene of a case."""
    gas = GASES[case["gas"]](case["alpha"])
    rate = case["strength"] * critical_rate(case["alpha"])
    match case["what"]:
        case "shear":
            return UniformShear(gas, rate)
        case "slab":
            return ShearedSlab(gas, rate, layers=8)
        case "cooling":
            return HomogeneousCooling(gas)
        case "force":
            return HeatFluxForce(gas, case["strength"])
    return FourierFlow(gas, case["cold"], length=3.0, layers=16)


def reference_case(case: dict) -> dict:
    """The long run that knows the truth of a case, and of all that are like it."""
    what = case["what"]
    same = {"what": "shear", "strength": 1.0} if what in ("shear", "slab") else {}
    return case | same | {"n": 2048, "realizations": 8}


def truth(case: dict, folder: Path) -> dict:
    """Values of the reference, kept in a file; the temperature as that of the case's shear rate."""
    if case["what"] in ("shear", "slab") and case["alpha"] > ELASTIC:
        model = steady_state(case["alpha"], scene_of(case).shear_rate)
        values = {name: float(getattr(model, name)) for name in SHEARED}
        return values | {"mean_temperature": values["temperature"]}
    long = reference_case(case)
    names = ("what", "gas", "alpha", "strength", "cold", "n")
    path = folder / ("_".join(str(long[name]) for name in names) + ".json")
    slow = 1.5 / (1 - case["alpha"] ** 2) if case["alpha"] < 1 else 20.0
    observables = OBSERVABLES[long["what"]]
    if not path.exists():
        collisions = max(300.0, 16.0 * slow)
        result = jdsmc.run(scene_of(long), **options(long, 99), collisions=collisions)
        late = result.series["collisions"].values > collisions / 2
        found = {n: float(np.mean(result.series[n].values[late])) for n in observables}
        path.write_text(json.dumps(found))
    values = json.loads(path.read_text())
    if "temperature" in values:
        values["temperature"] *= case["strength"] ** 2
        values["mean_temperature"] = values["temperature"]
    return values


def options(case: dict, seed: int) -> dict:
    """Of a run."""
    return {
        "n_particles": case["n"],
        "n_realizations": case["realizations"],
        "seed": seed,
        "steps_per_record": 256 if 1 > case["alpha"] > ELASTIC else 16,
        "time_step": 0.1 if 1 > case["alpha"] > 0.995 else 0.05,
        "progress": False,
    }


def outcome(case: dict, folder: Path) -> list[dict]:
    """Rows of the table: one for each observable, or one that says how the run was refused."""
    began = time.monotonic()
    slow = 1.5 / (1 - case["alpha"] ** 2) if case["alpha"] < 1 else 20.0
    budget = max(2_000.0, 40.0 * slow)
    try:
        result = jdsmc.run(
            scene_of(case), **options(case, case["case"]), rtol=case["rtol"], budget=budget
        )
    except jdsmc.NotSteadyError as error:
        return [case | {"outcome": "refused", "stopped": str(error)}]
    seconds = round(time.monotonic() - began, 1)
    start = float(result.to_xarray()["steady_from_collisions"])
    total = float(result.series["collisions"].values[-1])
    known, rows = truth(case, folder), []
    for name in OBSERVABLES[case["what"]]:
        value, error = result[name]
        off = value - known[name]
        allowed = 3.0 / case["n"] if name == "a2" else 0.03 * abs(known[name])
        wrong = abs(off) > 5 * error and abs(off) > allowed
        measured = {"observable": name, "value": value, "error": error, "truth": known[name]}
        scores = {"z": off / error, "relative": off / known[name], "seconds": seconds}
        how = {"outcome": "wrong" if wrong else "right", "start": start, "total": total}
        rows.append(case | measured | scores | how | {"stopped": result.attrs["stopped"]})
    return rows


COLUMNS = [
    *("case", "what", "gas", "alpha", "strength", "n", "realizations", "cold", "rtol"),
    *("outcome", "observable", "value", "error", "truth", "z", "relative"),
    *("start", "total", "seconds", "stopped"),
]


def main() -> None:
    """Run what the table lacks; tell how many are wrong or refused."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path, help="where the table and the references are kept")
    parser.add_argument("--cases", help="first:last of the hundred", default="0:100")
    given = parser.parse_args()
    table = Rows(given.folder / "blind_steady.csv", COLUMNS)
    done = {int(row["case"]) for row in table.all()}
    first, last = map(int, given.cases.split(":"))
    for case in sorted(cases()[first:last], key=lambda case: case["alpha"] % 1.0):
        if case["case"] in done:
            continue
        rows = outcome(case, given.folder)
        table.add(rows)
        print(case["case"], case["what"], case["alpha"], rows[0]["outcome"], flush=True)
    rows = table.all()
    runs = {
        kind: {r["case"] for r in rows if r["outcome"] == kind} for kind in ("wrong", "refused")
    }
    count = len({r["case"] for r in rows})
    print(f"{count} runs: {len(runs['wrong'])} wrong, {len(runs['refused'])} refused")


if __name__ == "__main__":
    main()
