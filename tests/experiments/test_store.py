"""Stored simulations are reused only if request and program are the same."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import jdsmc
from experiments import case, store
from jdsmc import InelasticHardSpheres, Result
from jdsmc.scenarios import HomogeneousCooling, UniformShear


def _write(folder: Path, **sources: str) -> None:
    for name, text in sources.items():
        path = folder / name.replace("__", "/")
        path = path.with_name({"init": "__init__"}.get(path.name, path.name) + ".py")
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A small package in place of jdsmc: `change(name)` tells if that changes the fingerprint."""
    monkeypatch.setattr(store, "PACKAGE", tmp_path)
    _write(
        tmp_path,
        scenes__one="from ..near import thing\nfrom ..ops import collide\nfrom .. import stats\n",
        near="def f():\n    from . import deep\n",
        deep="x = 1\n",
        stats="x = 1\n",
        ops__init="from .kernels import collide\nfrom .other import thing\n",
        ops__kernels="from .inner import g\n",
        ops__inner="g = 1\n",
        ops__other="thing = 1\n",
        init="from .aside import y\n",
        aside="y = 1\n",
        views__init="from ..drawn import z\n",
        drawn="z = 1\n",
    )

    def fingerprint() -> str:
        store.program.cache_clear()
        return store.program(tmp_path / "scenes" / "one.py")

    def change(name: str) -> bool:
        before = fingerprint()
        _write(tmp_path, **{name: "changed = 1\n"})
        return fingerprint() != before

    yield change
    store.program.cache_clear()


@pytest.mark.parametrize("name", ["scenes__one", "near", "deep", "stats"])
def test_a_module_that_is_imported_counts(package, name):
    """However indirectly, and inside functions too."""
    assert package(name)


@pytest.mark.parametrize("name", ["ops__init", "ops__kernels", "ops__inner", "ops__other"])
def test_what_a_package_reexports_counts(package, name):
    """`from ..ops import collide`: the package, where it takes the name from, and what that needs.

    A file moved below a package whose name is re-exported must not leave old results in use.
    """
    assert package(name)


@pytest.mark.parametrize("name", ["init", "aside", "views__init", "drawn"])
def test_what_decides_no_number_does_not_count(package, name):
    """Of a package of which a submodule is taken, the rest; and what only draws."""
    assert not package(name)


def test_every_real_scene_reaches_the_collisions():
    """In the package as it is: random numbers, collisions and estimates are found from a scene."""
    scene = UniformShear(InelasticHardSpheres(0.9), 1.0)
    found, waiting = set(), list(case.Case("any", scene).sources())
    while waiting:
        path = waiting.pop()
        outside = any(path.is_relative_to(store.PACKAGE / name) for name in store.OUTSIDE)
        if path not in found and not outside:
            found.add(path)
            waiting += store._imported(path)
    names = {str(path.relative_to(store.PACKAGE)) for path in found}
    needed = {"random.py", "stats.py", "collisions/meet.py", "running/engine.py", "motion/drive.py"}
    assert needed <= names
    assert not any(name.startswith(("views", "cli")) for name in names)


class Counted(case.Case):
    """A case that tells how often it was run, and is always steady."""

    runs: list = []  # noqa: RUF012

    def _once(self, options):
        self.runs.append(options["duration"])
        root = xr.Dataset({"a2": 1.0, "a2_error": 0.1})
        root.attrs = {"stopped": "in the test", "swept": "", "jdsmc_version": "0", "run": "1"}
        return Result(xr.DataTree.from_dict({"/": root}))


def test_reused_unless_asked_otherwise(tmp_path):
    scene = HomogeneousCooling(InelasticHardSpheres(np.array([0.5, 0.7])))
    one = Counted("one", scene, {"duration": 10.0})
    Counted.runs.clear()
    first = store.obtain(one, tmp_path)
    assert Counted.runs == [10.0] and first.is_steady
    assert float(store.obtain(one, tmp_path)["a2"]) == 1.0 and len(Counted.runs) == 1
    store.obtain(one, tmp_path, fresh=True)
    assert len(Counted.runs) == 2
    other = Counted("one", HomogeneousCooling(InelasticHardSpheres(0.5)), {"duration": 30.0})
    store.obtain(other, tmp_path)
    assert len(Counted.runs) == 3
    assert not list(tmp_path.glob("*.partial.h5"))


def test_what_is_not_steady_goes_on():
    """As if it had been asked for the longer time: nothing is simulated twice, nor differently."""
    scene = UniformShear(InelasticHardSpheres(0.9), 4.0)
    options = {"n_particles": 256, "n_realizations": 8, "collisions": 20.0}
    asked = case.Case("short", scene, options)
    assert not case.Case("short", scene, options, steady=False).simulate().is_steady
    found = asked.simulate()
    assert found.is_steady and float(found.attrs["collisions"]) > 20.0
    whole = options | {"collisions": float(found.attrs["collisions"])}
    again = case.Case("short", scene, whole).simulate()
    assert again["shear_stress"].value == found["shear_stress"].value


def test_parts_have_names_and_seeds_of_their_own():
    parts = Counted("part", HomogeneousCooling(InelasticHardSpheres(0.5))).parts(3)
    assert [part.name for part in parts] == ["part_0", "part_1", "part_2"]
    assert len({part.request() for part in parts}) == 3


def test_plain_data_is_kept_with_what_was_asked(tmp_path):
    path, made = tmp_path / "some.json", []

    def compute():
        made.append(1)
        return {"value": 1.5}

    for asked in ({"n": 1}, {"n": 1}, {"n": 2}):
        assert store.kept(path, asked, compute) == {"value": 1.5}
    assert len(made) == 2


def test_every_point_of_a_sweep_becomes_steady():
    """Near the elastic limit a gas takes ten times as long: the whole sweep goes on for it."""
    scene = UniformShear(InelasticHardSpheres([0.5, 0.95]), 4.0)
    options = {"n_particles": 256, "collisions": 30.0, "progress": False}
    short = jdsmc.run(scene, **options)
    assert short.is_steady and not case.steady_everywhere(short)
    found = case.Case("sweep", scene, options).simulate()
    assert case.steady_everywhere(found)
