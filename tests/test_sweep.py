"""Sweeps: which numbers of a scene are swept, and the order of their product."""

import jax.numpy as jnp
import numpy as np

from jdsmc import ElasticHardSpheres, InelasticHardSpheres, grid
from jdsmc.scenarios import UniformShear


def test_parameters_of_a_scene():
    """Names of the fields, gas first; a named rate factor is no number."""
    scene = UniformShear(ElasticHardSpheres(0.8), 4.0)
    assert list(grid.parameters(scene)) == ["restitution", "shear_rate"]
    scene = UniformShear(ElasticHardSpheres(0.8, 0.9), 4.0)
    assert list(grid.parameters(scene)) == ["restitution", "rate_factor", "shear_rate"]
    assert grid.dimensions(scene) == {}


def test_one_gas_is_one_point():
    flat, shape = grid.flatten(UniformShear(InelasticHardSpheres(0.8), 4))
    assert shape == ()
    np.testing.assert_array_equal(flat.gas.restitution, [0.8])
    np.testing.assert_array_equal(flat.shear_rate, [4.0])


def test_product_of_two_sweeps():
    """The last parameter varies fastest, so that reshaping to `shape` restores the grid."""
    gas = ElasticHardSpheres([0.5, 0.7, 0.9], 0.8, "measured")
    flat, shape = grid.flatten(UniformShear(gas, [1.0, 4.0]))
    assert shape == (3, 2)
    np.testing.assert_array_equal(flat.gas.restitution, [0.5, 0.5, 0.7, 0.7, 0.9, 0.9])
    np.testing.assert_array_equal(flat.shear_rate, [1.0, 4.0, 1.0, 4.0, 1.0, 4.0])
    np.testing.assert_array_equal(flat.gas.rate_factor, [0.8] * 6)
    assert flat.gas.drag == "measured"


def test_an_array_of_one_is_a_dimension():
    _, shape = grid.flatten(UniformShear(InelasticHardSpheres([0.8]), 4.0))
    assert shape == (1,)


def test_jax_arrays_are_swept_too():
    flat, shape = grid.flatten(UniformShear(InelasticHardSpheres(0.8), jnp.array([1.0, 2.0])))
    assert shape == (2,)
    np.testing.assert_array_equal(flat.shear_rate, [1.0, 2.0])


def test_take():
    """One point has scalar numbers; an added axis serves broadcasting over records."""
    flat, _ = grid.flatten(UniformShear(InelasticHardSpheres([0.5, 0.7]), 4.0))
    one = grid.take(flat, 1)
    assert one.gas.restitution == 0.7 and np.ndim(one.shear_rate) == 0
    assert grid.take(flat, (slice(None), None)).shear_rate.shape == (2, 1)
