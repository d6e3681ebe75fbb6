"""Tables, pictures and commands of the cooling and the heat-flux scenes."""

import inspect

import matplotlib.pyplot as plt
import numpy as np
import pytest

import jdsmc
from jdsmc import cli
from jdsmc._commands import Numerics

SMALL = ["--particles", "512", "--realizations", "8", "--rtol", "0.1", "--no-progress"]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Every test runs in an empty folder, and leaves no figure open."""
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    plt.close("all")


def _labels(result):
    figure = result.plot()
    return [text for panel in figure.axes for text in panel.get_legend_handles_labels()[1]]


def test_cooling(folder, capsys):
    """A run and a sweep; the tables show theory, the pictures Haff's law."""
    line = ["run", "cooling", "--restitution", "0.5", "--out", "c.h5", "--plot", "c.png"]
    assert cli.main([*line, *SMALL]) == 0
    out = capsys.readouterr().out
    assert "fourth cumulant a2" in out and "0.04984" in out and "C > 3" in out
    assert (folder / "c.png").read_bytes().startswith(b"\x89PNG")
    assert "Haff's law" in _labels(jdsmc.load("c.h5"))
    line = ["sweep", "cooling", "--restitution", "0.5,0.8", "--out", "s.h5"]
    assert cli.main([*line, *SMALL]) == 0
    out = capsys.readouterr().out
    assert "ihs: 2 points" in out and "a2 (theory)" in out
    sweep = jdsmc.load("s.h5")
    assert sweep["a2"].value.shape == (2,) and sweep.is_steady
    assert {"Haff's law", "a2", "a3", "α = 0.8"} <= set(_labels(sweep))


def test_heat_flux(folder, capsys):
    """A run at α = 1, where converged values are known, and a sweep of two parameters."""
    line = ["run", "heat-flux", "--restitution", "1", "--field", "0.1", "--out", "h.h5"]
    assert cli.main([*line, *SMALL, "--scheme", "paper", "--plot", "h.png"]) == 0
    out = capsys.readouterr().out
    for words in ("κ'/κ0", "1.025", "b'1, eq. (3.10)", "b'3, eq. (3.12)", "modified"):
        assert words in out
    assert "eq. (3.12)" in _labels(jdsmc.load("h.h5"))
    line = ["sweep", "heat-flux", "--restitution", "0.7:1:0.3", "--field", "0.1,0.2"]
    assert cli.main([*line, *SMALL, "--out", "s.h5"]) == 0
    out = capsys.readouterr().out
    assert "ihs: 4 points" in out and "first Sonine" in out
    sweep = jdsmc.load("s.h5")
    assert sweep["sonine"].value.shape == (2, 2, 3)
    labels = _labels(sweep)
    assert "ε* = 0.2" in labels and "converged: 1.025218" in labels


def test_not_steady(capsys):
    """The series are shown of what never became steady."""
    assert cli.main(["run", "cooling", *SMALL, "--collisions", "1", "--out", "x.h5"]) == 0
    assert "No steady values" in capsys.readouterr().out
    assert "Haff's law" in _labels(jdsmc.load("x.h5"))


def test_defaults_are_those_of_python():
    """A command without options makes the run that Python makes."""
    given = {"particles": "n_particles", "realizations": "n_realizations"}
    python = inspect.signature(jdsmc.run).parameters
    for name in Numerics.__dataclass_fields__:
        assert getattr(Numerics(), name) == python[given.get(name, name)].default


@pytest.mark.parametrize(
    "line, words",
    [
        ("run cooling --restitution 1.2", "restitution = 1.2 (0, 1]"),
        ("run cooling --restitution 0.5,0.6", "jdsmc sweep"),
        ("run cooling --field 0.1", "--field"),
        ("run cooling --observable shear_stress", "shear_stress relative_speed_cubed"),
        ("run heat-flux --field -1", "field = -1 [0, 2]"),
        ("run heat-flux --field 3", "field = 3 [0, 2]"),
        ("run heat-flux --field strong", "field = 'strong' number"),
        ("run heat-flux --field 0.1:0.2:0.1", "jdsmc sweep"),
        ("sweep heat-flux --field 0,0.1", "field = 0 duration"),
        ("run heat-flux --scheme euler", "--scheme exact paper"),
        ("run heat-flux --observable shear_stress", "shear_stress conductivity_ratio"),
        ("run", "run cooling run heat-flux"),
    ],
)
def test_bad_input(line, words, folder, capsys, monkeypatch):
    """One sentence, status 2, nothing written and nothing simulated."""
    monkeypatch.setattr("jdsmc.engine.Engine.advance", lambda self: pytest.fail("a chunk ran"))
    out = [*SMALL, "--out", "x.h5"] if " " in line else []
    try:
        status = cli.main([*line.split(), *out])
    except SystemExit as leaving:
        status = leaving.code
    assert status == 2
    error = capsys.readouterr().err
    for word in words.split():
        assert word in error
    assert not list(folder.iterdir()) and "Traceback" not in error


def test_runaway(capsys):
    """Status 1 and the reason; no steady value is shown."""
    line = ["run", "heat-flux", "--restitution", "0.5", "--field", "1.5"]
    assert cli.main([*line, *SMALL]) == 1
    out, err = capsys.readouterr()
    assert err.startswith("jdsmc: The heat-flux force runs away") and "field = 1.5" in err
    assert not out or "No steady values" in out


def test_theory_of_a_point():
    """The cells of a sweep's table are those of its own restitution."""
    from jdsmc.theory import transport  # noqa: PLC0415 - not hooked by the checks of the tests
    from jdsmc.views import heat_flux_force  # noqa: PLC0415

    first, modified = heat_flux_force._conductivities(np.array(0.5))
    assert first == transport.first_sonine(0.5).modified_conductivity
    assert modified == transport.modified_first_sonine(0.5).modified_conductivity
