"""Bad input is refused with one sentence that names the parameter and what is allowed."""

from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import ElasticHardSpheres, InelasticHardSpheres, check
from jdsmc.collisions.pairs import plan_pairs
from jdsmc.scenarios import UniformShear
from jdsmc.scenarios.options import Options

IHS = InelasticHardSpheres


@pytest.mark.parametrize("value", [1, 0.5, np.float32(0.5), [0.5, 1], np.array([1, 2]), 1e300])
def test_numbers_become_float64(value):
    array = check.physical(value)
    assert isinstance(array, np.ndarray) and array.dtype == np.float64
    np.testing.assert_array_equal(array, value)


def test_jax_values_are_left_alone():
    """A traced value cannot be inspected; a concrete one keeps its dtype and is checked."""
    value = jnp.array([0.5, 0.7])
    assert check.physical(value) is value
    with pytest.raises(ValueError, match=r"x = 0\.7"):
        check.in_range("x", value, 0.0, 0.6)
    traced = jax.jit(lambda x: check.in_range("x", x, 0.0, 0.6) or check.physical(x))
    assert traced(0.7) == jnp.float32(0.7)


@pytest.mark.parametrize(
    "value", ["0.5", "a lot", None, True, 1j, [[0.5], [0.6, 0.7]], {"a": 1}, np.array(["0.5"])]
)
def test_what_is_no_number(value):
    with pytest.raises(TypeError, match=r"restitution = .* not a number .* range \(0, 1\]"):
        IHS(value)


@pytest.mark.parametrize("value", [0.0, -0.1, 1.0000001, np.nan, np.inf, [0.5, 2.0]])
def test_restitution_outside_its_range(value):
    bad = "1.0000001" if value == 1.0000001 else f"{np.max(value):g}"
    with pytest.raises(ValueError, match=r"restitution = .* allowed range \(0, 1\]") as caught:
        IHS(value)
    assert f"= {bad} is" in str(caught.value)


@pytest.mark.parametrize("value", [1.0, 1e-9, [0.3, 1.0]])
def test_restitution_inside_its_range(value):
    np.testing.assert_array_equal(IHS(value).restitution, value)


@pytest.mark.parametrize("value", [-1e-9, np.nan, np.inf, -np.inf, [1.0, -4.0]])
def test_shear_rate_outside_its_range(value):
    with pytest.raises(ValueError, match=r"shear_rate = .* allowed range \[0, inf\)"):
        UniformShear(IHS(0.9), value)


@pytest.mark.parametrize("value, why", [([[0.5, 0.6]], "one-dimensional"), ([], "empty")])
def test_odd_shapes(value, why):
    with pytest.raises(ValueError, match=f"restitution .*{why}"):
        IHS(value)
    with pytest.raises(ValueError, match=f"shear_rate .*{why}"):
        UniformShear(IHS(0.9), value)


@pytest.mark.parametrize(
    "options, words",
    [
        ({"rate_factor": "quadratic"}, "rate_factor = 'quadratic' .*linear, viscosity"),
        ({"rate_factor": 0.0}, r"rate_factor = 0 .*\(0, 2\]"),
        ({"rate_factor": 2.5}, r"rate_factor = 2.5 .*\(0, 2\]"),
        ({"drag_factor": -0.5}, r"drag_factor = -0.5 .*\[0, inf\)"),
    ],
)
def test_elastic_gas(options, words):
    with pytest.raises(ValueError, match=words):
        ElasticHardSpheres(0.8, **options)


def test_names():
    with pytest.raises(ValueError, match=r"drag = 'strong' .*choose one of local, measured"):
        check.one_of("drag", "strong", ("local", "measured"))
    with pytest.raises((ValueError, TypeError), match="drag"):  # by the type hints, in tests
        ElasticHardSpheres(0.8, drag="strong")


def test_gas_of_another_kind():
    with pytest.raises(TypeError, match="gas"):
        UniformShear("ihs", 4.0)


@pytest.mark.parametrize("value", [True, np.bool_(True), 1.5, np.float32(0.1), np.nan, "3", None])
def test_what_is_no_integer(value):
    with pytest.raises(TypeError, match="count must be an integer"):
        check.at_least("count", value, 0)
    with pytest.raises(TypeError, match="count must be an integer"):
        check.whole("count", value, 0)


@pytest.mark.parametrize("value", [3, 3.0, np.int32(3), np.int64(3), np.uint8(3), np.float64(3.0)])
def test_integers(value):
    """Whatever is whole counts, 1e4 included; the engine gets an int."""
    check.at_least("count", value, 3)
    assert check.whole("count", value, 3) == 3 and type(check.whole("count", value, 3)) is int
    with pytest.raises(ValueError, match=r"count = 3.* \[4, inf\)"):
        check.whole("count", value, 4)


@pytest.mark.parametrize(
    "changed, words",
    [
        ({"n_particles": 0}, r"n_particles = 0 .*inf\)"),
        ({"n_particles": 63}, r"n_particles = 63 .*\[64, inf\)"),
        ({"n_particles": 4099}, "n_particles = 4099 .*use 4160"),  # a prime
        ({"time_step": 0.0}, r"time_step = 0 .*\(0, 1\]"),
        ({"time_step": 1.5}, r"time_step = 1.5 .*\(0, 1\]"),
        ({"splitting": "verlet"}, "splitting = 'verlet' .*strang, lie"),
        ({"dtype": "float16"}, "dtype = 'float16' .*float32, float64"),
        ({"dtype": "float64"}, "dtype = .*float64.*jax_enable_x64"),
    ],
)
def test_options(changed, words):
    good = {
        "n_particles": 512,
        "time_step": 0.1,
        "splitting": "strang",
        "dtype": "float32",
        "steps": 8,
    }
    assert Options.checked(**good).plan == plan_pairs(512, 0.1)
    for same in ({"n_particles": 512.0}, {"dtype": np.float32}, {"dtype": np.dtype("float32")}):
        assert Options.checked(**good | same) == Options.checked(**good)
    with pytest.raises(TypeError, match=r"n_particles must be an integer, got 1000\.5"):
        Options.checked(**good | {"n_particles": 1000.5})
    with pytest.raises(ValueError, match=words):
        Options.checked(**good | changed)


def test_path():
    assert check.path("checkpoint", "a/b.h5") == Path("a/b.h5") == check.path("", Path("a/b.h5"))
    for other in (3, b"a.h5", None):
        with pytest.raises(TypeError, match="checkpoint must be the path of a file, got"):
            check.path("checkpoint", other)
