"""Bad input: one sentence with the name and what is allowed, status 2, and nothing written."""

import pytest

SMALL = "--particles 512 --no-progress --time-step 0.2"

pytestmark = pytest.mark.usefixtures("nothing_runs")


@pytest.mark.parametrize(
    "flags, words",
    [
        ("--restitution 1.2", "restitution = 1.2 (0, 1]"),
        ("--restitution 0", "restitution = 0 (0, 1]"),
        ("--restitution -0.5", "restitution = -0.5 (0, 1]"),
        ("--restitution nan", "restitution = nan (0, 1]"),
        ("--restitution high", "restitution = 'high' number"),
        ("--restitution 0.9:0.5:0.1", "0.9:0.5:-0.1 0.5:0.9:0.1"),
        ("--shear-rate -4", "shear_rate = -4 [0, inf)"),
        ("--shear-rate inf", "shear_rate = inf [0, inf)"),
        ("--particles 0", "n_particles = 0 inf)"),
        ("--particles 10", "n_particles = 10 [64, inf)"),
        ("--particles 1000.5", "particles = 1000.5 whole number"),
        ("--realizations 3", "n_realizations = 3 [8, inf)"),
        ("--seed -1", "seed = -1 [0,"),
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
        ("--gas ihs,ihs", "gas = 'ihs,ihs' twice"),
        ("--gas disks", "UniformShear 3 velocity components InelasticHardDisks"),
        ("--gas ehs --rate-factor 3", "rate_factor = 3 (0, 2]"),
        ("--gas ehs --rate-factor cubic", "rate_factor = 'cubic' linear, viscosity"),
        ("--rate-factor 0.8", "--rate-factor nothing gas ihs --gas ehs"),
        ("--gas hard-spheres --restitution 0.8", "--restitution gas hard-spheres --gas ihs"),
        ("--splitting verlet", "splitting = 'verlet' strang lie"),
        ("--dtype float16", "dtype = 'float16' float32 float64"),
        ("--restitution 1", "steady state shear_rate > 0 duration, collisions"),
        ("--shear-rate 0", "steady state shear_rate > 0 duration, collisions"),
        ("--out missing/x.h5", "folder missing does not exist"),
        ("--plot missing/x.png", "folder missing does not exist"),
        ("--plot x.xyz", "picture .png, .pdf, .svg x.xyz"),
        ("--out x.png --plot ./x.png", "--out --plot same file"),
        ("--alpha 0.7", "no option --alpha did you mean --restitution"),
        ("--alpha=0.7", "no option --alpha did you mean --restitution"),
        ("--shear 3", "no option --shear did you mean --shear-rate"),
        ("--mood good", "no option --mood jdsmc run shear --help"),
        ("--field 0.1", "no option --field heat-flux"),
        ("--particles", "--particles"),
        ("0.7", "'0.7'"),
    ],
)
def test_bad_input(flags, words, refused):
    out = "" if "--out" in flags else "--out x.h5"
    error = refused(f"run shear {SMALL} {out} {flags}")
    for word in words.split():
        assert word in error
    assert refused(f"sweep shear {SMALL} {out} {flags}")


@pytest.mark.parametrize(
    "flags",
    ["--restitution 0.5,0.6", "--shear-rate 1:2:1", "--gas ihs,ehs", "--rate-factor 0.8,0.9"],
)
def test_run_is_for_one_gas(flags, refused):
    assert "jdsmc sweep" in refused(f"run shear --gas ehs {SMALL} --out x.h5 {flags}")


def test_gases_side_by_side_have_the_same_sweep(refused):
    error = refused("sweep shear --gas ihs,ehs --rate-factor 0.8,0.9")
    assert "ihs: nothing; ehs: rate_factor" in error


@pytest.mark.parametrize(
    "line, words",
    [
        ("run cooling --restitution 1.2", "restitution = 1.2 (0, 1]"),
        ("run cooling --shear-rate 4", "--shear-rate is of shear, sheared-slab"),
        ("run cooling --splitting lie", "splitting = 'lie'"),
        ("run heat-flux --restitution nan", "restitution = nan (0, 1]"),
        ("run heat-flux --field -1", "field = -1 [0, 2]"),
        ("run heat-flux --field 3", "field = 3 [0, 2]"),
        ("run heat-flux --field 0", "field = 0 field > 0 duration collisions"),
        ("run heat-flux --scheme best", "scheme = 'best' exact paper"),
        ("run fourier --cold-temperature 2", "cold_temperature = 2 (0, 1]"),
        ("run fourier --wall soft", "wall = 'soft' maxwell bgk"),
        ("run fourier --layers 0", "layers [1, inf)"),
        ("run fourier --gas ihs", "elastic gas restitution = 1"),
        ("run fourier --gravity -2", "gravity = -2 [-1, 1]"),
        ("run sheared-slab --gas ehs-measured", "measured local"),
        ("run navier-stokes --kick 2", "kick = 2 (0, 1]"),
        ("sweep --seed 1", "needs a scene shear"),
        ("run shaer", "no scene 'shaer' did you mean shear"),
        ("fly", "no command 'fly' run, sweep, show, plot"),
        ("show", "FILE"),
        ("plot", "FILE"),
        ("show missing.h5", "there is no file missing.h5"),
        ("plot missing.h5", "there is no file missing.h5"),
    ],
)
def test_bad_input_of_other_commands(line, words, refused):
    error = refused(line)
    for word in words.split():
        assert word in error


def test_existing_file(folder, refused):
    (folder / "x.h5").write_text("precious")
    assert "x.h5 exists" in refused("run shear --out x.h5")
    assert (folder / "x.h5").read_text() == "precious"


def test_unwritable_file(monkeypatch, refused):
    """As for a user who may not write there (root, who may, runs the tests in containers)."""

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("pathlib.Path.open", refuse)
    assert "cannot write x.h5: Permission denied" in refused("run shear --out x.h5")


@pytest.mark.parametrize("command", ["show", "plot"])
def test_files_that_cannot_be_read(command, folder, refused):
    (folder / "text.h5").write_text("not HDF5")
    assert "text.h5 is not a result file that can be read" in refused(f"{command} text.h5")
