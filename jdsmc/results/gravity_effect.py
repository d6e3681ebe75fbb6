"""The effect of gravity on the conductivity, at one reduced temperature gradient.

Tahiri, Tij and Santos (2000), section 4: at g = 0 the point z0 is the one with 𝒩(z0) = 5 mean free
paths to the cold wall (half of all); ε0 is the reduced gradient there. For other g, z0 is the point
with the same ε0. Then Δκ*(ε0, g*) = κ*(ε0, g*) - κ*(ε0, 0), eq. (33).
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..estimate import Estimate
from ..measure import conduction
from ..stats import jackknife
from .result import Result

NAMES = {
    "z0": "point of equal reduced gradient (λ0)",
    "mean_free_paths": "𝒩(z0), mean free paths from the cold wall",
    "reduced_gradient": "ε0",
    "reduced_gravity": "g*",
    "kappa_star": "κ*",
    "kappa_star_change": "Δκ*",
}

LEVER, STEEP = 1.0, 5.0
"""λ0 to either side of z0 between which slopes are taken; times its error that the slope of ε must
be for z0 to have an error."""


def at_equal_gradient(
    result: Result, window: float = conduction.WINDOW, gradient: float | None = None
) -> xr.Dataset:
    """κ*, g* and 𝒩 where ε = ε0, and Δκ*, of a sweep over gravity.

    Arguments:
        result: of `FourierFlow`, swept over gravity alone, with 0 among its values.
        window: width (λ0) of the window in which the temperature slope is fitted.
        gradient: ε0; by default the paper's rule.
    Returns: dataset over `gravity` of the quantities in `NAMES` and their standard errors, from a
    jackknife over realizations of the whole rule, the choice of z0 included, linear about z0. NaN
    for a state where no point has that ε0; its errors are NaN if ε(z) is so flat there that its
    slope is known no better than to a fifth.
    Raises ValueError for another sweep, or if no state has such a point.
    """
    found = points(result, window, gradient)
    out = xr.Dataset(coords={"gravity": result.steady["gravity"].values}, attrs={"window": window})
    for name, long in NAMES.items():
        value, error = found[name]
        out[name] = ("gravity", value, {"long_name": long})
        out[f"{name}_error"] = ("gravity", error, {"long_name": f"standard error of {long}"})
    return out


def points(
    result: Result, window: float = conduction.WINDOW, gradient: float | None = None
) -> dict[str, Estimate]:
    """The quantities in `NAMES` as estimates over gravity; arguments as of `at_equal_gradient`.

    Those of one result are correlated, with whatever window or gradient.
    """
    local = rule(result, window, gradient)
    found = _estimated(result, local.at_points, local.flat)
    if not np.any(np.isfinite(found["z0"].value)):
        raise ValueError("no layer has the reduced gradient asked for; give another gradient.")
    return found


def linear_response(
    result: Result,
    window: float = conduction.WINDOW,
    gradient: float | None = None,
    largest: float = np.inf,
) -> dict[str, Estimate]:
    """B and C of κ*(ε0, g*) = κ*(ε0, 0) + B ε0 g* + C g*², fitted to a sweep over gravity.

    Arguments as of `at_equal_gradient`; states with |g*| <= `largest` and a known κ* are used,
    weighted with its error. Errors from a jackknife of rule and fit together: the states have ε0 in
    common, so that their κ* are not independent.
    Returns: estimates "B", "C", "kappa_star" (at g = 0, from the fit) and "reduced_gradient".
    """
    effect = points(result, window, gradient)
    error = effect["kappa_star"].error
    used = (np.abs(effect["reduced_gravity"].value) <= largest) & np.isfinite(error)
    if np.sum(used) < 3:
        raise ValueError(f"fewer than three states have a known κ* and |g*| <= {largest:g}.")
    weight = 1.0 / np.asarray(error)[used]
    local = rule(result, window, gradient).at_points

    def fitted(averages):
        found = local(averages)
        strength, ratio = (found[name][used] for name in ("reduced_gravity", "kappa_star"))
        scaled = np.vander(strength, 3, increasing=True) * weight[:, None]
        best = np.linalg.lstsq(scaled, ratio * weight, rcond=None)[0]
        start = float(np.nanmean(found["reduced_gradient"]))
        return {
            "kappa_star": best[0],
            "B": best[1] / start,
            "C": best[2],
            "reduced_gradient": start,
        }

    return _estimated(result, fitted)


def _estimated(result: Result, function, unknown=None) -> dict[str, Estimate]:
    """A function of averages (gravity, ...) with its errors, realizations left out in turn.

    `unknown`: values of gravity at which what is found has no error.
    """
    value, error, left_out = jackknife(means(result), function, axis=1)
    if unknown is not None:
        error = {name: np.where(unknown, np.nan, x) for name, x in error.items()}
        left_out = {name: np.where(unknown, np.nan, x) for name, x in left_out.items()}
    run = (result.attrs["run"], "all gravities")
    return {
        name: Estimate(x, error[name], {run: left_out[name]}, np.zeros(np.shape(x), int))
        for name, x in value.items()
    }


def means(result: Result) -> dict[str, np.ndarray]:
    """Averages that add up, of a sweep over gravity alone: (gravity, realization, ...)."""
    if result.attrs["scene"] != "FourierFlow" or "realizations" not in result.to_xarray().children:
        raise ValueError("the effect of gravity needs steady values of FourierFlow.")
    data = result.to_xarray()["realizations"].to_dataset()
    if set(data.dims) != {"gravity", "realization", "z"} or not np.any(data["gravity"] == 0):
        raise ValueError("the effect of gravity needs a sweep over gravity alone, with 0 in it.")
    names = ("density", "pressure", "pressure_zz", "heat_flux", "mean_heat_flux")
    names = (*names, "heat_flux_cold_wall", "heat_flux_hot_wall")
    return {name: data[name].transpose("gravity", "realization", ...).values for name in names}


class Rule(NamedTuple):
    """`at_points`: averages (gravity, ...) to the quantities in `NAMES`, for a jackknife;
    `flat`: states whose ε(z) does not tell where it takes a value."""

    at_points: Callable[[dict], dict]
    flat: np.ndarray


def rule(result: Result, window: float = conduction.WINDOW, gradient: float | None = None) -> Rule:
    """The paper's rule, for every value of gravity."""
    coords = result.to_xarray()["realizations"].to_dataset()
    gravity, z = coords["gravity"].values, coords["z"].values
    length = float(result.attrs["parameter_length"])
    scene: Any = result.scene()
    exponent = 1.0 - 0.5 * scene.gas.speed_exponent()

    def local(averages: dict) -> dict:
        profile = conduction.profiles(averages)
        return conduction.reduced(profile, gravity, length, exponent, window)

    free = int(np.argmin(np.abs(gravity)))
    return linearised(local, means(result), free, z, 0.5 * length, gradient)


