"""The command line, called in this process."""

import signal

import jax
import numpy as np
import pytest
import xarray as xr

import jdsmc
from jdsmc import cli
from jdsmc.engine import Engine
from jdsmc.scenarios import UniformShear

SMALL = [
    *("--particles", "512", "--realizations", "8", "--rtol", "0.1", "--no-progress"),
    *("--time-step", "0.1", "--steps-per-record", "8"),
]
"""The program that the other tests compile, too: four gases a part on two cores."""

SMALL_SWEEP = [*SMALL, "--realizations", "4"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Every test runs in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def status(*words):
    """Exit status of a command, whether it is returned or raised."""
    try:
        return cli.main(list(words))
    except SystemExit as leaving:
        return leaving.code


@pytest.fixture
def nothing_runs(monkeypatch):
    """A chunk that is computed fails the test."""
    monkeypatch.setattr(Engine, "advance", lambda self: pytest.fail("a chunk was computed"))


# Commands


def test_run(folder, capsys):
    """The line of the manual; the same numbers as from Python."""
    line = "run shear --restitution 0.7 --shear-rate 4 --gas ihs --seed 3 --out shear.h5"
    assert status(*line.split(), *SMALL) == 0
    out, err = capsys.readouterr()
    assert "Results: shear.h5" in out and "shear stress" in out and not err
    scene = UniformShear(jdsmc.InelasticHardSpheres(0.7), 4.0)
    steps = {"time_step": 0.1, "steps_per_record": 8}
    options = {"n_particles": 512, "n_realizations": 8, "rtol": 0.1, "seed": 3} | steps
    same = jdsmc.run(scene, **options, progress=False)
    with xr.open_dataset("shear.h5", engine="h5netcdf") as data:
        for name in UniformShear.steady_observables:
            np.testing.assert_array_equal(data[name], same[name].value)
            np.testing.assert_array_equal(data[f"{name}_error"], same[name].error)
        assert data.attrs["seed"] == 3 and data.attrs["parameter_restitution"] == 0.7
        assert {"commit", "jdsmc_version", "jax_version", "stopped"} <= data.attrs.keys()
    assert sorted(p.name for p in folder.iterdir()) == ["shear.h5"]


def test_sweep_show_and_plot(folder, capsys):
    """Dimensions gas and restitution; the table and the picture are made from the file."""
    line = "sweep shear --restitution 0.6:0.7:0.1 --gas ihs,ehs --out sweep.h5 --plot sweep.pdf"
    assert status(*line.split(), *SMALL_SWEEP) == 0
    table = capsys.readouterr().out
    with xr.open_dataset("sweep.h5", engine="h5netcdf") as data:
        assert data["shear_stress"].dims == data["a2_error"].dims == ("gas", "restitution")
        assert list(data["gas"].values) == ["ihs", "ehs"]
        np.testing.assert_array_equal(data["restitution"], [0.6, 0.7])
        assert np.all(data["shear_stress"] > 0) and np.all(data["shear_stress_error"] > 0)
        attrs = data.attrs
    np.testing.assert_array_equal(attrs["parameter_restitution"], [0.6, 0.7])
    assert attrs["parameter_shear_rate"] == 4.0 and attrs["option_rate_factor"] == "linear"
    assert attrs["gas_model_ihs"] == "InelasticHardSpheres"
    assert attrs["gas_model_ehs"] == "ElasticHardSpheres"
    assert {"stopped", "stopped_ihs", "stopped_ehs", "seed", "commit"} <= attrs.keys()
    with xr.open_dataset("sweep.h5", engine="h5netcdf", group="series") as series:
        assert series["temperature"].dims == ("gas", "restitution", "sample")

    assert status("show", "sweep.h5") == 0
    shown = capsys.readouterr().out
    assert shown.strip() in table
    assert shown.count("ihs") >= 2 and shown.count("ehs") >= 2
    assert status("plot", "sweep.h5") == 0
    assert (folder / "sweep.pdf").read_bytes().startswith(b"%PDF")
    assert (folder / "sweep.png").read_bytes().startswith(b"\x89PNG")


def test_sweep_of_two_gases_at_one_point(folder):
    """No restitution to plot against: the curves are drawn against time."""
    gases = ["--gas", "ihs,ehs", "--collisions", "2"]
    numbers = ["--shear-rate", "1:1:1", "--restitution", "0.7", "--out", "two.h5"]
    assert status("sweep", "shear", *gases, *numbers, *SMALL) == 0
    with xr.open_dataset("two.h5", engine="h5netcdf", group="series") as series:
        assert series["temperature"].dims == ("gas", "shear_rate", "sample")
    assert status("plot", "two.h5", "--out", "picture.svg") == 0
    assert (folder / "picture.svg").read_bytes().startswith(b"<?xml")


@pytest.mark.parametrize("words", [["--help"], ["run", "--help"], ["run", "shear", "--help"]])
def test_help(words, capsys):
    assert status(*words) == 0
    text = capsys.readouterr().out
    assert "shear" in text


def test_float64(monkeypatch):
    """The command switches JAX to 64 bits, which a user of the shell cannot."""
    before = jax.config.read("jax_enable_x64")
    seen = []
    monkeypatch.setattr(cli, "run", lambda *_, **options: seen.append(options) or 1 / 0)
    try:
        with pytest.raises(ZeroDivisionError):
            status("run", "shear", *SMALL, "--dtype", "float64")
        assert jax.config.read("jax_enable_x64")
    finally:
        jax.config.update("jax_enable_x64", before)
    assert seen[0]["dtype"] == "float64"


def test_every_option_reaches_the_run(monkeypatch):
    """No flag is forgotten on its way to `jdsmc.run`."""
    seen = []
    monkeypatch.setattr(cli, "run", lambda scene, **options: seen.append((scene, options)) or 1 / 0)
    flags = {
        "particles": ("n_particles", 640),
        "realizations": ("n_realizations", 5),
        "seed": ("seed", 9),
        "duration": ("duration", 7.5),
        "collisions": ("collisions", 8.5),
        "observable": ("observable", "a2"),
        "rtol": ("rtol", 0.5),
        "budget": ("budget", 77.0),
        "time-step": ("time_step", 0.2),
        "splitting": ("splitting", "lie"),
        "dtype": ("dtype", "float32"),
        "steps-per-record": ("steps_per_record", 16),
    }
    words = [word for name, (_, value) in flags.items() for word in (f"--{name}", str(value))]
    gas = ["--gas", "ehs-measured", "--rate-factor", "0.8", "--restitution", "0.6"]
    with pytest.raises(ZeroDivisionError):
        status("run", "shear", *words, *gas, "--shear-rate", "2.5", "--no-progress")
    ((scene, options),) = seen
    assert options == dict(flags.values()) | {"progress": False}
    assert (scene.gas.restitution, scene.gas.rate_factor, scene.shear_rate) == (0.6, 0.8, 2.5)
    assert scene.gas.measured_drag


# Ranges and lists


@pytest.mark.parametrize(
    "text, values",
    [
        ("0.9", 0.9),
        ("1e-1", 0.1),
        ("0.5,0.7", [0.5, 0.7]),
        ("0.5:0.95:0.05", [0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95]),
        ("0.5:0.97:0.1", [0.5, 0.6, 0.7, 0.8, 0.9]),  # never past the last
        ("0:0.3:0.1", [0.0, 0.1, 0.2, 0.3]),  # reached in spite of rounding
        ("0.9:0.8:-0.05", [0.9, 0.85, 0.8]),
        ("0.7:0.7:0.1", [0.7]),
        ("0.1,0.5:0.6:0.1,0.9", [0.1, 0.5, 0.6, 0.9]),
    ],
)
def test_numbers(text, values):
    """Exactly the numbers that a person would write: the table and the file show them."""
    numbers = cli.numbers("x", text)
    assert np.shape(numbers) == np.shape(values)
    np.testing.assert_array_equal(numbers, values)


@pytest.mark.parametrize(
    "text",
    [
        *("", ",", "0.5,", "half", "0.5;0.6", "1:2", "1:2:3:4", "1:2:0", "1:2:-1", "2:1:1"),
        *("0:inf:1", "0:1:nan", "nan:1:1", "0:1:1e-9"),
    ],
)
def test_what_is_no_range(text):
    with pytest.raises(ValueError, match=r"x = .* is not a number, a range first:last:step"):
        cli.numbers("x", text)


# Bad input


@pytest.mark.parametrize(
    "flags, words",
    [
        ("--restitution 1.2", "restitution = 1.2 (0, 1]"),
        ("--restitution 0", "restitution = 0 (0, 1]"),
        ("--restitution -0.5", "restitution = -0.5 (0, 1]"),
        ("--restitution nan", "restitution = nan (0, 1]"),
        ("--restitution high", "restitution = 'high' number"),
        ("--shear-rate -4", "shear_rate = -4 [0, inf)"),
        ("--shear-rate inf", "shear_rate = inf [0, inf)"),
        ("--particles 0", "n_particles = 0 inf)"),
        ("--particles 10", "n_particles = 10 [64, inf)"),
        ("--particles 1.5", "--particles"),
        ("--realizations 3", "n_realizations = 3 [4, inf)"),
        ("--seed -1", "seed = -1 [0,"),
        ("--seed 18446744073709551616", "seed = 18446744073709551616 [0,"),
        ("--duration 0", "duration = 0 (0, inf)"),
        ("--duration nan", "duration = nan (0, inf)"),
        ("--collisions -3", "collisions = -3 (0, inf)"),
        ("--duration 1 --collisions 1", "duration or collisions, not both"),
        ("--rtol 0", "rtol = 0 (0, 1]"),
        ("--budget 0", "budget = 0 (0, inf)"),
        ("--time-step 3", "time_step = 3 (0, 1]"),
        ("--steps-per-record 0", "steps_per_record = 0 [1, inf)"),
        ("--observable viscosity", "observable = 'viscosity' shear_stress"),
        ("--gas water", "gas = 'water' ihs, ehs, ehs-measured"),
        ("--gas ihs,water", "gas = 'water' ihs, ehs, ehs-measured"),
        ("--gas ehs --rate-factor 3", "rate_factor = 3 (0, 2]"),
        ("--gas ehs --rate-factor cubic", "rate_factor = 'cubic' number"),
        ("--rate-factor cubic", "rate_factor = 'cubic' number"),
        ("--splitting verlet", "--splitting strang lie"),
        ("--dtype float16", "--dtype float32 float64"),
        ("--restitution 1", "steady state shear_rate > 0 restitution < 1 duration or collisions"),
        ("--shear-rate 0", "steady state shear_rate > 0 restitution < 1 duration or collisions"),
        ("--out missing/x.h5", "folder missing does not exist"),
        ("--plot missing/x.png", "folder missing does not exist"),
        ("--plot x.xyz", "picture .png, .pdf, .svg x.xyz"),
        ("--mood good", "--mood"),
    ],
)
@pytest.mark.parametrize("command", ["run", "sweep"])
def test_bad_input(command, flags, words, folder, capsys, nothing_runs):
    """One sentence with the name and the range, status 2, and nothing written."""
    out = [] if "--out" in flags else ["--out", "x.h5"]
    assert status(command, "shear", *SMALL, *out, *flags.split()) == 2
    error = capsys.readouterr().err
    for word in words.split():
        assert word in error
    assert not list(folder.iterdir())
    assert "Traceback" not in error
    if error.startswith("jdsmc: "):  # else the box of the parser
        assert error.count("\n") == 1


@pytest.mark.parametrize(
    "flags",
    ["--restitution 0.5,0.6", "--shear-rate 1:2:1", "--gas ihs,ehs", "--rate-factor 0.8,0.9"],
)
def test_run_is_for_one_gas(flags, folder, capsys, nothing_runs):
    assert status("run", "shear", "--gas", "ehs", *SMALL, "--out", "x.h5", *flags.split()) == 2
    assert "jdsmc sweep" in capsys.readouterr().err
    assert not list(folder.iterdir())


@pytest.mark.parametrize(
    "words", [[], ["run"], ["sweep", "--seed", "1"], ["fly"], ["show"], ["plot"]]
)
def test_incomplete_commands(words, capsys):
    assert status(*words) == 2
    assert capsys.readouterr().err


@pytest.mark.parametrize(
    "scene, flags, words",
    [
        ("cooling", "--restitution 1.2", "restitution = 1.2 (0, 1]"),
        ("heat-flux", "--restitution nan", "restitution = nan (0, 1]"),
        ("heat-flux", "--field -1", "field = -1 [0, 2]"),
        ("heat-flux", "--field 3", "field = 3 [0, 2]"),
        ("heat-flux", "--field 0", "field = 0 field > 0 duration collisions"),
        ("heat-flux", "--scheme best", "--scheme exact paper"),
        ("cooling", "--shear-rate 4", "--shear-rate"),
    ],
)
def test_bad_input_of_other_scenes(scene, flags, words, folder, capsys, nothing_runs):
    assert status("run", scene, *SMALL, "--out", "x.h5", *flags.split()) == 2
    error = capsys.readouterr().err
    for word in words.split():
        assert word in error
    assert not list(folder.iterdir())


def test_existing_file(folder, capsys, nothing_runs):
    (folder / "x.h5").write_text("precious")
    assert status("run", "shear", *SMALL, "--out", "x.h5") == 2
    assert "x.h5 exists" in capsys.readouterr().err
    assert (folder / "x.h5").read_text() == "precious"


def test_unwritable_file(folder, capsys, monkeypatch, nothing_runs):
    """As for a user who may not write there (root, who may, runs the tests in containers)."""

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("pathlib.Path.open", refuse)
    assert status("run", "shear", *SMALL, "--out", "x.h5") == 2
    assert "cannot write x.h5: Permission denied" in capsys.readouterr().err
    assert not list(folder.iterdir())


@pytest.mark.parametrize("command", ["show", "plot"])
def test_files_that_cannot_be_read(command, folder, capsys):
    (folder / "text.h5").write_text("not HDF5")
    assert status(command, "missing.h5") == 2
    assert "there is no file missing.h5" in capsys.readouterr().err
    assert status(command, "text.h5") == 2
    assert "text.h5 is not an HDF5 file written by jdsmc" in capsys.readouterr().err
    assert [p.name for p in folder.iterdir()] == ["text.h5"]


# What is kept when a run ends early


def test_not_steady(capsys):
    """Status 1 and the reason; what was measured is in the file."""
    assert status("run", "shear", *SMALL, "--budget", "5", "--out", "x.h5") == 1
    out, err = capsys.readouterr()
    assert err.startswith("jdsmc: no steady state within 5 collisions")
    assert "No steady values" in out
    result = jdsmc.load("x.h5")
    assert not result.is_steady
    assert result.series.sizes["sample"] >= 8


def test_ctrl_c(monkeypatch, capsys):
    """The gas under way is kept up to there, and the gases after it are not begun."""
    advance = Engine.advance

    def interrupted(self):
        if self.chunks == 2:
            signal.raise_signal(signal.SIGINT)
        return advance(self)

    monkeypatch.setattr(Engine, "advance", interrupted)
    line = "sweep shear --gas ihs,ehs --restitution 0.6,0.7 --collisions 1e6 --out x.h5"
    assert status(*line.split(), *SMALL_SWEEP) == 0
    assert "ehs:" not in capsys.readouterr().out
    result = jdsmc.load("x.h5")
    assert list(result.to_xarray()["gas"].values) == ["ihs"]
    assert result.attrs["stopped"].startswith("interrupted")
    # three chunks of eight records, as far as the clocks of all realizations have come
    assert 2 * 8 < result.series.sizes["sample"] <= 3 * 8


def test_fault_in_the_second_gas(monkeypatch, capsys):
    """The first gas is kept, and so is what the second one measured."""
    run = cli.run

    def faulty(scene, **options):
        result = run(UniformShear(jdsmc.InelasticHardSpheres([0.6, 0.7]), 4.0), **options)
        if scene.gas.frictional:
            error = jdsmc.FaultError("too wild")
            error.result = result
            raise error
        return result

    monkeypatch.setattr(cli, "run", faulty)
    line = "sweep shear --gas ihs,ehs --restitution 0.6,0.7 --collisions 2 --out x.h5"
    assert status(*line.split(), *SMALL_SWEEP) == 1
    assert "jdsmc: too wild" in capsys.readouterr().err
    assert list(jdsmc.load("x.h5").to_xarray()["gas"].values) == ["ihs", "ehs"]


def test_ctrl_c_outside_a_run(monkeypatch, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(cli, "run", interrupted)
    assert status("run", "shear", *SMALL) == 130
    assert "interrupted" in capsys.readouterr().err
