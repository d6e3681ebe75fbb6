"""The tables of table.md that belong to this paper, each as lines of Markdown."""

import numpy as np

from jdsmc import Estimate, Result

from ..markdown import grid
from . import balance, budget, effect, molecules
from .data import Measurements
from .reference import COLUMNS
from .systems import COMBINATIONS, EXAMPLE, PAPER, Combination

DIGITS = {
    "z0": 2,
    "mean_free_paths": 1,
    "reduced_gravity": 3,
    "kappa_star": 3,
    "kappa_star_change": 3,
}


def states(data: Measurements, combination: Combination) -> list[str]:
    """One of tables 2 to 5, each number of the paper before ours."""
    lines = []
    for row in effect.rows(data, combination):
        cells = [f"{row.gravity:g}"]
        for name in COLUMNS:
            cell = row.cells[name]
            cells.append(f"{cell.paper:.{DIGITS[name]}f} / {_shown(cell)}")
        lines.append([*cells, row.verdict])
    header = ["g", *(f"{effect.SYMBOLS[n]} paper / ours" for n in COLUMNS), "verdict"]
    return grid(header, lines)


def _shown(cell: effect.Cell) -> str:
    if not cell.known:
        return "-"
    return f"{cell.ours.value:.0f}" if cell.distance is None else str(cell.ours)


def summary(data: Measurements) -> list[str]:
    """All rows of each column together."""
    lines = []
    for combination in COMBINATIONS:
        for name in COLUMNS:
            found = effect.summary(data, combination, name)
            lines.append(
                [
                    combination.label,
                    effect.SYMBOLS[name],
                    f"{effect.scatter(combination, name):.4f}",
                    f"{found.agreeing} of {found.count}",
                    str(found.offset),
                    f"{found.chi2:.1f}",
                ]
            )
    return grid(
        ["table", "column", "scatter of the paper", "agree", "mean of ours - paper", "χ²/rows"],
        lines,
    )


def paper_noise(data: Measurements) -> tuple[float, float]:
    """Error of the paper's κ* by its scatter, and by ours scaled with particles and time."""
    scaled = []
    for combination in COMBINATIONS:
        errors = data.effects[combination]["kappa_star_error"].values
        ratio = particle_time(data.sweep(combination)) / (PAPER["n_particles"] * PAPER["averaged"])
        scaled.append(np.nanmedian(errors) * np.sqrt(ratio))
    rough = [effect.scatter(c, "kappa_star") for c in COMBINATIONS]
    return float(np.mean(rough)), float(np.mean(scaled))


def particle_time(result: Result) -> float:
    """N times realizations times the time averaged over (τ0), of a mean state."""
    attrs, tree = result.attrs, result.to_xarray().to_dataset()
    end = float(result.series["time"].max())
    time = end - float(tree["steady_from_time"].mean())
    return int(attrs["n_particles"]) * int(attrs["n_realizations"]) * time


def response(data: Measurements) -> list[str]:
    """B and C of Δκ* = B ε0 g* + C g*², ours and from the paper's tables."""
    lines = []
    for combination in COMBINATIONS:
        ours, paper = data.responses[combination], effect.paper_response(combination)
        narrow = effect.narrow_response(data, combination)
        lines.append(
            [
                combination.label,
                str(ours["reduced_gradient"]),
                str(ours["kappa_star"]),
                str(ours["B"]),
                str(narrow) if narrow else "",
                str(paper["B"]),
                _distance(ours["B"], paper["B"]),
                str(ours["C"]),
                str(paper["C"]),
            ]
        )
    header = [
        "sweep",
        "ε0",
        "κ*(g = 0)",
        "B",
        f"B, \\|g*\\| <= {effect.NARROW:g}".replace("\\", ""),
    ]
    return grid(
        [*header, "B of the paper's table", "difference", "C", "C of the paper's table"], lines
    )


def _distance(one: Estimate, other: Estimate) -> str:
    return f"{(one.value - other.value) / np.hypot(one.error, other.error):+.1f} σ"


