"""A run that was ended at any point goes on from its file as if nothing had happened."""

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardDisks, InelasticHardSpheres, scenarios, transport
from jdsmc.files import seal
from jdsmc.running import checkpoint
from jdsmc.running.limits import Limits
from jdsmc.running.run import options_of, scenes_of
from jdsmc.running.session import Session

from ..helpers import differences

SMALL = {"n_particles": 256, "seed": 3, "progress": False}
SHEAR = scenarios.UniformShear(InelasticHardSpheres([0.6, 0.8]), 4.0)
RUNS = {
    "sweep, until precise, with derivatives": (
        SHEAR,
        {"rtol": 0.05, "sensitivity": ("restitution", "shear_rate")},
    ),
    "for a time": (scenarios.HomogeneousCooling(InelasticHardSpheres(0.9)), {"duration": 20.0}),
    "in space": (
        scenarios.FourierFlow(InelasticHardSpheres(1.0), length=2.0, cold_temperature=0.5),
        {"duration": 25.0, "n_particles": 640, "steps_per_record": 8},
    ),
    "on the host": (
        scenarios.MolecularDynamics(InelasticHardDisks(0.9), density=0.05),
        {"duration": 20.0, "n_particles": 160},
    ),
}


class Killed(BaseException):
    """As if the power had failed."""


@pytest.fixture
def killed(monkeypatch):
    """Makes runs end with `Killed` after a number of chunks."""

    def after(chunks: int):
        usual, made = Session.advance, []

        def advance(session):
            if len(made) == chunks:
                raise Killed
            made.append(None)
            usual(session)

        monkeypatch.setattr(Session, "advance", advance)
        return lambda: monkeypatch.setattr(Session, "advance", usual)

    return after


@pytest.mark.parametrize("kind", RUNS)
def test_after_a_crash_the_result_is_that_of_the_whole_run(kind, tmp_path, killed):
    """Killed after three chunks, the last of which had not been written."""
    scene, own = RUNS[kind]
    options = SMALL | own
    whole = jdsmc.run(scene, **options)
    path = tmp_path / "run.h5"
    alive = killed(3)
    with pytest.raises(Killed):
        jdsmc.run(scene, checkpoint=path, every=1e-9, **options)
    alive()
    assert whole.series.sizes["sample"] > 3  # else nothing was left to do
    assert not differences(whole, jdsmc.resume(path, progress=False))
    assert not differences(whole, jdsmc.resume(path, progress=False))  # finished: the same again


def test_a_finished_run_goes_on_as_if_asked_at_once(tmp_path):
    """From the file, and in this process."""
    path = tmp_path / "run.h5"
    first = jdsmc.run(SHEAR, rtol=0.05, checkpoint=path, **SMALL)
    whole = jdsmc.run(SHEAR, rtol=0.002, **SMALL)
    assert whole.series.sizes["sample"] > first.series.sizes["sample"]
    assert "series" in differences(first, whole)  # else the lines below could not fail
    copy = Path(shutil.copy(path, tmp_path / "copy.h5"))  # of what goes on here the file is written
    assert not differences(whole, jdsmc.resume(first, rtol=0.002, progress=False))
    assert not differences(whole, jdsmc.resume(copy, rtol=0.002, progress=False))
    assert not differences(whole, jdsmc.resume(path, progress=False))


def test_kicks_go_on(tmp_path, killed):
    """Those of `transport.navier_stokes`, killed after the second; then one more is asked for."""
    kicks = {"n_particles": 256, "duration": 1.0, "progress": False}
    gas, path = InelasticHardSpheres([0.7, 0.9]), tmp_path / "run.h5"
    whole = transport.navier_stokes(gas, n_kicks=3, **kicks)
    alive = killed(2)
    with pytest.raises(Killed):
        transport.navier_stokes(gas, n_kicks=3, checkpoint=path, every=1e-9, **kicks)
    alive()
    assert not differences(whole, transport.resume(path, progress=False))
    more = transport.resume(path, n_kicks=4, progress=False)
    assert more.attrs["n_records"] == 4
    assert not differences(transport.navier_stokes(gas, n_kicks=4, **kicks), more)
    other = tmp_path / "other.h5"
    jdsmc.run(SHEAR, collisions=4.0, checkpoint=other, **SMALL)
    with pytest.raises(ValueError, match="keeps no kicks"):
        transport.resume(other)


def test_what_failed_may_be_given_more(tmp_path):
    """A run that was not steady within its budget fails again, and goes on with a larger one."""
    path = tmp_path / "run.h5"
    scene = scenarios.UniformShear(InelasticHardSpheres(0.95), 4.0)
    small, large = {"rtol": 0.02, "budget": 70.0}, {"rtol": 0.02, "budget": 300.0}
    with pytest.raises(jdsmc.NotSteadyError):
        jdsmc.run(scene, checkpoint=path, **small, **SMALL)
    with pytest.raises(jdsmc.NotSteadyError):
        jdsmc.resume(path, progress=False)
    whole = jdsmc.run(scene, **large, **SMALL)
    assert not differences(whole, jdsmc.resume(path, budget=300.0, progress=False))


