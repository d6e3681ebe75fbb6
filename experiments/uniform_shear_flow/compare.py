"""Verdicts: does our value agree with the quoted one?"""

from typing import NamedTuple

from jdsmc import Estimate

from .measured import Span
from .reference import Quoted

AGREEMENT = 2.0
"""Standard errors beyond the rounding of the quoted digits that still count as agreement."""


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
