"""What is repeated: seeds, keys, compiled programs, and dtypes."""

import logging

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr

from jdsmc import random, sweep
from jdsmc.running.engine import Engine, gas_keys

from .. import helpers
from .small import assert_same, scene, simulate


def test_same_seed_same_numbers():
    one, other = simulate(rtol=0.1, seed=5), simulate(rtol=0.1, seed=5)
    assert_same(one, other)
    assert one.attrs == other.attrs
    xr.testing.assert_identical(one.distribution, other.distribution)


def test_another_seed_other_numbers():
    one, other = simulate(duration=1.0, seed=5), simulate(duration=1.0, seed=6)
    assert np.all(one.series["shear_stress"] != other.series["shear_stress"])


def assert_common(whole, part, point):
    """Over the records that both have, a point of a sweep equals another run bit for bit."""
    shortest = min(whole.sizes["sample"], part.sizes["sample"])
    assert shortest > 8
    for name in part.data_vars:
        ours, theirs = whole[name][point].values[:shortest], part[name].values[:shortest]
        np.testing.assert_array_equal(ours, theirs, err_msg=str(name))
    ours, theirs = whole["time"][point].values[:shortest], part["time"].values[:shortest]
    np.testing.assert_array_equal(ours, theirs)


def test_a_sweep_its_parts_and_its_points_are_the_same_numbers():
    """At fixed collisions, in any order: numbers come from the values, not from their places.

    How long the others run differs: the point with the fewest collisions ends a run.
    """
    whole = simulate(scene([0.6, 0.8, 0.9]), collisions=10.0).series
    part = simulate(scene([0.9, 0.6]), collisions=10.0).series
    for k, alpha in enumerate((0.6, 0.8, 0.9)):
        assert_common(whole, simulate(scene(alpha), collisions=10.0).series, k)
    assert_common(whole, part.isel(restitution=0), 2)
    assert_common(whole, part.isel(restitution=1), 0)
    assert np.all(whole["shear_stress"][0] != whole["shear_stress"][1])


def test_realizations_are_the_same_numbers_however_many():
    """The first eight of eleven realizations are those of a run of eight."""
    sizes = helpers.options(512, steps=8)
    scenes, _ = sweep.points(scene())
    few, many = (Engine(scenes, count, 3, sizes).advance()[0] for count in (8, 11))
    for ours, theirs in zip(jax.tree.leaves(few), jax.tree.leaves(many), strict=True):
        np.testing.assert_array_equal(ours, theirs[:, :8])
    assert len(np.unique(many.moments.xy[0, :, -1])) == 11


def test_every_gas_has_its_own_key():
    """No key is shared by two gases of a sweep, nor by two seeds (2^64 keys: chance 1e-13)."""
    scenes, _ = sweep.points(scene(np.linspace(0.5, 0.9, 8), np.linspace(1.0, 4.0, 5)))
    words = [
        (int(key.high), int(key.low))
        for seed in (0, 1, 2**63)
        for one in scenes
        for key in gas_keys(one, 10, seed)
    ]
    assert len(set(words)) == len(words) == 3 * 40 * 10


def test_every_chunk_has_its_own_numbers():
    """The second chunk of a gas that is put back to its start differs from the first."""
    gas = Engine(sweep.points(scene())[0], 8, 0, helpers.options(512, steps=8))
    start = gas.all_states()
    first, _ = gas.advance()
    gas.take(start, 1)
    second, _ = gas.advance()
    np.testing.assert_array_equal(first.moments.xy[..., 0], second.moments.xy[..., 0])
    assert np.all(first.moments.xy[..., 1:] != second.moments.xy[..., 1:])


def test_values_compile_nothing(caplog):
    """Another seed, restitution, shear rate or length of the run is the same program."""
    simulate(duration=1.0)
    with jax.log_compiles(), caplog.at_level(logging.WARNING):
        simulate(scene(0.8, 2.0), seed=7, duration=8.0)
        simulate(scene(0.6, 3.0), rtol=0.1)
        simulate(scene([0.7, 0.8]), duration=1.0)
        assert not [r for r in caplog.records if "Compiling" in r.getMessage()]
        jax.jit(lambda x: x + 1)(1.0)
        assert [r for r in caplog.records if "Compiling" in r.getMessage()], "else blind"


# Precision and order of a step


@pytest.fixture
def x64():
    """Leaves the switch as it was."""
    before = jax.config.read("jax_enable_x64")
    yield
    jax.config.update("jax_enable_x64", before)


def test_dtypes(x64):
    """float64 is kept throughout, and so is float32 where float64 is enabled.

    The random words are the same, so the two differ by rounding as long as every collision is
    accepted in both: for this seed, over one chunk, by less than 1e-4.
    """
    single = simulate(duration=1.0).series
    jax.config.update("jax_enable_x64", True)
    for dtype in ("float64", "float32"):
        options = helpers.options(512, dtype=dtype, steps=8)
        one = jax.tree.map(lambda x: jnp.asarray(x, dtype), scene())  # noqa: B023
        key = random.key_from_seed(1)
        state = eqx.filter_eval_shape(one.initial, key, options)
        shapes = eqx.filter_eval_shape(one.advance, key, state, options)
        floating = [x.dtype for x in jax.tree.leaves(shapes) if x.dtype.kind == "f"]
        assert len(floating) > 10 and set(floating) == {jnp.dtype(dtype)}
    double = simulate(duration=1.0, dtype="float64").series
    common = min(double.sizes["sample"], single.sizes["sample"])  # the slowest clock ends either
    for name in ("temperature", "shear_stress"):
        ours, theirs = (run[name].values[:common] for run in (double, single))
        assert np.any(ours != theirs)
        np.testing.assert_allclose(ours, theirs, rtol=1e-4, atol=1e-4)


def test_float64_needs_x64():
    with pytest.raises(ValueError, match=r"dtype = .*float64.*jax_enable_x64"):
        simulate(dtype="float64")


def test_options_reach_the_engine(monkeypatch):
    seen = []
    monkeypatch.setattr(Engine, "__init__", lambda self, *given: seen.append(given) or 1 / 0)
    with pytest.raises(ZeroDivisionError):
        simulate(splitting="lie", time_step=0.05, steps_per_record=100, seed=3)
    ((_, realizations, seed, options, _),) = seen
    assert (realizations, seed) == (8, 3)
    assert (options.splitting, options.time_step) == ("lie", 0.05)
    assert (options.steps, options.records) == (100, 1)  # at least one record a chunk
