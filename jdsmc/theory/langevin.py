"""Hydrodynamic noise of a cooling gas of disks, without simulation.

The smallest transverse mode of N inelastic hard disks in a periodic square,
xi = sum_i w_x exp(i k y_i), from the linear Boltzmann-Langevin equation about the homogeneous
cooling state: what a simulation of a dilute gas (no recollisions) must give. Equation numbers are
those of Costantini and Puglisi, Phys. Rev. E 82, 011305 (2010), rebuilt, as the published ones
depend on a constant that the text does not tell. The stationary representation is theirs: the
scaled velocity w grows as exp(mu s) between collisions and T is the stationary temperature.

All depends on the restitution alpha and on `reduced_number` = N n sigma^2 alone: the side of the
square is sqrt(8 N n sigma^2) lambda0. "N at fixed density" thus is the wave number.

Units: lambda0 = 1 / (2 sqrt(2) n sigma), v0 = sqrt(2 T0 / m), tau0 = lambda0 / v0. Viscosities are
over eta0, the elastic one in the first Sonine approximation, sqrt(m T / pi) / (2 sigma). With the
exact one a dilute elastic gas has eta / eta0 = 1.0220.

    mode = transverse_mode(0.8, 20)
    mode.viscosity_ratio, mode.truncation["viscosity_ratio"]
    mode.autocorrelation(np.linspace(0, 50, 200))

`truncation` holds for each number what the cut-offs of the expansion leave: the extrapolated rest
in the degree of the moments plus the difference of two Sonine orders of the cooling state. At
reduced_number >= 20 that of the viscosities is below 1e-4 (relative) for restitution >= 0.7, and
so are C(0), the decay rate and the tail at 20 for >= 0.75; near the stability limit, where C(0)
diverges, these lose digits (2e-4 at 0.75 and 28, 1.2e-4 at 0.7 and 20, 5e-4 at 0.7 and 24).
Towards smaller numbers it grows (elastic viscosity: 5e-5 at 15, 5e-4 at 10, and the tail 1e-2 at
8). At 0.5 it is percents, as the expansion is only asymptotic; below 0.4 everything but the closed
forms refuses.

C(s) starts flat (momentum is conserved in a collision) and bends into the tail
A exp(-s / tau) with A > C(0). The noise strength eta1 of (11) is that of C(0); the one of a white
noise that would give the tail is another number, here `tail_...`: elastic disks have eta1 = eta
exactly, and A = 1.14 at reduced_number = 20.
"""

from functools import lru_cache
from math import inf, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from jdsmc.check import at_least, in_range, scalar, whole
from jdsmc.theory.closed_langevin import navier_stokes_limit, two_moment_limit
from jdsmc.theory.disk_moments import HIGHEST_DEGREE, cooling_distribution, moments
from jdsmc.theory.mode_results import (
    COLLISION_TIME,
    CoolingState,
    LongWaveLimit,
    TransverseMode,
)
from jdsmc.theory.mode_solution import (
    LOWEST_RESTITUTION,
    ROUNDING,
    extrapolate,
    levels,
    marginal_wave_number,
    solve,
)

__all__ = [
    "CoolingState",
    "LongWaveLimit",
    "TransverseMode",
    "cooling_state",
    "long_wave_limit",
    "navier_stokes_limit",
    "stability_limit",
    "stability_limit_truncation",
    "transverse_mode",
    "two_moment_limit",
]

Floats = NDArray[np.float64]
ELASTIC_VISCOSITY = 1 / (2 * sqrt(2 * pi))  # eta0 / (n m) over v0 / (n sigma)
SMALL_WAVE_NUMBER = 0.02  # over n sigma; the error of the extrapolation is of its fourth power
NAMES = (
    "amplitude",
    "decay_rate",
    "tail_amplitude",
    "viscosity_ratio",
    "noise_viscosity_ratio",
    "noise_over_viscosity",
    "tail_noise_viscosity_ratio",
    "tail_noise_over_viscosity",
)


