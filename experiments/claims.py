"""Statements of a paper without a number: how each is put to the test."""

from collections.abc import Callable
from typing import Any, NamedTuple


class Finding(NamedTuple):
    """What was measured, in words and numbers, and whether it bears the statement out.

    `holds` is None if the errors leave it open.
    """

    measured: str
    holds: bool | None


class Claim(NamedTuple):
    """A statement, where it stands, and the check, a function of all measurements."""

    what: str
    place: str
    check: Callable[[Any], Finding]


def percent(fraction: float, digits: int = 1) -> str:
    """A fraction in percent."""
    return f"{100 * fraction:.{digits}f}%"


def decide(value: float, error: float, positive: bool = True) -> bool | None:
    """True if a number has the expected sign by more than 2 errors, False if the other, or None."""
    signed = value if positive else -value
    if abs(signed) <= 2.0 * error:
        return None
    return bool(signed > 0)
