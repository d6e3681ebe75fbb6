"""Cooling disks by DSMC: error against cost over copies, cells and time step; speed.

    python -m benchmarks.cooling_disks [--folder benchmarks/results]
    python -m benchmarks.cooling_disks --speed

α = 0.8, N = 1000, n σ² = 0.01, where the theory knows T~/T0 = 1, a2 and η. What recollisions of
the same few particles do shows in T~; what the width of the cells does, in η. Rows are kept in
cooling_disks.json; a second call goes on where the first was ended. `--speed` times steps
(N = 3000, M = 10), and runs by DSMC and molecular dynamics until η is known to 2% (N = 2000).
Start it with NPROC=1 in the environment to see what one core does.
"""

import argparse
import json
import math
import os
import time
import warnings
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardDisks
from jdsmc.scenarios import CoolingDisks, MolecularDynamics
from jdsmc.theory import langevin

from .timing import facts, say

ALPHA, NUMBER, DENSITY = 0.8, 1000, 0.01
GAS = f"α = {ALPHA}, N = {NUMBER}, n σ² = {DENSITY}"
DURATION, REALIZATIONS = 600.0, 8
SAMPLED_EVERY = 0.7
LEAN = [(1, 1.0), (1, 0.4), (1, 0.2)]
"""Copies and real disks of a cell: the fake heating of M = 1, at a shorter time step: pairs in such
cells would else collide with a probability above one."""

CHART = [
    *((1, r) for r in (2.0, 4.0)),
    *((2, r) for r in (1.0, 2.0, 4.0, 8.0)),
    *((5, r) for r in (0.25, 0.5, 1.0, 2.0)),
    *((10, r) for r in (0.25, 0.5, 1.0)),
    (20, 0.5),
]
DEFAULT = (10, 0.5, 0.07)
WANTED = 0.02
"""Relative error of η to which costs are scaled."""


def cases() -> list[tuple[int, float, float]]:
    """Copies, real disks of a cell, time step: all at 0.07 first."""
    usual = [(m, r, 0.0175) for m, r in LEAN] + [(m, r, 0.07) for m, r in CHART]
    others = [(m, r, h) for h in (0.035, 0.14, 0.2) for m, r in ((2, 2.0), (5, 1.0))]
    return usual + others


def measure(copies: int, real_per_cell: float, time_step: float) -> dict:
    """One row of the chart; CPU seconds without the compilation."""
    scene = CoolingDisks(
        InelasticHardDisks(ALPHA),
        density=DENSITY,
        copies=copies,
        real_per_cell=real_per_cell,
    )
    options = {
        "n_particles": NUMBER,
        "n_realizations": REALIZATIONS,
        "time_step": time_step,
        "steps_per_record": round(SAMPLED_EVERY / time_step),
        "progress": False,
    }
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        jdsmc.run(scene, duration=1.0, seed=2, **options)
        compiled = time.process_time()
        result = jdsmc.run(scene, duration=DURATION, seed=1, **options)
        ended = time.process_time()
    row = {"copies": copies, "real_per_cell": real_per_cell, "time_step": time_step}
    row["cell"] = float(np.sqrt(8 * DENSITY * real_per_cell))
    row["in_cell"] = copies * real_per_cell
    row["seconds"] = ended - compiled
    for name in ("temperature", "a2", "viscosity_ratio"):
        row[name], row[f"{name}_error"] = result[name]
    return row


def viscosity_off(row: dict) -> tuple[float, float]:
    """η over its exact value less one, and the error."""
    exact = langevin.transverse_mode(ALPHA, NUMBER * DENSITY).viscosity_ratio
    return row["viscosity_ratio"] / exact - 1.0, row["viscosity_ratio_error"] / exact


def cost(row: dict) -> float:
    """CPU seconds for a statistical error of η of `WANTED`."""
    return row["seconds"] * (viscosity_off(row)[1] / WANTED) ** 2


