"""Sweeps: which numbers of a scene are swept, under which names, and the order of their product."""

from typing import Any, ClassVar

import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres, sweep
from jdsmc.scenarios import AbstractHomogeneous, UniformShear, homogeneous_observables


class TwoGases(AbstractHomogeneous):
    """Two gases in one scene, and a vector of the physics beside them."""

    reports: ClassVar = homogeneous_observables("temperature")
    monitored: ClassVar = ("temperature",)

    gas: jdsmc.AbstractGas
    first: jdsmc.AbstractGas
    second: jdsmc.AbstractGas
    direction: Any = jdsmc.number("direction of a field", axes=1, default=(0.0, 0.0, 1.0))

    def step(self, key, velocity, majorant, duration, options):
        return self.collide(key, velocity, majorant, duration, options)


def two_gases(**more):
    first, second = InelasticHardSpheres([0.5, 0.7]), InelasticHardSpheres([0.8, 0.9, 1.0])
    return TwoGases(InelasticHardSpheres(1.0), first, second, **more)


def test_parameters_of_a_scene():
    """Names of the fields, gas first; a named rate factor is no number."""
    scene = UniformShear(ElasticHardSpheres(0.8), 4.0)
    assert list(sweep.parameters(scene)) == ["restitution", "drag_factor", "shear_rate"]
    numbers = ["gas.restitution", "gas.drag_factor", "shear_rate"]
    assert list(sweep.numbers(scene)) == numbers
    scene = UniformShear(ElasticHardSpheres(0.8, 0.9), 4.0)
    names = ["restitution", "rate_factor", "drag_factor", "shear_rate"]
    assert list(sweep.parameters(scene)) == names
    assert sweep.dimensions(scene) == {}


def test_one_gas_is_one_point():
    (one,), shape = sweep.points(UniformShear(InelasticHardSpheres(0.8), 4))
    assert shape == ()
    assert one.gas.restitution == 0.8 and one.shear_rate == 4.0
    assert np.ndim(one.gas.restitution) == np.ndim(one.shear_rate) == 0


def test_product_of_two_sweeps():
    """The last parameter varies fastest, so that reshaping to `shape` restores the sweep."""
    gas = ElasticHardSpheres([0.5, 0.7, 0.9], 0.8, "measured")
    scenes, shape = sweep.points(UniformShear(gas, [1.0, 4.0]))
    assert shape == (3, 2)
    assert [s.gas.restitution for s in scenes] == [0.5, 0.5, 0.7, 0.7, 0.9, 0.9]
    assert [s.shear_rate for s in scenes] == [1.0, 4.0, 1.0, 4.0, 1.0, 4.0]
    assert {float(s.gas.rate_factor) for s in scenes} == {0.8}
    assert {s.gas.drag for s in scenes} == {"measured"}


def test_an_array_of_one_is_a_dimension():
    _, shape = sweep.points(UniformShear(InelasticHardSpheres([0.8]), 4.0))
    assert shape == (1,)


def test_jax_arrays_are_swept_too():
    scene = UniformShear(InelasticHardSpheres(0.8), jnp.array([1.0, 2.0]))
    scenes, shape = sweep.points(scene)
    assert shape == (2,)
    assert [s.shear_rate for s in scenes] == [1.0, 2.0]


def test_stacked_points_have_a_first_axis():
    """What a group of gases is made of: numbers of shape (gases,), switches as they were."""
    scenes, _ = sweep.points(UniformShear(ElasticHardSpheres([0.5, 0.7], drag="measured"), 4.0))
    stacked = sweep.stack(scenes)
    np.testing.assert_array_equal(stacked.gas.restitution, [0.5, 0.7])
    np.testing.assert_array_equal(stacked.shear_rate, [4.0, 4.0])
    assert stacked.gas.drag == "measured"


def test_numbers_of_the_same_name_stay_two():
    """Two gases swept over different restitutions: their product, each gas with its own."""
    scenes, shape = sweep.points(two_gases())
    assert shape == (2, 3)
    pairs = [(float(s.first.restitution), float(s.second.restitution)) for s in scenes]
    assert pairs == [(a, b) for a in (0.5, 0.7) for b in (0.8, 0.9, 1.0)]
    assert {float(s.gas.restitution) for s in scenes} == {1.0}
    dimensions = sweep.dimensions(two_gases())
    assert list(dimensions) == ["first_restitution", "second_restitution"]
    np.testing.assert_array_equal(dimensions["first_restitution"], [0.5, 0.7])
    np.testing.assert_array_equal(dimensions["second_restitution"], [0.8, 0.9, 1.0])


def test_both_sweeps_reach_the_result():
    """Both are dimensions of everything measured, under a name of their own."""
    sizes = {"n_particles": 64, "n_realizations": 8, "time_step": 0.1, "steps_per_record": 8}
    series = jdsmc.run(two_gases(), duration=1.0, progress=False, **sizes).series
    assert series["temperature"].dims == ("first_restitution", "second_restitution", "sample")
    np.testing.assert_array_equal(series["second_restitution"], [0.8, 0.9, 1.0])


def test_a_vector_of_the_physics_is_no_sweep():
    """With one axis more it is one, and every point has its vector."""
    assert sweep.points(two_gases(direction=[1.0, 0.0, 0.0]))[1] == (2, 3)
    scenes, shape = sweep.points(two_gases(direction=np.eye(3)[:2]))
    assert shape == (2, 3, 2)
    np.testing.assert_array_equal(scenes[0].direction, [1.0, 0.0, 0.0])
    np.testing.assert_array_equal(scenes[1].direction, [0.0, 1.0, 0.0])
    with pytest.raises(ValueError, match=r"direction .*an array of 1 axes"):
        two_gases(direction=1.0)


def test_fingerprints_tell_points_apart():
    """Class, path, value and switch each matter; the last digits of float64 do not."""
    gas = InelasticHardSpheres(0.7)
    prints = [
        sweep.fingerprint(scene)
        for scene in (
            UniformShear(gas, 4.0),
            UniformShear(gas, 4.1),
            UniformShear(InelasticHardSpheres(0.71), 4.0),
            UniformShear(ElasticHardSpheres(0.7), 4.0),
            UniformShear(ElasticHardSpheres(0.7, drag="measured"), 4.0),
            TwoGases(gas, InelasticHardSpheres(0.5), InelasticHardSpheres(0.8)),
            TwoGases(gas, InelasticHardSpheres(0.8), InelasticHardSpheres(0.5)),
        )
    ]
    assert len(set(prints)) == len(prints)
    rounded = UniformShear(InelasticHardSpheres(np.arange(0.3, 0.9, 0.1)[4]), 4.0)
    assert rounded.gas.restitution != 0.7 and sweep.fingerprint(rounded) == prints[0]


def test_points_that_float32_does_not_tell_apart():
    """They would have the same random numbers, and pass for independent."""
    for values in ([0.7, 0.7 + 1e-9], [0.7, 0.9, 0.7]):
        with pytest.raises(ValueError, match=r"restitution = 0\.7.* is there twice"):
            sweep.points(UniformShear(InelasticHardSpheres(values), 4.0))