def linearised(
    local: Callable[[dict], dict], averages: dict, free: int, z, half: float, gradient: float | None
) -> Rule:
    """The rule, linear about the points z0 of the averages over all realizations.

    Arguments: `local`, averages (gravity, ...) to the profiles (gravity, z) of `NAMES`; averages
    (gravity, realization, ...); the state without gravity; half of all mean free paths.

    With d the change of ε(z0) - ε0 the point moves by -d over the slope of ε. That is taken over
    2 `LEVER`: from one layer to the next it is mostly noise where ε(z) is flat, and the error of
    z0 would be what that noise says (0.17 λ0 where three wider windows scatter by 0.3).
    """

    def wanted(found: dict) -> tuple[float, float]:
        start = float(np.interp(half, found["mean_free_paths"][free], z))
        there = np.interp(start, z, found["reduced_gradient"][free])
        return start, float(there) if gradient is None else gradient

    whole = local({name: np.mean(x, axis=1) for name, x in averages.items()})
    start, value = wanted(whole)
    points = np.array([_crossing(z, one, value, start) for one in whole["reduced_gradient"]])
    names = [name for name in NAMES if name in whole]

    def slopes(found: dict) -> dict[str, np.ndarray]:
        low, high = (np.clip(points + x, z[0], z[-1]) for x in (-LEVER, LEVER))
        return {n: (_at(high, z, found[n]) - _at(low, z, found[n])) / (high - low) for n in names}

    slope = slopes(whole)
    _, error, _ = jackknife(averages, lambda one: slopes(local(one)), axis=1)

    def at_points(averages: dict) -> dict:
        found = local(averages)
        start, value = wanted(found)
        shift = (value - _at(points, z, found["reduced_gradient"])) / slope["reduced_gradient"]
        if gradient is None:
            shift[free] = start - points[free]
        there = {n: _at(points, z, found[n]) + slope[n] * shift for n in names}
        there["reduced_gradient"] = np.where(np.isnan(points), np.nan, value)
        change = there["kappa_star"] - there["kappa_star"][free]
        return {"z0": points + shift, **there, "kappa_star_change": change}

    steep = np.abs(slope["reduced_gradient"]) > STEEP * error["reduced_gradient"]
    steep[free] |= gradient is None  # that point is where 𝒩 is half of all
    return Rule(at_points, ~steep)


def _at(points: np.ndarray, z, profiles: np.ndarray) -> np.ndarray:
    """Each profile (gravity, z) at the point of its state."""
    return np.array([np.interp(p, z, one) for p, one in zip(points, profiles, strict=True)])


def _crossing(z, gradient, wanted: float, start: float) -> float:
    """Where the reduced gradient takes a value, nearest to `start`; NaN if nowhere."""
    above = gradient > wanted
    places = np.flatnonzero(above[1:] != above[:-1])
    if not len(places):
        return float("nan")
    share = (wanted - gradient[places]) / (gradient[places + 1] - gradient[places])
    found = z[places] + share * (z[places + 1] - z[places])
    return float(found[np.argmin(np.abs(found - start))])
