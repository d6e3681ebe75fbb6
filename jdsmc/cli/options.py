"""Options of the command line: one for every field of a scene and its gases, and those of a run."""

import dataclasses
import inspect
import typing
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

import numpy as np

from .. import check
from ..fields import given
from ..running.run import run
from .numbers import numbers, one_number, truth, whole

UNSET = dataclasses.MISSING


@dataclass(frozen=True)
class Option:
    """What can be said as `--flag TEXT`.

    `name`: of the field or argument; `read`: from the name and the text to the value; `default`:
    UNSET if it must be given, a function of the relative error asked where it depends on that.
    """

    flag: str
    name: str
    meaning: str
    read: Callable[[str, str], Any]
    default: Any = UNSET
    metavar: str = "NUMBER"

    @property
    def help(self) -> str:
        """Meaning and default."""
        if self.default is UNSET:
            return f"{self.meaning} (must be given)"
        if self.default is None:
            return self.meaning
        if callable(self.default):
            return f"{self.meaning} (default: what --rtol needs)"
        default = self.default
        return (
            f"{self.meaning} (default: {default if isinstance(default, str) else f'{default:g}'})"
        )

    def value(self, text: str | None, rtol: float | None) -> Any:
        """What was said, or the default; ValueError for a text that means nothing."""
        if text is not None:
            return self.read(self.name, text)
        if self.default is UNSET:
            raise ValueError(f"--{self.flag} must be given: {self.meaning}.")
        return self.default(rtol) if callable(self.default) else self.default


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:g}" if isinstance(value, int | float) else str(value)


def options_of(kind: type, fixed: dict[str, Any], taken: set[str], prefix: str) -> list[Option]:
    """An option for every field of a scene or gas that is a number, a choice or a count.

    Arguments: `fixed`, fields that are known; `taken`, flags that mean something else already:
    a field of that name gets a `prefix`.
    """
    hints = _hints(kind)
    found = []
    for field in given(kind):
        if not field.init or field.name in fixed or field.name == "gas":
            continue
        flag = field.name.replace("_", "-")
        flag = f"{prefix}-{flag}" if flag in taken else flag
        option = _option(flag, field, hints.get(field.name, Any))
        if option is not None:
            found.append(option)
        elif field.default is UNSET and field.default_factory is UNSET:
            raise ValueError(
                f"{kind.__name__} cannot be made on the command line: {field.name} is no number, "
                "choice or count; give it a default, or use Python."
            )
    return found


def _hints(kind: type) -> dict[str, Any]:
    try:
        return typing.get_type_hints(kind)
    except NameError:  # annotations of names that only a type checker knows
        return {}


def _option(flag: str, field: dataclasses.Field, hint: Any) -> Option | None:
    """The option of a field; None for what cannot be written as a text."""
    facts = field.metadata
    meaning = facts.get("meaning", field.name.replace("_", " "))
    default = _default(field)
    choices = facts.get("choices") or (typing.get_args(hint) if _is_literal(hint) else ())
    if choices:
        said = f"{meaning}: {', '.join(choices)}", partial(chosen, choices=choices), "NAME"
    elif hint is bool or isinstance(default, bool):
        said = f"{meaning}: yes or no", truth, "yes|no"
    elif "least" in facts or hint is int:
        least = f", at least {facts['least']}" if "least" in facts else ""
        said = meaning + least, whole, "NUMBER"
    elif hint is str:
        said = meaning, text, "TEXT"
    elif facts.get("static") and hint is float:
        said = _with_unit(meaning, facts, ()), one_number, "NUMBER"
    elif "range" in facts or hint in (float, Any):
        names = facts.get("names", ())
        said = _with_unit(meaning, facts, names), partial(numbers, names=names), "NUMBER[S]"
    else:
        return None
    return Option(flag, field.name, *said[:2], default, said[2])


def _default(field: dataclasses.Field) -> Any:
    """What is taken if nothing is said: the example of the field, or its default."""
    example = field.metadata.get("example")
    default = field.default if example is None else example
    return np.asarray(default).tolist() if isinstance(default, np.ndarray) else default


def _is_literal(hint: Any) -> bool:
    return typing.get_origin(hint) is Literal


def text(name: str, said: str) -> str:
    """What was said."""
    return said


def chosen(name: str, said: str, choices: tuple[str, ...]) -> str:
    """One of a few names; ValueError for another."""
    check.one_of(name, said, choices)
    return said


def _with_unit(meaning: str, facts, names: tuple[str, ...]) -> str:
    """Meaning, unit, interval and names of a number."""
    unit = facts.get("unit", "1")
    text = meaning if unit == "1" else f"{meaning} in {unit}"
    if "range" in facts:
        ends = facts["range"]
        left = "[" if ends["low_included"] and np.isfinite(ends["low"]) else "("
        right = "]" if ends["high_included"] and np.isfinite(ends["high"]) else ")"
        text += f"; in {left}{ends['low']:g}, {ends['high']:g}{right}"
    return text + (f", or {', '.join(names)}" if names else "")


def _several(name: str, text: str) -> str | tuple[str, ...]:
    return tuple(text.split(",")) if "," in text else text


def run_options(taken: set[str], default_rtol: float, particles: str) -> list[Option]:
    """The options of `jdsmc.run`, but for those that a field of the scene has the name of.

    Arguments: the flags taken; the relative error that the scene asks if nothing is said; a clause
    that tells how many particles it takes.
    """
    usual = {name: one.default for name, one in inspect.signature(run).parameters.items()}
    table = (
        ("particles", "n_particles", whole, f"particles of one realization {particles}"),
        ("realizations", "n_realizations", whole, "independent realizations: all error bars"),
        ("seed", "seed", whole, "seed of all random numbers"),
        ("duration", "duration", one_number, "time to simulate in τ0; if neither this nor "
         "--collisions is given, run until steady and precise"),
        ("collisions", "collisions", one_number, "time in accepted collisions per particle"),
        ("observable", "observable", _several, "observable (or several, a,b) whose precision ends "
         "the run; by default the main one of the scene"),
        ("rtol", "rtol", one_number, "relative standard error asked of that observable "
         f"(default: {default_rtol:g})"),
        ("budget", "budget", one_number, "most collisions per particle to spend"),
        ("time-step", "time_step", one_number, "largest time step, as a fraction of τ(T) and of "
         "the scene's own times, in (0, 1]"),
        ("splitting", "splitting", partial(chosen, choices=("strang", "lie")),
         "order of flow and collisions in a step: strang (second order) or lie (first, as in the "
         "papers)"),
        ("dtype", "dtype", partial(chosen, choices=("float32", "float64")),
         "precision of the velocities: float32 or float64"),
        ("steps-per-record", "steps_per_record", whole, "time steps between two measurements"),
        ("checkpoint", "checkpoint", text, "file that keeps the run; `jdsmc resume FILE` goes on"),
        ("every", "every", one_number, "seconds between two writings of that file"),
    )  # fmt: skip
    return [
        Option(flag, name, meaning, read, usual[name], _metavar(read))
        for flag, name, read, meaning in table
        if flag not in taken
    ]


def _metavar(read) -> str:
    return "NUMBER" if read in (whole, one_number) else "FILE" if read is text else "NAME"
