"""Claims of a paper: a number or a sentence, where it stands, and what we measure of it."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from jdsmc import Estimate

from .markdown import grid
from .numbers import Span

AGREEMENT = 2.0
"""Standard errors (beyond the rounding of a quoted number) that still count as agreement."""

HOLDS = {True: "holds", False: "**does not hold**", None: "not resolved"}


class Claim(NamedTuple):
    """What a paper says: the quoted sentence, or what the number is; its section or figure.

    `expected`, `half_width`: the number, and half a unit of its last digit (for a range half its
    length plus that). `key`: the name of the function that measures it.
    """

    key: str
    text: str
    place: str
    expected: float | None = None
    half_width: float = 0.0


class Finding(NamedTuple):
    """What was measured, in words and numbers, and whether it bears a sentence out.

    `holds` is true or false, or None if the errors leave it open; `distance`: by how many standard
    errors the weakest of several numbers decides it.
    """

    measured: str
    holds: Any
    distance: float | None = None


class Verdict(NamedTuple):
    """A claim beside our measurement: Estimate, Span, number or text.

    `distance`: of a number, beyond its rounding, in our standard errors; of a sentence, if signs of
    numbers decide it, that of the weakest.
    """

    claim: Claim
    measured: Any
    holds: bool | None
    distance: float | None

    @property
    def text(self) -> str:
        """In a word."""
        far = "" if self.distance is None else f" by {self.distance:.1f} σ"
        if self.claim.expected is None:
            return HOLDS[self.holds] + (far if self.holds else "")
        return "agrees" if self.holds else f"**differs{far}**"


def read(path: Path) -> dict[str, list[Claim]]:
    """Claims of a text file by its headings: `key | text | place [| value | half width]` a line."""
    found: dict[str, list[Claim]] = {}
    for line in path.read_text().splitlines():
        if line.startswith("# "):
            found[line[2:]] = claims = []
        else:
            key, text, place, *number = line.split(" | ")
            claims.append(Claim(key, text, place, *map(float, number)))
    return found


def judge(claim: Claim, measured) -> Verdict:
    """A claim beside what was measured of it."""
    if isinstance(measured, Finding):
        holds = None if measured.holds is None else bool(measured.holds)
        return Verdict(claim, measured.measured, holds, measured.distance)
    wanted, half = float(claim.expected or 0.0), claim.half_width
    if isinstance(measured, Span):
        holds = measured.low <= wanted + half and measured.high >= wanted - half
        return Verdict(claim, measured, holds, None)
    value, error = measured if isinstance(measured, Estimate) else (measured, 0.0)
    beyond = float(abs(value - wanted) - half)
    distance = beyond / float(error) if error > 0 else None
    return Verdict(claim, measured, bool(beyond <= AGREEMENT * error), distance)


def table(verdicts: Iterable[Verdict]) -> list[str]:
    """Claims beside what was measured, of one kind: numbers or sentences."""
    rows, numbers = [], False
    for found in verdicts:
        claim, numbers = found.claim, found.claim.expected is not None
        paper = [f"{claim.expected:g} ± {claim.half_width:g}"] if numbers else []
        rows.append([claim.text, claim.place, *paper, shown(found.measured), found.text])
    header = ["quantity", "place", "paper", "ours"] if numbers else ["claim", "place", "measured"]
    return grid([*header, "verdict"], rows)


def shown(measured) -> str:
    """A value as text."""
    return f"{measured:.5g}" if isinstance(measured, float | np.floating) else str(measured)


def percent(fraction, digits: int = 1) -> str:
    """A fraction in percent, with its error if it has one."""
    if isinstance(fraction, Estimate):
        value, error = (100.0 * float(part) for part in fraction)
        return f"({value:.{digits}f} ± {error:.{digits}f})%"
    return f"{100 * fraction:.{digits}f}%"


def positive(found: Estimate) -> bool | None:
    """True if a number is above 0 by more than 2 errors, False if below by as much, or None."""
    value, error = (float(part) for part in found)
    return value > 0 if abs(value) > AGREEMENT * error else None  # None if the error is NaN


def all_positive(head: str, numbers: dict[str, Estimate], shown: dict | None = None) -> Finding:
    """A sentence that holds if all numbers are above 0, by more than 2 errors.

    Arguments: what they are; the numbers by label; texts to show in their place.
    """
    texts = {label: value_and_error(one) for label, one in numbers.items()} | (shown or {})
    text = f"{head}: " + "; ".join(f"{label} {one}".strip() for label, one in texts.items())
    least = min(float(one.distance(0.0)) for one in numbers.values())
    return Finding(text, every(positive(one) for one in numbers.values()), least)


def value_and_error(found: Estimate) -> str:
    """Both, to digits that their sizes ask for."""
    value, error = (float(part) for part in found)
    return f"{value:+.4g} ± {error:.2g}"


def every(signs: Iterable[bool | None]) -> bool | None:
    """True if all hold, False if one does not, else None."""
    signs = list(signs)
    return False if False in signs else (None if None in signs else True)
