"""Runs that cannot be trusted end with a sentence, and with what was measured until then."""

import equinox as eqx
import jax
import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardSpheres, random, sweep
from jdsmc.collisions.pairs import plan_pairs
from jdsmc.collisions.whole import collide
from jdsmc.running import faults
from jdsmc.running.engine import Engine
from jdsmc.running.history import History

from .. import helpers
from ..helpers import f32, maxwellian
from .small import scene, simulate


def test_not_steady():
    """The budget ends soon after the warm-up: what was measured comes with the error."""
    with pytest.raises(jdsmc.NotSteadyError, match=r"no steady state within 65 .*budget") as caught:
        simulate(scene(0.95), budget=65.0)
    result = caught.value.result
    assert result is not None and not result.is_steady
    assert 55 < float(result.series["collisions"][-1]) < 85
    assert result.attrs["stopped"] == str(caught.value)


def spoiled(monkeypatch, spoil):
    """Have every engine go on from states changed by `spoil` after its first chunk."""
    advance = Engine.advance

    def patched(self, watch):
        if self.chunks == 1:
            self.states = [spoil(state) for state in self.states]
        return advance(self, watch)

    monkeypatch.setattr(Engine, "advance", patched)


@pytest.mark.parametrize("factor", [np.nan, 3e19])
def test_numbers_that_are_not_finite(factor, monkeypatch):
    """NaN, and ⟨V²⟩ = 1e39 above the largest float32; the chunk before is kept."""
    spoiled(
        monkeypatch,
        lambda s: eqx.tree_at(lambda s: s.velocity, s, tuple(f32(factor) * v for v in s.velocity)),
    )
    with pytest.raises(jdsmc.FaultError, match=r"infinite or NaN .*reduce time_step") as caught:
        simulate(collisions=50.0)
    result = caught.value.result
    assert result is not None and result.attrs["stopped"].startswith("fault: Velocities became")
    assert np.all(np.isfinite(result.series["temperature"]))


def check_tally(**changed):
    """The check of the first chunk of a run whose tally is changed by shares of its collisions."""
    sizes = helpers.options(512, steps=8)
    scenes, _ = sweep.points(scene())
    record, sample = Engine(scenes, 8, 0, sizes).advance()
    accepted = 10 * record.tally.accepted  # enough of them to judge
    tally = {"accepted": accepted} | {name: share * accepted for name, share in changed.items()}
    for name, values in tally.items():
        record = eqx.tree_at(lambda r, n=name: getattr(r.tally, n), record, values)
    history = History(scenes, 512, 8)
    history.append(record, sample)
    faults.check_collisions(history, record)


def test_lost_collisions():
    """Counted: candidates without a slot where a step is longer than the waves were made for, and
    pairs that outrun a majorant of 1.5 v0. The longest step that fits loses none.
    """
    plan = plan_pairs(2**12, 0.1)
    velocity = maxwellian(1, helpers.options(2**12))
    gas, key = InelasticHardSpheres(f32(0.7)), random.key_from_seed(1)
    step = eqx.filter_jit(lambda w, dt: collide(key, gas, plan, velocity, w, dt)[1])
    for majorant, hits, overflow, excess in ((6, 1, 0, 0), (6, 2, 1, 1), (1.5, 1, 0, 1)):
        duration = 0.9999 * hits * plan.largest_hits() * 2**0.5 / majorant
        tally = step(f32(majorant), f32(duration))
        assert (float(tally.overflow) > 0, float(tally.excess) > 0) == (overflow, excess)


@pytest.mark.parametrize("name, words", [("overflow", "had no slot"), ("excess", "above one")])
def test_lost_collisions_are_raised(name, words):
    """From 1e-4 of them on: a tenth of the precision asked by default."""
    check_tally(**{name: 0.99e-4})
    with pytest.raises(jdsmc.FaultError, match=rf"{words} .*reduce time_step"):
        check_tally(**{name: 1.01e-4})


@pytest.mark.parametrize(
    "error", [jax.errors.JaxRuntimeError("RESOURCE_EXHAUSTED: 9 GiB"), MemoryError()]
)
def test_no_room(error, monkeypatch):
    """Whoever has no room is told what to make smaller."""

    def full(*_):
        raise error

    monkeypatch.setattr(Engine, "advance", full)
    with pytest.raises(MemoryError, match=r"8 gases of 512 particles .* fewer n_particles"):
        simulate(collisions=5.0)


def test_another_error_of_the_device_stays_what_it_is(monkeypatch):
    def broken(*_):
        raise jax.errors.JaxRuntimeError("INTERNAL: no such thing")

    monkeypatch.setattr(Engine, "advance", broken)
    with pytest.raises(jax.errors.JaxRuntimeError, match="INTERNAL"):
        simulate(collisions=5.0)
