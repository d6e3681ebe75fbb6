"""Our value of every number that the text quotes for the homogeneous problem."""

from typing import NamedTuple

import numpy as np
import xarray as xr
from scipy.optimize import curve_fit

from jdsmc import Estimate, combine
from jdsmc.measure.observables import maxwell_speed_classes
from jdsmc.units import VISCOSITY_TIME

from ..case import estimate
from ..numbers import Fit, Span, each
from .cases import BOTH, FAST, SLOW
from .data import PAPER, Shear

SHARES = maxwell_speed_classes()
"""Equilibrium shares of the four speed classes."""

HYDRODYNAMIC = 2.0
"""Collisions per particle after which the paper takes the kinetic stage as over (Fig. 10)."""


def value(gas: str, restitution: float, name: str, index: int | None = None):
    """A single steady value at a τ0 = 4."""

    def of(data) -> Estimate:
        found = data.steady(gas, restitution, FAST, name)
        return found if index is None else found[index]

    return of


def over_ihs(name: str, gas: str):
    """The ratio of a gas to IHS at α = 0.5, a τ0 = 4."""
    return lambda data: data.steady(gas, 0.5, FAST, name) / data.steady("ihs", 0.5, FAST, name)


def _share(index: int, function):
    ratio = value("ihs", 0.5, "speed_ratio", index)
    return lambda data: function(ratio(data))


STEADY = {
    "temperature": value("ihs", 0.9, "temperature"),
    "ehs_temperature": value("ehs", 0.9, "temperature"),
    "shear_stress": value("ihs", 0.9, "shear_stress"),
    "normal_stress": value("ihs", 0.9, "normal_stress_xy"),
    "excess_temperature": lambda data: over_ihs("temperature", "ehs")(data) - 1.0,
    **{f"ratio_{k}": value("ihs", 0.5, "speed_ratio", k) for k in range(4)},
    "slow_share": _share(0, lambda ratio: ratio * SHARES[0]),
    "middle_share": _share(1, lambda ratio: ratio * SHARES[1]),
    "overpopulation": _share(0, lambda ratio: ratio - 1.0),
    "underpopulation": _share(1, lambda ratio: 1.0 - ratio),
    "delicate": lambda data: 1.0 - over_ihs("normal_stress_zy", "ehs")(data),
    "delicate_measured": lambda data: 1.0 - over_ihs("normal_stress_zy", "ehs_measured")(data),
}
"""Numbers that one or two steady states decide; `evidence` can repeat them."""

STAYS = 5.0
"""Collisions per particle for which a quantity must stay near its steady value to count as there.

Longer would wait for the fluctuations of a finite gas, not for the approach.
"""


def settled(series: xr.Dataset, relative: np.ndarray, clock: str) -> Span:
    """From when a running mean over one collision is off by less than 2% (5%, 1%), in `clock`."""
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


def settling(restitution: float, shear_rate: float, clock: str):
    """When T has come within 2% of T_s for good, in `clock`; the range is 5% to 1%."""

    def of(data: Shear) -> Span:
        series = data.series("ihs", restitution, shear_rate)
        final = float(data.steady("ihs", restitution, shear_rate, "temperature"))
        return settled(series, series["temperature"].values / final, clock)

    return of


def speed_ratios(data: Shear) -> tuple[xr.Dataset, Estimate]:
    """The series at α = 0.5, a τ0 = 4, and R_l in it: (sample, speed class)."""
    series = data.series("ihs", 0.5, FAST).transpose("sample", "speed_class", ...)
    return series, estimate(series, "speed_ratio")


def ratio_settling(data: Shear) -> Span:
    """When R_0, R_1 and R_2 have all come within 2% of their steady values."""
    series, ratios = speed_ratios(data)
    relative = ratios.value / data.steady("ihs", 0.5, FAST, "speed_ratio").value
    spans = [settled(series, column, "clock") for column in relative.T[:3]]
    return max(spans, key=lambda span: span.value)


