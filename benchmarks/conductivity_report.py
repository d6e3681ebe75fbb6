"""Tables of the heat-flux benchmarks, from the measured numbers and nothing else."""

import numpy as np

from . import conductivity
from .conductivity import APPROACH, PAPER
from .report import grid, spread


def tables(data: dict) -> str:
    """The whole report."""
    versions = ", ".join(f"{name} {version}" for name, version in data["machine"].items())
    quick = "\n\n**Quick mode: tiny sizes, numbers without meaning.**" if data["quick"] else ""
    head = (
        "# Heat-flux force: speed\n\nMade by `python -m benchmarks.heat_flux`; what is measured "
        "and how is said in `benchmarks/conductivity.py`. "
        f"The run took {data['minutes']:.1f} minutes.\n\nMachine: {versions}.{quick}"
    )
    return "\n\n".join([head, _throughput(data["throughput"]), _times(data)]) + "\n"


def _throughput(rows: list[dict]) -> str:
    header = ["scheme", "dt/τ", "N", "particle-steps/s", "ns per particle-step"]
    cells = []
    for row in rows:
        speed = row["particle_steps_per_second"]
        each = f"{1e9 / speed['median']:.2f}"
        sizes = [row["scheme"], f"{row['time_step']:g}", f"{row['n_particles']:,}"]
        cells.append([*sizes, spread(speed), each])
    title = f"## Particle-steps per second on {conductivity.CORES} cores (α = 0.5)"
    return "\n\n".join([title, "Medians, in brackets the range.", grid(header, cells)])


def _times(data: dict) -> str:
    target = data["target"]
    ours, kicks = (_seconds_needed(data[name], target) for name in ("ours", "kicks"))
    theirs = paper_seconds(data)
    header = ["method", "wall time (s)", "κ'/κ0 measured", "paper's time over this"]
    rows = [
        [
            "two fields extrapolated, defaults of `run`",
            f"{ours:.3g}",
            _mean(data["ours"]),
            f"{theirs / ours:.0f}",
        ],
        [
            "kicks (κ, μ and η too)",
            f"{kicks:.3g}",
            _mean(data["kicks"]),
            f"{theirs / kicks:.0f}",
        ],
        [
            f"paper's parameters (ε* = {PAPER['field']:g}, extrapolated in time)",
            f"{theirs:.3g}",
            "",
            "1",
        ],
    ]
    fields = " and ".join(f"{field:g}" for field in conductivity.FIELDS)
    note = (
        f"Without compiling ({_compiling(data['ours']):.1f} s, {_compiling(data['kicks']):.1f} s). "
        f"Fields {fields}. The time of the averages is scaled as 1/error² to the target; of "
        "the kicks' bias in ε and of the paper's in ε* and dt nothing is counted."
    )
    title = f"## Wall time to κ'(0.5) within {100 * target:g}% on {conductivity.CORES} cores"
    return "\n\n".join([title, note, grid(header, rows)])


def paper_seconds(data: dict) -> float:
    """The paper's parameters: steps to the steady state and through the measurement."""
    row = next(r for r in data["throughput"] if r["scheme"] == "paper")
    particles = PAPER["particles"] * PAPER["realizations"]
    measured = (data["noise"]["noise"] / data["target"]) ** 2 / particles
    work = particles * (APPROACH + measured) / PAPER["time_step"]
    return work / row["particle_steps_per_second"]["median"]


def _seconds_needed(runs: dict, target: float) -> float:
    """Mean over the runs without compiling: the approach, and the rest times (error/target)²."""
    wall, value, error, approach = (np.array(column[1:]) for column in runs.values())
    factor = np.mean((error / value / target) ** 2)
    return float(np.mean(wall * approach) + np.mean(wall * (1 - approach)) * factor)


def _compiling(runs: dict) -> float:
    return runs["seconds"][0] - float(np.mean(runs["seconds"][1:]))


def _mean(runs: dict) -> str:
    error = np.sqrt(np.sum(np.square(runs["error"]))) / len(runs["error"])
    return f"{np.mean(runs['value']):.4f} ± {error:.4f}"
