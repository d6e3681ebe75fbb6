"""Cooling disks by DSMC: error against cost over copies, cells and time step.

    python -m benchmarks.cooling_disks [--folder benchmarks/results]

α = 0.8, N = 1000, n σ² = 0.01, where the theory knows T~/T0 = 1 and a2. What recollisions of the
same few particles do shows in T~ within a few hundred τ0; the viscosity needs longer runs. Rows are
kept in cooling_disks.json; a second call goes on where the first was ended.
"""

import argparse
import json
import time
import warnings
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardDisks
from jdsmc.scenarios import CoolingDisks
from jdsmc.theory import langevin

ALPHA, NUMBER, DENSITY = 0.8, 1000, 0.01
DURATION, REALIZATIONS = 120.0, 8
SAMPLED_EVERY = 0.7
STEPS = (0.035, 0.07, 0.14)
LEAN = [(1, 1.0), (1, 0.4), (1, 0.2)]
"""Copies and real disks of a cell: the fake heating of M = 1."""

CHART = [
    *((1, r) for r in (2.0, 4.0)),
    *((2, r) for r in (1.0, 2.0, 4.0)),
    *((5, r) for r in (0.25, 0.5, 1.0)),
    *((10, r) for r in (0.25, 0.5)),
    (20, 0.5),
]


def cases() -> list[tuple[int, float, float]]:
    """Copies, real disks of a cell, time step: all at 0.07 first."""
    usual = [(m, r, 0.07) for m, r in (*LEAN, *CHART)]
    others = [(m, r, h) for h in (0.035, 0.14) for m, r in ((1, 0.4), (5, 1.0))]
    return usual + others


def measure(copies: int, real_per_cell: float, time_step: float) -> dict:
    """One row of the chart: averages over the later 3/4 of the run; CPU seconds without the
    compilation."""
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
    series = result.series
    late = series["time"].values > DURATION / 4
    row = {"copies": copies, "real_per_cell": real_per_cell, "time_step": time_step}
    row["cell"] = float(np.sqrt(8 * DENSITY * real_per_cell))
    row["in_cell"] = copies * real_per_cell
    row["seconds"] = ended - compiled
    for name in ("temperature", "a2"):
        row[name] = float(np.mean(series[name].values[late]))
        # errors of records add up over some two relaxation times, 1/μ for T~
        memory = 2 * (12.6 if name == "temperature" else 3.0)
        error = np.mean(series[f"{name}_error"].values[late])
        row[f"{name}_error"] = float(error / np.sqrt(max(1.0, 0.75 * DURATION / memory)))
    return row


def table(rows: list[dict]) -> str:
    """As Markdown."""
    exact = langevin.cooling_state(ALPHA).a2
    lines = [
        f"# Cooling disks: copies, cells, time step (α = {ALPHA}, N = {NUMBER}, n σ² = {DENSITY})",
        "",
        f"{REALIZATIONS} realizations of {DURATION:g} τ0, later 3/4; exact T~/T0 = 1 (dilute), "
        f"a2 = {exact:.4f}. CPU seconds on a shared machine.",
        "",
        "| copies | real a cell | fictive a cell | Δx/λ0 | dt/τ0 | T~/T0 | a2 | CPU (s) |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for r in rows:
        lines.append(
            f"| {r['copies']} | {r['real_per_cell']:g} | {r['in_cell']:g} | {r['cell']:.2f} "
            f"| {r['time_step']:g} | {r['temperature']:.4f} ± {r['temperature_error']:.4f} "
            f"| {r['a2']:.4f} ± {r['a2_error']:.4f} | {r['seconds']:.1f} |"
        )
    return "\n".join(lines) + "\n"


def picture(rows: list[dict], path: Path) -> None:
    """T~ against cost, and against Δx/(λ0 N_c), the share of collisions that are recollisions."""
    from jdsmc.views import pictures  # noqa: PLC0415 - slow to import

    figure, panels = pictures.grid(2)
    for number, copies in enumerate(sorted({r["copies"] for r in rows})):
        chosen = [r for r in rows if r["copies"] == copies and r["time_step"] == 0.07]
        value = np.array([r["temperature"] - 1 for r in chosen])
        error = np.array([r["temperature_error"] for r in chosen])
        share = np.array([r["cell"] / r["in_cell"] for r in chosen])
        for panel, x in zip(panels, ([r["seconds"] for r in chosen], share), strict=True):
            pictures.bars(panel, np.array(x), value, error, number, f"{copies} copies")
    for panel, label in zip(
        panels, ("CPU time (s)", "Δx/λ0 over fictive particles a cell"), strict=True
    ):
        panel.set(xscale="log", xlabel=label, ylabel="T~/T0 - 1")
        panel.axhline(0.0, color="k", lw=0.5)
    title = f"Cooling disks, α = {ALPHA}, N = {NUMBER}, n σ² = {DENSITY}, dt = 0.07 τ0"
    pictures.finish(figure, panels, title).savefig(path, dpi=120)


def main() -> None:
    """Run what is missing; write table and picture."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--folder", type=Path, default=Path(__file__).parent / "results")
    folder = parser.parse_args().folder
    store = folder / "cooling_disks.json"
    rows = json.loads(store.read_text()) if store.exists() else []
    done = {(r["copies"], r["real_per_cell"], r["time_step"]) for r in rows}
    for case in cases():
        if case not in done:
            rows.append(measure(*case))
            store.write_text(json.dumps(rows, indent=1) + "\n")
            (folder / "cooling_disks.md").write_text(table(rows))
            picture(rows, folder / "cooling_disks.png")


if __name__ == "__main__":
    main()
