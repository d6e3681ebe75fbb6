"""What is kept: saved before anything else, under another name if need be."""

import io
import os
import signal
import subprocess
import sys

import pytest

import jdsmc
from jdsmc.cli import main
from jdsmc.cli.keep import picture_of
from jdsmc.files import seal
from jdsmc.results import Result


def test_saved_and_shown(folder, asked, status, capsys):
    assert status("run shear --out x.h5") == 0
    out, err = capsys.readouterr()
    assert out.startswith("Results: x.h5\n") and not err
    assert jdsmc.load("x.h5").attrs["scene"] == "UniformShear"
    assert status("show x.h5") == 0
    assert capsys.readouterr().out.strip() in out


def test_the_file_appears_meanwhile(folder, monkeypatch, measured, status, capsys):
    """Neither is lost: the other file stays, the result lies beside it."""

    def run(*_, **__):
        (folder / "x.h5").write_text("precious")
        return measured

    monkeypatch.setattr("jdsmc.cli.simulate.run", run)
    assert status("run shear --out x.h5") == 0
    out, err = capsys.readouterr()
    assert "Results: x-2.h5" in out and "x-2.h5" in err and "exists" in err
    assert (folder / "x.h5").read_text() == "precious"
    assert jdsmc.load("x-2.h5").attrs["run"] == measured.attrs["run"]


def test_the_folder_vanishes(folder, monkeypatch, measured, status, capsys):
    """The result goes to the current folder."""
    (folder / "there").mkdir()

    def run(*_, **__):
        (folder / "there").rmdir()
        return measured

    monkeypatch.setattr("jdsmc.cli.simulate.run", run)
    assert status("run shear --out there/x.h5") == 0
    assert "there/x.h5 could not be written" in capsys.readouterr().err
    assert jdsmc.load("x.h5").attrs["run"] == measured.attrs["run"]


def test_a_table_that_cannot_be_made(folder, asked, monkeypatch, status, capsys):
    """The result is saved, also where nobody asked for a file."""

    def fail(self):
        raise KeyError("no such thing")

    monkeypatch.setattr(Result, "table", fail)
    assert status("run shear --out x.h5") == 1
    assert status("run shear") == 1
    assert "table could not be made" in capsys.readouterr().err
    assert {"x.h5", "jdsmc-UniformShear.h5"} == {p.name for p in folder.iterdir()}


def test_a_picture_that_cannot_be_drawn(asked, measured, monkeypatch, status, capsys):
    """Neither file nor table suffers."""

    def fail(self, path=None):
        raise RuntimeError("no ink")

    monkeypatch.setattr(Result, "plot", fail)
    assert status("run shear --out x.h5 --plot x.png") == 1
    out, err = capsys.readouterr()
    assert "No steady values" in out and "x.png could not be drawn: no ink." in err
    assert jdsmc.load("x.h5").attrs["run"] == measured.attrs["run"]


def test_gases_that_cannot_be_joined(folder, asked, monkeypatch, status):
    """Each is kept alone."""

    def fail(results):
        raise ValueError("cannot join")

    monkeypatch.setattr("jdsmc.cli.keep.join_gases", fail)
    assert status("sweep shear --gas ihs,ehs --out x.h5") == 1
    assert {"x-ihs.h5", "x-ehs.h5"} == {p.name for p in folder.iterdir()}


@pytest.mark.parametrize("result", [True, False])
def test_fault(result, measured, monkeypatch, status, capsys, folder):
    """Status 1 and the reason; what was measured, if anything, is in the file."""

    def run(*_, **__):
        error = jdsmc.NotSteadyError("too wild")
        error.result = measured if result else None
        raise error

    monkeypatch.setattr("jdsmc.cli.simulate.run", run)
    assert status("run shear --out x.h5") == 1
    assert capsys.readouterr().err == "jdsmc: too wild\n"
    assert [p.name for p in folder.iterdir()] == (["x.h5"] if result else [])


def test_fault_in_the_second_gas(measured, monkeypatch, status, capsys):
    """The first gas is kept, and so is what the second one measured."""

    def run(scene, **_):
        if type(scene.gas).__name__ == "ElasticHardSpheres":
            error = jdsmc.FaultError("too wild")
            error.result = measured
            raise error
        return measured

    monkeypatch.setattr("jdsmc.cli.simulate.run", run)
    assert status("sweep shear --gas ihs,ehs --out x.h5") == 1
    assert "jdsmc: too wild" in capsys.readouterr().err
    assert list(jdsmc.load("x.h5").steady["gas"].values) == ["ihs", "ehs"]


def test_ctrl_c_outside_a_run(monkeypatch, status, capsys):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("jdsmc.cli.simulate.run", interrupted)
    assert status("run shear") == 130
    assert "interrupted" in capsys.readouterr().err


@pytest.mark.parametrize(
    "file, picture",
    [
        ("shear.h5", "shear.png"),
        ("shear_0.7", "shear_0.7.png"),
        ("a/shear.nc", "a/shear.png"),
        ("run.1.h5", "run.1.png"),
    ],
)
def test_name_of_a_picture(file, picture, tmp_path):
    assert picture_of(tmp_path / file) == tmp_path / picture


def test_a_terminal_without_greek(measured, folder, monkeypatch):
    """Letters that it lacks are spelled."""
    measured.save("x.h5")
    monkeypatch.setattr(Result, "table", lambda self: "κ'/κ0 1.05(2)")
    bytes_out = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(bytes_out, encoding="ascii"))
    assert main(["show", "x.h5"]) == 0
    assert bytes_out.getvalue().decode().strip() == "kappa'/kappa0 1.05(2)"


def test_a_reader_that_has_seen_enough(measured):
    """`jdsmc show x.h5 | head -0` says nothing: run as a process, whose pipe nobody reads."""
    measured.save("x.h5")
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(
        [sys.executable, "-m", "jdsmc", "show", "x.h5"],
        stdout=write,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(write)
    assert (done.returncode, done.stderr) == (0, b"")


def test_a_picture_never_replaces_data(measured, status, capsys):
    """Whatever the file is called, and by whichever command."""
    measured.save("x.png")
    for line in ("plot x.png --out x.png", "run shear --plot x.png"):
        assert status(line) == 2
        assert "x.png holds data, not a picture" in capsys.readouterr().err
    assert jdsmc.load("x.png").attrs["run"] == measured.attrs["run"]


def test_ctrl_c_while_saving(asked, measured, monkeypatch, status):
    """The file is written all the same."""
    usual = signal.signal(signal.SIGINT, signal.default_int_handler)
    fill = Result.save

    def save(self, path):
        signal.raise_signal(signal.SIGINT)
        return fill(self, path)

    monkeypatch.setattr(Result, "save", save)
    try:
        assert status("run shear --out x.h5") == 0
    finally:
        signal.signal(signal.SIGINT, usual)
    assert jdsmc.load("x.h5").attrs["run"] == measured.attrs["run"]


def test_a_terminal_that_is_gone(measured, monkeypatch):
    """Closed by whoever called: nothing to print to, and no error about that."""
    measured.save("x.h5")
    monkeypatch.setattr(sys, "stdout", None)
    assert main(["show", "x.h5"]) == 0


def test_a_file_without_a_seal(measured, folder, status, capsys):
    """It is shown, with a sentence instead of Python's warning."""
    written = measured.save("x.h5").read_bytes()
    (folder / "x.h5").write_bytes(written[: -seal.LENGTH])
    assert status("show x.h5") == 0
    out, err = capsys.readouterr()
    assert "No steady values" in out and err.startswith("jdsmc: x.h5 has no seal")
    assert err.count("\n") == 1
