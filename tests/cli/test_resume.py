"""`jdsmc run --checkpoint`, `jdsmc resume`, `jdsmc merge`: one night on a cluster."""

import subprocess
import sys
import time

import jdsmc
from jdsmc.cli import main

RUN = "run shear --particles 256 --restitution 0.7 --no-progress"


def run(capsys, words: str) -> tuple[int, str, str]:
    status = main(words.split())
    said = capsys.readouterr()
    return status, said.out, said.err


def test_killed_resumed_gone_on_and_merged(tmp_path, monkeypatch, capsys):
    """A process that is killed in the middle; its run ends as that of another that was not."""
    monkeypatch.chdir(tmp_path)
    long = f"{RUN} --collisions 30000 --checkpoint night.h5 --every 0.01"
    process = subprocess.Popen([sys.executable, "-m", "jdsmc", *long.split()])
    while not (tmp_path / "night.h5").exists():
        assert process.poll() is None
        time.sleep(0.05)
    process.kill()
    process.wait()
    status, said, _ = run(capsys, "resume night.h5 --collisions 400 --out night_result.h5")
    assert status == 0, said
    run(capsys, f"{RUN} --collisions 400 --out day.h5")
    day, night = jdsmc.load("day.h5"), jdsmc.load("night_result.h5")
    assert day.series.identical(night.series) and day.steady.equals(night.steady)
    assert run(capsys, f"{RUN} --seed 1 --collisions 400 --out other.h5")[0] == 0
    status, said, _ = run(capsys, "merge day.h5 other.h5 --out all.h5")
    assert status == 0 and "Results: all.h5" in said
    assert jdsmc.load("all.h5").attrs["n_realizations"] == 16


def test_bad_input_ends_in_a_sentence(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there.h5").write_bytes(b"x")
    for words, told in (
        ("resume no.h5", "no file no.h5"),
        ("resume there.h5", "no checkpoint"),
        ("resume there.h5 --rtol much", "rtol"),
        ("merge there.h5", "there.h5"),
        (f"{RUN.replace('run', 'sweep')} --gas ihs,ehs --checkpoint run.h5", "one"),
        (f"{RUN} --checkpoint there.h5", "resume"),
    ):
        status, _, said = run(capsys, words)
        assert status == 2 and told in said, words
        assert said.count("\n") == 1