def thermal_share(choose):
    """Least or largest share of particles below 2 v0 after the kinetic stage, α = 0.5, a τ0 = 4.

    That stage "lasts about one collision per particle" (section V B).
    """

    def of(data: Shear) -> Estimate:
        series, ratios = speed_ratios(data)
        late = series["clock"].values > 1.0
        slow = ratios.value[late, :2] * SHARES[:2]
        share = running_mean(series["clock"].values[late], np.sum(slow, axis=1))
        place = choose(share)
        error = ratios.error[late, :2][place] * SHARES[:2]
        return Estimate(float(share[place]), float(np.hypot(*error)))

    return of


ISOTROPIC_SLOPE = 3.0 / 16.0
"""⟨V12³⟩/⟨V12³⟩0 = 1 + (3/16) a2 in isotropic states (section V C)."""


class Slope(NamedTuple):
    """⟨V12³⟩/⟨V12³⟩0 - 1 = k a2: the slope, its range over the points, misfits per point (χ²/ν)."""

    slope: Estimate
    least: float
    largest: float
    misfit: float
    misfit_isotropic: float


def slopes(data: Shear) -> dict[str, Slope]:
    """Least-squares slopes through the origin, for each gas and for both."""
    pairs = {
        gas: (data.against(gas, "a2"), data.against(gas, "relative_speed_cubed") - 1.0)
        for gas in BOTH
    }
    joined = [
        combine(lambda *x: np.concatenate(x), *part) for part in zip(*pairs.values(), strict=True)
    ]
    return {name: _slope(*pair) for name, pair in (pairs | {"both": tuple(joined)}).items()}


def _slope(x: Estimate, y: Estimate) -> Slope:
    slope = combine(lambda x, y: np.sum(x * y) / np.sum(x * x), x, y)
    variance = y.error**2 + (slope.value * x.error) ** 2

    def misfit(k) -> float:
        return float(np.sum((y.value - k * x.value) ** 2 / variance) / (len(x.value) - 1))

    local = y.value / x.value
    ranges = float(local.min()), float(local.max())
    return Slope(slope, *ranges, misfit(slope.value), misfit(ISOTROPIC_SLOPE))


def crossing(name: str):
    """Restitution at which an observable of EHS and IHS is equal.

    Their difference, which vanishes at α = 1, is (1-α) times a fitted parabola.
    """

    def of(data: Shear) -> Estimate:
        alpha, (ihs, ehs) = data.restitutions(), data.both(name)
        weight = (1.0 - alpha) / (ehs - ihs).error

        def root(one, other):
            scaled = (other - one) / (1.0 - alpha)
            found = np.polynomial.Polynomial.fit(alpha, scaled, 2, w=weight).roots()
            real = found[np.abs(found.imag) < 1e-9].real
            inside = real[(real > alpha[0]) & (real < alpha[-1])]
            return inside[np.argmin(np.abs(inside - 0.7))] if len(inside) else np.nan

        return combine(root, ihs, ehs)

    return of


TAIL = 3.0
"""Tails begin at this C: three thermal speeds, as R_3 does."""

LARGEST_ERROR = 0.3
"""Bins with a larger relative error are left out: their logarithm is not Gaussian."""


class Tail(NamedTuple):
    """Fits of ln F to A - B C^μ for `first` <= C <= `last`.

    `exponent`: μ when free; `misfits`: χ²/ν of μ = 1 and μ = 2; `slopes`: -d ln F/dC in the inner
    and the outer half of the range.
    """

    exponent: Estimate
    misfits: tuple[float, float]
    slopes: tuple[Estimate, ...]
    first: float
    last: float


