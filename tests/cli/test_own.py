"""Scenes and gases of a user's module, named on the command line."""

import sys

import pytest

MODULE = '''
from typing import Any, ClassVar
import jdsmc
from jdsmc.scenarios import AbstractHomogeneous, homogeneous_observables


class Still(AbstractHomogeneous):
    """Nothing happens."""

    gas: jdsmc.AbstractGas
    depth: Any = jdsmc.number("depth h", "λ0", low=0.0, high=9.0)
    levels: int = jdsmc.count("levels", default=3)
    duration: Any = jdsmc.number("how long it was still", "τ0", default=1.0)
    plain: float = 2.0
    deep: bool = False
    reports: ClassVar = homogeneous_observables("a2")
    monitored: ClassVar = ("fourth",)

    def step(self, key, velocity, majorant, duration, options):
        return self.collide(key, velocity, majorant, duration, options)


class Soft(jdsmc.AbstractGas):
    softness: Any = jdsmc.number("softness s", low=0.0, high=1.0)
    depth: Any = jdsmc.number("depth of the potential", default=0.5)

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing))
'''


@pytest.fixture(autouse=True)
def module(folder, monkeypatch):
    """`mine.py` in the current folder, and `there/yours.py`; forgotten afterwards."""
    (folder / "mine.py").write_text(MODULE, encoding="utf-8")
    (folder / "there").mkdir()
    (folder / "there" / "yours.py").write_text(MODULE, encoding="utf-8")
    (folder / "broken.py").write_text("import jdsmc\n1 / 0\n", encoding="utf-8")
    monkeypatch.setattr(sys, "path", list(sys.path))
    yield
    for name in ("mine", "yours", "broken"):
        sys.modules.pop(name, None)


def test_a_scene_and_a_gas(asked, status):
    line = "run mine:Still --gas mine:Soft --softness 0.25 --depth 3 --levels 4 --deep yes"
    assert status(f"{line} --duration 7 --gas-depth 0.75 --plain 1.5") == 0
    ((scene, options),) = asked
    assert (type(scene).__name__, type(scene.gas).__name__) == ("Still", "Soft")
    assert (scene.depth, scene.levels, scene.plain, scene.deep) == (3.0, 4, 1.5, True)
    assert (scene.gas.softness, scene.gas.depth) == (0.25, 0.75)
    # a field that is called like an option of the run takes its place
    assert scene.duration == 7.0 and "duration" not in options


@pytest.mark.parametrize("where", ["there/yours.py", "there/yours"])
def test_a_module_elsewhere(where, asked, status):
    assert status(f"run {where}:Still --depth 1") == 0
    assert asked[0][0].depth == 1.0


def test_help(status, capsys):
    assert status("run mine:Still --gas mine:Soft --help") == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "Nothing happens." in text
    assert "--depth NUMBER[S] depth h in λ0; in [0, 9] (must be given)" in text
    assert "--levels NUMBER levels, at least 1 (default: 3)" in text
    assert "Soft: softness s; in [0, 1] (must be given)" in text


@pytest.mark.parametrize(
    "line, words",
    [
        ("run mine:Still", "--depth must be given: depth h in λ0"),
        ("run mine:Still --depth -1", "depth = -1 [0, 9]"),
        ("run mine:Stil --depth 1", "mine has no scene 'Stil' Still"),
        ("run mine:Soft", "mine has no scene 'Soft'"),
        ("run shear --gas mine:Still", "mine has no gas 'Still' Soft"),
        ("run shear --gas mine:Soft", "--softness must be given"),
        ("run shear --gas mine:Soft,ihs --softness 0.1", "jdsmc sweep"),
        ("run theirs:Still", "no module theirs"),
        ("run there/theirs.py:Still", "no file theirs.py"),
        ("run broken:Still", "broken ZeroDivisionError broken.py, line 2"),
    ],
)
def test_sentences(line, words, refused, nothing_runs):
    error = refused(line)
    for word in words.split():
        assert word in error
