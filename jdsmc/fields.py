"""Fields of gases and scenes that say what they are: meaning, unit, allowed range.

Checks of input, the command line, labels and files are made from these, so a field is described
once. A plain annotated field works too; it only says less.
"""

import dataclasses
from typing import Any

import equinox as eqx
import numpy as np

from . import check

REQUIRED = dataclasses.MISSING


def number(
    meaning: str,
    unit: str = "1",
    *,
    low: float = -np.inf,
    high: float = np.inf,
    low_included: bool = True,
    high_included: bool = True,
    default: Any = REQUIRED,
    names: tuple[str, ...] = (),
    axes: int = 0,
    example: Any = None,
) -> Any:
    """A physical number, traced in a step; a sweep gives it one more axis.

    Arguments: what it is and its unit; the interval it must lie in; `names` that may stand for
    values; `axes` of the number itself: 0 for a scalar, 1 for a vector that belongs to the physics;
    `example`, what the command line takes if nothing is said (a function of the relative error
    asked, where it depends on that).
    """
    facts = {"low": low, "high": high, "low_included": low_included, "high_included": high_included}
    said = {"meaning": meaning, "unit": unit, "range": facts, "names": names, "axes": axes}
    return eqx.field(
        default=default,
        converter=lambda value: value if isinstance(value, str) else check.physical(value),
        metadata=said | {"example": example},
    )


def choice(meaning: str, choices: tuple[str, ...], *, default: Any = REQUIRED) -> Any:
    """A name out of a few, fixed while a program is compiled."""
    return eqx.field(
        default=default, static=True, metadata={"meaning": meaning, "choices": choices}
    )


def count(meaning: str, *, least: int = 1, default: Any = REQUIRED) -> Any:
    """A size: an integer that selects a compiled program."""
    return eqx.field(default=default, static=True, metadata={"meaning": meaning, "least": least})


def check_fields(module: eqx.Module) -> None:
    """Raise ValueError or TypeError unless every described field holds what it allows."""
    for field in dataclasses.fields(module):
        value, facts = getattr(module, field.name), field.metadata
        if "choices" in facts:
            check.one_of(field.name, value, facts["choices"])
        elif "least" in facts:
            check.at_least(field.name, value, facts["least"])
        elif "range" in facts and isinstance(value, str):
            check.one_of(field.name, value, (*facts["names"], "a number"))
        elif "range" in facts:
            check.in_range(field.name, value, axes=facts["axes"], **facts["range"])


def described(module: eqx.Module) -> dict[str, dict[str, Any]]:
    """Meaning, unit, ... of every field by name; what a field does not say is left out."""
    return {field.name: dict(field.metadata) for field in dataclasses.fields(module)}
