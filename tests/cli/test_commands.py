"""Whole commands: the lines of the README, small."""

import signal

import numpy as np
import pytest
import xarray as xr

import jdsmc
from jdsmc.running.session import Session
from jdsmc.scenarios import UniformShear

SMALL = "--particles 256 --time-step 0.2 --rtol 0.1 --no-progress"


def test_run(folder, status, capsys):
    """The same numbers as from Python."""
    line = "run shear --restitution 0.7 --shear-rate 4 --gas ihs --seed 3 --out shear.h5"
    assert status(f"{line} {SMALL}") == 0
    out, err = capsys.readouterr()
    assert "Results: shear.h5" in out and not err
    scene = UniformShear(jdsmc.InelasticHardSpheres(0.7), 4.0)
    options = {"n_particles": 256, "time_step": 0.2, "rtol": 0.1, "seed": 3, "progress": False}
    same = jdsmc.run(scene, **options)
    with xr.open_dataset("shear.h5", engine="h5netcdf") as data:
        for name in same:
            np.testing.assert_array_equal(data[name], same[name].value)
            np.testing.assert_array_equal(data[f"{name}_error"], same[name].error)
        assert data.attrs["seed"] == 3 and data.attrs["parameter_restitution"] == 0.7
        assert {"commit", "jdsmc_version", "jax_version", "stopped"} <= data.attrs.keys()
    assert sorted(p.name for p in folder.iterdir()) == ["shear.h5"]
    assert str(jdsmc.load("shear.h5").scene()) == str(scene)


def test_sweep_show_and_plot(folder, status, capsys):
    """Dimensions gas and restitution; the table and the picture are made from the file."""
    line = "sweep shear --restitution 0.6:0.7:0.1 --gas ihs,ehs --out sweep.h5 --plot sweep.pdf"
    assert status(f"{line} {SMALL}") == 0
    table = capsys.readouterr().out
    with xr.open_dataset("sweep.h5", engine="h5netcdf") as data:
        assert data["shear_stress"].dims == data["a2_error"].dims == ("gas", "restitution")
        assert list(data["gas"].values) == ["ihs", "ehs"]
        np.testing.assert_array_equal(data["restitution"], [0.6, 0.7])
        assert data["restitution"].attrs["long_name"] == "coefficient of normal restitution α"
        assert data["restitution"].attrs["units"] == "1"
        assert np.all(data["shear_stress"] > 0) and np.all(data["shear_stress_error"] > 0)
        attrs = data.attrs
    np.testing.assert_array_equal(attrs["parameter_restitution"], [0.6, 0.7])
    assert attrs["parameter_shear_rate"] == 4.0
    assert attrs["gas_model_ihs"] == "InelasticHardSpheres"
    assert attrs["gas_model_ehs"] == "ElasticHardSpheres"
    assert {"stopped", "stopped_ihs", "stopped_ehs", "seed", "commit"} <= attrs.keys()
    with xr.open_dataset("sweep.h5", engine="h5netcdf", group="series") as series:
        assert series["temperature"].dims == ("gas", "restitution", "sample")

    assert status("show sweep.h5") == 0
    shown = capsys.readouterr().out
    assert shown.strip() in table
    assert status("show sweep.h5 --csv") == 0
    head, *rows = capsys.readouterr().out.splitlines()
    assert head.startswith("gas,restitution,shear_stress,shear_stress_error,") and len(rows) == 4
    assert rows[0].startswith("ihs,0.6,")
    assert status("show sweep.h5 --along nowhere") == 2
    assert "nothing lies along 'nowhere'" in capsys.readouterr().err
    assert status("plot sweep.h5") == 0
    assert (folder / "sweep.pdf").read_bytes().startswith(b"%PDF")
    assert (folder / "sweep.png").read_bytes().startswith(b"\x89PNG")


@pytest.fixture
def interrupted(monkeypatch):
    """Ctrl-C in the third chunk of every run."""
    advance, chunks = Session.advance, []

    def advance_and_interrupt(self):
        chunks.append(self)
        if chunks.count(self) == 3:
            signal.raise_signal(signal.SIGINT)
        return advance(self)

    monkeypatch.setattr(Session, "advance", advance_and_interrupt)


def test_ctrl_c(interrupted, status, capsys):
    """The gas under way is kept up to there, and the gases after it are not begun.

    A shell learns of it, so that what follows does not take the run for whole.
    """
    line = "sweep shear --gas ihs,ehs --restitution 0.6,0.7 --collisions 1e6 --out x.h5"
    assert status(f"{line} {SMALL}") == 130
    assert "ehs:" not in capsys.readouterr().out
    result = jdsmc.load("x.h5")
    assert list(result.steady["gas"].values) == ["ihs"]
    assert result.interrupted
    assert result.series.sizes["sample"] > 0


def test_a_seed_too_large(refused):
    """Known only to the generator of random numbers."""
    error = refused(f"run shear --seed 18446744073709551616 {SMALL}")
    assert "seed = 18446744073709551616" in error
