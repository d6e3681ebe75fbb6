"""Two features together: what each does right alone."""

import json
import signal

import jax.numpy as jnp
import matplotlib.pyplot as plt
import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.errors import FaultError, Interrupted
from jdsmc.estimate import combine
from jdsmc.fit.transient import series_of
from jdsmc.results import join_gases
from jdsmc.running.limits import Limits
from jdsmc.running.run import scenes_of
from jdsmc.running.session import Session
from jdsmc.scenarios import CouetteFlow, HomogeneousCooling, UniformShear

from ..helpers import Viscoelastic, options

SCENE = UniformShear(InelasticHardSpheres(0.7), 4.0)
SMALL = {"n_particles": 256, "progress": False}


def test_derivatives_are_merged_by_the_number_they_are_with_respect_to():
    names = ("restitution", "shear_rate")
    one = jdsmc.run(SCENE, collisions=40.0, sensitivity=names, seed=1, **SMALL)
    other = jdsmc.run(SCENE, collisions=40.0, sensitivity=names[::-1], seed=2, **SMALL)
    merged = jdsmc.merge([one, other]).sensitivity["temperature"]
    for name in names:
        each = [float(r.sensitivity["temperature"][name].value) for r in (one, other)]
        assert float(merged[name].value) == pytest.approx(np.mean(each))
    alone = jdsmc.run(SCENE, collisions=40.0, sensitivity="restitution", seed=3, **SMALL)
    with pytest.raises(ValueError, match="with respect to"):
        jdsmc.merge([one, alone])


def test_a_precision_then_times_from_a_file(tmp_path):
    """Derivatives along a series need samples from the start, which this run does not have."""
    path = tmp_path / "run.h5"
    one = jdsmc.run(SCENE, rtol=0.1, sensitivity="restitution", checkpoint=path, **SMALL)
    end = float(one.series["collisions"][-1])
    for more in (10.0, 20.0):
        again = jdsmc.resume(path, collisions=end + more, progress=False)
        assert "sensitivity_series" not in again.to_xarray().children
        assert np.isfinite(again.sensitivity["temperature"]["restitution"].value)


def test_times_of_a_series_are_of_one_gas():
    result = jdsmc.run(SCENE, collisions=40.0, **SMALL)
    _, (known,) = series_of(result, ("temperature",), 0)
    again = combine(np.mean, known)
    # of 8 realizations, each averaged in time: far above that of as many independent numbers
    apart = np.sqrt(np.mean(known.error**2) / known.value.size)
    assert again.error > 2.0 * apart


def test_gases_side_by_side_know_their_realizations():
    alone = jdsmc.run(SCENE, collisions=60.0, **SMALL)
    other = jdsmc.run(UniformShear(InelasticHardSpheres(0.8), 4.0), collisions=60.0, **SMALL)
    joined = join_gases({"one": alone, "other": other})
    stress = joined["shear_stress"]
    assert np.all((stress - stress).error == 0)
    one, mine = (r["pressure_xx"] - r["pressure_yy"] for r in (joined.at(gas="one"), alone))
    assert one.error == pytest.approx(mine.error)
    assert stress[0].interval() == pytest.approx(alone["shear_stress"].interval())


def test_one_of_the_gases_side_by_side_is_as_it_was():
    """The longer series pads the other with NaN, which is taken off again."""
    short = jdsmc.run(SCENE, collisions=2.0, **SMALL)
    model = UniformShear(jdsmc.ElasticHardSpheres(0.7), 4.0)
    long = jdsmc.run(model, collisions=20.0, **SMALL)
    joined = join_gases({"ihs": short, "ehs": long})
    for gas, alone in (("ihs", short), ("ehs", long)):
        one = joined.at(gas=gas)
        assert one.attrs["gas_model"] == alone.attrs["gas_model"]
        assert np.array_equal(one.series["time"], alone.series["time"])
        plt.close(one.plot())


def test_an_observable_that_is_no_number_is_named():
    """Elastic spheres lose nothing, so that their cooling rate over that of a Maxwellian is none;
    whatever the order of the points."""
    for alpha in ([0.9, 1.0], [1.0, 0.9]):
        scene = HomogeneousCooling(InelasticHardSpheres(np.array(alpha)))
        with pytest.raises(FaultError, match="relative_speed_cubed_collisional is not a number"):
            jdsmc.run(scene, observable="relative_speed_cubed_collisional", rtol=0.2, **SMALL)


