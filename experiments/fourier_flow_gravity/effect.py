"""Tables 2 to 5: our rows beside the paper's, and the coefficient B from both.

The paper gives no error bars. Its statistical errors are estimated from its own columns: the
scatter about a polynomial of degree 4 in g, which is all that a smooth function leaves of them. An
error that all rows of a table have in common, such as that of ε0, is not in this estimate.
"""

from typing import NamedTuple

import numpy as np
from jdsmc.gravity_effect import linear_response

from jdsmc import Estimate

from .data import Measurements
from .reference import COLUMNS, HALF_WIDTHS, table
from .systems import Combination

DEGREE = 4
"""Of the polynomials in g about which the scatter of the paper's columns is taken."""

AGREEMENT = 2.0
"""Combined standard errors that still count as agreement."""


class Cell(NamedTuple):
    """A number of tables 2 to 5 and ours; `distance` is ours minus the paper's in combined errors.

    The combined error is made of ours, of the paper's scatter and of its rounding; None where both
    are zero by definition.
    """

    paper: float
    ours: Estimate
    distance: float | None

    @property
    def known(self) -> bool:
        """False if our profile has no point with ε0, at least with one realization left out."""
        return bool(np.isfinite(self.ours.value) and np.isfinite(self.ours.error))


class Row(NamedTuple):
    """A state of tables 2 to 5."""

    gravity: float
    cells: dict[str, Cell]

    @property
    def verdict(self) -> str:
        """Agrees, or what differs and by how many combined errors."""
        if not self.cells["kappa_star"].known:
            return "not comparable: no point with ε0"
        far = {n: c.distance for n, c in self.cells.items() if c.distance is not None}
        far = {n: d for n, d in far.items() if abs(d) > AGREEMENT}
        if not far:
            return "agrees"
        return "differs: " + ", ".join(f"{SYMBOLS[n]} {d:+.1f} σ" for n, d in far.items())


SYMBOLS: dict[str, str] = dict(zip(COLUMNS, ("z0", "𝒩(z0)", "g*", "κ*", "Δκ*"), strict=True))


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


def rows(data: Measurements, combination: Combination) -> list[Row]:
    """The rows of a table of which we have the state."""
    effect, paper, found = data.effects[combination], table(combination), []
    for k, gravity in enumerate(paper["gravity"]):
        at = np.flatnonzero(np.isclose(effect["gravity"].values, gravity))
        if len(at):
            here = effect.isel(gravity=int(at[0]))
            cells = {n: _cell(combination, n, paper[n][k], here) for n in COLUMNS}
            found.append(Row(float(gravity), cells))
    return found


def _cell(combination: Combination, name: str, paper: float, here) -> Cell:
    ours = Estimate(float(here[name]), float(here[f"{name}_error"]))
    defined = name in ("mean_free_paths", "reduced_gravity", "kappa_star_change")
    cell = Cell(float(paper), ours, None)
    if not cell.known or (defined and float(here["gravity"]) == 0.0):
        return cell
    rounding = HALF_WIDTHS[name] / 3**0.5
    error = np.sqrt(ours.error**2 + scatter(combination, name) ** 2 + rounding**2)
    return cell._replace(distance=float((ours.value - paper) / error))


class Summary(NamedTuple):
    """All rows of one column of a table together.

    `offset`: mean of ours minus the paper's, and its error if the rows were independent;
    `chi2`: mean of the squared distances.
    """

    agreeing: int
    count: int
    offset: Estimate
    chi2: float


def summary(data: Measurements, combination: Combination, name: str) -> Summary:
    """One column of a table."""
    cells = [row.cells[name] for row in rows(data, combination)]
    cells = [cell for cell in cells if cell.distance is not None]
    distance = np.array([cell.distance for cell in cells])
    difference = np.array([cell.ours.value - cell.paper for cell in cells])
    error = difference / np.where(distance == 0, 1.0, distance)
    offset = Estimate(
        float(np.mean(difference)), float(np.sqrt(np.sum(error**2)) / len(difference))
    )
    agreeing = int(np.sum(np.abs(distance) <= AGREEMENT))
    return Summary(agreeing, len(cells), offset, float(np.mean(distance**2)))


NARROW = 0.05
"""|g*| up to which B is fitted again: does it depend on the range?"""


def narrow_response(data: Measurements, combination: Combination) -> Estimate | None:
    """B from the states with |g*| <= `NARROW` alone, if there are more than three."""
    strength = data.effects[combination]["reduced_gravity"].values
    if np.sum(np.abs(strength) <= NARROW) < 4:
        return None
    return linear_response(data.sweep(combination), largest=NARROW)["B"]


def paper_response(combination: Combination) -> dict[str, Estimate]:
    """The same from the paper's table: least squares with equal weights, errors from the misfit."""
    columns = table(combination)
    best, covariance = np.polyfit(columns["reduced_gravity"], columns["kappa_star"], 2, cov=True)
    error = np.sqrt(np.diag(covariance))
    gradient = PAPER_GRADIENT[combination.key]
    return {
        "B": Estimate(float(best[1] / gradient), float(error[1] / gradient)),
        "C": Estimate(float(best[0]), float(error[0])),
        "kappa_star": Estimate(float(best[2]), float(error[2])),
    }


PAPER_GRADIENT = {"0.05 maxwell": 0.33, "0.05 bgk": 0.36, "0.01 maxwell": 0.44, "0.01 bgk": 0.48}
"""ε0 of the paper's tables."""
