"""Our value of every quoted number, from the simulations."""

import numpy as np
import xarray as xr
from jdsmc.observables import VISCOSITY_TIME, maxwell_speed_classes

from jdsmc import Estimate

from ..compare import Span
from . import correlation, tails
from .data import Measurements, SteadyQuantity, Term
from .systems import FAST, SLOW

SHARES = maxwell_speed_classes()
"""Equilibrium shares of the four speed classes."""

HYDRODYNAMIC = 2.0
"""Collisions per particle after which the paper takes the kinetic stage as over (Fig. 10)."""


def one(gas, restitution, shear_rate, name, index=None, function=lambda x: x) -> SteadyQuantity:
    """A function of a single steady observable."""
    return SteadyQuantity((Term(gas, restitution, shear_rate, name, index),), function)


def ratio(name: str, gas: str, function) -> SteadyQuantity:
    """A function of the ratio of a gas to IHS at α = 0.5, a τ0 = 4."""
    terms = (Term(gas, 0.5, FAST, name), Term("ihs", 0.5, FAST, name))
    return SteadyQuantity(terms, lambda x, y: function(x / y))


STEADY: dict[str, SteadyQuantity] = {
    "temperature": one("ihs", 0.9, FAST, "temperature"),
    "ehs_temperature": one("ehs", 0.9, FAST, "temperature"),
    "shear_stress": one("ihs", 0.9, FAST, "shear_stress"),
    "normal_stress": one("ihs", 0.9, FAST, "normal_stress_xy"),
    "excess_temperature": ratio("temperature", "ehs", lambda x: x - 1.0),
    **{f"ratio_{k}": one("ihs", 0.5, FAST, "speed_ratio", k) for k in range(4)},
    "slow_share": one("ihs", 0.5, FAST, "speed_ratio", 0, lambda x: x * SHARES[0]),
    "middle_share": one("ihs", 0.5, FAST, "speed_ratio", 1, lambda x: x * SHARES[1]),
    "overpopulation": one("ihs", 0.5, FAST, "speed_ratio", 0, lambda x: x - 1.0),
    "underpopulation": one("ihs", 0.5, FAST, "speed_ratio", 1, lambda x: 1.0 - x),
    "delicate": ratio("normal_stress_zy", "ehs", lambda x: 1.0 - x),
    "delicate_measured": ratio("normal_stress_zy", "ehs_measured", lambda x: 1.0 - x),
}
"""Numbers that one or two steady states decide; `evidence` can repeat them."""


def settling(data: Measurements, restitution: float, shear_rate: float, clock: str) -> Span:
    """When T has come within 2% of T_s for good, in `clock`; the range is 5% to 1%."""
    series = data.series("ihs", restitution, shear_rate)
    final = data.lookup(Term("ihs", restitution, shear_rate, "temperature")).value
    return settled(series, series["temperature"].values / final, clock)


def ratio_settling(data: Measurements) -> Span:
    """When R_0, R_1 and R_2 have all come within 2% of their steady values."""
    series = data.series("ihs", 0.5, FAST)
    steady = data.steady("ihs", 0.5, FAST)["speed_ratio"].values[:3]
    ratios = series["speed_ratio"].transpose("sample", "speed_class").values[:, :3] / steady
    spans = [settled(series, column, "clock") for column in ratios.T]
    return max(spans, key=lambda span: span.value)


STAYS = 5.0
"""Collisions per particle for which a quantity must stay near its steady value to count as there.

Longer would wait for the fluctuations of a finite gas, not for the approach.
"""


def settled(series: xr.Dataset, relative: np.ndarray, clock: str) -> Span:
    """From when a running mean over one collision is off by less than 2% (5%, 1%)."""
    collisions = series["clock"].values
    smooth = running_mean(collisions, relative)
    places = [_first_inside(collisions, smooth, limit) for limit in (0.02, 0.05, 0.01)]
    return Span(*(float(series[clock].values[k]) for k in places), label="within 2% [5% to 1%]")


def running_mean(clock: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Mean over the records within half a collision per particle of each record."""
    first, last = np.searchsorted(clock, clock - 0.5), np.searchsorted(clock, clock + 0.5)
    total = np.concatenate([[0.0], np.cumsum(values)])
    return (total[last] - total[first]) / (last - first)


def _first_inside(collisions: np.ndarray, relative: np.ndarray, limit: float) -> int:
    """The first record after which the limit is kept for `STAYS` collisions; else the last."""
    outside = np.concatenate([[0], np.cumsum(np.abs(relative - 1.0) > limit)])
    until = np.searchsorted(collisions, collisions + STAYS)
    kept = (outside[until] == outside[:-1]) & (until < len(collisions))
    return int(np.argmax(kept)) if kept.any() else len(collisions) - 1


def thermal_share(data: Measurements, choose) -> Estimate:
    """Least or largest share of particles below 2 v0 after the kinetic stage, α = 0.5, a τ0 = 4.

    That stage "lasts about one collision per particle" (section V B).
    """
    series = data.series("ihs", 0.5, FAST)
    late = series["clock"].values > 1.0
    ratios = series["speed_ratio"].transpose("sample", "speed_class").values[late]
    errors = series["speed_ratio_error"].transpose("sample", "speed_class").values[late]
    share = running_mean(series["clock"].values[late], ratios[:, :2] @ SHARES[:2])
    place = choose(share)
    return Estimate(float(share[place]), float(np.hypot(*(errors[place, :2] * SHARES[:2]))))


def measure(data: Measurements) -> dict[str, Estimate | Span]:
    """Our value of every entry of `reference.NUMBERS`, by its key."""
    fits = correlation.fits(data)
    values: dict[str, Estimate | Span] = {k: q.of(data.lookup) for k, q in STEADY.items()}
    values |= {
        "settling_s_09": settling(data, 0.9, FAST, "clock"),
        "settling_s_05": settling(data, 0.5, FAST, "clock"),
        "settling_t_09": settling(data, 0.9, FAST, "time"),
        "settling_t_05": settling(data, 0.5, FAST, "time"),
        "slow_t_09": settling(data, 0.9, SLOW, "time"),
        "slow_t_05": settling(data, 0.5, SLOW, "time"),
        "ratio_settling": ratio_settling(data),
        "least_thermal": thermal_share(data, np.argmin),
        "most_thermal": thermal_share(data, np.argmax),
        "slope": fits["both"].slope,
        "crossing_a2": correlation.crossing(data, "a2"),
        "crossing_cubed": correlation.crossing(data, "relative_speed_cubed"),
        "exponent": tails.exponent(data, "ihs", 0.5).exponent,
    }
    return values


def theory() -> dict[str, float]:
    """The formulas behind the entries of `reference.THEORY`."""
    return {
        "equilibrium_slow": SHARES[0],
        "equilibrium_middle": SHARES[1],
        "equilibrium_thermal": SHARES[0] + SHARES[1],
        "mean_free_time": np.sqrt(np.pi) / 2 / VISCOSITY_TIME,
        "characteristic_time": 1 / VISCOSITY_TIME,
        "viscosity_time": VISCOSITY_TIME,
        "newtonian_ihs": correlation.newtonian_ihs(0.5),
        "newtonian_ehs": correlation.newtonian_ehs(0.5),
    }
