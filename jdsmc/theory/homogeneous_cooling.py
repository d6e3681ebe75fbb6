r"""Homogeneous cooling of a gas of inelastic hard disks or spheres, without simulation.

Equation numbers are those of Montanero, Santos and Garzo, "First-order Chapman-Enskog velocity
distribution function in a granular gas", Physica A 376, 75 (2007). The homogeneous cooling state
(2.8) is described by its first cumulant a2 alone: f0 = f_M [1 + a2 L_2^{(d/2-1)}(c^2)] (2.9).

Units: m = lambda0 = v0 = tau0 = 1 and T0 = 1/2, where v0 = sqrt(2 T0/m) and lambda0 is the mean
free path of the Maxwellian, its mean speed over its collision frequency: with the density n,

    lambda0 = Gamma((d+1)/2) / (sqrt(2) pi^{(d-1)/2} n sigma^{d-1}),

which is 1/(sqrt(2) pi n sigma^2) for spheres and 1/(sqrt(8) n sigma) for disks. In these units the
effective collision frequency (2.15) at T0 is nu0 = 4 Gamma((d+1)/2) / ((d+2) Gamma(d/2)).

In every function `restitution` is alpha in (0, 1], `temperature` is T/T0 > 0 and `dimension` is an
integer d >= 2; ValueError is raised outside these ranges.
"""

from math import gamma, inf
from operator import index

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def kurtosis(restitution: ArrayLike, dimension: int = 3) -> Floats:
    """Fourth cumulant a2 = <V^4> / (d (d+2) (T/m)^2) - 1, Eqs. (2.13) and (2.16).

    `restitution` may have any shape, which is that of the result. The estimate is linear in a2: it
    solves mu_4 / (1 + a2) = (d+2) mu_2, with mu_p the rate at which collisions reduce <c^p>, both
    sides to first order in a2.
    """
    alpha, d = checked_restitution(restitution), checked_dimension(dimension)
    numerator = 16 * (1 - alpha) * (1 - 2 * alpha**2)
    return numerator / (25 + 24 * d - alpha * (57 - 8 * d) - 2 * (1 - alpha) * alpha**2)


def effective_frequency(dimension: int = 3) -> float:
    """nu0 tau0 at T = T0, Eq. (2.15); it grows like sqrt(T). For spheres 8/(5 sqrt(pi))."""
    d = checked_dimension(dimension)
    return 4 * gamma((d + 1) / 2) / ((d + 2) * gamma(d / 2))


def cooling_rate(
    restitution: ArrayLike, temperature: ArrayLike = 1.0, dimension: int = 3
) -> Floats:
    """zeta tau0 with the first Sonine correction, Eq. (2.14): dT/dt = -zeta T.

    `restitution` and `temperature` broadcast with each other to the shape of the result.
    """
    alpha, d = checked_restitution(restitution), checked_dimension(dimension)
    warmth = _checked("temperature", temperature, "(0, inf)")
    elastic_scale = (d + 2) / (4 * d) * effective_frequency(d) * np.sqrt(warmth)
    return elastic_scale * (1 - alpha**2) * (1 + 3 / 16 * kurtosis(alpha, d))


def collision_rate(
    restitution: ArrayLike, temperature: ArrayLike = 1.0, dimension: int = 3
) -> Floats:
    """Collisions per particle and time, ds/dt in 1/tau0, with the first Sonine correction.

    A collision counts once, though it takes two particles: s is the number of collisions in the
    gas over the number of particles, so that ds/dt = n sigma^{d-1} B <V12>/2 with B the integral
    of g^.sigma^ over the hemisphere. Hence ds/dt = <V12>/(2 <V12>_M) mean_speed_M/lambda0, with
    mean_speed_M = Gamma((d+1)/2)/Gamma(d/2) sqrt(T/T0): 1/sqrt(pi) for spheres at T0.

    <V12>/<V12>_M = 1 - a2/16: to first order the distribution of the relative velocity has half
    the cumulant a2, and the mean of x^{p/2} L_2^{(d/2-1)}(x) over that of x^{p/2} is p (p-2)/8, at
    p = 1 here. (p = 3 gives the 3/16 of Eq. 2.14.)

    `restitution` and `temperature` broadcast with each other to the shape of the result.
    """
    alpha, d = checked_restitution(restitution), checked_dimension(dimension)
    warmth = _checked("temperature", temperature, "(0, inf)")
    maxwellian = gamma((d + 1) / 2) / (2 * gamma(d / 2)) * np.sqrt(warmth)
    return maxwellian * (1 - kurtosis(alpha, d) / 16)


def haff_temperature(
    time: ArrayLike,
    restitution: ArrayLike,
    initial_temperature: ArrayLike = 1.0,
    dimension: int = 3,
) -> Floats:
    """Haff's law: T(t)/T0 = (T(0)/T0) (1 + zeta(0) t/2)^{-2}, from dT/dt = -zeta T.

    `time` is in tau0, >= 0; `initial_temperature` is T(0)/T0 > 0. They and `restitution` broadcast
    with each other to the shape of the result.
    """
    duration = _checked("time", time, "[0, inf)")
    start = _checked("initial_temperature", initial_temperature, "(0, inf)")
    return start / (1 + cooling_rate(restitution, start, dimension) * duration / 2) ** 2


def haff_collisions(
    time: ArrayLike,
    restitution: ArrayLike,
    initial_temperature: ArrayLike = 1.0,
    dimension: int = 3,
) -> Floats:
    """Collisions per particle s(t) = (2 r/zeta) ln(1 + zeta t/2), r the `collision_rate` at t = 0.

    It is the time integral of `collision_rate` along Haff's law; r t for elastic collisions.
    Arguments as in `haff_temperature`. Conversely T = T(0) exp(-(zeta/r) s).
    """
    duration = _checked("time", time, "[0, inf)")
    start = _checked("initial_temperature", initial_temperature, "(0, inf)")
    elapsed = cooling_rate(restitution, start, dimension) * duration / 2
    slowing = np.ones_like(elapsed)  # ln(1 + x)/x, which is 1 at x = 0
    np.divide(np.log1p(elapsed), elapsed, out=slowing, where=elapsed > 0)
    return collision_rate(restitution, start, dimension) * duration * slowing


def checked_restitution(restitution: ArrayLike) -> Floats:
    """`restitution` as an array of doubles; ValueError unless all of it lies in (0, 1]."""
    return _checked("restitution", restitution, "(0, 1]")


def checked_dimension(dimension: int) -> int:
    """`dimension` as an int; ValueError unless it is an integer >= 2."""
    try:
        value = index(dimension)
    except TypeError:
        value = 0
    if value < 2:
        raise ValueError(f"dimension must be an integer >= 2, got {dimension!r}.")
    return value


def _checked(name: str, value: ArrayLike, allowed: str) -> Floats:
    """`value` as doubles within the interval spelled by `allowed`, infinities and NaN excluded."""
    low, high = (float(end) for end in allowed[1:-1].split(","))
    array = np.asarray(value, dtype=np.float64)
    above = array >= low if allowed[0] == "[" else array > low
    below = array <= high if high < inf else array < inf
    if not np.all(above & below):
        raise ValueError(f"{name} must lie in {allowed}, got {value}.")
    return array
