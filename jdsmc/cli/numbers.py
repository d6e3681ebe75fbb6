"""Texts of the command line as numbers: ranges, lists, whole numbers."""

import numpy as np

MOST_STEPS = 100_000
"""Longest range taken for meant."""


def numbers(name: str, text: str, names: tuple[str, ...] = ()) -> np.ndarray | str:
    """A number, or an array of the ranges first:last:step and comma-separated values in a text.

    `names` may stand for values. ValueError for anything else, and for a range that leads nowhere.
    """
    if text in names:
        return text
    try:
        parts = [[float(x) for x in part.split(":")] for part in text.split(",")]
    except ValueError:
        parts = [[]]
    if not all(len(part) in (1, 3) for part in parts):
        also = f", or one of {', '.join(names)}" if names else ""
        raise ValueError(
            f"{name} = {text!r} is not a number, a range first:last:step, or a list of these{also}."
        )
    values = np.concatenate([_range(name, text, part) for part in parts])
    return values if len(values) > 1 or ":" in text else values.reshape(())


def _range(name: str, text: str, part: list[float]) -> np.ndarray:
    if len(part) == 1:
        return np.array(part)
    first, last, step = part
    problem = f"{name} = {text!r} is not a number, a range first:last:step, or a list of these"
    if not np.all(np.isfinite(part)) or step == 0:
        raise ValueError(f"{problem}: the numbers of a range are finite, and its step is not zero.")
    steps = (last - first) / step
    if steps < 0:
        raise ValueError(
            f"{problem}: a step of {step:g} from {first:g} never reaches {last:g}; write "
            f"{first:g}:{last:g}:{-step:g} or {last:g}:{first:g}:{step:g}."
        )
    if steps >= MOST_STEPS:
        raise ValueError(f"{problem}: this one has more than {MOST_STEPS} values.")
    count = int(steps + 1e-6)  # the last value is met in spite of rounding, and never passed
    return np.round(first + step * np.arange(count + 1), 12)


def one_number(name: str, text: str) -> float:
    """A single number; ValueError for anything else."""
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"{name} = {text!r} is not a number.") from None


def whole(name: str, text: str) -> int:
    """A whole number: 20000 and 2e4, not 1000.5; ValueError for anything else."""
    try:
        return int(text)  # exact, however large
    except ValueError:
        value = one_number(name, text)
    if not np.isfinite(value) or value != int(value):
        raise ValueError(f"{name} = {text} is not a whole number.")
    return int(value)


def truth(name: str, text: str) -> bool:
    """yes or no; ValueError for anything else."""
    words = {"yes": True, "true": True, "no": False, "false": False}
    if text.lower() not in words:
        raise ValueError(f"{name} = {text!r} is unknown; say yes or no.")
    return words[text.lower()]
