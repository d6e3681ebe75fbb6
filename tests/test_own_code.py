"""A gas or scene of one's own that was edited is compiled again; one that was not is not."""

import types

import jax
import numpy as np
import pytest

import jdsmc
from jdsmc import scenarios
from jdsmc.own_code import Code
from jdsmc.running import engine

SMALL = {"n_particles": 64, "collisions": 5.0, "progress": False}
LOSS = 0.5
NUMBERS = types.SimpleNamespace(share=0.5)


def half(x):
    return 0.5 * x


class Lossy(jdsmc.AbstractGas):
    """Hard spheres that lose what a number of this module says."""

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        pairs = zip(relative_velocity, outgoing, strict=True)
        return tuple(NUMBERS.share * (1.0 - half(LOSS)) * (a - b) for a, b in pairs)


def cooled(gas) -> float:
    """The last temperature of a short cooling."""
    result = jdsmc.run(scenarios.HomogeneousCooling(gas), **SMALL)
    return float(result.series["temperature"].values[-1])


def exchanged(monkeypatch, name):
    """Edits the gas in one of the ways of a notebook."""

    def less(self, relative_velocity, outgoing):
        return tuple(0.3 * (a - b) for a, b in zip(relative_velocity, outgoing, strict=True))

    if name == "a number of the module":
        monkeypatch.setitem(globals(), "LOSS", 0.9)
    elif name == "an attribute of an object":
        monkeypatch.setattr(NUMBERS, "share", 0.4)
    elif name == "a function that is called":
        monkeypatch.setitem(globals(), "half", lambda x: 0.8 * x)
    else:
        monkeypatch.setattr(Lossy, "momentum_transfer", less)


@pytest.mark.parametrize(
    "what",
    [
        *("a number of the module", "an attribute of an object"),
        *("a function that is called", "a method"),
    ],
)
def test_an_edited_gas_is_another(what, monkeypatch):
    """Of the same seed, it cools differently: to what a program made anew gives, to the bit."""
    before = cooled(Lossy())
    exchanged(monkeypatch, what)
    after = cooled(Lossy())
    assert after != before
    jax.clear_caches()
    assert cooled(Lossy()) == after
    monkeypatch.undo()
    assert cooled(Lossy()) == before


def test_what_was_not_edited_is_not_compiled_again():
    """A second run of an own gas, and of ours at another number, trace nothing."""

    def traced(gas) -> int:
        cooled(gas)
        before = engine._advance._cached._cache_size()
        cooled(gas)
        return engine._advance._cached._cache_size() - before

    assert traced(Lossy()) == 0
    cooled(jdsmc.InelasticHardSpheres(0.7))
    assert traced(jdsmc.InelasticHardSpheres(0.8)) == 0


def test_an_exchanged_method_of_ours_is_seen(monkeypatch):
    """Of a gas of this package, too."""
    gas = jdsmc.InelasticHardSpheres(0.7)
    scene = scenarios.UniformShear(gas, 4.0)
    before = Code(scene)
    assert before == Code(scene) and hash(before) == hash(Code(scene))
    monkeypatch.setattr(type(gas), "rate", lambda self, speed: 2.0 * speed)
    assert before != Code(scene)


@pytest.mark.parametrize(
    "one, other",
    [
        (np.array([1.0, 2.0]), np.array([1.0, 3.0])),
        ([1, {"a": 2}], [1, {"a": 3}]),
        ({1, 2}, {1, 3}),
        (lambda x: x, lambda x: x + 1),
        (types.SimpleNamespace(a=1), types.SimpleNamespace(a=2)),
        (iter([1]), iter([1])),  # cannot be looked into: equal to nothing
    ],
)
def test_what_a_method_finds_is_compared_by_value(one, other, monkeypatch):
    monkeypatch.setitem(globals(), "LOSS", one)
    first, again = Code(Lossy()), Code(Lossy())
    monkeypatch.setitem(globals(), "LOSS", other)
    assert first != Code(Lossy())
    assert (first == again) == (not isinstance(one, type(iter([]))))
