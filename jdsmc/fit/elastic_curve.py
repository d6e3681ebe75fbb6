r"""The steady sheared elastic gas with drag, for every β and d at once: one curve an observable.

Divided by β the steady Boltzmann equation of Astillero and Santos, eq. (2.20), holds

    x = d (1-α²)/β

and nothing else besides a/β. Every reduced stress and cumulant is a function F(x), a* is β F(x), η*
is F(x)/β. F is known to be √x (or x, or 1) times a power series in x for small x, as a shear of
either sign is the same but for that of the stress; the kinetic model, whose z = ζ/ν is
proportional to x, suggests a polynomial in u = z/(1+z) for what is left (its stresses and η* are
of degree 0 to 2; a* is √x over one of degree 1). It is fitted to one sweep.
"""

from typing import Any, NamedTuple

import equinox as eqx
import numpy as np

from ..estimate import Estimate, combine
from ..gases import ElasticHardSpheres
from ..results.result import Result
from ..scenarios import UniformShear
from ..units import COOLING, VISCOSITY_TIME
from .targets import nearest

NODES, DEGREE = 8, 4
"""Points of the sweep; degree of the polynomial in u. A fifth degree changes nothing (tests)."""

LARGEST, SMALLEST = 1.3, 0.45
"""β/d that is looked at: the first at the largest restitution, the second at the smallest."""

BEYOND = 1.5
"""Factor by which a curve may be used below the smallest x of its sweep, where it is all but a
straight line in u and the range of u grows by a fiftieth."""

ALPHA = 0.5
"""Restitution at which the sweep is made, over the drag factor, with β = 1."""


class Law(NamedTuple):
    """O = β^degree x^power P(u), or O = β^degree x^power / P(u) if `inverse`."""

    degree: int
    power: float
    inverse: bool = False


LAWS = {
    "shear_stress": Law(0, 0.5),
    "reduced_shear_rate": Law(1, 0.5, inverse=True),
    "reduced_viscosity": Law(-1, 0.0),
    "normal_stress_xy": Law(0, 1.0),
    "normal_stress_zy": Law(0, 1.0),
    "first_viscometric": Law(-2, 0.0),
    "second_viscometric": Law(-2, 0.0),
    "pressure_xx": Law(0, 0.0),
    "pressure_yy": Law(0, 0.0),
    "pressure_zz": Law(0, 0.0),
    "a2": Law(0, 1.0),
    "a3": Law(0, 1.0),
    "relative_speed_cubed": Law(0, 0.0),
    "collision_rate_ratio": Law(0, 0.0),
}
"""Observables of uniform shear that an elastic gas can be held to."""


def law(name: str) -> Law:
    """The law of an observable; ValueError for what has none, saying what to name instead."""
    if name == "temperature":
        raise ValueError(
            "target 'temperature' depends on the shear rates of both scenes; name "
            "reduced_shear_rate, which is the same but for these."
        )
    if name == "relative_speed_cubed_collisional":
        raise ValueError(
            "target 'relative_speed_cubed_collisional' is the energy lost in collisions, and the "
            "elastic gas loses none; name relative_speed_cubed."
        )
    if name not in LAWS:
        raise ValueError(
            f"target {name!r} is unknown{nearest(name, LAWS)}; choose from {', '.join(LAWS)}."
        )
    return LAWS[name]


def stretched(x):
    """u = z/(1+z), z = ζ/ν of the kinetic model."""
    z = COOLING * VISCOSITY_TIME * np.asarray(x, float)
    return z / (1.0 + z)


def elastic_sweep(model: UniformShear, restitution=None) -> UniformShear:
    """The scene whose run knows the elastic gas at every β that is of use at these restitutions.

    Arguments: the model, whose kind of drag and shear rate are kept; α, a number or an array, by
    default that of its gas. Points lie at Chebyshev's nodes in u.
    """
    own: Any = model.gas
    alpha = np.atleast_1d(np.asarray(own.restitution if restitution is None else restitution))
    low, high = (1.0 - np.max(alpha) ** 2) / LARGEST, (1.0 - np.min(alpha) ** 2) / SMALLEST
    if low <= 0:
        raise ValueError(
            "restitution = 1 has no drag and no steady shear; take restitutions below 1."
        )
    ends = stretched(np.array([low, high]))
    cosines = np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)[::-1]
    u = ends[0] + (ends[1] - ends[0]) * (0.5 + 0.5 * cosines / cosines[-1])
    x = u / (1.0 - u) / (COOLING * VISCOSITY_TIME)
    gas = ElasticHardSpheres(ALPHA, 1.0, own.drag, x / (1.0 - ALPHA**2))
    return eqx.tree_at(lambda scene: scene.gas, model, gas)


class Curve:
    """F(x) of one observable, fitted to a sweep; `low`, `high`: the range of x that it covers."""

    def __init__(self, result: Result, name: str):
        self.law = law(name)
        made: Any = result.scene(UniformShear, ElasticHardSpheres)
        made = made.gas
        x = np.asarray(made.drag_factor * (1.0 - made.restitution**2) / made.rate_factor)
        self.low, self.high = float(x[0]) / BEYOND, float(x[-1])
        found = result[name]
        values, errors = np.asarray(found.value), np.asarray(found.error)
        self._sign = -1 if self.law.inverse else 1
        u = stretched(x)
        self._middle, self._half = 0.5 * (u[0] + u[-1]), 0.5 * (u[-1] - u[0])
        fitted = (values / x**self.law.power) ** self._sign
        known = errors / np.abs(values) * np.abs(fitted)
        known = np.exp(np.polyval(np.polyfit(self._t(x), np.log(known), 1), self._t(x)))
        columns = self._columns(x)
        self._hat = np.linalg.pinv(columns / known[:, None]) / known
        self._coefficients = self._hat @ fitted
        self.misfit = float(np.sum(((fitted - columns @ self._coefficients) / known) ** 2))
        self.misfit /= len(x) - columns.shape[1]
        spread = max(1.0, np.sqrt(self.misfit))
        parts = [found[k] / x[k] ** self.law.power for k in range(len(x))]
        self._nodes = [_spread(one**self._sign, spread) for one in parts]

    def _t(self, x):
        return (stretched(x) - self._middle) / self._half

    def _columns(self, x) -> np.ndarray:
        columns = np.polynomial.chebyshev.chebvander(self._t(x), DEGREE)
        return columns.reshape((*np.shape(x), DEGREE + 1))

    def observable(self, beta, x):
        """The observable at a rate factor and x, arrays of one shape."""
        return self._front(beta, x) * (self._columns(x) @ self._coefficients) ** self._sign

    def estimate(self, beta: float, x: float) -> Estimate:
        """The same at one point, with its error."""
        row, front = self._columns(x) @ self._hat, self._front(beta, x)
        return combine(lambda *y: front * (row @ np.array(y)) ** self._sign, *self._nodes)

    def _front(self, beta, x):
        return np.asarray(beta, float) ** self.law.degree * np.asarray(x) ** self.law.power


def _spread(one: Estimate, factor: float) -> Estimate:
    """The same number with an error that is larger by a factor."""
    middle = one.value
    return combine(lambda value: middle + factor * (value - middle), one)
