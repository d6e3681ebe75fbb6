"""Random numbers in the ranges that fields declare, and things that are none."""

import math

import numpy as np
from hypothesis import strategies as st

from jdsmc.fields import given

FARTHEST = 100.0
"""Where a range has no end."""

SMALLEST = 1e-9
"""Nearest to zero but zero: beyond, float32 has nothing of it beside one, and ratios overflow."""


def within(facts: dict):
    """Numbers of a range: its ends where they belong to it, near them, and any between."""
    low = max(facts["low"], -FARTHEST)
    high = min(facts["high"], FARTHEST)
    ends = [low] * facts["low_included"] + [high] * facts["high_included"]
    inside = st.floats(low, high, exclude_min=not facts["low_included"], exclude_max=True)
    inside = inside.filter(lambda value: value == 0.0 or abs(value) >= SMALLEST)
    small = st.floats(-6.0, 0.0).map(lambda power: low + (high - low) * 10.0**power)
    return st.one_of(inside, small, *([st.sampled_from(ends)] if ends else []))


def fields_of(make: type, fixed: dict | None = None):
    """Arguments of a gas or scene that its fields allow; those of `fixed` as they are given."""
    chosen = {}
    for field in given(make):
        facts = field.metadata
        if field.name == "gas" or field.name in (fixed or {}):
            continue
        if "choices" in facts:
            chosen[field.name] = st.sampled_from(facts["choices"])
        elif "range" in facts:
            names = [st.sampled_from(facts["names"])] if facts["names"] else []
            chosen[field.name] = st.one_of(within(facts["range"]), *names)
    return st.fixed_dictionaries(chosen).map(lambda found: found | (fixed or {}))


ANY_NUMBER = st.one_of(
    st.floats(),
    st.integers(),
    st.sampled_from([0, -0.0, 1, -1, math.inf, math.nan, 5e-324, 1e308, 2**63, 10**400]),
    st.floats(width=32).map(np.float32),
    st.integers(-128, 127).map(np.int8),
)
ANYTHING = st.one_of(
    ANY_NUMBER,
    st.none(),
    st.booleans(),
    st.text(max_size=5),
    st.binary(max_size=3),
    st.complex_numbers(),
    st.lists(ANY_NUMBER, max_size=3),
    st.lists(ANY_NUMBER, max_size=3).map(tuple),
    st.lists(st.lists(st.floats(), max_size=2), max_size=2),
    st.dictionaries(st.text(max_size=2), st.floats(), max_size=1),
    st.lists(st.floats(), max_size=3).map(np.array),
    st.just(object()),
    st.just(float),
)
"""What somebody may pass where a number belongs."""
