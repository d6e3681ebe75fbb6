"""A run that goes on from its result is the run that was asked for at once."""

import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import HomogeneousCooling, UniformShear

SMALL = {
    **{"n_particles": 512, "time_step": 0.1, "steps_per_record": 8},  # of `small`: compiled once
    **{"progress": False, "seed": 3},
}


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
    jdsmc.resume(first, collisions=8.0, progress=False)
    with pytest.raises(ValueError, match="gone on from already"):
        jdsmc.resume(first, collisions=10.0, progress=False)
    loaded = jdsmc.load(first.save(tmp_path / "first.h5"))
    for result in (loaded, first.at(restitution=0.6)):
        with pytest.raises(ValueError, match="holds no gas"):
            jdsmc.resume(result, collisions=10.0, progress=False)
