"""The physical numbers of a gas or scene: found by name, shifted, differentiated along."""

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from .. import sweep
from ..scenarios.base import AbstractScene


def tangent(arrays, path: str):
    """A pytree like `arrays` that is one at a path and zero elsewhere."""

    def leaf(at, value):
        return jnp.ones_like(value) if sweep.path_of(at) == path else jnp.zeros_like(value)

    return jax.tree_util.tree_map_with_path(leaf, arrays)


def shifted(scene: AbstractScene, path: str, by: Any) -> Any:
    """The scene with one of its numbers changed by a number, of the host or traced."""
    chosen, rest = eqx.partition(scene, sweep.is_number)

    def leaf(at, value):
        return value + by if sweep.path_of(at) == path else value

    return eqx.combine(jax.tree_util.tree_map_with_path(leaf, chosen), rest)


def slope(function: Callable, step: float) -> Any:
    """Derivative at zero by central differences at h and 2h: the error is h⁴ f⁽⁵⁾/30."""
    near, far = (_difference(function, k * step) for k in (1.0, 2.0))
    return jax.tree.map(lambda a, b: (8.0 * a - b) / (12.0 * step), near, far)


def _difference(function: Callable, step: float) -> Any:
    return jax.tree.map(lambda a, b: a - b, function(step), function(-step))


def chosen_paths(scene: AbstractScene, wrt) -> dict[str, str]:
    """Paths of the numbers asked for, by their short names.

    Arguments: the scene of one point; names, one name, or True for every number.
    Raises ValueError for what is no single physical number, TypeError for what is no name.
    """
    known = {short: path for path, short in sweep.labels(scene).items()}
    single = {n: p for n, p in known.items() if not sweep.facts(scene, p).get("axes", 0)}
    if wrt is True:
        return single
    names = (wrt,) if isinstance(wrt, str) else wrt
    if not isinstance(names, tuple | list) or not all(isinstance(name, str) for name in names):
        raise TypeError(f"wrt = {wrt!r} is neither True nor a name or a tuple of names.")
    words = {path.split(".")[-1]: value for path, value in sweep.statics(scene).items()}
    for name in names:
        if name in single:
            continue
        if name in known:
            raise ValueError(f"wrt = {name!r} is an array; derivatives are of single numbers.")
        if isinstance(words.get(name), str):
            raise ValueError(
                f"wrt = {name!r} is given as the word {words[name]!r}, not as a number; there are "
                f"derivatives with respect to {', '.join(single)}."
            )
        raise ValueError(
            f"wrt = {name!r} is no physical number of this scene; choose among {', '.join(single)}."
        )
    if not names:
        raise ValueError(f"wrt is empty; choose among {', '.join(single)}.")
    return {name: single[name] for name in names}
