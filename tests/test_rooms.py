"""The house: rooms import in one direction, no circle, and nothing grows too large."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1] / "jdsmc"
ORDER = (
    {"units", "types", "check", "errors", "random", "fields", "sweep", "stats", "estimate", "sums"},
    {"own_code"},
    {"files"},
    {"theory"},
    {"gases"},
    {"motion"},
    {"events"},
    {"collisions"},
    {"measure"},
    {"scenarios"},
    {"views"},  # what draws a result is handed one, and knows nothing of its class
    {"results"},
    {"running", "derivatives"},  # a run samples for derivatives, and derivatives are runs
    {"transport", "fit", "cli", "__main__"},
    {""},  # the front door, jdsmc itself
)
"""Rooms and single files, from the ground up: each may import what stands above it here."""

MOST_LINES, MOST_FLAT, MOST_BY_NAME = 320, 14, 8


@cache
def modules() -> dict[str, Path]:
    """Every module of the package by its name below jdsmc; a package by that of its folder."""
    found = {}
    for path in sorted(ROOT.rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


@cache
def imports(name: str) -> frozenset[str]:
    """The modules that a module imports: at its top, in functions and for type checking."""
    path = modules()[name]
    package = ["jdsmc", *path.relative_to(ROOT).parts[:-1]]
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else []
            base = ".".join([*above, *([node.module] if node.module else [])])
            for alias in node.names:
                inner = f"{base}.{alias.name}"
                found.add(inner if inner.removeprefix("jdsmc.") in modules() else base)
    ours = {one.removeprefix("jdsmc").removeprefix(".") for one in found if _is_ours(one)}
    return frozenset(ours - {name})


def _is_ours(name: str) -> bool:
    return name == "jdsmc" or name.startswith("jdsmc.")


def room(name: str) -> int:
    """The place of a module in `ORDER`."""
    first = name.split(".", maxsplit=1)[0]
    places = [k for k, names in enumerate(ORDER) if first in names]
    assert places, f"{name} is in no room of tests/test_rooms.py: give it a place there"
    return places[0]


def test_imports_are_seen():
    """Else the tests below could not fail."""
    assert "running.run" in imports("")
    assert "gases.base" in imports("collisions.meet")
    assert "random" in imports("collisions.meet")
    assert len(modules()) > 50 and sum(len(imports(name)) for name in modules()) > 200


def test_rooms_import_in_one_direction():
    wrong = [
        f"{name} imports {other or 'jdsmc'}"
        for name in modules()
        for other in imports(name)
        if room(other) > room(name)
    ]
    assert not wrong


def test_no_circle():
    """Among modules, imports inside functions and under TYPE_CHECKING counted."""
    done: set[str] = set()

    def follow(name: str, way: tuple[str, ...]):
        assert name not in way, " -> ".join((*way[way.index(name) :], name))
        if name not in done:
            for other in imports(name):
                follow(other, (*way, name))
            done.add(name)

    for name in modules():
        follow(name, ())


@pytest.mark.parametrize("name", modules())
def test_files_are_short(name):
    assert len(modules()[name].read_text().splitlines()) <= MOST_LINES


def test_few_files_lie_flat():
    assert len(list(ROOT.glob("*.py"))) <= MOST_FLAT


def test_attributes_are_hardly_ever_found_by_name():
    """What a gas or scene must provide is declared, not looked for."""
    calls = [
        f"{name}: {line.strip()}"
        for name, path in modules().items()
        for line in path.read_text().splitlines()
        if re.search(r"\b(hasattr|getattr)\(", line)
    ]
    assert len(calls) <= MOST_BY_NAME, calls
