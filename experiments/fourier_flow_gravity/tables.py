"""The tables of table.md that belong to this paper, each as lines of Markdown."""

from functools import partial

import numpy as np

from jdsmc import Estimate, Result
from jdsmc.results.gravity_effect import linear_response

from ..markdown import grid
from . import balance, effect, profiles
from .cases import COMBINATIONS, PAPER_WORK, Combination
from .data import PAPER, Fourier


def summary(data: Fourier) -> list[str]:
    """All rows of each column together, and how they are judged."""
    rows = []
    for c in COMBINATIONS:
        for name, symbol in effect.SYMBOLS.items():
            agree, offset, misfit = effect.summary(data, c, name)
            rough = f"{effect.scatter(c, name):.4f}"
            rows.append([c.label, symbol, rough, agree, offset, f"{misfit:.1f}"])
    header = ["table", "column", "scatter of the paper", "agree", "mean of ours - paper"]
    return grid([*header, "χ²/rows"], rows)


def paper_scatter(_: Fourier) -> str:
    """Error of the paper's κ* by its scatter, mean of the tables."""
    return f"{np.mean([effect.scatter(c, 'kappa_star') for c in COMBINATIONS]):.4f}"


def scaled_error(data: Fourier) -> str:
    """Error of the paper's κ* by ours, scaled with particles and time."""
    scaled = []
    for combination in COMBINATIONS:
        error = np.nanmedian(data.effects[combination]["kappa_star"].error)
        scaled.append(error * np.sqrt(particle_time(data.sweep(combination)) / PAPER_WORK))
    return f"{np.mean(scaled):.4f}"


def particle_time(result: Result) -> float:
    """N times realizations times the time averaged over (τ0), of a mean state."""
    particles = int(result.attrs["n_particles"]) * int(result.attrs["n_realizations"])
    end = float(result.series["time"].max())
    return particles * (end - float(result.steady["steady_from_time"].mean()))


def states(combination: Combination, data: Fourier) -> list[str]:
    """One of tables 2 to 5, each number of the paper before ours."""
    rows = []
    for row in effect.rows(data, combination):
        cells = [
            f"{cell.paper:.{effect.DIGITS[name]}f} / {_shown(cell)}"
            for name, cell in row.cells.items()
        ]
        rows.append([f"{row.gravity:g}", *cells, row.verdict])
    header = ["g", *(f"{symbol} paper / ours" for symbol in effect.SYMBOLS.values())]
    return grid([*header, "verdict"], rows)


def _shown(cell: effect.Cell) -> str:
    if not cell.known:
        return "-"
    return f"{cell.ours.value:.0f}" if cell.difference is None else str(cell.ours)


for _number, _combination in enumerate(COMBINATIONS, start=2):
    PAPER.tables[f"table_{_number}"] = partial(states, _combination)


def response(data: Fourier) -> list[str]:
    """B and C of Δκ* = B ε0 g* + C g*², ours and from the paper's tables."""
    rows = []
    for c in COMBINATIONS:
        ours, paper = data.responses[c], effect.paper_response(c)
        fitted = [ours["reduced_gradient"], ours["kappa_star"], ours["B"]]
        apart = f"{ours['B'].distance(paper['B']):+.1f} σ"
        narrow = effect.narrow_response(data, c)
        rows.append([c.label, *fitted, narrow, paper["B"], apart, ours["C"], paper["C"]])
    header = ["sweep", "ε0", "κ*(g = 0)", "B", f"B, |g*| <= {effect.NARROW:g}"]
    header += ["B of the paper's table", "difference", "C", "C of the paper's table"]
    return grid(header, rows)


def balances(data: Fourier) -> list[str]:
    """(12) and (13) for every state."""
    rows = []
    for combination in COMBINATIONS:
        for gravity in data.gravity[combination]:
            state = data.realizations(combination, float(gravity))
            walls = balance.walls(state)
            tests = [test(state) for test in (balance.momentum, balance.energy)]
            cells = [balance.slope(state) if gravity else ""]
            cells += [f"{t.statistic:.2f} ({t.probability:.2f})" for t in tests]
            cells += [walls["gas"], *(_off(walls[side], 0.0) for side in ("cold", "hot"))]
            rows.append([combination.label, f"{gravity:g}", *cells])
    header = ["sweep", "g", "slope of P_zz/(-g n)", "Q of (12) (probability)"]
    header += ["Q of (13) (probability)", "q_z", "cold wall - q_z", "hot wall - q_z"]
    return grid(header, rows)


def _off(found: Estimate, truth: float) -> str:
    return f"{found} ({found.distance(truth):+.1f} σ)"


def windows(data: Fourier) -> list[str]:
    """κ* and Δκ* with other windows, of the same simulations; and B."""
    lines = _changes("window", profiles.windows(data), str)
    rows = [
        [c.label, *profiles.response_by_window(data.sweep(c)), effect.paper_response(c)["B"]]
        for c in data.gravity
    ]
    header = ["B", *(f"window {w:g} λ0" for w in profiles.WINDOWS), "the paper's table"]
    lines += ["", "B in all combinations, from the same simulations:", ""]
    return lines + grid(header, rows)


def variants(data: Fourier) -> list[str]:
    """κ*, Δκ* and q with other numerics, in other simulations."""
    return _changes("simulation", profiles.variants(data), None)


def _changes(kind: str, entries: list[profiles.Entry], show) -> list[str]:
    """Values beside their changes; these relative, unless they are shown otherwise."""
    rows = []
    for entry in entries:
        cells = []
        for name, value in entry.values.items():
            change = entry.changes.get(name)
            if change is None:
                text = ""
            elif show or name.startswith("Δ"):
                text = str(change)
            else:
                text = f"{change * (100.0 / abs(float(value)))}%"
            cells += [value, text]
        rows.append([entry.label, *cells])
    return grid([kind, *(x for name in entries[0].values for x in (name, "change"))], rows)


def maxwell(data: Fourier) -> list[str]:
    """Maxwell molecules beside eq. (6)."""
    rows = []
    for length, result in data.molecules.items():
        for window in profiles.MAXWELL_WINDOWS:
            found = linear_response(result, window * length)
            gradient = found["reduced_gradient"]
            second = profiles.second_order(float(gradient.value))
            wanted = {"kappa_star": 1.0, "B": profiles.FIRST_ORDER, "C": second}
            cells = [_off(found[name], truth) for name, truth in wanted.items()]
            known = f"1, {profiles.FIRST_ORDER:g}, {second:.1f}"
            rows.append([f"{length:g}", f"{window * length:g}", gradient, *cells, known])
    return grid(["L", "window", "ε0", "κ*(g = 0)", "B", "C", "eq. (6)"], rows)