def transverse_mode(
    restitution: float, reduced_number: float, degree: int | None = None, *, unstable: bool = False
) -> TransverseMode:
    """Fluctuations of the smallest transverse mode at N n sigma^2 = `reduced_number`.

    With `degree` None the numbers are extrapolated from three degrees of the moments (about 1 s
    for the first call at a restitution, below 1 s for more); with a degree (12 to 40) they are
    those of this degree. `unstable` continues the equations beyond the stability limit, where C(0)
    is negative and no stationary state exists. ValueError outside 0.4 <= restitution <= 1,
    beyond the stability limit, and where reduced_number is so small (below about 6) that the
    mode has no exponential tail.
    """
    alpha, number = _checked(restitution), _checked_number(reduced_number)
    if degree is not None:
        degree = _checked_degree(degree)
    wave_number = 2 * pi / sqrt(number)
    table, degrees, orders = _level_table(alpha, wave_number, degree)
    values, truncation = _estimate(table, extrapolated=degree is None)
    if degree is None:
        mu = moments(alpha, degrees[-1], orders[0]).growth_rate
        values = _derived(values[:3], mu, wave_number)
    if not unstable and values[1] <= 0:
        raise ValueError(
            f"reduced_number = {number:g} is beyond the stability limit "
            f"{stability_limit(alpha):.4g} at restitution {alpha:g}: the shear mode grows and "
            "there is no stationary state; take fewer particles or a smaller density."
        )
    scale = np.array([1, 1 / COLLISION_TIME, *np.ones(len(NAMES) - 2)])
    return TransverseMode(
        restitution=alpha,
        reduced_number=number,
        degree=degrees[-1],
        wave_number=wave_number / COLLISION_TIME,
        growth_rate=moments(alpha, degrees[-1], orders[0]).growth_rate / COLLISION_TIME,
        **_named(values * scale),
        truncation=_named(truncation * scale),
        _fine=solve(alpha, wave_number, degrees[-1], orders[0]),
        _coarse=solve(alpha, wave_number, degrees[-2], orders[0]),
    )


def stability_limit(restitution: float) -> float:
    """Largest N n sigma^2 without growing shear; infinite for elastic disks.

    Several percent below the estimate of hydrodynamics, `navier_stokes_limit`, as k lambda0 is
    not small. ValueError outside 0.4 <= restitution <= 1.
    """
    return _stability_limit(_checked(restitution))[0]


def stability_limit_truncation(restitution: float) -> float:
    """What the cut-offs leave of `stability_limit`: 5e-4 of 24.88 at 0.7, 7e-3 of 19.75 at 0.6."""
    return _stability_limit(_checked(restitution))[1]


@lru_cache(maxsize=64)
def _stability_limit(alpha: float) -> tuple[float, float]:
    if alpha == 1:
        return inf, 0.0
    degrees, orders = levels(alpha, None)
    guess = 2 * pi / sqrt(navier_stokes_limit(alpha))
    cuts = [*((degree, orders[0]) for degree in degrees), (degrees[0], orders[1])]
    wave_numbers = np.array([marginal_wave_number(alpha, *cut, guess) for cut in cuts])
    value, error = _estimate((2 * pi / wave_numbers) ** 2, extrapolated=True)
    return float(value), float(error)


def long_wave_limit(restitution: float) -> LongWaveLimit:
    """The limits k -> 0, continued through the instability where restitution < 1.

    From two small wave numbers, with the term in k^2 removed. The degree hardly matters there; the
    truncation is mostly that of the cooling state. ValueError outside 0.4 <= restitution <= 1.
    """
    alpha = _checked(restitution)
    near = _level_table(alpha, SMALL_WAVE_NUMBER, None)[0]
    far = _level_table(alpha, SMALL_WAVE_NUMBER * sqrt(2), None)[0]
    values, truncation = _estimate(2 * near - far, extrapolated=True)
    truncation = truncation + SMALL_WAVE_NUMBER**4 * np.abs(values)
    kept = [name for name in NAMES if "viscosity" in name]
    named, errors = _named(values), _named(truncation)
    return LongWaveLimit(
        restitution=alpha,
        **{name: named[name] for name in kept},
        truncation={name: errors[name] for name in kept},
    )


