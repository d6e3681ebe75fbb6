"""One point of the map: a cheap run, what must come out of it, and the verdict."""

import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import jdsmc

RIGHT, REFUSED, WARNED, WRONG = "right", "refused", "warned", "WRONG"
VERDICTS = (RIGHT, WARNED, REFUSED, WRONG)

SIGMAS = 5.0
"""Standard errors within which a value is right. Errors of eight realizations have Student's t of
seven degrees of freedom: 0.16% lie beyond."""

UNKNOWN = 0.2
"""Relative error from which on a value tells nothing, and is not called right."""


class Truth(NamedTuple):
    """A measured value with its error, and what it must be, within a `tolerance` (relative).

    `scale` stands for the expected value where that is zero.
    """

    name: str
    value: float
    error: float
    expected: float
    tolerance: float
    scale: float = 0.0

    @property
    def size(self) -> float:
        """What relative numbers are relative to."""
        return self.scale or abs(self.expected)

    @property
    def distance(self) -> float:
        """Largest allowed deviations that it is off: right up to one."""
        allowed = SIGMAS * self.error + self.tolerance * self.size
        off = abs(self.value - self.expected) / max(allowed, 1e-300)
        return float(off) if np.isfinite(off) else np.inf

    @property
    def is_right(self) -> bool:
        """True if it is within what is allowed, and its error small enough to tell."""
        return self.distance <= 1.0 and self.error <= UNKNOWN * self.size


class Point(NamedTuple):
    """A scene at the edge of what is allowed.

    `family` and `knob`: what is varied; `setting`: its value; `make` gives the scene; `options` are
    those of `jdsmc.run`; `truths` tells from the result what must be right; `refuses`: True if it
    has to be refused, None if it may.
    """

    family: str
    setting: str
    make: Callable[[], Any]
    options: dict[str, Any]
    truths: Callable[[Any], list[Truth]]
    refuses: bool | None = None


class Verdict(NamedTuple):
    """A row of the table."""

    family: str
    setting: str
    verdict: str
    quantity: str
    value: float
    error: float
    expected: float
    sentence: str
    cpu_seconds: float


def judge(point: Point) -> Verdict:
    """Run a point and hold it to its truth; the worst of its values stands for it."""
    began = time.process_time()
    warning, worst = "", Truth("", np.nan, np.nan, np.nan, np.nan)
    try:
        result = jdsmc.run(point.make(), **({"progress": False} | point.options))
        warning = str(result.attrs.get("remarks", ""))
        truths = point.truths(result)
        worst = max(truths, key=lambda one: (not one.is_right, one.distance))
        verdict = WARNED if warning else RIGHT if worst.is_right else WRONG
        if point.refuses:
            verdict, warning = WRONG, "It had to be refused."
    except (ValueError, TypeError, jdsmc.FaultError) as error:
        warning = " ".join(str(error).split())
        said = len(warning) > 20 and warning.endswith(".")
        verdict = REFUSED if said and point.refuses is not False else WRONG
    spent = time.process_time() - began
    head = (point.family, point.setting, verdict)
    return Verdict(*head, worst.name, worst.value, worst.error, worst.expected, warning, spent)
