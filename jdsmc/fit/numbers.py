"""Numbers of a scene or its gas, by name: read and replaced."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import sweep as sweeps
from ..fields import ingredients
from ..gases import ElasticHardSpheres
from ..scenarios import AbstractScene
from .targets import FREE, nearest


def check_model(model: Any, free: tuple[str, ...]) -> None:
    """Raise for what is no scene, and for free numbers that it does not have."""
    if not isinstance(model, AbstractScene):
        raise TypeError(f"model must be a scene, got {model!r}.")
    known = list(sweeps.parameters(model))
    if isinstance(model.gas, ElasticHardSpheres):
        known = list(dict.fromkeys([*known, *FREE]))
    for name in free:
        if name not in known:
            raise ValueError(
                f"free = {name!r} is no number of the model{nearest(name, known)}; its numbers are "
                f"{', '.join(known)}. For {' and '.join(FREE)} take ElasticHardSpheres."
            )
    swept = [name for name in sweeps.dimensions(model) if name != "restitution"]
    if swept:
        raise ValueError(f"{swept[0]} of the model is swept; only its restitution may be.")


def value_of(model: AbstractScene, name: str) -> float:
    """A number of the scene or its gas; β of an elastic gas also where it is named."""
    if name == "rate_factor" and isinstance(model.gas, ElasticHardSpheres):
        return float(np.asarray(model.gas.collision_factor()))
    return float(sweeps.parameters(model)[name])


def replaced(model: AbstractScene, numbers: Mapping[str, Any]) -> AbstractScene:
    """The scene made again with other numbers; ValueError where one is not allowed."""
    kind: Any = type(model)
    gas = type(model.gas)(**_with(model.gas, numbers))
    return kind(**(_with(model, numbers) | {"gas": gas}))


def _with(module, numbers: Mapping[str, Any]) -> dict[str, Any]:
    own = ingredients(module)
    return own | {name: value for name, value in numbers.items() if name in own}
