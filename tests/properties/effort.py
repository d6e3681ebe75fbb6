"""How many cases each property is given."""

import os

from hypothesis import HealthCheck, Phase, settings

FULL = os.environ.get("PROPERTIES") == "full"


def cases(full: int, small: int):
    """Settings of a property: its cases in the full search, and in CI (the same ones each time)."""
    return settings(
        max_examples=full if FULL else small,
        derandomize=not FULL,
        database=None,
        deadline=None,  # the first case of a kind compiles
        print_blob=FULL,
        phases=(Phase.generate, Phase.shrink) if FULL else (Phase.generate,),
        suppress_health_check=list(HealthCheck),
    )