def tail(data: Shear, gas: str, restitution: float) -> Tail:
    """Fits to the tail of F, averaged over the shear rates."""
    c, log = _log_tail(data, gas, restitution)
    start = (log.value[0] + 2.0 * c[0], 2.0, 1.0)
    best, covariance = curve_fit(
        lambda c, constant, factor, power: constant - factor * c**power,
        *(c, log.value, start, log.error),
        absolute_sigma=True,
        bounds=([-np.inf, 0.0, 0.2], [np.inf, np.inf, 4.0]),
        maxfev=20_000,
    )

    def line(part, power: int) -> Fit:
        return Fit(np.stack([np.ones(len(c[part])), -(c[part] ** power)], axis=1), each(log[part]))

    halves = (c < 0.5 * (c[0] + c[-1]), c >= 0.5 * (c[0] + c[-1]))
    return Tail(
        Estimate(float(best[2]), float(np.sqrt(covariance[2, 2]))),
        (line(slice(None), 1).misfit, line(slice(None), 2).misfit),
        tuple(line(half, 1).terms[1] for half in halves),
        *(float(c[0]), float(c[-1])),
    )


def _log_tail(data: Shear, gas: str, restitution: float) -> tuple[np.ndarray, Estimate]:
    """C and ln F, up to the first bin that is too uncertain."""
    found = data.distribution(gas, restitution)
    c, density = found["speed_bin"].values, found["speed"].values
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = np.where(density > 0, found["speed_error"].values / density, np.inf)
    uncertain = np.flatnonzero((c > TAIL) & ~(relative < LARGEST_ERROR))
    inside = slice(np.searchsorted(c, TAIL), uncertain[0] if len(uncertain) else len(c))
    floor = np.median(relative[inside])  # a bin whose few realizations agree by chance
    error = np.maximum(relative[inside], 0.1 * floor)
    return c[inside], Estimate(np.log(density[inside]), error)


def newtonian_ihs(alpha: float) -> float:
    """Navier-Stokes η* of IHS in the first Sonine approximation, without the small a2 terms.

    η* = 1/(ν - ζ/2) with ν = (1+α)(3-α)/4, ζ = 5(1-α²)/12 in units of ν0 (Brey et al. 1998, [8]).
    """
    return 1.0 / ((1 + alpha) * (3 - alpha) / 4 - 5 * (1 - alpha**2) / 24)


def newtonian_ehs(alpha: float) -> float:
    """Navier-Stokes η* of EHS and of BGK: η* = 1/(β + ζ/2), from the stress balance."""
    return 1.0 / ((1 + alpha) / 2 + 5 * (1 - alpha**2) / 24)


PAPER.measures |= STEADY | {
    "settling_s_09": settling(0.9, FAST, "clock"),
    "settling_s_05": settling(0.5, FAST, "clock"),
    "settling_t_09": settling(0.9, FAST, "time"),
    "settling_t_05": settling(0.5, FAST, "time"),
    "slow_t_09": settling(0.9, SLOW, "time"),
    "slow_t_05": settling(0.5, SLOW, "time"),
    "ratio_settling": ratio_settling,
    "least_thermal": thermal_share(np.argmin),
    "most_thermal": thermal_share(np.argmax),
    "slope": lambda data: slopes(data)["both"].slope,
    "crossing_a2": crossing("a2"),
    "crossing_cubed": crossing("relative_speed_cubed"),
    "exponent": lambda data: tail(data, "ihs", 0.5).exponent,
    "equilibrium_slow": lambda _: SHARES[0],
    "equilibrium_middle": lambda _: SHARES[1],
    "equilibrium_thermal": lambda _: SHARES[0] + SHARES[1],
    "mean_free_time": lambda _: np.sqrt(np.pi) / 2 / VISCOSITY_TIME,
    "characteristic_time": lambda _: 1 / VISCOSITY_TIME,
    "viscosity_time": lambda _: VISCOSITY_TIME,
    "newtonian_ihs": lambda _: newtonian_ihs(0.5),
    "newtonian_ehs": lambda _: newtonian_ehs(0.5),
}
