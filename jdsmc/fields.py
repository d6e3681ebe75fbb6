"""Fields of gases and scenes that say what they are: meaning, unit, allowed range.

Checks of input, the command line, labels and files are made from these, so a field is described
once. A plain annotated field works too; it only says less.
"""

import dataclasses
from html import escape
from typing import Any

import equinox as eqx
import numpy as np

from . import check

REQUIRED = dataclasses.MISSING

plain_methods = object.__getattribute__
"""`__getattribute__` of gases and scenes. Equinox would make a module of every bound method each
time it is named, which took a quarter of the host's part of a run (34 µs for one)."""


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
    facts = {"meaning": meaning, "least": least}
    return eqx.field(default=default, static=True, converter=check.counted, metadata=facts)


def derived() -> Any:
    """What the constructor works out from the other fields, fixed while a program is compiled."""
    return eqx.field(static=True, metadata={"derived": True})


def held(module) -> list[tuple[dataclasses.Field, Any]]:
    """Every field of a gas or scene, and what it holds."""
    return [(field, getattr(module, field.name)) for field in dataclasses.fields(module)]


def given(module) -> list[dataclasses.Field]:
    """The fields that make a gas or scene: all but those that are derived from others."""
    return [f for f in dataclasses.fields(module) if not f.metadata.get("derived", False)]


def ingredients(module) -> dict[str, Any]:
    """What a gas or scene was made from, by the names of its fields."""
    names = {field.name for field in given(module)}
    return {field.name: value for field, value in held(module) if field.name in names}


def text(module) -> str:
    """A gas or scene with its numbers, as it would be typed."""
    parts = [f"{name}={_shown(value)}" for name, value in ingredients(module).items()]
    return f"{type(module).__name__}({', '.join(parts)})"


def as_html(module) -> str:
    """A gas or scene for a notebook: name, value, unit and meaning of every field."""
    rows = []
    for field in given(module):
        value, facts = ingredients(module)[field.name], field.metadata
        shown = text(value) if dataclasses.is_dataclass(value) else _shown(value)
        unit = facts.get("unit", "")
        cells = (field.name, shown, "" if unit == "1" else unit, facts.get("meaning", ""))
        rows.append("".join(f'<td style="text-align: left">{escape(c)}</td>' for c in cells))
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return f"<b>{escape(type(module).__name__)}</b><table><tbody>{body}</tbody></table>"


def _shown(value) -> str:
    if isinstance(value, np.ndarray | np.generic):
        return np.array2string(np.asarray(value), separator=", ", threshold=20)
    return repr(value)


def check_fields(module: eqx.Module) -> None:
    """Raise ValueError or TypeError unless every described field holds what it allows."""
    for field, value in held(module):
        facts = field.metadata
        if "choices" in facts:
            check.one_of(field.name, value, facts["choices"])
        elif "least" in facts:
            check.size(field.name, value, facts["least"])
        elif "range" in facts and facts["names"] and isinstance(value, str):
            check.one_of(field.name, value, (*facts["names"], "a number"))
        elif "range" in facts:
            check.in_range(field.name, value, axes=facts["axes"], **facts["range"])