def test_a_refused_time_leaves_the_run_as_it_was():
    result = jdsmc.run(SCENE, rtol=0.1, **SMALL)
    with pytest.raises(ValueError, match="reached already"):
        jdsmc.resume(result, duration=1.0, progress=False)
    assert "duration" not in jdsmc.resume(result, progress=False).attrs


@pytest.mark.parametrize(
    "limits",
    [
        {"collisions": np.int64(2), "budget": np.float32(400.0)},
        {"duration": np.array(30.0)},
        {"rtol": np.array([0.2]), "observable": ["shear_stress"]},
        {"rtol": np.float32(0.2), "budget": jnp.float32(400.0)},
    ],
)
def test_limits_of_other_types_can_be_written(limits):
    scenes = scenes_of(SCENE)
    asked = Limits(scenes, options(256), **limits)
    again = Limits(scenes, options(256), **json.loads(json.dumps(asked.given)))
    assert again.attributes() == asked.attributes()


def test_whole_numbers_given_as_others_are_kept(tmp_path):
    path = tmp_path / "run.h5"
    one = {"n_realizations": 8.0, "seed": np.int32(3), "checkpoint": path}
    jdsmc.run(SCENE, collisions=2.0, **one, **SMALL)
    assert jdsmc.resume(path, collisions=4.0, progress=False).attrs["seed"] == 3


def test_a_swept_number_that_is_reported_too_is_refused_before_the_run():
    scene = CouetteFlow(Viscoelastic(np.array([0.2, 0.4])), wall_velocity=1.0, length=2.0, layers=4)
    with pytest.raises(ValueError, match="dissipation is swept, and is what CouetteFlow reports"):
        jdsmc.run(scene, duration=1.0, **SMALL)


def test_a_run_that_broke_off_within_a_chunk_does_not_go_on(monkeypatch):
    result = jdsmc.run(SCENE, collisions=2.0, **SMALL)

    def broken(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("jdsmc.running.session.faults.check_record", broken)
    with pytest.raises(KeyboardInterrupt):
        jdsmc.resume(result, collisions=20.0, progress=False)
    monkeypatch.undo()
    with pytest.raises(ValueError, match="within a chunk"):
        jdsmc.resume(result, collisions=20.0, progress=False)


def test_what_goes_on_in_one_process_is_kept_as_before(tmp_path):
    path = tmp_path / "run.h5"
    first = jdsmc.run(SCENE, collisions=2.0, checkpoint=path, **SMALL)
    later = jdsmc.resume(first, collisions=6.0, progress=False)
    kept = jdsmc.resume(path, progress=False)
    assert kept.series.equals(later.series)


def test_one_run_has_one_checkpoint(tmp_path):
    options = {"checkpoint": tmp_path / "x.h5", **SMALL}
    with pytest.raises(ValueError, match="keeps one run"):
        jdsmc.fit.calibrate(SCENE, UniformShear(jdsmc.ElasticHardSpheres(0.7), 4.0), **options)
    assert not list(tmp_path.iterdir())


def test_a_result_without_steady_values_is_one():
    result = jdsmc.run(SCENE, collisions=1.0, **SMALL)
    assert not result.is_steady
    assert result


def test_points_by_labelled_values():
    sweep = UniformShear(InelasticHardSpheres(np.array([0.6, 0.8])), 4.0)
    result = jdsmc.run(sweep, collisions=40.0, **SMALL)
    for value in result.steady["restitution"]:
        assert result.at(restitution=value).attrs["parameter_restitution"] == float(value)


def test_ctrl_c_ends_a_calibration(monkeypatch):
    """Where it is: the run under way ends, and its result is not taken for a whole one."""
    usual, chunks = Session.advance, iter(range(100))

    def advance(self):
        usual(self)
        if next(chunks) == 2:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Session, "advance", advance)
    model = UniformShear(jdsmc.ElasticHardSpheres(0.7), 4.0)
    with pytest.raises(Interrupted, match="interrupted after") as caught:
        jdsmc.fit.calibrate(SCENE, model, n_particles=256, progress=False)
    assert caught.value.result.interrupted