def balances(data: Measurements) -> list[str]:
    """(12) and (13) for every state."""
    lines = []
    for combination in COMBINATIONS:
        for gravity in data.size.gravity[combination]:
            state = data.realizations(combination, float(gravity))
            flux, stress = balance.energy(state), balance.momentum(state)
            walls = balance.walls(state)
            lines.append(
                [
                    combination.label,
                    f"{gravity:g}",
                    str(balance.slope(state)) if gravity else "",
                    f"{stress.statistic:.2f} ({stress.probability:.2f})",
                    f"{flux.statistic:.2f} ({flux.probability:.2f})",
                    str(walls["gas"]),
                    *(_offset(walls[side]) for side in ("cold", "hot")),
                ]
            )
    header = ["sweep", "g", "slope of P_zz/(-g n)", "Q of (12) (probability)"]
    header += ["Q of (13) (probability)", "q_z", "cold wall - q_z", "hot wall - q_z"]
    return grid(header, lines)


def _offset(difference: Estimate) -> str:
    return f"{difference} ({difference.value / difference.error:+.1f} σ)"


def windows(data: Measurements) -> list[str]:
    """κ* and Δκ* with other windows, of the same simulations."""
    lines = []
    for entry in budget.windows(data):
        cells = [entry.label]
        for name in budget.QUANTITIES:
            cells += [str(entry.values[name]), str(entry.changes[name]) if entry.changes else ""]
        lines.append(cells)
    return grid(["window", *_with_changes(list(budget.QUANTITIES))], lines)


def responses_by_window(data: Measurements) -> list[str]:
    """B of every combination with other windows, and of the paper's table."""
    lines = [
        [
            combination.label,
            *(str(found) for found in budget.response_by_window(data, combination)),
            str(effect.paper_response(combination)["B"]),
        ]
        for combination in data.size.gravity
    ]
    return grid(["B", *(f"window {w:g} λ0" for w in budget.WINDOWS), "the paper's table"], lines)


def variants(data: Measurements) -> list[str]:
    """κ*, Δκ* and q with other numerics, in other simulations."""
    entries = budget.variants(data)
    names, lines = list(entries[0].values), []
    for entry in entries:
        cells = [entry.label]
        for name in names:
            cells += [str(entry.values[name]), _percent(entry, name)]
        lines.append(cells)
    return grid(["simulation", *_with_changes(names)], lines)


def _percent(entry: budget.Entry, name: str) -> str:
    """The change, relative for what is not itself a difference."""
    if entry.changes is None:
        return ""
    change = entry.changes[name]
    if name.startswith("Δ"):
        return str(change)
    scale = 100.0 / abs(entry.values[name].value)
    return f"{Estimate(scale * change.value, scale * change.error)}%"


def _with_changes(names: list[str]) -> list[str]:
    return [part for name in names for part in (name, "change")]


def maxwell(data: Measurements) -> list[str]:
    """Maxwell molecules beside eq. (6)."""
    lines = []
    for length, result in data.molecules.items():
        for window in molecules.WINDOWS:
            found = molecules.response(result, window)
            off = molecules.distances(found)
            gradient = found["reduced_gradient"].value
            lines.append(
                [
                    f"{length:g}",
                    f"{window * length:g}",
                    str(found["reduced_gradient"]),
                    *(f"{found[n]} ({off[n]:+.1f} σ)" for n in ("kappa_star", "B", "C")),
                    f"1, {molecules.FIRST_ORDER:g}, {molecules.second_order(gradient):.1f}",
                ]
            )
    header = ["L", "window", "ε0", "κ*(g = 0)", "B", "C", "eq. (6)"]
    return grid(header, lines)


def simulations(data: Measurements) -> list[str]:
    """What was run, and for how long."""
    lines = []
    for name, result in data.results.items():
        attrs, tree = result.attrs, result.to_xarray().to_dataset()
        step = float(result.series["time"].diff("sample").mean())
        lines.append(
            [
                name,
                f"{tree.sizes['gravity']}",
                f"{attrs['n_particles']} x {attrs['n_realizations']}",
                f"{attrs['layers']}",
                f"{step / int(attrs['steps_per_record']) / SAMPLES:.4f}",
                f"{float(result.series['time'].max()):.0f}",
                f"{float(tree['steady_from_time'].max()):.0f}",
                f"{float(attrs['seconds']):.0f}",
            ]
        )
    header = ["simulation", "g", "N x realizations", "layers", "time step (τ0)", "duration (τ0)"]
    return grid([*header, "averaged from (latest)", "s"], lines)


SAMPLES = 8
"""Samples of a record: `FourierFlow.samples_per_record`."""

REFERENCE_EXAMPLE = EXAMPLE.label
