"""How ⟨V12³⟩ follows a2, where the two gases cross, and the formulas the paper compares with."""

from typing import NamedTuple

import numpy as np

from jdsmc import Estimate

from .data import Measurements

ISOTROPIC_SLOPE = 3.0 / 16.0
"""⟨V12³⟩/⟨V12³⟩0 = 1 + (3/16) a2 in isotropic states (section V C)."""

DRAWS = 4000
"""Random data sets for the error of a root."""


class Fit(NamedTuple):
    """⟨V12³⟩/⟨V12³⟩0 - 1 = k a2: the slope, its range over the points, misfits per point (χ²/ν)."""

    slope: Estimate
    least: float
    largest: float
    misfit: float
    misfit_isotropic: float


def mean_over_rates(data: Measurements, gas: str, name: str) -> Estimate:
    """A steady observable against restitution, averaged over the shear rates."""
    rates = data.steady_case(gas).shear_rate
    parts = [data.steady_values(gas, rate, name) for rate in rates]
    error = np.sqrt(sum(part.error**2 for part in parts)) / len(parts)
    return Estimate(sum(part.value for part in parts) / len(parts), error)


def fits(data: Measurements) -> dict[str, Fit]:
    """Least-squares slopes through the origin, for each gas and for both."""
    points = {}
    for gas in ("ihs", "ehs"):
        a2, cubed = (mean_over_rates(data, gas, n) for n in ("a2", "relative_speed_cubed"))
        points[gas] = np.array([a2.value, a2.error, cubed.value - 1.0, cubed.error])
    points["both"] = np.concatenate([points["ihs"], points["ehs"]], axis=1)
    return {name: _fit(*columns) for name, columns in points.items()}


def _fit(x, x_error, y, y_error) -> Fit:
    slope = np.sum(x * y) / np.sum(x * x)
    variance = y_error**2 + (slope * x_error) ** 2
    error = np.sqrt(np.sum(x * x * variance)) / np.sum(x * x)

    def misfit(k: float) -> float:
        return float(np.sum((y - k * x) ** 2 / variance) / (len(x) - 1))

    local = y / x
    return Fit(
        Estimate(float(slope), float(error)),
        float(local.min()),
        float(local.max()),
        misfit(slope),
        misfit(ISOTROPIC_SLOPE),
    )


def crossing(data: Measurements, name: str) -> Estimate:
    """Restitution at which an observable of EHS and IHS is equal.

    Their difference, which vanishes at α = 1, is (1-α) times a fitted parabola; the error comes
    from fits to randomly displaced data.
    """
    alpha = np.array(data.restitutions())
    ihs, ehs = (mean_over_rates(data, gas, name) for gas in ("ihs", "ehs"))
    scaled = (ehs.value - ihs.value) / (1.0 - alpha)
    error = np.hypot(ehs.error, ihs.error) / (1.0 - alpha)
    random = np.random.default_rng(0)
    roots = [_root(alpha, random.normal(scaled, error), error) for _ in range(DRAWS)]
    low, high = np.nanpercentile(roots, [15.9, 84.1])
    return Estimate(_root(alpha, scaled, error), float(high - low) / 2.0)


def _root(alpha: np.ndarray, values: np.ndarray, error: np.ndarray) -> float:
    parabola = np.polynomial.Polynomial.fit(alpha, values, 2, w=1.0 / error)
    roots = parabola.roots()
    real = roots[np.abs(roots.imag) < 1e-9].real
    inside = real[(real > alpha[0]) & (real < alpha[-1])]
    return float(inside[np.argmin(np.abs(inside - 0.7))]) if len(inside) else np.nan


def white_noise_a2(alpha):
    """a2 of IHS heated by white noise, d = 3 (van Noije and Ernst 1998, the paper's [51])."""
    return 16 * (1 - alpha) * (1 - 2 * alpha**2) / (241 - 177 * alpha + 30 * (1 - alpha) * alpha**2)


def newtonian_ihs(alpha: float) -> float:
    """Navier-Stokes η* of IHS in the first Sonine approximation, without the small a2 terms.

    η* = 1/(ν - ζ/2) with ν = (1+α)(3-α)/4, ζ = 5(1-α²)/12 in units of ν0 (Brey et al. 1998, [8]).
    """
    return 1.0 / ((1 + alpha) * (3 - alpha) / 4 - 5 * (1 - alpha**2) / 24)


def newtonian_ehs(alpha: float) -> float:
    """Navier-Stokes η* of EHS and of BGK: η* = 1/(β + ζ/2), from the stress balance."""
    return 1.0 / ((1 + alpha) / 2 + 5 * (1 - alpha**2) / 24)
