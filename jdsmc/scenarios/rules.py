"""What a scene of the user's own must return, asked before anything is compiled."""

from typing import Any

import equinox as eqx
import jax
import numpy as np

from .. import sweep
from ..collisions.meet import Collisions
from ..gases.rules import refuse_untraced
from ..own_code import Code
from ..types import Key
from .base import AbstractScene, Record
from .homogeneous import AbstractHomogeneous, HomogeneousState
from .options import Options
from .slab import AbstractSlab, SlabState

OURS = __package__
"""Scenes of this package have tests instead."""

_GOOD: set[tuple] = set()
"""Classes with their sizes that were looked at before: to trace a scene takes half a second."""


def check_methods(scene: AbstractScene, options: Options) -> None:
    """Raise TypeError, with the name of the method, for a scene whose methods return nonsense.

    They are traced, not run: shapes and types are looked at, of one point of a sweep.
    """
    if type(scene).__module__.startswith(f"{OURS}.") or not scene.traced:
        return
    asked = _Asked(scene, options)
    kind = jax.tree.structure(asked.scene), options, Code(scene)
    if kind in _GOOD:
        return
    state = asked.initial()
    if type(scene).advance is AbstractHomogeneous.advance:
        asked.step_of_velocities(state)
    if type(scene).advance is AbstractSlab.advance:
        asked.flight(state)
    asked.advance(state)
    asked.finish_chunk(state)
    _GOOD.add(kind)


class _Asked:
    """The methods of one scene, asked for shapes."""

    def __init__(self, scene: AbstractScene, options: Options):
        numbers, rest = eqx.partition(scene, sweep.is_number)

        def shape(leaf):
            return jax.ShapeDtypeStruct(np.shape(leaf), options.dtype)

        self.scene = eqx.combine(jax.tree.map(shape, numbers), rest)
        self.options = options
        self.name = type(scene).__name__
        word: Any = jax.ShapeDtypeStruct((), np.dtype("uint32"))
        self.key = Key(word, word)
        self.number = shape(0.0)

    def shapes(self, method, *arguments) -> Any:
        """What a method returns, arrays without their values."""

        def traced(scene, key, *given):
            return method(scene, key, *given)

        try:
            return eqx.filter_eval_shape(traced, self.scene, self.key, *arguments)
        except (jax.errors.JAXTypeError, ValueError) as error:
            refuse_untraced(f"A method of {self.name}", error)
            raise

    def initial(self) -> Any:
        """The state, of the kind that the class above goes by, if `advance` is from there."""
        state = self.shapes(lambda s, k: s.initial(k, self.options))
        for above, its in ((AbstractHomogeneous, HomogeneousState), (AbstractSlab, SlabState)):
            if type(self.scene).advance is above.advance and not isinstance(state, its):
                self.refuse("initial", f"a {its.__name__} or what derives from it", state)
        return state

    def step_of_velocities(self, state: HomogeneousState) -> None:
        """`step` of a homogeneous gas."""
        must = (
            "(velocity, tally): the components of the velocity, of the shape and type they came "
            "in, and the Collisions that `collide` returns"
        )
        found = self.shapes(
            lambda s, k, v, m, d: s.step(k, v, m, d, self.options),
            *(state.velocity, state.majorant, self.number),
        )
        velocity, tally = self.two("step", must, found)
        if not (same(velocity, state.velocity) and isinstance(tally, Collisions)):
            self.refuse("step", must, found)

    def flight(self, state: SlabState) -> None:
        """`move` and `wanted_step` of a gas in space."""
        moved = self.shapes(lambda s, k, x, d: s.move(k, x, d), state, self.number)
        if not same(moved, state):
            self.refuse("move", f"the state with arrays as they came in, {described(state)}", moved)
        wanted = self.shapes(lambda s, k, x: s.wanted_step(s.measure(x), self.options), state)
        if not is_one_number(wanted):
            self.refuse("wanted_step", "one number", wanted)

    def advance(self, state: Any) -> None:
        """`advance`: every record is made from the state that the one before it left."""
        must = "(state, record): the state with arrays as they came in, and a Record"
        found = self.shapes(lambda s, k, x: s.advance(k, x, self.options), state)
        after, record = self.two("advance", must, found)
        if not isinstance(record, Record) or not isinstance(record.tally, Collisions):
            self.refuse("advance", f"{must} whose tally is a Collisions", found)
        if not is_one_number(record.elapsed):
            self.refuse("advance", f"{must} whose `elapsed` is one number", record.elapsed)
        if not same(after, state):
            self.refuse("advance", f"{must}; the state came in as {described(state)}", after)

    def finish_chunk(self, state: Any) -> None:
        """`finish_chunk`: the same state, and a sample."""
        must = "(state, sample): the state with arrays as they came in, and a module or None"
        found = self.shapes(lambda s, k, x: s.finish_chunk(x), state)
        after, sample = self.two("finish_chunk", must, found)
        if not (same(after, state) and (sample is None or isinstance(sample, eqx.Module))):
            self.refuse("finish_chunk", must, found)

    def two(self, method: str, must: str, found: Any) -> tuple:
        """A pair; TypeError for anything else."""
        if not (isinstance(found, tuple) and len(found) == 2):
            self.refuse(method, must, found)
        return found

    def refuse(self, method: str, must: str, found: Any) -> None:
        """Raise TypeError."""
        raise TypeError(f"{self.name}.{method} must return {must}; got {described(found)}.")


def is_one_number(found: Any) -> bool:
    """True of one traced number."""
    return isinstance(found, jax.ShapeDtypeStruct) and found.shape == ()


def same(one: Any, other: Any) -> bool:
    """True if two pytrees have arrays of the same shapes and types in the same places."""
    leaves, kind = jax.tree.flatten(one)
    wanted, known = jax.tree.flatten(other)
    return kind == known and list(map(described, leaves)) == list(map(described, wanted))


def described(found: Any) -> str:
    """Arrays by type and shape, the rest by the names of their types."""
    if isinstance(found, jax.ShapeDtypeStruct):
        return f"{found.dtype}{list(found.shape)}"
    if found is None:
        return "None"
    if type(found) in (tuple, list):
        return f"({', '.join(map(described, found))})"
    if isinstance(found, eqx.Module):
        fields = ", ".join(f"{n}: {described(v)}" for n, v in vars(found).items())
        return f"{type(found).__name__}({fields})"
    return type(found).__name__
