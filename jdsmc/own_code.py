"""What the methods of a scene and a gas of one's own are made of, compared by value.

JAX keeps compiled programs by the classes of what they are given. A method that was exchanged, or
that reads a number of the notebook which has changed since, is the same to it as before; with its
`Code` among the arguments the program is made anew.
"""

import dataclasses
import enum
import functools
import sys
import sysconfig
import types
from collections.abc import Hashable
from typing import Any

import jax
import numpy as np

from .fields import held

PLAIN = (type(None), bool, int, float, complex, str, bytes, enum.Enum, types.CodeType)
INSTALLED = tuple(sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib"))
"""Where programs do not change while a process runs."""


class Code:
    """The code of a module's class, of those it is made of, and of all that their methods use.

    Two are equal if functions, and what these find in their modules and closures, are: numbers,
    arrays, containers, functions, objects. What cannot be compared equals nothing.
    """

    def __init__(self, module: Any):
        self._parts = _Walk().module(module)
        self._hash = hash(self._parts)

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, Code) and self._parts == other._parts)

    def __hash__(self) -> int:
        return self._hash


class _Walk:
    """One way through methods; what was met before is told by its number."""

    def __init__(self):
        self._met: dict[int, tuple[int, Any]] = {}

    def module(self, module: Any) -> Hashable:
        """Classes of a scene and of its parts, and functions among its fields; no numbers."""
        found = [self.value(type(module))]
        for _, part in held(module):
            if dataclasses.is_dataclass(part) and not isinstance(part, type):
                found.append(self.module(part))
            elif callable(part):
                found.append(self.value(part))
        return tuple(found)

    def value(self, value: Any) -> Hashable:
        """Anything that a method may find."""
        if isinstance(value, PLAIN):
            return type(value), value
        if id(value) in self._met:
            return "again", self._met[id(value)][0]
        self._met[id(value)] = len(self._met), value  # held, so that no other takes its place
        if isinstance(value, np.ndarray | np.generic | jax.Array):
            array = np.asarray(value)
            return array.dtype.str, array.shape, array.tobytes()
        return self._made_of(value)

    def _all(self, *parts: Any) -> Hashable:
        return tuple(self.value(part) for part in parts)

    @functools.singledispatchmethod
    def _made_of(self, value: Any) -> Hashable:
        """A wrapper of a function, or an object: with what it holds, if that can be seen."""
        for name in ("__wrapped__", "__func__", "method"):
            if (inner := _own(value, name)) is not None:
                return self.value(inner)
        name = _own(value, "__qualname__")  # of a function, but not of an object
        if name is not None and _is_installed(str(_own(value, "__module__"))):
            return name
        inner = _attributes(value)
        if inner:
            return self._all(type(value), inner)
        shown = repr(value)  # of what is written in C: by its value, if it shows one
        return object() if " at 0x" in shown else (type(value).__qualname__, shown)

    @_made_of.register
    def _container(self, value: list | tuple | set | frozenset) -> Hashable:
        return type(value), self._all(*value)

    @_made_of.register
    def _table(self, value: dict) -> Hashable:
        return self._all(*value.keys(), *value.values())

    @_made_of.register
    def _built_in(self, value: types.BuiltinFunctionType) -> Hashable:
        return value

    @_made_of.register
    def _partial(self, value: functools.partial) -> Hashable:
        return self._all(value.func, value.args, value.keywords)

    @_made_of.register
    def _property(self, value: property) -> Hashable:
        return self._all(value.fget)

    @_made_of.register
    def _module(self, value: types.ModuleType) -> Hashable:
        return value.__name__

    @_made_of.register
    def _function(self, function: types.FunctionType) -> Hashable:
        cells = [_content(cell) for cell in function.__closure__ or ()]
        if _is_installed(function.__globals__.get("__name__", "")):
            if (inner := _own(function, "__wrapped__")) is not None:
                return self.value(inner)
            return function.__code__, self._all(*(x for x in cells if callable(x)))
        found, names = [function.__defaults__, function.__kwdefaults__, *cells], _names(function)
        for name in names:
            one = function.__globals__.get(name)
            found.append(one)
            if isinstance(one, types.ModuleType) and not _is_installed(one.__name__):
                found += [vars(one)[inner] for inner in names if inner in vars(one)]
        return function.__code__, self._all(*found)

    @_made_of.register
    def _class(self, kind: type) -> Hashable:
        """Methods of all classes above: those of installed ones too, which may be exchanged."""
        found: list[Hashable] = [kind.__module__, kind.__qualname__]
        for one in kind.__mro__:
            if one.__module__.startswith("jdsmc.") or not _is_installed(one.__module__):
                found += [(name, self.value(x)) for name, x in vars(one).items() if _counts(name)]
        return tuple(found)


def _own(value: Any, name: str) -> Any:
    """An attribute, without calling a `__getattr__`; None if there is none."""
    try:
        return object.__getattribute__(value, name)
    except AttributeError:
        return None


def _attributes(value: Any) -> dict[str, Any]:
    """The attributes of an object."""
    slots = [vars(kind).get("__slots__", ()) for kind in type(value).__mro__]
    names = [n for one in slots for n in ([one] if isinstance(one, str) else one)]
    return (_own(value, "__dict__") or {}) | {
        n: x for n in names if (x := _own(value, n)) is not None
    }


def _content(cell) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # not set yet
        return None


def _counts(name: str) -> bool:
    """Whether an attribute of a class is part of its program."""
    return not name.startswith(("__", "_abc")) or name == "__call__"


@functools.cache
def _is_installed(module: str) -> bool:
    """True of jdsmc, and of modules that are built in or lie where packages are installed."""
    if module.partition(".")[0] == "jdsmc":
        return True
    file = vars(sys.modules[module]).get("__file__") if module in sys.modules else None
    if file is None:
        return module in sys.builtin_module_names
    return str(file).startswith(INSTALLED)


def _names(function: types.FunctionType) -> list[str]:
    """Names that a function, and those within it, look up."""
    found, waiting = {}, [function.__code__]
    while waiting:
        code = waiting.pop()
        found |= dict.fromkeys(code.co_names)
        waiting += [one for one in code.co_consts if isinstance(one, types.CodeType)]
    return list(found)