def table(rows: list[dict]) -> str:
    """As Markdown."""
    exact = langevin.cooling_state(ALPHA).a2
    lines = [
        f"# Cooling disks: copies, cells, time step ({GAS})",
        "",
        f"Made by `python -m benchmarks.cooling_disks`; do not edit. {REALIZATIONS} realizations "
        f"of {DURATION:g} τ0. Exact, for cells without width: T~/T0 = 1, a2 = {exact:.4f}; η is "
        "shown over its exact value. CPU seconds; the last column is scaled to an error of "
        f"{WANTED:.0%} of η. The default in bold.",
        "",
        "| copies | real a cell | fictive a cell | Δx/λ0 | dt/τ0 | T~/T0 - 1 | a2 | η/exact - 1 "
        "| CPU (s) | CPU (s) to 2% |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for r in rows:
        off, error = viscosity_off(r)
        bold = "**" if (r["copies"], r["real_per_cell"], r["time_step"]) == DEFAULT else ""
        lines.append(
            f"| {bold}{r['copies']}{bold} | {bold}{r['real_per_cell']:g}{bold} "
            f"| {r['in_cell']:g} | {r['cell']:.2f} | {r['time_step']:g} "
            f"| {r['temperature'] - 1:+.4f} ± {r['temperature_error']:.4f} "
            f"| {r['a2']:.4f} ± {r['a2_error']:.4f} | {off:+.3f} ± {error:.3f} "
            f"| {r['seconds']:.1f} | {cost(r):.1f} |"
        )
    return "\n".join(lines) + "\n"


def picture(rows: list[dict], path: Path) -> None:
    """T~ against Δx/(λ0 N_c), the share of collisions that are recollisions; η against Δx; both
    against the cost."""
    from jdsmc.views import pictures  # noqa: PLC0415 - slow to import
    from jdsmc.views.figure import plain_numbers  # noqa: PLC0415

    figure, panels = pictures.grid(3, columns=3)
    usual = [r for r in rows if r["time_step"] == 0.07]
    for number, copies in enumerate(sorted({r["copies"] for r in usual})):
        chosen = [r for r in usual if r["copies"] == copies]
        share = np.array([r["cell"] / r["in_cell"] for r in chosen])
        heat = np.array([(r["temperature"] - 1, r["temperature_error"]) for r in chosen]).T
        off = np.array([viscosity_off(r) for r in chosen]).T
        label = f"{copies} copies" if copies > 1 else "1 copy"
        pictures.bars(panels[0], share, *heat, number, label)
        pictures.bars(panels[1], np.array([r["cell"] for r in chosen]), *off, number, label)
        pictures.bars(panels[2], np.array([cost(r) for r in chosen]), *off, number, label)
    default = next((r for r in rows if r["time_step"] == 0.07 and is_default(r)), None)
    if default:
        off = viscosity_off(default)[0]
        at = [
            (default["cell"] / default["in_cell"], default["temperature"] - 1),
            (default["cell"], off),
            (cost(default), off),
        ]
        for panel, (x, y) in zip(panels, at, strict=True):
            panel.plot(x, y, "o", ms=13, mfc="none", mec="k", label="the default")
    labels = ("Δx/λ0 over fictive particles a cell", "Δx/λ0", "CPU time to 2% of η (s)")
    for panel, label, scaled in zip(panels, labels, (True, False, True), strict=True):
        panel.set(xlabel=label, ylabel="η over exact - 1")
        panel.axhline(0.0, color="k", lw=0.5)
        if scaled:
            panel.set_xscale("log")
            plain_numbers(panel.xaxis)
    panels[0].set_ylabel("T~/T0 - 1")
    title = f"Cooling disks, {GAS}, dt = 0.07 τ0"
    pictures.finish(figure, panels, title).savefig(path, dpi=120)


def is_default(row: dict) -> bool:
    """True for the copies and cells of the default."""
    return (row["copies"], row["real_per_cell"]) == DEFAULT[:2]


def chart(folder: Path) -> None:
    """Run what is missing; write table and picture."""
    folder.mkdir(parents=True, exist_ok=True)
    store = folder / "cooling_disks.json"
    rows = json.loads(store.read_text()) if store.exists() else []
    done = {(r["copies"], r["real_per_cell"], r["time_step"]) for r in rows}
    for case in cases():
        if case not in done:
            try:
                rows.append(measure(*case))
            except jdsmc.FaultError as error:
                say(f"{case} is refused: {error}")
                continue
            store.write_text(json.dumps(rows, indent=1) + "\n")
        (folder / "cooling_disks.md").write_text(table(rows))
        picture(rows, folder / "cooling_disks.png")


def speed() -> None:
    """Nanoseconds a fictive particle-step, collisions a second, seconds to 2% of η."""
    say(facts())
    say(f"NPROC = {os.environ.get('NPROC', 'not set')}")
    real, copies, duration = 3000, 10, 20.0
    scene = CoolingDisks(InelasticHardDisks(0.9), density=DENSITY, copies=copies)
    options = {"n_particles": real, "time_step": 0.07, "steps_per_record": 5, "progress": False}
    jdsmc.run(scene, duration=1.0, **options)
    wall, processor = time.perf_counter(), time.process_time()
    result = jdsmc.run(scene, duration=duration, seed=1, **options)
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    series = result.series
    steps = REALIZATIONS * real * copies * 5 * series.sizes["sample"]
    met = REALIZATIONS * real * copies * float(series["collisions"][-1]) / 2.0
    say(
        f"DSMC, N = {real}, M = {copies}, four modes every five steps: "
        f"{processor / steps * 1e9:.1f} ns of CPU and {wall / steps * 1e9:.1f} ns of wall a "
        f"fictive particle-step; {met / processor:.3g} collisions a second of CPU, "
        f"{met / wall:.3g} of wall (C++, one core: 18 ns, 3.4e6)"
    )
    number = 2000
    kinds = {
        "DSMC": CoolingDisks(InelasticHardDisks(ALPHA), density=DENSITY),
        "molecular dynamics": MolecularDynamics(InelasticHardDisks(ALPHA), density=DENSITY),
    }
    exact = langevin.transverse_mode(ALPHA, number * DENSITY).viscosity_ratio
    for name, scene in kinds.items():
        jdsmc.run(scene, n_particles=number, duration=2.0, progress=False)
        wall, processor = time.perf_counter(), time.process_time()
        result = jdsmc.run(scene, n_particles=number, rtol=WANTED, budget=1e5, progress=False)
        wall, processor = time.perf_counter() - wall, time.process_time() - processor
        value = result["viscosity_ratio"]
        say(
            f"{name}, α = {ALPHA}, N = {number}: η/η0 = {value} (dilute theory {exact:.4f}) after "
            f"{math.ceil(float(result.series['time'][-1]))} τ0, {wall:.1f} s of wall, "
            f"{processor:.1f} s of CPU"
        )


def main() -> None:
    """The chart, or the speeds."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--folder", type=Path, default=Path(__file__).parent / "results")
    parser.add_argument("--speed", action="store_true", help="time steps and whole runs instead")
    given = parser.parse_args()
    if given.speed:
        speed()
    else:
        chart(given.folder)


if __name__ == "__main__":
    main()
