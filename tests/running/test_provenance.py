"""What a file tells of versions: those of jdsmc, never of what lies around it."""

import os
import shutil
import subprocess
from importlib import metadata
from pathlib import Path

import equinox as eqx
import pytest
import xarray as xr

import jdsmc
from jdsmc.results import Result
from jdsmc.running import provenance
from jdsmc.scenarios import HomogeneousCooling, Options

PROJECT = '[project]\nname = "{}"\n'


def git(folder, *arguments) -> str:
    """Run git there, as nobody in particular."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    who = ["-c", "user.name=nobody", "-c", "user.email=nobody@example.org"]
    command = ["git", *who, *arguments]
    done = subprocess.run(
        command, cwd=folder, env=clean, capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """A function: the folder of a project of a name, with a copy of the package, committed."""
    if shutil.which("git") is None:
        pytest.skip("there is no git")

    def make(name: str) -> Path:
        module = tmp_path / "jdsmc" / "running" / "provenance.py"
        module.parent.mkdir(parents=True)
        module.write_text("")
        (tmp_path / "pyproject.toml").write_text(PROJECT.format(name))
        git(tmp_path, "init", "-q")
        git(tmp_path, "add", "-A")
        git(tmp_path, "commit", "-qm", "first")
        monkeypatch.setattr(provenance, "__file__", str(module))
        return tmp_path

    return make


def test_a_bare_checkout(monkeypatch):
    """Without installed metadata there is no version, and no error."""

    def missing(name):
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", missing)
    assert provenance.version() == "unknown"


def test_commit(checkout):
    """That of the checkout, and whether it was changed since."""
    folder = checkout("jdsmc")
    head = git(folder, "rev-parse", "HEAD")
    assert provenance.commit() == head
    (folder / "jdsmc" / "new.py").write_text("")
    assert provenance.commit() == f"{head}+"


def test_the_repository_of_a_user(checkout):
    """Who copied the package into a project of their own has made another commit than we."""
    checkout("mine")
    assert provenance.commit() == "unknown"


def test_variables_of_git(checkout, tmp_path_factory, monkeypatch):
    """They speak of another repository, as within one of its hooks."""
    folder = checkout("jdsmc")
    head = git(folder, "rev-parse", "HEAD")
    other = tmp_path_factory.mktemp("other")
    git(other, "init", "-q")
    for name in ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_OBJECT_DIRECTORY"):
        monkeypatch.setenv(name, str(other / ".git"))
    assert provenance.commit() == head


def test_installed(tmp_path, monkeypatch):
    """Below a repository of the user's, as in its virtual environment."""
    module = tmp_path / "site-packages" / "jdsmc" / "running" / "provenance.py"
    (tmp_path / ".git").mkdir()
    (tmp_path / "pyproject.toml").write_text(PROJECT.format("jdsmc"))
    monkeypatch.setattr(provenance, "__file__", str(module))
    assert provenance.commit() == "unknown"


class Switched(HomogeneousCooling):
    """A scene with switches that NetCDF has no type for."""

    quick: bool = eqx.field(default=True, static=True)
    mask: int = eqx.field(default=2**70, static=True)

    def __init__(self, gas):
        super().__init__(gas)
        self.quick, self.mask = True, 2**70


def test_switches_fit_into_a_file(tmp_path):
    """Truth values and huge integers as text: else no result of such a run could be saved."""
    scene = Switched(jdsmc.InelasticHardSpheres(0.7))
    options = Options.checked(64, 0.1, "strang", "float32", 8)
    attrs = provenance.provenance(scene, options)
    assert attrs["option_quick"] == "True" and attrs["option_mask"] == str(2**70)
    result = Result(xr.DataTree(xr.Dataset(attrs=attrs)))
    assert jdsmc.load(result.save(tmp_path / "x.h5")).attrs["option_quick"] == "True"
