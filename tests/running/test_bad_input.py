"""Bad input is refused before anything is computed; what only looks odd works."""

import jax
import numpy as np
import pytest

import jdsmc
from jdsmc.running.engine import Engine
from jdsmc.running.run import scenes_of
from jdsmc.scenarios import UniformShear

from .small import assert_same, scene, simulate


@pytest.mark.parametrize(
    "options, words",
    [
        ({"n_particles": 0}, "n_particles = 0"),
        ({"n_particles": 10}, "n_particles = 10"),
        ({"n_realizations": 7}, r"n_realizations = 7 .*\[8, inf\)"),
        ({"n_realizations": 2**40}, r"n_realizations = 1099511627776 .*\[8, 2\^20\)"),
        ({"every": 0.0}, r"every = 0 .*\(0, inf\)"),
        ({"seed": -1}, "seed = -1"),
        ({"seed": 2**64}, "seed = 18446744073709551616"),
        ({"duration": 0.0}, r"duration = 0 .*\(0, inf\)"),
        ({"duration": np.nan}, "duration = nan"),
        ({"collisions": -5.0}, "collisions = -5"),
        ({"duration": 1.0, "collisions": 1.0}, "duration or collisions, not both"),
        ({"rtol": 0.0}, r"rtol = 0 .*\(0, 1\]"),
        ({"rtol": 1.5}, "rtol = 1.5"),
        ({"rtol": (0.1, 0.2)}, r"one for each observable \(shear_stress\)"),
        ({"budget": 0.0}, "budget = 0"),
        ({"time_step": 2.0}, "time_step = 2"),
        ({"observable": "viscosity"}, "observable = 'viscosity' .*reduced_viscosity"),
        ({"steps_per_record": 0}, "steps_per_record = 0"),
        ({"n_particles": 2**40}, r"n_particles = 1099511627776 .*\[64, 2\^31\)"),
        ({"steps_per_record": 2**31}, r"steps_per_record = 2147483648 .*2\^31"),
    ],
)
def test_bad_options(options, words, monkeypatch):
    """Refused before anything is computed."""
    monkeypatch.setattr(Engine, "advance", lambda self, watch: pytest.fail("a chunk was computed"))
    with pytest.raises(ValueError, match=words):
        simulate(**options)


@pytest.mark.parametrize(
    "name", ["n_particles", "n_realizations", "seed", "duration", "rtol", "splitting", "dtype"]
)
def test_options_of_a_wrong_type(name):
    with pytest.raises((TypeError, ValueError), match=name):
        simulate(**{name: "much"})


def test_not_within_a_transformation():
    """Told what to do instead: of a traced number, and of a run that is traced as a whole."""

    def last(alpha):
        return simulate(scene(alpha, 4.0), collisions=2.0).series["temperature"].values[-1]

    for transformed in (jax.jit(last), jax.grad(last), jax.jit(lambda x: x * last(0.7))):
        with pytest.raises(TypeError, match=r"cannot be run within jax.jit, grad or vmap: .*sweep"):
            transformed(0.7)


def test_float64_in_a_context():
    """JAX's x64 mode of this thread is that of the threads of the run."""
    with jax.enable_x64(True):
        wide = simulate(collisions=2.0, dtype="float64")
        again = simulate(collisions=2.0, dtype="float64")
    assert_same(wide, again)
    narrow = simulate(collisions=2.0)
    first = [float(r.series["temperature"].values[1]) for r in (wide, narrow)]
    assert first[0] == pytest.approx(first[1], rel=1e-3)  # the same gas, rounded otherwise


@pytest.mark.parametrize("restitution, shear_rate", [(1.0, 4.0), (0.9, 0.0), ([0.9, 1.0], 4.0)])
def test_no_steady_state_to_wait_for(restitution, shear_rate):
    with pytest.raises(ValueError, match=r"no steady state .*needs shear_rate > 0 .*give duration"):
        simulate(scene(restitution, shear_rate))


@pytest.mark.parametrize("what", [UniformShear, jdsmc.InelasticHardSpheres(0.7), "shear", None])
def test_what_is_no_scene(what):
    """A class is told how to become a scene."""
    words = r"class UniformShear; make one" if what is UniformShear else "scene must be one of"
    with pytest.raises(TypeError, match=words):
        scenes_of(what)  # asked first by `run`, whose type hints would speak up here


def test_what_only_looks_odd():
    """Whole floats, NumPy's integers and dtypes are what they stand for, in the file too."""
    plain = simulate(duration=1.0, seed=3)
    numbers = {"n_particles": 5.12e2, "n_realizations": np.int64(8), "seed": np.int32(3)}
    odd = simulate(duration=1.0, dtype=np.float32, steps_per_record=8.0, **numbers)
    assert_same(odd, plain)
    assert odd.attrs == plain.attrs
    assert type(odd.attrs["seed"]) is type(odd.attrs["n_particles"]) is int


def test_the_shortest_time_steps():
    """Pairs are too few to be counted in rows: one row is laid out, and hardly any is taken."""
    result = simulate(duration=1e-11, time_step=1e-12)
    assert 0 < float(result.series["time"][-1]) < 1e-9


def test_masked_numbers_are_no_numbers():
    with pytest.raises(TypeError, match=r"(?s)restitution = .* is not a number"):
        jdsmc.InelasticHardSpheres(np.ma.array([0.5, 0.7], mask=[False, True]))


@pytest.mark.parametrize("name", ["n_particles", "n_realizations", "seed", "steps_per_record"])
def test_what_is_not_whole(name):
    with pytest.raises(TypeError, match=rf"{name} must be an integer, got 1000\.5"):
        simulate(**{name: 1000.5})
