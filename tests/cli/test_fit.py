"""`jdsmc fit beta`."""

import re

import numpy as np
import pytest
import xarray as xr


@pytest.fixture
def fitted(monkeypatch):
    """Instead of calibrating, keeps what would be asked."""
    seen = []
    monkeypatch.setattr("jdsmc.cli.fit.calibrate", lambda *a, **k: seen.append((a, k)))
    monkeypatch.setattr("jdsmc.cli.fit.keep", lambda *_, **__: 0)
    return seen


def test_everything_is_handed_on(status, fitted):
    line = "fit beta --restitution 0.5:0.7:0.1 --target a2,shear_stress+a3 --drag measured"
    more = "--free rate_factor,drag_factor --rtol 0.01 --seed 4 --shear-rate 2 --no-progress"
    assert status(f"{line} {more}") == 0
    ((reference, model, target), options) = fitted[0]
    np.testing.assert_allclose(reference.gas.restitution, [0.5, 0.6, 0.7])
    np.testing.assert_allclose(model.gas.restitution, [0.5, 0.6, 0.7])
    assert model.gas.drag == "measured" and reference.shear_rate == model.shear_rate == 2.0
    assert target == "a2,shear_stress+a3" and options["free"] == ("rate_factor", "drag_factor")
    assert (options["rtol"], options["seed"], options["progress"]) == (0.01, 4, False)
    assert options["n_particles"] == 4096


def test_what_is_taken_if_nothing_is_said(status, fitted):
    assert status("fit beta") == 0
    ((reference, model, target), options) = fitted[0]
    assert len(reference.gas.restitution) == 10 and model.gas.drag == "local"
    assert target == "shear_stress,reduced_shear_rate" and options["free"] == ("rate_factor",)
    assert options["rtol"] == 0.001


@pytest.mark.parametrize(
    "line, words",
    [
        ("fit", "needs what to fit: beta"),
        ("fit bet", "did you mean beta"),
        ("fit beta --restitution 1.5", r"restitution = 1.5 is outside the allowed range \(0, 1\]"),
        ("fit beta --target shear_stres", "did you mean shear_stress"),
        ("fit beta --targt a2", "did you mean --target"),
        ("fit beta --drag strong", "choose one of local, measured"),
        ("fit beta --plot beta.txt", "the name of a picture"),
        ("fit beta --free beta", "is no number of the model"),
    ],
)
def test_refused(line, words, refused, nothing_runs):
    assert re.search(words, refused(line))


def test_a_small_fit(folder, status, capsys):
    """The file and the table."""
    line = "fit beta --restitution 0.8 --target shear_stress --particles 256 --rtol 0.1"
    assert status(f"{line} --time-step 0.2 --no-progress --out beta.h5") == 0
    assert "misfit" in capsys.readouterr().out
    with xr.open_dataset("beta.h5", engine="h5netcdf") as data:
        assert data["rate_factor"].dims == ("restitution", "target")
        assert np.all(data["rate_factor_error"] > 0)
        assert list(data["target"].values) == ["shear_stress"]
    assert status("show beta.h5") == 0 and status("plot beta.h5") == 0


def test_help(status, capsys):
    assert status("fit beta --help") == 0
    assert "--target" in capsys.readouterr().out
    assert status("") == 0
    assert "jdsmc fit beta" in capsys.readouterr().out