def test_an_older_file_is_kept_and_a_damaged_one_refused(tmp_path):
    path = tmp_path / "run.h5"
    jdsmc.run(SHEAR, collisions=8.0, checkpoint=path, every=1e-9, **SMALL)
    older = checkpoint.previous(path)
    assert seal.is_whole(older)
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)
    with pytest.raises(ValueError, match=f"was changed.*{older.name}"):
        jdsmc.resume(path, progress=False)
    path.write_bytes(data[:-7])
    with pytest.raises(ValueError, match="cut"):
        jdsmc.resume(path, progress=False)
    path.unlink()
    with pytest.raises(FileNotFoundError, match=older.name):
        jdsmc.resume(path, progress=False)
    whole = jdsmc.run(SHEAR, collisions=8.0, **SMALL)
    assert not differences(whole, jdsmc.resume(older, progress=False))


def jdsmc_result(path):
    """A file that jdsmc wrote, but no checkpoint."""
    result = jdsmc.run(SHEAR, collisions=4.0, **SMALL)
    seal.write(path, result.save, overwrite=False)
    return path


def test_bad_input_is_refused_before_the_run(tmp_path, monkeypatch):
    (tmp_path / "there.h5").write_bytes(b"")
    for options, words in (
        ({"checkpoint": tmp_path / "there.h5"}, "jdsmc.resume"),
        ({"checkpoint": tmp_path / "no" / "run.h5"}, "folder"),
        ({"checkpoint": tmp_path / "run.h5", "every": 0.0}, "every = 0"),
    ):
        with monkeypatch.context() as patch, pytest.raises((ValueError, OSError), match=words):
            patch.setattr(Session, "advance", lambda self: pytest.fail("it ran"))
            jdsmc.run(SHEAR, rtol=0.1, **options, **SMALL)
    for path in (tmp_path / "there.h5", jdsmc_result(tmp_path / "result.h5")):
        with pytest.raises(ValueError, match="no checkpoint"):
            jdsmc.resume(path)


def test_one_run_at_a_time_writes_a_file(tmp_path):
    path = tmp_path / "run.h5"
    one, other = (checkpoint.Keeper(path, 1.0, SHEAR, {}, new=True) for _ in range(2))
    with one, pytest.raises(BlockingIOError, match="another process writes"), other:
        pytest.fail("both have it")
    with other:
        pass
    assert not list(tmp_path.iterdir())


def test_another_version_says_so(tmp_path, monkeypatch):
    path = tmp_path / "run.h5"
    jdsmc.run(SHEAR, collisions=4.0, checkpoint=path, **SMALL)
    here = checkpoint.made_by()
    monkeypatch.setattr(checkpoint, "made_by", lambda: here | {"jax": "0.1"})
    with pytest.warns(UserWarning, match="jax .*not to the bit"):
        jdsmc.resume(path, progress=False)


def test_writing_takes_a_small_share(tmp_path, monkeypatch):
    """If it takes a second, the next one waits for a hundred, however often it was asked for."""
    clock = [0.0]
    monkeypatch.setattr(checkpoint.time, "monotonic", lambda: clock[0])

    def write(path, fill, **options):
        written.append(clock[0])
        clock[0] += 1.0

    written: list[float] = []
    monkeypatch.setattr(seal, "write", write)
    monkeypatch.setattr(checkpoint, "made_by", dict)
    keeper = checkpoint.Keeper(tmp_path / "run.h5", 5.0, SHEAR, {}, new=True)
    points = scenes_of(SHEAR)
    options = options_of(points, 256, 0.1, "strang", "float32", 8)
    session = Session(points, 8, 3, options, Limits(points, options))
    for _ in range(500):
        clock[0] += 1.0
        if keeper.is_due():
            keeper.keep(session, "")
    assert written[0] == 5.0
    assert np.min(np.diff(written)) >= 100.0


def test_the_file_is_plain_hdf5(tmp_path):
    """With checksums on every array, and nothing pickled."""
    path = tmp_path / "run.h5"
    jdsmc.run(SHEAR, collisions=4.0, checkpoint=path, **SMALL)
    with h5py.File(path) as file:
        parts = [file["run"], *file["state"].values()]
        assert len(parts) > 4
        assert all(one.fletcher32 and one.dtype.kind in "fiub" for one in parts)


def test_a_disk_that_is_full_ends_no_run(tmp_path, monkeypatch):
    """The run warns and goes on."""

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(seal, "write", full)
    with pytest.warns(UserWarning, match="No space left.*goes on"):
        result = jdsmc.run(SHEAR, collisions=4.0, checkpoint=tmp_path / "run.h5", **SMALL)
    assert "the asked time was simulated" in result.attrs["stopped"]


def test_no_file_of_others_is_replaced(tmp_path):
    """That of the name where the checkpoint before the last one will be, too."""
    first = jdsmc.run(SHEAR, collisions=4.0, **SMALL)
    kept = first.save(tmp_path / "run.previous.h5")
    with pytest.raises(FileExistsError, match=r"run.previous.h5 exists, .*another name"):
        jdsmc.run(SHEAR, collisions=4.0, checkpoint=tmp_path / "run.h5", **SMALL)
    assert not differences(first, jdsmc.load(kept))


def test_a_budget_alone_leaves_the_time_as_it_was(tmp_path, killed):
    """ "What is not given is as it was"."""
    path = tmp_path / "run.h5"
    whole = jdsmc.run(SHEAR, collisions=12.0, **SMALL)
    alive = killed(1)
    with pytest.raises(Killed):
        jdsmc.run(SHEAR, collisions=12.0, checkpoint=path, every=1e-9, **SMALL)
    alive()
    found = jdsmc.resume(path, budget=4000.0, progress=False)
    assert found.attrs["stopped"] == whole.attrs["stopped"]
    assert found.series.equals(whole.series)
