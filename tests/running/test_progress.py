"""What is shown while a run goes on."""

import io
import math
from types import SimpleNamespace

import pytest

from jdsmc.running import progress
from jdsmc.running.progress import FIRST_LINE, Lines, progress_bar


@pytest.fixture
def session():
    """Half way, with a precision."""
    return SimpleNamespace(
        limits=SimpleNamespace(fixed=False, named="shear_stress"),
        tracker=SimpleNamespace(all_measuring=True),
        spent=120.0,
        precision=0.0123,
        progress=lambda: 0.5,
    )


def test_no_terminal(session, monkeypatch):
    """A short run says nothing to a log, and a bar nowhere leaves control characters in it."""
    log = io.StringIO()
    monkeypatch.setattr("sys.stderr", log)
    with progress_bar(True) as shown:
        for _ in range(3):
            shown.show(session)
    assert isinstance(shown, Lines) and log.getvalue() == ""


def test_lines_now_and_then(session):
    """A day looked at every second has some twenty lines, each later than the one before."""
    now, lines = [0.0], []
    shown = Lines(lines.append, clock=lambda: now[0])
    day = 86_400
    for second in range(day):
        now[0] = float(second)
        shown.show(session)
    wanted = 1 + math.log(day / FIRST_LINE) / math.log(progress.GROWTH)
    assert abs(len(lines) - wanted) < 1
    words = "collisions/particle 120, shear_stress ±0.012\n"
    assert lines[0] == f"jdsmc: measuring, 50% after 60 s, {words}"


def test_terminal(session, monkeypatch):
    """A bar, which is gone from the line's start on when it is drawn anew."""
    terminal = io.StringIO()
    terminal.isatty = lambda: True
    monkeypatch.setattr("sys.stderr", terminal)
    with progress_bar(True) as shown:
        shown.show(session)
    assert "measuring  50%" in terminal.getvalue() and "\r" in terminal.getvalue()


def test_nothing_is_shown(session, capfd):
    with progress_bar(False) as shown:
        shown.show(session)
    assert capfd.readouterr() == ("", "")
