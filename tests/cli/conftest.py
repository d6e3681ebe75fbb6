"""The command line, called in this process, in an empty folder."""

import pytest

import jdsmc
from jdsmc.cli import main


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Every test runs in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def status():
    """A function: exit status of a command line, words being separated by spaces."""
    return lambda line, *words: main([*line.split(), *words])


@pytest.fixture
def refused(status, capsys, folder):
    """A function: the sentence with which a line is refused, nothing being written."""

    def sentence(line: str) -> str:
        before = sorted(folder.iterdir())
        assert status(line) == 2
        out, error = capsys.readouterr()
        assert error.startswith("jdsmc: ") and error.count("\n") == 1
        assert not out or out.endswith(" points\n")  # how many a sweep has
        assert sorted(folder.iterdir()) == before
        return error

    return sentence


@pytest.fixture
def nothing_runs(monkeypatch):
    """A session that is begun fails the test."""
    message = "a simulation was begun"
    monkeypatch.setattr("jdsmc.running.run.Session", lambda *_: pytest.fail(message))


@pytest.fixture(scope="session")
def measured():
    """Results of a gas over two collisions per particle: no steady values."""
    scene = jdsmc.scenarios.UniformShear(jdsmc.InelasticHardSpheres(0.7), 4.0)
    return jdsmc.run(scene, n_particles=256, collisions=2.0, time_step=0.2, progress=False)


@pytest.fixture
def asked(monkeypatch, measured):
    """Instead of running, keeps what `jdsmc.run` would get: a list of (scene, options)."""
    seen = []

    def run(scene, **options):
        seen.append((scene, options))
        return measured

    monkeypatch.setattr("jdsmc.cli.simulate.run", run)
    return seen
