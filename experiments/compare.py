"""Numbers that a paper quotes, and verdicts: does our value agree?

`half_width` is half a unit of the last digit quoted; for a range half its length plus that.
"""

from dataclasses import dataclass
from typing import NamedTuple

from jdsmc import Estimate

AGREEMENT = 2.0
"""Standard errors beyond the rounding of the quoted digits that still count as agreement."""


@dataclass(frozen=True)
class Quoted:
    """A number in the paper."""

    key: str
    what: str
    value: float
    half_width: float
    place: str


class Span(NamedTuple):
    """A number that depends on a criterion: at the middle one, and the range from loose to strict.

    `label` tells the criteria.
    """

    value: float
    low: float
    high: float
    label: str


class Comparison(NamedTuple):
    """A quoted number beside ours."""

    quoted: Quoted
    ours: Estimate | Span | float
    agrees: bool
    verdict: str


def compare(quoted: Quoted, ours: Estimate | Span | float) -> Comparison:
    """The distance beyond the rounding of the quoted digits, in our standard errors."""
    if isinstance(ours, Span):
        low, high = quoted.value - quoted.half_width, quoted.value + quoted.half_width
        agrees = ours.low <= high and ours.high >= low
        return Comparison(quoted, ours, agrees, "agrees" if agrees else "differs")
    value, error = ours if isinstance(ours, Estimate) else (ours, 0.0)
    beyond = abs(value - quoted.value) - quoted.half_width
    if beyond <= AGREEMENT * error:
        return Comparison(quoted, ours, True, "agrees")
    sigma = f" by {beyond / error:.1f} σ" if error > 0 else ""
    return Comparison(quoted, ours, False, f"differs{sigma}")


def shown(ours: Estimate | Span | float) -> str:
    """Our value as text."""
    if isinstance(ours, Span):
        return f"{ours.value:.3g} ({ours.low:.3g} to {ours.high:.3g})"
    return str(ours) if isinstance(ours, Estimate) else f"{ours:.5g}"
