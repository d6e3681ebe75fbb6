"""A run that goes on from its result is the run that was asked for at once."""

import copy
import pickle
import signal

import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.running.session import Session
from jdsmc.scenarios import HomogeneousCooling, UniformShear

from ..helpers import differences

SMALL = {
    **{"n_particles": 512, "time_step": 0.1, "steps_per_record": 8},  # of `small`: compiled once
    **{"progress": False, "seed": 3},
}


@pytest.fixture
def interrupted(monkeypatch):
    """Makes a run end by Ctrl-C after a number of chunks."""

    def after(make, chunks: int):
        usual, made = Session.advance, []

        def advance(session):
            made.append(None)
            if len(made) == chunks:
                signal.raise_signal(signal.SIGINT)
            usual(session)

        before = signal.signal(signal.SIGINT, signal.default_int_handler)  # not ignored
        try:
            with monkeypatch.context() as patch:
                patch.setattr(Session, "advance", advance)
                return make()
        finally:
            signal.signal(signal.SIGINT, before)

    return after


def shear(restitution=(0.6, 0.8), **limits):
    return jdsmc.run(UniformShear(InelasticHardSpheres(list(restitution)), 4.0), **SMALL, **limits)


def test_collisions_gone_on_for_are_those_asked_at_once():
    """To the bit: series, steady values and errors, of a sweep."""
    whole = shear(collisions=60.0)
    part = shear(collisions=20.0)
    gone_on = jdsmc.resume(part, collisions=60.0, progress=False)
    for group in ("series", "left_out"):
        one, other = (r.to_xarray()[group].to_dataset() for r in (whole, gone_on))
        assert one.identical(other)
    assert whole.steady.equals(gone_on.steady)
    assert gone_on.attrs["collisions"] == 60.0


def test_more_precision_is_asked_of_the_same_run():
    """The error falls below what is asked, and the series begins as it did."""
    scene = HomogeneousCooling(InelasticHardSpheres(0.7))
    first = jdsmc.run(scene, rtol=0.02, **SMALL)
    better = jdsmc.resume(first, rtol=0.005, progress=False)
    value, error = better["relative_speed_cubed"]
    assert error <= 0.005 * value
    count = first.series.sizes["sample"]
    assert better.series.sizes["sample"] > count
    # the last samples of the first series wait for the slowest realization
    before, after = (r.series["a2"].values[: count // 2] for r in (first, better))
    np.testing.assert_array_equal(before, after)


def test_what_cannot_go_on_says_so(tmp_path):
    first = shear(collisions=5.0)
    with pytest.raises(ValueError, match="reached already"):
        jdsmc.resume(first, collisions=2.0, progress=False)
    with pytest.raises(ValueError, match=r"every = -1 .*\(0, inf\)"):
        jdsmc.resume(first, collisions=8.0, every=-1.0, progress=False)
    jdsmc.resume(first, collisions=8.0, progress=False)
    with pytest.raises(ValueError, match="gone on from already"):
        jdsmc.resume(first, collisions=10.0, progress=False)
    loaded = jdsmc.load(first.save(tmp_path / "first.h5"))
    for result in (loaded, first.at(restitution=0.6)):
        with pytest.raises(ValueError, match="holds no gas"):
            jdsmc.resume(result, collisions=10.0, progress=False)


def test_without_new_limits_a_result_is_given_again():
    """One that came to its end; one that Ctrl-C ended goes on to what had been asked."""
    first = shear(collisions=5.0)
    again = jdsmc.resume(first, progress=False)
    assert again.attrs["stopped"] == first.attrs["stopped"]
    assert not differences(first, again)


def test_what_ctrl_c_ended_goes_on_to_its_end(interrupted):
    """As if nothing had happened: in this process, to the bit."""
    whole = shear(collisions=60.0)
    part = interrupted(lambda: shear(collisions=60.0), chunks=3)
    assert part.interrupted and part.series.sizes["sample"] < whole.series.sizes["sample"]
    assert not differences(whole, jdsmc.resume(part, progress=False))


def test_a_run_and_what_it_went_on_to_are_correlated():
    """They share most of their time: the difference is known far better than each of them, and
    their mean no better. Of 300 and 320 collisions the windows share more than nine tenths, so that
    the error of the difference is about √(1 - 0.93) = 0.26 of each (of seven degrees of freedom:
    0.5 is three standard deviations more); independent ones had 1.4 of it.
    """
    first = shear(restitution=[0.6], collisions=300.0)
    error = first["shear_stress"].error
    later = jdsmc.resume(first, collisions=320.0, progress=False)
    assert np.all((later["shear_stress"] - first["shear_stress"]).error < 0.5 * error)
    both = 0.5 * (later["shear_stress"] + first["shear_stress"])
    assert np.all(both.error > 0.9 * later["shear_stress"].error)


def test_copies_travel_without_the_gas():
    """What processes of a pool send back: all numbers, the same runs; but nothing to go on with."""
    first = shear(collisions=45.0)
    for copied in (pickle.loads(pickle.dumps(first)), copy.deepcopy(first)):
        assert not differences(first, copied)
        assert np.all((copied["shear_stress"] - first["shear_stress"]).error == 0.0)
        with pytest.raises(ValueError, match="holds no gas"):
            jdsmc.resume(copied, collisions=50.0, progress=False)
    assert first.under_way is not None
