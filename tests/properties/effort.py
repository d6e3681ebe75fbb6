"""How many cases each property is given, and what became of them."""

import functools
import inspect
import os
from collections import Counter

from hypothesis import HealthCheck, Phase, event, settings

FULL = os.environ.get("PROPERTIES") == "full"

COUNTS: dict[str, Counter] = {}
"""By property: cases that were tried and held, and refusals on the way."""

PAGE = """\
# Properties searched

Made by `python -m tests.properties --page FILE`; do not edit. Random gases, scenes, options,
command lines, files and merges (`tests/properties`). Refusals: runs, scenes, options and merges on
the way that were refused, each with one sentence, as bad input must be (a case may make two runs).
A run has 64 particles, eight realizations and a few chunks. The page is written only if every
property held in every case.

"""


def cases(full: int, small: int):
    """Settings of a property: its cases in the full search, and in CI (the same ones each time)."""
    limits = settings(
        max_examples=full if FULL else small,
        derandomize=not FULL,
        database=None,
        deadline=None,  # the first case of a kind compiles
        print_blob=FULL,
        phases=(Phase.generate, Phase.shrink) if FULL else (Phase.generate,),
        suppress_health_check=list(HealthCheck),
    )

    def counted(test):
        one, count = test.hypothesis.inner_test, COUNTS.setdefault(sentence(test), Counter())

        @functools.wraps(one)
        def case(*arguments, **named):
            COUNTS["now"] = count
            one(*arguments, **named)
            count["held"] += 1

        test.hypothesis.inner_test = case
        return limits(test)

    return counted


def sentence(test) -> str:
    """What a property is about, and what it says."""
    what = test.__name__.removeprefix("test_").replace("_", " ")
    return f"{what}: {' '.join((inspect.getdoc(test) or '').split())}"


def refused(error: Exception) -> None:
    """Note that the present case ends in a sentence."""
    event(f"refused: {str(error)[:40]}")
    COUNTS["now"]["refused"] += 1


def page(seconds: float) -> str:
    """A table of the properties, and what the search took."""
    found = {name: count for name, count in COUNTS.items() if name != "now"}
    lines = ["| property | cases | refusals |", "|---|---|---|"]
    for name, count in found.items():
        lines.append(f"| {name} | {count['held']} | {count['refused']} |")
    total = Counter()
    for count in found.values():
        total.update(count)
    lines.append(f"| all | {total['held']} | {total['refused']} |")
    ended = (
        f"None of {total['held']} cases was silently wrong. They took {seconds / 60:.0f} minutes"
    )
    return PAGE + "\n".join(lines) + f"\n\n{ended} of CPU time.\n"
