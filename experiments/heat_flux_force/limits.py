"""The limit of weak fields: ε* -> 0 for every quantity, and how far a finite field is from it.

Turning the x axis round turns ε and odd averages round, so that an odd average over ε* is an even
function of ε*: its corrections are of order ε*², then ε*⁴. The coefficients of the series are not
bounded: the force feeds an algebraic tail, of which high moments are finite for weak fields only.
Each quantity is fitted up to the field, and with the terms, of `FITS`.
"""

from typing import NamedTuple

import numpy as np

from jdsmc import Estimate

from .data import Measurements


class Quantity(NamedTuple):
    """A quantity of linear response: its name in a result, its Sonine order, its label."""

    name: str
    order: int | None
    label: str


CONDUCTIVITY = Quantity("conductivity_ratio", None, "κ'/κ0")
SONINE = tuple(Quantity("sonine", k, f"b'_{k}") for k in (1, 2, 3))
MARGINAL = tuple(Quantity("sonine_marginal", k, f"b'_{k} (3.12)") for k in (1, 2, 3))


class Fit(NamedTuple):
    """How a quantity is fitted: the strongest field used, and the powers of ε*² besides 1."""

    strongest: float
    powers: tuple[int, ...]


FITS = {None: Fit(0.1, (1, 2)), 1: Fit(0.1, (1, 2)), 2: Fit(0.1, (1, 2)), 3: Fit(0.07, (1, 2))}
"""By Sonine order (None: κ'). The misfit of each is in table.md."""


class Limit(NamedTuple):
    """A fit v + c ε*² (+ d ε*⁴): best values, their covariance, powers of ε*², χ² over ν."""

    best: np.ndarray
    covariance: np.ndarray
    powers: tuple[float, ...]
    misfit: float

    @property
    def value(self) -> Estimate:
        """The limit."""
        return self.at(0.0)

    def at(self, strength: float) -> Estimate:
        """The fit at a field."""
        weights = strength ** (2.0 * np.array((0, *self.powers)))
        return self._combined(weights)

    def excess(self, strength: float) -> Estimate:
        """The fit at a field minus the limit, over the limit."""
        weights = strength ** (2.0 * np.array((0, *self.powers)))
        weights[0] = 0.0
        return Estimate(*(part / abs(self.best[0]) for part in self._combined(weights)))

    def _combined(self, weights) -> Estimate:
        return Estimate(
            float(weights @ self.best), float(np.sqrt(weights @ self.covariance @ weights))
        )


def fit(strengths, value, error, powers: tuple[float, ...]) -> Limit:
    """Weighted least squares."""
    strengths, value, error = (np.asarray(x, float) for x in (strengths, value, error))
    exponents = 2.0 * np.array((0, *powers))
    design = strengths[:, None] ** exponents / error[:, None]
    covariance = np.linalg.inv(design.T @ design)
    best = covariance @ (design.T @ (value / error))
    freedom = len(value) - len(best)
    misfit = np.sum((value / error - design @ best) ** 2) / freedom if freedom else np.nan
    return Limit(best, covariance, powers, float(misfit))


def limit(data: Measurements, quantity: Quantity, restitution: float) -> Limit:
    """The limit of a quantity at one restitution."""
    chosen = FITS[quantity.order]
    strengths = np.array(data.fields)
    value, error = data.against_field(quantity.name, restitution, quantity.order)
    used = strengths <= chosen.strongest + 1e-12
    return fit(strengths[used], value[used], error[used], chosen.powers)


def limits(data: Measurements, quantity: Quantity) -> Estimate:
    """The limit at every restitution, arrays."""
    found = [limit(data, quantity, alpha).value for alpha in data.restitutions]
    return Estimate(*(np.array(column) for column in zip(*found, strict=True)))
