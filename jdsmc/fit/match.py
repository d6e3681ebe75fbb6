"""Numbers of an elastic gas that match observables: roots, least squares, and their errors."""

from collections.abc import Sequence

import numpy as np
import scipy

from ..estimate import Estimate, combine
from .elastic_curve import Curve
from .labelled import Match, nothing
from .targets import Target

GRID = 400
"""Points at which a match is looked for before it is polished."""

ROUNDING = 1e-6
"""Percent: what is left of an exact match."""

STEP = 1e-4
"""Relative step of the derivatives of a curve, which is a polynomial."""


class Elastic:
    """The elastic gas at one restitution: observables as functions of its free numbers.

    Arguments: 1-α²; the curves of a target; the names of the free numbers, `rate_factor` or
    `drag_factor` or both; values of those that are not free.
    """

    def __init__(
        self, loss: float, curves: Sequence[Curve], free: tuple[str, ...], fixed: dict[str, float]
    ):
        self.loss, self.curves, self.free, self.fixed = loss, curves, free, fixed
        self.low = max(curve.low for curve in curves)
        self.high = min(curve.high for curve in curves)

    def place(self, numbers) -> tuple:
        """β and x at values of the free numbers."""
        known = self.fixed | dict(zip(self.free, numbers, strict=True))
        beta = known["rate_factor"]
        return beta, known["drag_factor"] * self.loss / beta

    def values(self, numbers) -> np.ndarray:
        """The observables, (targets, ...)."""
        beta, x = self.place(numbers)
        return np.stack([curve.observable(beta, x) for curve in self.curves])

    def slopes(self, numbers) -> np.ndarray:
        """Their derivatives, (targets, free)."""
        columns = []
        for k, value in enumerate(numbers):
            ends = [np.array(numbers, float), np.array(numbers, float)]
            ends[0][k] -= STEP * value
            ends[1][k] += STEP * value
            below, above = (self.values(end) for end in ends)
            columns.append((above - below) / (2.0 * STEP * value))
        return np.stack(columns, axis=-1)

    def grid(self) -> list[np.ndarray]:
        """Values of the free numbers within the range of the curves, from the elastic limit on."""
        x = np.geomspace(self.low, self.high, GRID)
        if self.free == ("rate_factor",):
            return [self.fixed["drag_factor"] * self.loss / x]
        if self.free == ("drag_factor",):
            return [x * self.fixed["rate_factor"] / self.loss]
        beta = np.geomspace(0.3, 2.0, GRID)
        both = np.meshgrid(x, beta, indexing="ij")
        found = {"rate_factor": both[1], "drag_factor": both[0] * both[1] / self.loss}
        return [found[name].ravel() for name in self.free]

    def within(self, numbers) -> bool:
        """True if the curves are known there."""
        beta, x = self.place(numbers)
        return bool(beta > 0 and self.low <= x <= self.high)


def match(elastic: Elastic, target: Target, wanted: list[Estimate]) -> Match:
    """The free numbers that match what is wanted, best in relative terms where there are more.

    Of several roots of one observable that nearest to the elastic limit is taken.
    """
    goal = np.array([float(one.value) for one in wanted])
    if not np.all(np.isfinite(goal)):
        return nothing(elastic.free, "the reference has no steady value")
    grid = elastic.grid()
    off = elastic.values(grid) - goal[:, None]
    single = len(goal) == 1
    best = _root(elastic, grid[0], off[0], goal) if single else _least(elastic, target, grid, goal)
    if best is None or not elastic.within(best):
        return nothing(elastic.free, _why(elastic, target, grid, off, goal))
    beta, x = elastic.place(best)
    scale = np.array(target.weights) / np.abs(goal)
    model = [curve.estimate(float(beta), float(x)) for curve in elastic.curves]
    slopes = elastic.slopes(best) * scale[:, None]
    inverse = np.linalg.pinv(slopes)

    def split(*values):
        count = len(goal)
        miss = scale * (np.array(values[:count]) - np.array(values[count:]))
        return np.append(best - inverse @ (miss - middle), _percent(miss, slopes, inverse, middle))

    middle = scale * (np.array([float(one.value) for one in model]) - goal)
    found = combine(split, *model, *wanted)
    numbers = {name: found[k] for k, name in enumerate(elastic.free)}
    error = float((model[0] - wanted[0]).error)
    doubt = _doubt(target, off[0], error, float(best[0])) if single else ""
    if doubt:
        return nothing(elastic.free, doubt)
    exact = len(goal) == len(best) and float(found[-1].value) < ROUNDING
    return Match(numbers, Estimate(0.0, 0.0) if exact else found[-1])


def _percent(miss, slopes, inverse, middle) -> float:
    """Root of the mean square of what is left after the fit, in %."""
    left = miss - slopes @ (inverse @ (miss - middle))
    return 100.0 * float(np.sqrt(np.mean(left**2)))


def _root(elastic: Elastic, grid: np.ndarray, off: np.ndarray, goal) -> np.ndarray | None:
    """The first crossing from the elastic limit on."""
    places = np.flatnonzero(np.diff(np.sign(off)) != 0)
    if not len(places):
        return None
    ends = grid[places[0]], grid[places[0] + 1]
    return np.array(
        [scipy.optimize.brentq(lambda b: float(elastic.values([b])[0] - goal[0]), *ends)]
    )


def _least(elastic: Elastic, target: Target, grid, goal) -> np.ndarray | None:
    """The best of the grid, polished; None if it lies at the end of what is known."""
    scale = np.array(target.weights) / np.abs(goal)

    def misses(numbers) -> np.ndarray:
        return scale * (elastic.values(numbers) - goal)

    score = np.sum((scale[:, None] * (elastic.values(grid) - goal[:, None])) ** 2, axis=0)
    start = np.array([values[np.argmin(score)] for values in grid])
    if np.argmin(score) in (0, len(score) - 1):
        return None
    return scipy.optimize.least_squares(misses, start, xtol=1e-12, ftol=1e-12, x_scale=start).x


def _why(elastic: Elastic, target: Target, grid, off, goal) -> str:
    """A clause on what comes nearest, where nothing matches."""
    score = np.sum((off / goal[:, None]) ** 2, axis=0)
    nearest = int(np.argmin(score))
    name = {"rate_factor": "β", "drag_factor": "d"}
    near = ", ".join(
        f"{name[free]} = {values[nearest]:.3g}"
        for free, values in zip(elastic.free, grid, strict=True)
    )
    miss = 100.0 * np.sqrt(np.mean((off[:, nearest] / goal) ** 2))
    first = grid[0]
    return (
        f"no {' and '.join(name[one] for one in elastic.free)} matches {target.label}: looked at "
        f"from {min(first):.3g} to {max(first):.3g}, nearest at {near}, off by {miss:.2g}%"
    )


def _doubt(target: Target, off, error: float, best: float) -> str:
    """A clause if the match is lost two standard errors away: near a turn or the end of a curve."""
    if all(np.any(np.diff(np.sign(off + shift)) != 0) for shift in (-2.0 * error, 2.0 * error)):
        return ""
    return (
        f"{target.label} is matched near {best:.3g}, but within two standard errors of it nothing "
        "matches any more: ask for a smaller rtol, or for another target"
    )
