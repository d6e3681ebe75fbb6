"""Rows of the table: a run in this process, what it cost, how far it is from the truth."""

import csv
import time
import warnings
from pathlib import Path

import numpy as np

import jdsmc

from .scenes import Studied

COLUMNS = (
    *("scene", "observable", "knob", "setting", "value", "bias", "error"),
    *("cost_cpu_seconds", "particle_steps", "is_default"),
)
OF_RUN = ("time_step", "n_particles", "splitting", "steps_per_record")
DEFAULT, REFERENCE = "default", "reference"
LONGER = 1.5
"""Factor by which a run is made longer until it is steady."""
QUICK = 0.25
"""Share of the length of a row that a quick table takes."""


def campaign(scenes: list[Studied], table: Path, *, quick: bool) -> list[dict]:
    """Make what the table lacks; its rows."""
    if not table.exists():
        table.write_text(",".join(COLUMNS) + "\n")
    for scene in scenes:
        done = {(r["knob"], r["setting"]) for r in rows_of(table) if r["scene"] == scene.name}
        for knob, setting, given in settings(scene, quick=quick):
            if (knob, str(setting)) in done:
                continue
            print(f"{scene.name}: {knob} {setting}", flush=True)
            new = row(scene, knob, setting, given, truth_of(scene, rows_of(table)), quick=quick)
            with table.open("a", newline="") as file:
                csv.DictWriter(file, COLUMNS).writerows(new)
    return rows_of(table)


def settings(scene: Studied, *, quick: bool) -> list[tuple[str, object, dict]]:
    """Knob, setting, what is given to scene and run; the reference and the default first."""
    found: list[tuple[str, object, dict]] = []
    if scene.reference:
        found.append((REFERENCE, "", scene.reference))
    found.append((DEFAULT, "", {}))
    for knob, values in scene.knobs.items():
        some = values[:: max(1, len(values) - 1)] if quick else values
        found += [(knob, value, {knob: value}) for value in some]
    return found


def row(scene: Studied, knob, setting, given: dict, truth: dict, *, quick: bool) -> list[dict]:
    """One run: a row for each observable. The program is compiled before the clock starts."""
    options = {name: value for name, value in given.items() if name in OF_RUN}
    length = dict(scene.length)
    clock = next(name for name in ("duration", "collisions") if name in length)
    length[clock] *= (QUICK if quick else 1.0) * (scene.longer if knob == REFERENCE else 1.0)
    options = length | options | {"progress": False}
    made = scene.make(**given)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # what is tried is known to be off
        try:
            jdsmc.run(made, **options | {clock: 1e-3})
            while True:
                began = time.process_time()
                result = jdsmc.run(made, seed=7, **options)
                cost = time.process_time() - began
                if result.is_steady:
                    break
                options[clock] *= LONGER
        except jdsmc.FaultError as error:
            print(f"no row: {error}", flush=True)
            return []
    attrs = result.attrs
    steps = attrs["n_records"] * attrs["steps_per_record"]
    shared = {"scene": scene.name, "knob": knob, "setting": setting}
    shared |= {"cost_cpu_seconds": f"{cost:.4g}", "is_default": knob == DEFAULT}
    shared["particle_steps"] = int(steps * attrs["n_particles"] * attrs["n_realizations"])
    rows = []
    for name in scene.observables:
        value, error = (float(np.mean(x)) for x in result[name])
        bias = value - truth.get(name, value)
        numbers = {"value": value, "bias": bias, "error": float(np.hypot(bias, error))}
        rows.append(shared | {"observable": name} | {n: f"{x:.6g}" for n, x in numbers.items()})
    return rows


def truth_of(scene: Studied, rows: list[dict]) -> dict[str, float]:
    """By theory, or of the reference run."""
    own = [r for r in rows if r["scene"] == scene.name and r["knob"] == REFERENCE]
    return {r["observable"]: float(r["value"]) for r in own} | scene.truth


def rows_of(table: Path) -> list[dict]:
    """What a table holds."""
    with table.open() as file:
        return list(csv.DictReader(file))
