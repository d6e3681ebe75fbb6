"""Our value of every quoted number, from the simulations."""

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import sonine_elastic

from ..compare import Span
from .coefficients import ELASTIC_ORDER
from .data import Measurements
from .distribution import odd_part, share_below
from .limits import CONDUCTIVITY, SONINE, Limit, fit, limit
from .relaxation import approach
from .systems import PAPER_FIELD

SHARE_FIELD = 0.05
"""The strongest field of the extrapolation of shares: at 0.1 terms beyond ε*² are seen."""


def share_limit(data: Measurements, restitution: float) -> Limit:
    """The share of c_x² <= 6 in the heat flux against the field, extrapolated with ε*²."""
    strengths = np.array([f for f in data.fields if f <= SHARE_FIELD])
    found = [share_below(odd_part(data.steady(f), restitution, f)) for f in strengths]
    value, error = (np.array(column) for column in zip(*found, strict=True))
    return fit(strengths, value, error, (1,))


def measure(data: Measurements) -> dict[str, Estimate | Span]:
    """Our value of every entry of `reference.NUMBERS`, by its key; limits of weak fields."""
    first, second = SONINE[:2]
    return {
        "relaxation": approach(data, CONDUCTIVITY, 0.3, PAPER_FIELD).within,
        "relaxation_sonine_03": approach(data, second, 0.3, PAPER_FIELD).within,
        "relaxation_sonine_1": approach(data, first, 1.0, PAPER_FIELD).within,
        "elastic": limit(data, CONDUCTIVITY, 1.0).value,
        "share_elastic": share_limit(data, 1.0).value,
        "share_03": share_limit(data, 0.3).value,
    }


def theory() -> dict[str, float]:
    """The formulas behind the entries of `reference.THEORY`."""
    return {"elastic": sonine_elastic.conductivity_ratio(ELASTIC_ORDER)}
