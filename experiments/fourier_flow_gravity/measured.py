"""Our value of every quoted number, from the simulations."""

import numpy as np

from jdsmc import Estimate

from ..compare import Span
from . import profiles
from .data import Measurements
from .systems import COMBINATIONS, EXAMPLE, EXAMPLE_GRAVITY


def measure(data: Measurements) -> dict[str, Estimate | Span]:
    """Our value of every entry of `reference.NUMBERS`, by its key."""
    found: dict[str, Estimate | Span] = {}
    for combination in COMBINATIONS:
        fit = data.responses[combination]
        found[f"gradient {combination.key}"] = fit["reduced_gradient"]
        found[f"response {combination.key}"] = fit["B"]
    for gravity in (-0.016, 0.012):
        state = data.state(EXAMPLE, gravity)
        for side, cold in (("cold", True), ("hot", False)):
            found[f"jump {side} {gravity:g}"] = profiles.jump(state, EXAMPLE.cold, cold)
            found[f"density {side} {gravity:g}"] = profiles.density(state, cold)
    found["crossing"] = crossing(data)
    return found


def crossing(data: Measurements) -> Span:
    """Where p and P_zz cross, over the gravities of Fig. 4: the middle one and the range."""
    each = [profiles.crossing(data.realizations(EXAMPLE, g)) for g in EXAMPLE_GRAVITY]
    value, error = (np.array(column) for column in zip(*each, strict=True))
    low, high = float(np.nanmin(value - error)), float(np.nanmax(value + error))
    return Span(float(np.nanmedian(value)), low, high, "g of Fig. 4")


def theory() -> dict[str, float]:
    """The formulas behind the entries of `reference.THEORY`."""
    return {"paths": (15.0 * np.pi**0.5 / 16.0) ** 2}