def cooling_state(restitution: float, order: int | None = None) -> CoolingState:
    """The cooling state with Sonine polynomials up to `order` (3 to 8; None: the best known).

    Exact integrals of the collision operator, all products kept, so a2 differs from the published
    linear estimate, by -0.0045 at restitution 0.8. ValueError outside the ranges, and for an order
    of which the expansion, only asymptotic below 0.7, has no state (8 at 0.4).
    """
    alpha = _checked(restitution)
    if order is not None:
        at_least("order", order, 3)
        in_range("order", order, 3, 8)
    best = levels(alpha, None)[1][0]
    upper = best if order is None else int(order)
    try:
        fine, mu = cooling_distribution(alpha, upper)
        coarse, coarse_mu = cooling_distribution(alpha, upper - 1)
    except RuntimeError:
        raise ValueError(
            f"order = {upper} is too high at restitution {alpha:g}: the expansion has no cooling "
            f"state there; {best} is the best one."
        ) from None
    signs = (-1.0) ** np.arange(len(fine))
    change = abs(mu - coarse_mu) / COLLISION_TIME + ROUNDING * mu
    return CoolingState(
        restitution=alpha,
        sonine=fine * signs,
        cooling_rate=2 * mu / COLLISION_TIME,
        growth_rate=mu / COLLISION_TIME,
        truncation={
            "a2": float(abs(fine[2] - coarse[2])),
            "cooling_rate": 2 * change,
            "growth_rate": change,
        },
    )


def _level_table(alpha: float, wave_number: float, degree: int | None):
    """All `NAMES` at three degrees, and at the lowest with the coarser cooling state.

    Shape (4, len(NAMES)), in units of n sigma and sqrt(2 T / m); with the degrees and orders.
    """
    degrees, orders = levels(alpha, degree)
    cuts = [*((each, orders[0]) for each in degrees), (degrees[0], orders[1])]

    def row(cut):
        primary = solve(alpha, wave_number, *cut).primary
        return _derived(primary, moments(alpha, *cut).growth_rate, wave_number)

    best = row(cuts[2])  # first: what is refused is then said of the degree that was asked for
    return np.array([row(cuts[0]), row(cuts[1]), best, row(cuts[3])]), degrees, orders


def _derived(primary: Floats, mu: float, wave_number: float) -> Floats:
    """C(0), 1/tau, A and Eqs. (10), (11) from them, in the order of `NAMES`."""
    amplitude, rate, tail = primary
    scale = wave_number**2 * ELASTIC_VISCOSITY
    ratio = rate / (rate + mu)
    noise = amplitude * np.array([rate / scale, ratio])
    white = tail * np.array([rate / scale, ratio])
    return np.array([amplitude, rate, tail, (rate + mu) / scale, *noise, *white])


def _estimate(table: Floats, *, extrapolated: bool) -> tuple[Floats, Floats]:
    """Values and truncation of a `_level_table`; its first axis is gone."""
    limit, rest = extrapolate(table[:3])
    values = limit if extrapolated else table[2]
    state = np.abs(table[0] - table[3])
    return values, np.abs(limit - values) + rest + state + ROUNDING * np.abs(values)


def _named(values: Floats) -> dict[str, float]:
    return dict(zip(NAMES, map(float, values), strict=True))


def _checked(restitution: float) -> float:
    if np.ndim(restitution) > 0:
        scalar("restitution", restitution, 0, 1)
    in_range("restitution", restitution, LOWEST_RESTITUTION, 1)
    return float(restitution)


def _checked_number(reduced_number: float) -> float:
    scalar("reduced_number", reduced_number, 0, inf)
    return float(reduced_number)


def _checked_degree(degree) -> int:
    in_range("degree", degree, 12, HIGHEST_DEGREE)
    return whole("degree", degree, 12)
