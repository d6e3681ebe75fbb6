"""The limit of weak fields: ε* -> 0 for every quantity, and how far a finite field is from it.

Turning the x axis round turns ε and odd averages round, so that an odd average over ε* is an even
function of ε*: its corrections are of order ε*², then ε*⁴. The coefficients of the series are not
bounded: the force feeds an algebraic tail, of which high moments are finite for weak fields only.
Each quantity is fitted up to the field of `STRONGEST`, with 1, ε*² and ε*⁴.
"""

from typing import NamedTuple

from jdsmc import Estimate

from ..numbers import Even
from .data import Heat


class Quantity(NamedTuple):
    """A quantity of linear response: its name in a result, its Sonine order, its label."""

    name: str
    order: int | None
    label: str


CONDUCTIVITY = Quantity("modified_conductivity", None, "κ'/κ0")
SONINE = tuple(Quantity("sonine", k, f"b'_{k}") for k in (1, 2, 3))
MARGINAL = tuple(Quantity("sonine_marginal", k, f"b'_{k} (3.12)") for k in (1, 2, 3))

STRONGEST = {None: 0.1, 1: 0.1, 2: 0.1, 3: 0.07}
"""Strongest field that is fitted, by Sonine order (None: κ'). Misfits are in table.md."""


def used(data: Heat, quantity: Quantity) -> list[float]:
    """The fields that are fitted."""
    return [f for f in data.fields if f <= STRONGEST[quantity.order] + 1e-12]


def at_field(data: Heat, quantity: Quantity, restitution: float, strength: float) -> Estimate:
    """A quantity at a field."""
    return data.steady(strength).value(quantity.name, restitution, quantity.order)


def limit(data: Heat, quantity: Quantity, restitution: float) -> Even:
    """The fit to a quantity at one restitution; made once."""
    key = quantity, restitution
    if key not in data.fits:
        strengths = used(data, quantity)
        values = [at_field(data, quantity, restitution, f) for f in strengths]
        data.fits[key] = Even(strengths, values, (1, 2))
    return data.fits[key]


def limits(data: Heat, quantity: Quantity) -> Estimate:
    """The limit at every restitution, arrays."""
    return data.over_restitutions(lambda alpha: limit(data, quantity, alpha).limit)
