"""A file rebuilds the scene that made it, of classes that are there: it never imports anything."""

import dataclasses
import json
import sys

import equinox as eqx
import numpy as np
import pytest
import xarray as xr

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardDisks, InelasticHardSpheres, MaxwellMolecules
from jdsmc.results.result import Result
from jdsmc.running.provenance import specification
from jdsmc.scenarios import (
    CouetteFlow,
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    NavierStokes,
    ShearedSlab,
    UniformShear,
    WhiteNoiseThermostat,
)

from ..helpers import Viscoelastic
from ..test_sweep import two_gases

SCENES = [
    UniformShear(InelasticHardSpheres(0.7), 4.0),
    UniformShear(InelasticHardSpheres([0.6, 0.8]), np.array([1.0, 2.0, 4.0])),
    UniformShear(ElasticHardSpheres(0.7), 4.0),
    UniformShear(ElasticHardSpheres([0.7, 0.9], 0.8, drag="measured"), 4.0),
    UniformShear(Viscoelastic(0.4), 4.0),
    HomogeneousCooling(InelasticHardDisks(0.5)),
    HomogeneousCooling(MaxwellMolecules()),
    HeatFluxForce(InelasticHardSpheres(0.7), [0.05, 0.1], "paper"),
    FourierFlow(InelasticHardSpheres(1.0), 0.05, 0.01, 5.0, "bgk", 20),
    ShearedSlab(ElasticHardSpheres(0.7), 2.0, [2.5, 5.0], "nonequilibrium", layers=7),
    CouetteFlow(InelasticHardSpheres(0.9), [0.0, 0.5], 0.5, 0.8, layers=7),
    WhiteNoiseThermostat(MaxwellMolecules(), 0.2),
    NavierStokes(InelasticHardSpheres(0.6), 0.2, 3.0),
    two_gases(direction=[0.0, 1.0, 0.0]),
    two_gases(direction=np.eye(3)),
]


def assert_equal(ours, theirs):
    """Class by class and field by field: numbers of one shape and value, equal switches."""
    assert type(ours) is type(theirs)
    for field in dataclasses.fields(ours):
        one, other = (vars(x)[field.name] for x in (ours, theirs))
        if isinstance(one, eqx.Module):
            assert_equal(one, other)
        else:
            assert np.shape(one) == np.shape(other)
            np.testing.assert_array_equal(one, other)


def saved(scene, path) -> Result:
    """A file that tells of a scene, without the run."""
    tree = xr.DataTree(xr.Dataset(attrs={"jdsmc_version": "0", "specification": text_of(scene)}))
    return jdsmc.load(Result(tree).save(path / "scene.h5"))


def text_of(scene) -> str:
    return json.dumps(specification(scene))


@pytest.mark.parametrize("scene", SCENES, ids=repr)
def test_a_scene_is_built_again(scene, tmp_path):
    """Ours and a user's, with every number, sweep, vector and switch."""
    assert_equal(saved(scene, tmp_path).scene(), scene)


def test_a_run_tells_of_its_scene(tmp_path):
    """All of it goes into the file; what it rebuilds gives the same numbers again."""
    scene = UniformShear(ElasticHardSpheres([0.6, 0.8], drag="measured"), 4.0)
    sizes = {"n_particles": 512, "time_step": 0.1, "steps_per_record": 8, "progress": False}
    first = jdsmc.run(scene, duration=1.0, **sizes)
    loaded = jdsmc.load(first.save(tmp_path / "run.h5"))
    assert loaded.attrs["option_drag"] == "measured"
    again = jdsmc.run(loaded.scene(), duration=1.0, **sizes)
    xr.testing.assert_identical(again.series, first.series)
    with pytest.raises(ValueError, match="only the whole of a sweep knows its scene"):
        loaded.at(restitution=0.6).scene()


def renamed(scene, **names) -> str:
    """The text of a scene whose classes are said to be called otherwise."""
    text = text_of(scene)
    for old, new in names.items():
        text = text.replace(f"{SCENES[0].__module__}:{old}", new)
    return text


@pytest.mark.parametrize(
    "name",
    [
        "nowhere.at_all:UniformShear",
        "jdsmc.scenarios.uniform_shear:Vanished",
        "jdsmc.scenarios.uniform_shear:UniformShear.nothing",
        "json.tool:main",  # a module that could be imported, and must not be
        "os:system",  # a function is no class of a scene
        "subprocess:Popen",
        "builtins:dict",
    ],
)
def test_classes_that_are_not_there(name, tmp_path):
    """Refused with a sentence; nothing is imported or called."""
    sys.modules.pop("json.tool", None)
    text = renamed(SCENES[0], UniformShear=name)
    tree = xr.DataTree(xr.Dataset(attrs={"jdsmc_version": "0", "specification": text}))
    loaded = jdsmc.load(Result(tree).save(tmp_path / "scene.h5"))
    before = set(sys.modules)
    with pytest.raises(ValueError, match=r"class .* of .*"):
        loaded.scene()
    assert set(sys.modules) == before and "json.tool" not in sys.modules


def test_classes_can_be_passed_in(tmp_path):
    """By the name of the class, wherever it is now."""
    text = renamed(SCENES[0], UniformShear="my_notebook:UniformShear")
    tree = xr.DataTree(xr.Dataset(attrs={"jdsmc_version": "0", "specification": text}))
    loaded = jdsmc.load(Result(tree).save(tmp_path / "scene.h5"))
    with pytest.raises(ValueError, match=r"UniformShear of my_notebook is not imported; pass it"):
        loaded.scene()
    assert_equal(loaded.scene(UniformShear), SCENES[0])
