"""The effect of gravity on the conductivity, at one reduced temperature gradient.

Tahiri, Tij and Santos (2000), section 4: at g = 0 the point z0 is the one with 𝒩(z0) = 5 mean free
paths to the cold wall (half of all); ε0 is the reduced gradient there. For other g, z0 is the point
with the same ε0. Then Δκ*(ε0, g*) = κ*(ε0, g*) - κ*(ε0, 0), eq. (33).
"""

from typing import Any

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


def at_equal_gradient(
    result: Result, window: float = conduction.WINDOW, gradient: float | None = None
) -> xr.Dataset:
    """κ*, g* and 𝒩 where ε = ε0, and Δκ*, of a sweep over gravity.

    Arguments:
        result: of `FourierFlow`, swept over gravity alone, with 0 among its values.
        window: width (λ0) of the window in which the temperature slope is fitted.
        gradient: ε0; by default the paper's rule.
    Returns: dataset over `gravity` of the quantities in `NAMES` and their standard errors, from a
    jackknife over realizations of the whole rule, the choice of z0 included. NaN for a state where
    no point has that ε0; its errors are NaN if that happens with one realization left out.
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
    found = _estimated(result, rule(result, window, gradient))
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
    local = rule(result, window, gradient)

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


def _estimated(result: Result, function) -> dict[str, Estimate]:
    """A function of averages (gravity, ...) with its errors, realizations left out in turn."""
    value, error, left_out = jackknife(means(result), function, axis=1)
    run = (result.attrs["run"], "all gravities")
    return {name: Estimate(value[name], error[name], {run: left_out[name]}) for name in value}


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


def rule(result: Result, window: float = conduction.WINDOW, gradient: float | None = None):
    """The paper's rule: a function of averages (gravity, ...), to be put into a jackknife.

    It returns a dict of the quantities in `NAMES`, for every value of gravity.
    """
    coords = result.to_xarray()["realizations"].to_dataset()
    gravity, z = coords["gravity"].values, coords["z"].values
    length = float(result.attrs["parameter_length"])
    scene: Any = result.scene()
    exponent = 1.0 - 0.5 * scene.gas.speed_exponent()

    def at_points(averages: dict) -> dict:
        profile = conduction.profiles(averages)
        local = conduction.reduced(profile, gravity, length, exponent, window)
        return _at_point(local, gravity, z, 0.5 * length, gradient)

    return at_points


def _at_point(local: dict, gravity, z, half: float, gradient: float | None) -> dict:
    """Everything at z0, for every value of gravity; `half` is 𝒩(z0) at g = 0."""
    free = int(np.argmin(np.abs(gravity)))
    start = float(np.interp(half, local["mean_free_paths"][free], z))
    wanted = np.interp(start, z, local["reduced_gradient"][free]) if gradient is None else gradient
    points = [_crossing(z, one, wanted, start) for one in local["reduced_gradient"]]

    def there(name):
        return np.array([np.interp(p, z, one) for p, one in zip(points, local[name], strict=True)])

    found = {name: there(name) for name in NAMES if name in local}
    change = found["kappa_star"] - found["kappa_star"][free]
    return {"z0": np.array(points), **found, "kappa_star_change": change}


def _crossing(z, gradient, wanted: float, start: float) -> float:
    """Where the reduced gradient takes a value, nearest to `start`; NaN if nowhere."""
    above = gradient > wanted
    places = np.flatnonzero(above[1:] != above[:-1])
    if not len(places):
        return float("nan")
    share = (wanted - gradient[places]) / (gradient[places + 1] - gradient[places])
    found = z[places] + share * (z[places + 1] - z[places])
    return float(found[np.argmin(np.abs(found - start))])
