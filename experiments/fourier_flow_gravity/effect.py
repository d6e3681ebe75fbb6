"""Tables 2 to 5: our rows beside the paper's, and the coefficient B from both.

The paper gives no error bars. Its statistical errors are estimated from its own columns: the
scatter about a polynomial of degree 4 in g, which is all that a smooth function leaves of them. An
error that all rows of a table have in common, such as that of ε0, is not in this estimate.
"""

from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from jdsmc import Estimate
from jdsmc.results.gravity_effect import linear_response

from .cases import COMBINATIONS, Combination
from .data import Fourier

SYMBOLS = {
    "z0": "z0",
    "mean_free_paths": "𝒩(z0)",
    "reduced_gravity": "g*",
    "kappa_star": "κ*",
    "kappa_star_change": "Δκ*",
}
"""Columns of tables 2 to 5 after g, by the names of `jdsmc.results.gravity_effect`."""

DIGITS = dict(zip(SYMBOLS, (2, 1, 3, 3, 3), strict=True))

HALF_WIDTHS = dict(zip(SYMBOLS, (0.025, 0.05, 0.0005, 0.0005, 0.0005), strict=True))
"""Half a unit of the last digit; z0 is given in steps of 0.05, half a layer."""

PAPER_GRADIENT = dict(zip(COMBINATIONS, (0.33, 0.36, 0.44, 0.48), strict=True))
"""ε0 of the paper's tables."""

DEGREE = 4
"""Of the polynomials in g about which the scatter of the paper's columns is taken."""

AGREEMENT = 2.0
"""Combined standard errors that still count as agreement."""

NARROW = 0.05
"""|g*| up to which B is fitted again: does it depend on the range?"""


@cache
def table(combination: Combination) -> dict[str, np.ndarray]:
    """One of tables 2 to 5: `gravity` and the columns of `SYMBOLS`, arrays over its rows."""
    lines = (Path(__file__).parent / "tables.txt").read_text().splitlines()
    rows = [line.split() for line in lines if not line.startswith("#")]
    key = [f"{combination.cold:g}", combination.wall]
    columns = np.array([row[2:] for row in rows if row[:2] == key], float).T
    return dict(zip(("gravity", *SYMBOLS), columns, strict=True))


class Cell(NamedTuple):
    """A number of tables 2 to 5 and ours; `difference` is ours minus the paper's.

    Its error is made of ours, of the paper's scatter and of its rounding; None where both are zero
    by definition, or where our profile has no point with ε0, at least with one realization left
    out.
    """

    paper: float
    ours: Estimate
    difference: Estimate | None

    @property
    def known(self) -> bool:
        """False if our profile has no point with ε0."""
        return bool(np.isfinite(self.ours.value) and np.isfinite(self.ours.error))

    @property
    def distance(self) -> float | None:
        """The difference in combined errors."""
        return None if self.difference is None else float(self.difference.distance(0.0))


class Row(NamedTuple):
    """A state of tables 2 to 5."""

    gravity: float
    cells: dict[str, Cell]

    @property
    def verdict(self) -> str:
        """Agrees, or what differs and by how many combined errors."""
        if not self.cells["kappa_star"].known:
            return "not comparable: no point with ε0"
        far = [(n, c.distance) for n, c in self.cells.items() if c.distance is not None]
        far = [f"{SYMBOLS[n]} {d:+.1f} σ" for n, d in far if abs(d) > AGREEMENT]
        return "differs: " + ", ".join(far) if far else "agrees"


def scatter(combination: Combination, name: str) -> float:
    """Standard error of a number in a column of the paper, from its roughness.

    Δκ* has the error of κ* twice, its own and that of g = 0.
    """
    if name == "kappa_star_change":
        return 2**0.5 * scatter(combination, "kappa_star")
    rows = table(combination)
    gravity = rows["gravity"] / np.max(np.abs(rows["gravity"]))
    rest = rows[name] - np.polyval(np.polyfit(gravity, rows[name], DEGREE), gravity)
    return float(np.sqrt(np.sum(rest**2) / (len(rest) - DEGREE - 1)))


def rows(data: Fourier, combination: Combination) -> list[Row]:
    """The rows of a table of which we have the state."""
    effect, paper, found = data.effects[combination], table(combination), []
    gravities = np.array(data.gravity[combination])
    for k, gravity in enumerate(paper["gravity"]):
        for at in np.flatnonzero(np.isclose(gravities, gravity)):
            cells = {n: _cell(combination, n, paper, k, effect[n][at]) for n in SYMBOLS}
            found.append(Row(float(gravity), cells))
    return found


def _cell(combination: Combination, name: str, paper: dict, k: int, ours: Estimate) -> Cell:
    cell = Cell(float(paper[name][k]), ours, None)
    defined = name in ("mean_free_paths", "reduced_gravity", "kappa_star_change")
    if not cell.known or (defined and paper["gravity"][k] == 0.0):
        return cell
    error = np.hypot(scatter(combination, name), HALF_WIDTHS[name] / 3**0.5)
    return cell._replace(difference=ours - Estimate(cell.paper, error))


def summary(data: Fourier, combination: Combination, name: str) -> tuple[str, Estimate, float]:
    """All rows of one column of a table together: how many agree, the mean difference, χ²/rows.

    The difference is ours minus the paper's, with its error if the rows were independent.
    """
    found = [row.cells[name].difference for row in rows(data, combination)]
    value, error = np.array([(one.value, one.error) for one in found if one is not None]).T
    distance = value / error
    offset = Estimate(np.mean(value), np.sqrt(np.sum(error**2)) / len(error))
    agreeing = f"{np.sum(np.abs(distance) <= AGREEMENT)} of {len(value)}"
    return agreeing, offset, float(np.mean(distance**2))


def narrow_response(data: Fourier, combination: Combination) -> Estimate | str:
    """B from the states with |g*| <= `NARROW` alone, if there are more than three."""
    strength = data.effects[combination]["reduced_gravity"].value
    if np.sum(np.abs(strength) <= NARROW) < 4:
        return ""
    return linear_response(data.sweep(combination), largest=NARROW)["B"]


def paper_response(combination: Combination) -> dict[str, Estimate]:
    """The same from the paper's table: least squares with equal weights, errors from the misfit."""
    columns = table(combination)
    best, covariance = np.polyfit(columns["reduced_gravity"], columns["kappa_star"], 2, cov=True)
    pairs = zip(best, np.sqrt(np.diag(covariance)), strict=True)
    fit = dict(zip(("C", "B", "kappa_star"), (Estimate(*pair) for pair in pairs), strict=True))
    return fit | {"B": fit["B"] / PAPER_GRADIENT[combination]}
