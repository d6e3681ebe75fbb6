"""What is to be matched: names of observables, each fit with one of them or several."""

import difflib
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from .. import check

SERIES = "series/"
"""What the name of a whole transient begins with: the group of a file that holds it."""

FREE = ("rate_factor", "drag_factor")
"""Numbers of the elastic gas that an exact scaling can adjust."""


class Target(NamedTuple):
    """One fit: observables to match together, and the weight of the relative misfit of each."""

    label: str
    names: tuple[str, ...]
    weights: tuple[float, ...]

    @property
    def of_series(self) -> bool:
        """True if transients are to be matched."""
        return self.names[0].startswith(SERIES)


def targets_of(target: str | Sequence[str], weights) -> list[Target]:
    """The fits of a text, `a,b+c` being one of a and one of b and c together; one fit of a list.

    `weights`: of the observables, in the order of the list, or by name; all 1 if None.
    Raises ValueError for an empty target and for weights that are not positive or not of these.
    """
    words = [target] if isinstance(target, str) else target
    if not isinstance(words, list | tuple) or not all(isinstance(one, str) for one in words):
        raise TypeError(f"target = {target!r} is neither the name of an observable nor a list.")
    fits = target.split(",") if isinstance(target, str) else ["+".join(target)]
    found = []
    for label in fits:
        names = tuple(name.strip() for name in label.split("+"))
        if not all(names):
            raise ValueError(f"target = {target!r} names nothing; write shear_stress, say.")
        if len(set(names)) < len(names):
            raise ValueError(f"target = {label!r} names an observable twice; name each once.")
        if len({name.startswith(SERIES) for name in names}) > 1:
            raise ValueError(
                f"target = {label!r} mixes steady values and series; fit them one by one."
            )
        if any(fit.names == names for fit in found):
            raise ValueError(f"target = {target!r} asks for {label!r} twice; ask once.")
        found.append(Target("+".join(names), names, _weights(names, weights)))
    return found


def _weights(names: tuple[str, ...], weights) -> tuple[float, ...]:
    if weights is None:
        return (1.0,) * len(names)
    if isinstance(weights, Mapping):
        unknown = [name for name in weights if name not in names]
        if unknown:
            raise ValueError(f"weights has {unknown[0]!r}, which is no target.")
        weights = [weights.get(name, 1.0) for name in names]
    given = check.physical(weights)
    if not isinstance(given, np.ndarray) or given.ndim != 1:
        raise TypeError(
            f"weights = {weights!r} must be {len(names)} positive numbers, one for each target."
        )
    values = tuple(map(float, given))
    if len(values) != len(names) or not all(np.isfinite(one) and one > 0 for one in values):
        raise ValueError(
            f"weights = {weights!r} must be {len(names)} positive numbers, one for each target."
        )
    return values


def check_free(free: Iterable[str], target: Target) -> None:
    """Raise ValueError unless the target can decide the free numbers."""
    free = tuple(free)
    if not free:
        raise ValueError("free names no number to adjust; give free=('rate_factor',).")
    if len(free) > len(target.names) and not target.of_series:
        raise ValueError(
            f"target {target.label!r} is one number and cannot fix {len(free)}, "
            f"{', '.join(free)}; add an observable or free fewer numbers."
            if len(target.names) == 1
            else f"the {len(target.names)} observables of target {target.label!r} cannot fix "
            f"{len(free)} numbers; add observables or free fewer numbers."
        )


def nearest(word: str, known: Iterable[str]) -> str:
    """A clause with the known word that is nearest, or nothing."""
    near = difflib.get_close_matches(word, list(known), n=1)
    return f" (did you mean {near[0]}?)" if near else ""
