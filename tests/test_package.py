"""What is shipped: one version, everything that is needed, no link that leads nowhere."""

import email
import importlib
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

import jdsmc
from jdsmc.cli import main

ROOT = Path(__file__).parents[1]
LINK = re.compile(r"\]\((?!https?:|#)([^)]*)\)")
"""Markdown links within the repository."""


def project() -> dict:
    return tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def test_one_version(capsys):
    """In Python, on the command line, in the package's data, in the citation and the changes."""
    version = project()["version"]
    assert jdsmc.__version__ == version
    assert main(["--version"]) == 0 and capsys.readouterr().out == f"jdsmc {version}\n"
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text()
    assert re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.M)[0] == version


def test_every_public_name_follows_from_one_import(monkeypatch):
    """`import jdsmc` and dots lead to all that the reference describes, in a fresh process."""
    monkeypatch.syspath_prepend(ROOT / "docs")
    described = importlib.import_module("public_names")
    names = [name for part in described.PARTS.values() for name in part.things]
    names += [f"jdsmc.theory.{name}" for name in described.THEORY]
    assert len(names) > 40
    words = ["-c", f"import jdsmc\nfor name in {names}: eval(name)"]
    done = subprocess.run([sys.executable, *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_gpu_gets_the_same_jax():
    """The extra must not allow a version that the core refuses."""
    (core,) = (one for one in project()["dependencies"] if one.startswith("jax>"))
    (extra,) = project()["optional-dependencies"]["gpu"]
    assert extra.split(";")[0] == core.replace("jax", "jax[cuda12]", 1)


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md"])
def test_links_of_the_repository(page):
    """Every file that is linked to is there."""
    found = LINK.findall((ROOT / page).read_text())
    assert found and all((ROOT / path).is_file() for path in found)


@pytest.mark.slow
def test_wheel(tmp_path):
    """Built, unpacked away from the checkout, run: needs the package index for the builder."""

    def python(*words, **options):
        done = subprocess.run(
            [sys.executable, *words], capture_output=True, text=True, check=False, **options
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    python("-m", "pip", "wheel", "--no-deps", "-w", str(tmp_path), str(ROOT))
    (wheel,) = tmp_path.glob("*.whl")
    archive = zipfile.ZipFile(wheel)
    sources = {str(path.relative_to(ROOT)) for path in (ROOT / "jdsmc").rglob("*.py")}
    assert sources | {"jdsmc/py.typed"} <= {*archive.namelist()}
    (about,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
    text = email.message_from_bytes(archive.read(about)).get_payload()
    assert not LINK.search(text) and "# jdsmc" in text
    archive.extractall(tmp_path / "installed")
    there = {"cwd": tmp_path, "env": {"PYTHONPATH": str(tmp_path / "installed")}}
    assert str(tmp_path) in python("-c", "import jdsmc; print(jdsmc.__file__)", **there)
    assert python("-m", "jdsmc", "--version", **there) == f"jdsmc {jdsmc.__version__}\n"
    run = "-m jdsmc run shear --restitution 0.7 --shear-rate 4 --particles 256 --collisions 2"
    assert "steady" in python(*run.split(), "--out", "x.h5", **there)
    assert "steady" in python("-m", "jdsmc", "show", "x.h5", **there)
