"""How a batch is cut into groups, and who advances them, must not show in the results."""

import os
from typing import Any, ClassVar

import equinox as eqx
import jax
import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardSpheres, sweep
from jdsmc.running import engine
from jdsmc.running.engine import Engine, gas_keys, group_size
from jdsmc.running.host_engine import HostEngine
from jdsmc.scenarios import AbstractScene, ShearedSlab, UniformShear

from .. import helpers

SHEARED = UniformShear(InelasticHardSpheres([0.6, 0.9]), 4.0)
SLAB = ShearedSlab(InelasticHardSpheres([0.6, 0.9]), 2.0, layers=5)


class Drawn(AbstractScene):
    """A scene whose steps are plain Python: random numbers and their mean."""

    reports: ClassVar = (jdsmc.Observable("mean", "mean of what was drawn"),)
    monitored: ClassVar = ("mean",)
    traced: ClassVar = False

    gas: jdsmc.AbstractGas
    width: Any = jdsmc.number("width", low=0.0)

    def initial(self, key, options):
        return np.random.default_rng(key).normal(size=options.n_particles)

    def advance(self, key, state, options):
        kicks = np.random.default_rng(key).normal(size=state.shape)
        state = state + float(self.width) * kicks
        return state, DrawnRecord(np.mean(state), np.float64(1.0))

    def averages(self, record):
        return {"mean": record.mean}

    def observables(self, means):
        return means


class DrawnRecord(eqx.Module):
    """Mean of the state, and how long the record lasted."""

    mean: Any
    elapsed: Any


DRAWN = Drawn(InelasticHardSpheres(1.0), [0.1, 0.2])


def chunks(scene, n_realizations=9, n_particles=256, count=2):
    """The leaves of records and samples of some chunks, (points, realizations, ...)."""
    scenes, _ = sweep.points(scene)
    sizes = helpers.options(n_particles, 0.05, steps=4, samples=8, in_space=scene.in_space)
    run = (Engine if scene.traced else HostEngine)(scenes, n_realizations, 1, sizes)
    return jax.tree.leaves([run.advance() for _ in range(count)])


def assert_equal(ours, theirs):
    """Every array, bit for bit."""
    for one, other in zip(ours, theirs, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("scene", [SHEARED, SLAB, DRAWN], ids=["homogeneous", "slab", "host"])
def test_cores_do_not_matter(scene, monkeypatch):
    """Two points of nine realizations on one, two and three cores: the same bits."""
    results = []
    for cores in (1, 2, 3):
        monkeypatch.setattr(
            os, "sched_getaffinity", lambda _, n=cores: set(range(n)), raising=False
        )
        results.append(chunks(scene))
    assert_equal(results[1], results[0])
    assert_equal(results[2], results[0])
    assert max(x.size for x in results[0]) > 18  # else blind


@pytest.mark.parametrize(
    ("scene", "number"),
    [(SHEARED, 256), (SHEARED, 1072), (SHEARED, 3550), (SLAB, 256), (DRAWN, 256)],
    ids=["homogeneous", "67 rows", "71 rows", "slab", "host"],  # odd ones: no tile fits a gas
)
def test_a_gas_does_not_know_its_neighbours(scene, number):
    """Each point alone, its nine realizations in other groups than in the sweep: the same bits."""
    both = chunks(scene, n_particles=number)
    for point, one in enumerate(sweep.points(scene)[0]):
        assert_equal([x[point : point + 1] for x in both], chunks(one, n_particles=number))
    values = np.concatenate([x.reshape(18, -1) for x in both], axis=1)
    assert len(np.unique(values, axis=0)) == 18  # every gas has random numbers of its own


def test_groups_of_another_size_differ_by_rounding(monkeypatch):
    """Against one gas at a time, which is another program.

    The same random numbers, hence the same collisions; fused arithmetic may round differently
    (1e-7 a step, 8 steps; 1e-5 leaves room for a few of them to add up).
    """
    scenes, _ = sweep.points(SHEARED)
    sizes = helpers.options(256, 0.05, steps=4, samples=8)
    together, _ = Engine(scenes, 4, 1, sizes).advance()
    monkeypatch.setattr(engine, "MOST_TOGETHER", 1)
    alone, _ = Engine(scenes, 4, 1, sizes).advance()
    np.testing.assert_array_equal(together.tally.accepted, alone.tally.accepted)
    heat = [m.xx + m.yy + m.zz for m in (together.moments, alone.moments)]
    np.testing.assert_allclose(heat[0], heat[1], rtol=1e-5)


@pytest.mark.parametrize(
    ("n_particles", "scene", "expected"),
    [(1_000, SHEARED, 4), (6_400, SHEARED, 3), (50_000, SHEARED, 1), (1_000, SLAB, 1)],
)
def test_size_of_a_group(n_particles, scene, expected):
    """From N alone: at most four small homogeneous gases, 20 000 particles; one in space."""
    sizes = helpers.options(n_particles, 0.05, steps=4, in_space=scene.in_space)
    assert {group_size(gases, scene, sizes) for gases in (1, 8, 23)} == {expected}


@pytest.mark.parametrize("n_realizations", [8, 9, 11])
def test_groups_cover_the_batch(n_realizations):
    """Every gas once, in order; the last one fills the last group up."""
    scenes, _ = sweep.points(SHEARED)
    run = Engine(scenes, n_realizations, 7, helpers.options(256, steps=4))
    expected = [int(key.low) for one in scenes for key in gas_keys(one, n_realizations, 7)]
    found = [int(low) for keys in run._keys for low in keys.low]
    assert found[: len(expected)] == expected
    assert set(found[len(expected) :]) <= {expected[-1]}
    assert {keys.low.shape for keys in run._keys} == {(4,)}
