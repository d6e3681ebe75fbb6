"""Derivatives of any scene from a smooth fit over a sweep about its point.

Seven values of a number about the scene's own, equally far apart in a variable in which averages
are smooth, are run in one compiled program. The slope at the scene's own value of a polynomial of
degree 4 fitted to them is the derivative; that of degree 2 fitted to the same, its difference
being the truncation. Slopes are linear in what was measured, and the points are independent gases,
so that errors add up in squares.
"""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from .. import check, sweep
from ..errors import NotSteadyError, unbroken
from ..fields import ingredients
from ..results.result import Result
from ..results.sensitivity import Sensitivity
from ..running.checkpoint import check_none
from ..running.run import run
from ..scenarios.base import AbstractScene
from ..stats import spread_to
from .numbers import chosen_paths

POINTS, DEGREE, LOWER = 7, 4, 2

SHARE_OF_RANGE = 0.02
"""The least half, over half of the allowed range: for a number that is zero, say."""

INSIDE = 1e-3
"""Share of the width by which points stay away from a border that is not allowed itself."""


class Variable(NamedTuple):
    """A number θ through a variable u in which averages are smooth: u(θ), θ(u), dθ/du.

    `width`: half of the range of the points over u itself. Noise falls with it as 1/h, and what
    degree 4 leaves out grows as h⁴.
    """

    of: Callable
    back: Callable
    slope: Callable
    width: float


PLAIN = Variable(lambda x: x, lambda u: u, lambda u: 1.0, 0.4)
INELASTICITY = Variable(
    *(lambda x: np.sqrt(1.0 - x**2), lambda u: np.sqrt(1.0 - u**2)),
    *(lambda u: -u / np.sqrt(1.0 - u**2), 0.2),
)
"""u = √(1-α²): stresses and cumulants of a sheared gas go as u near the elastic limit."""


def sensitivity_by_sweep(
    scene: AbstractScene,
    wrt: bool | str | tuple[str, ...],
    *,
    widths: Mapping[str, float] | None = None,
    **options,
) -> Sensitivity:
    """Derivatives of all steady values, profiles included, from runs of `POINTS` values a number.

    Arguments:
        scene: one point of any scene.
        wrt: names of physical numbers, or True for all that can be varied.
        widths: half of the range of values about the scene's own, by name, for some of them; for a
            restitution in √(1-α²). By default 0.4 of the number (0.2 of √(1-α²)), at least 0.02
            of half of the allowed range. Where a border is in the way, points move inwards.
        options: as of `jdsmc.run`, for every point.
    Returns: as `jdsmc.sensitivity`; `.result` is the run of the scene itself. Derivatives of a
        profile are at a fixed layer.
    Raises ValueError for a swept scene, for what is no number, for one that cannot be varied (the
    restitution of a Fourier flow), and what `jdsmc.run` raises.
    """
    check_none(options, "a smooth fit")
    if sweep.swept_paths(scene):
        raise ValueError("a smooth fit is about one point; give a scene without arrays.")
    paths = chosen_paths(sweep.points(scene)[0][0], wrt)
    plans = {}
    for name, path in paths.items():
        try:
            plans[name] = planned(scene, path, (widths or {}).get(name))
        except ValueError:
            if wrt is not True:
                raise
    centre = unbroken(run(scene, **options))
    slopes = [
        slopes_of(unbroken(run(one, **options)), name, *w) for name, (one, *w) in plans.items()
    ]
    return with_slopes(centre, list(plans), slopes)


def planned(scene: AbstractScene, path: str, width: float | None = None):
    """The scene to be run, and the weights of its points in the two slopes at the scene's own.

    Returns: a sweep; weights (points,) of degree `DEGREE` and of degree `LOWER`.
    """
    name, facts = path.rsplit(".", maxsplit=1)[-1], sweep.facts(scene, path)
    number = float(np.asarray(sweep.numbers(scene)[path]))
    allowed = facts.get("range") or {"low": -np.inf, "high": np.inf}
    variable = INELASTICITY if name == "restitution" else PLAIN
    ends = sorted(variable.of(np.array([allowed["low"], allowed["high"]])))
    at = float(variable.of(number))
    if width is None:
        spread = 0.5 * (ends[1] - ends[0])
        least = SHARE_OF_RANGE * spread if np.isfinite(spread) else 0.0
        width = max(variable.width * abs(at), least)
    if width == 0.0:
        raise ValueError(
            f"{name} = 0 does not say how far to vary it; give widths = {{{name!r}: ...}}."
        )
    check.scalar(f"widths[{name!r}]", width, 0.0, np.inf, high_included=False)
    low, high = _inside(at - width, at + width, ends, 2.0 * INSIDE * width)
    u = np.linspace(low, high, POINTS)
    varied = replaced(scene, path, variable.back(u))
    if variable is INELASTICITY and at == 0.0:
        raise ValueError(
            "wrt = 'restitution' has no derivative from a fit at restitution = 1: averages are "
            "smooth in √(1-α²) only; give a restitution below 1."
        )
    per_unit = 1.0 / width / variable.slope(at)
    own, lower = (per_unit * slope_weights((u - at) / width, n) for n in (DEGREE, LOWER))
    return varied, own, lower


