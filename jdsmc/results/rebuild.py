"""Scenes and gases built again from the plain data of a file."""

import sys

import equinox as eqx
import numpy as np


def rebuilt(data, classes: tuple[type, ...] = ()):
    """A scene or gas from plain data, as `provenance.specification` makes it.

    Its classes must have been imported, or be passed in: a file never causes an import. Raises
    ValueError if one of them is not there.
    """
    if isinstance(data, list):
        return (
            np.asarray(data, dtype=float) if _numeric(data) else [rebuilt(x, classes) for x in data]
        )
    if not (isinstance(data, dict) and set(data) == {"class", "fields"}):
        return data
    module, _, name = data["class"].partition(":")
    known = {f"{one.__module__}:{one.__qualname__}": one for one in classes}
    known |= {one.__qualname__: one for one in classes}
    found = known.get(data["class"]) or known.get(name)
    if found is None:
        found = sys.modules.get(module)
        for part in name.split("."):
            found = vars(found).get(part) if found is not None else None
    # nothing else may be called: a file could name any class there is
    if not (isinstance(found, type) and issubclass(found, eqx.Module)):
        raise ValueError(
            f"the class {name} of {module} is not imported; pass it: scene({name}). It must be "
            "one of a scene or gas."
        )
    return found(**{field: rebuilt(value, classes) for field, value in data["fields"].items()})


def _numeric(data: list) -> bool:
    return all(isinstance(x, int | float) or (isinstance(x, list) and _numeric(x)) for x in data)
