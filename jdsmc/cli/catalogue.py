"""What can be named on the command line: scenes and gases of the library, and those of a user."""

import difflib
import importlib
import importlib.util
import sys
import traceback
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..gases import (
    AbstractGas,
    ElasticHardSpheres,
    InelasticHardDisks,
    InelasticHardSpheres,
    MaxwellMolecules,
)
from ..scenarios import SCENES, AbstractScene
from ..scenarios.base import command_of


@dataclass(frozen=True)
class Gas:
    """A gas as it is named on the command line: its class, and fields that the name decides."""

    name: str
    make: type[AbstractGas]
    meaning: str
    fixed: dict[str, Any] = field(default_factory=dict)


GASES = (
    Gas("ihs", InelasticHardSpheres, "inelastic hard spheres"),
    Gas("ehs", ElasticHardSpheres, "elastic hard spheres under a drag", {"drag": "local"}),
    Gas("ehs-measured", ElasticHardSpheres, "the same, its drag measured", {"drag": "measured"}),
    Gas("hard-spheres", InelasticHardSpheres, "elastic hard spheres", {"restitution": 1.0}),
    Gas("maxwell-molecules", MaxwellMolecules, "Maxwell molecules, elastic"),
    Gas("disks", InelasticHardDisks, "inelastic hard disks"),
)


def first_line(thing: type) -> str:
    """The first sentence of a docstring, for lists; empty if there is none of its own."""
    text = (vars(thing).get("__doc__") or "").strip()
    return "" if text.startswith(f"{thing.__name__}(") else text.split("\n", 1)[0]


def scenes() -> dict[str, type[AbstractScene]]:
    """The scenes of the library by their names."""
    return {command_of(scene): scene for scene in SCENES}


def find_scene(name: str) -> type[AbstractScene]:
    """The scene of a name, or of `module:Class`; ValueError if there is none."""
    known = scenes()
    if ":" in name:
        return _imported(name, AbstractScene)
    if name not in known:
        raise ValueError(
            f"there is no scene {name!r}{did_you_mean(name, known)}. Scenes: {', '.join(known)}, "
            "or your own as module:Class."
        )
    return known[name]


def find_class(name: str) -> type:
    """A scene or gas `module:Class` of a user's own; ValueError if it is neither."""
    if ":" not in name:
        raise ValueError(f"class = {name!r} must be module:Class.")
    try:
        return _imported(name, AbstractScene)
    except ValueError:
        return _imported(name, AbstractGas)


def find_gases(text: str, can: list[str]) -> list[Gas]:
    """The gases of a list of names; ValueError for one that is unknown or named twice.

    `can`: the names to tell of then.
    """
    known = {gas.name: gas for gas in GASES}
    names = text.split(",")
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise ValueError(f"gas = {text!r} names {twice} twice; name every gas once.")
    found = []
    for name in names:
        if ":" in name:
            make = _imported(name, AbstractGas)
            found.append(Gas(make.__name__, make, first_line(make)))
        elif name in known:
            found.append(known[name])
        else:
            raise ValueError(
                f"gas = {name!r} is unknown{did_you_mean(name, can)}; choose from "
                f"{', '.join(can)}, or your own as module:Class."
            )
    if len({gas.name for gas in found}) < len(found):
        raise ValueError(f"gas = {text!r} holds two classes of the same name; rename one.")
    return found


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """A clause with the known word that is nearest, or nothing."""
    near = difflib.get_close_matches(word, list(known), n=1)
    return f" (did you mean {near[0]}?)" if near else ""


def _imported(name: str, kind: type) -> type:
    """A class `module:Class` or `path/to/module.py:Class`, imported because the user names it."""
    where, _, label = name.rpartition(":")
    module = _module(where)
    found = vars(module).get(label)
    if not (isinstance(found, type) and issubclass(found, kind)):
        what = "scene" if kind is AbstractScene else "gas"
        there = [
            key
            for key, value in vars(module).items()
            if isinstance(value, type) and issubclass(value, kind) and value.__module__ == where
        ]
        names = f"; it has {', '.join(there)}" if there else ""
        raise ValueError(
            f"{where} has no {what} {label!r} (a class derived from {kind.__name__}){names}."
        )
    return found


def _module(where: str):
    """The module of a name or a path, looked for in the current folder first."""
    path = Path(where if where.endswith(".py") else f"{where}.py")
    is_path = where.endswith(".py") or len(path.parts) > 1
    if is_path and not path.is_file():
        raise ValueError(f"there is no file {path} to import.")
    folder = str(path.parent.resolve()) if is_path else str(Path.cwd())
    if folder not in sys.path:
        sys.path.insert(0, folder)
    try:
        importlib.invalidate_caches()
        return importlib.import_module(path.stem if is_path else where)
    except ModuleNotFoundError as error:
        if error.name == where.split(".", maxsplit=1)[0]:
            raise ValueError(
                f"there is no module {where} in this folder, nor one that is installed."
            ) from None
        raise ValueError(f"{where} cannot be imported: {error}.") from None
    except Exception as error:  # whatever the user's module does wrong, told in one sentence
        last = traceback.extract_tb(error.__traceback__)[-1]
        place = f"{Path(last.filename).name}, line {last.lineno}"
        if isinstance(error, SyntaxError):
            place = f"{Path(error.filename or where).name}, line {error.lineno}"
        kind = type(error).__name__
        raise ValueError(f"{where} cannot be imported: {kind}: {error} ({place}).") from error