def _inside(low: float, high: float, ends, margin: float) -> tuple[float, float]:
    """An interval moved, and cut if it must be, to lie within the allowed one."""
    least, most = ends[0] + margin, ends[1] - margin
    if low < least:
        low, high = least, high + least - low
    if high > most:
        low, high = max(least, low + most - high), most
    return low, high


def slope_weights(x: np.ndarray, degree: int) -> np.ndarray:
    """Weights (points,) with which values at x give the slope at 0 of the fitted polynomial."""
    return np.linalg.pinv(np.vander(x, degree + 1, increasing=True))[1]


def replaced(module, path: str, value):
    """A gas or scene made anew, and checked, with another value of one number.

    Raises ValueError where that may not be.
    """
    first, _, rest = path.partition(".")
    parts = ingredients(module)
    if first not in parts:
        raise ValueError(f"{path} of {type(module).__name__} is worked out, not given.")
    parts[first] = replaced(parts[first], rest, value) if rest else value
    try:
        return type(module)(**parts)
    except ValueError as error:
        name = path.rsplit(".", maxsplit=1)[-1]
        raise ValueError(f"{name} cannot be varied: {error}") from error


def slopes_of(measured: Result, name: str, own, lower) -> dict[str, dict[str, np.ndarray]]:
    """By observable: the slope, its error, its truncation, and with each realization left out.

    Raises NotSteadyError if a point has no steady values.
    """
    started = measured.steady.get("steady_from_time", np.nan)
    if not np.all(np.isfinite(started)):
        raise NotSteadyError(
            f"not all values of {name} became steady ({measured.attrs['stopped']}); give the runs "
            "more time, or a smaller width."
        )
    data, found = measured.steady, {}
    left_out = measured.to_xarray()["left_out"].to_dataset()
    for observable in measured:
        values, errors = (
            data[observable + suffix].transpose(name, ...).values for suffix in ("", "_error")
        )
        value, other = (np.tensordot(w, values, 1) for w in (own, lower))
        error = np.sqrt(np.tensordot(own**2, errors**2, 1))
        replicas = left_out[observable].transpose("realization", name, ...).values
        replicas = np.tensordot(replicas, own, (1, 0))
        spread = np.sqrt((len(replicas) - 1) * np.var(replicas, axis=0))
        replicas = spread_to(replicas, spread, error)
        found[observable] = {
            "": value,
            "_error": error,
            "_truncation": np.abs(value - other),
            "_left_out": value + replicas - np.mean(replicas, axis=0),
        }
    return found


def with_slopes(centre: Result, names: list[str], slopes: list[dict]) -> Sensitivity:
    """The run of the scene itself, with derivatives as groups of its tree."""
    tree, steady = centre.to_xarray(), centre.steady
    groups = {path: tree[path].to_dataset() for path in ("/", *(f"/{n}" for n in tree.children))}
    values, left_out = {}, {}
    for observable in centre:
        dims = steady[observable].dims
        each = [one[observable] for one in slopes]
        for suffix in ("", "_error", "_truncation"):
            key, attrs = observable + suffix, steady[observable].attrs
            values[key] = (("parameter", *dims), np.stack([one[suffix] for one in each]), attrs)
        stacked = np.stack([one["_left_out"] for one in each], axis=1)
        left_out[observable] = (("realization", "parameter", *dims), stacked)
    coords = {"parameter": names} | {n: c for n, c in steady.coords.items()}
    groups["/sensitivity"] = xr.Dataset(values, coords)
    groups["/sensitivity_left_out"] = xr.Dataset(left_out, coords)
    return Result(xr.DataTree.from_dict(groups)).sensitivity
