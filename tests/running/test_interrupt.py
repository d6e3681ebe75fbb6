"""Ctrl-C ends a run and keeps what was measured."""

import os
import signal
import threading

import pytest

from jdsmc.running.engine import Engine
from jdsmc.running.progress import interruptible

from .small import assert_same, simulate


@pytest.fixture(autouse=True)
def usual_ctrl_c():
    """Ctrl-C as in a terminal: a background job of a shell starts with it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupt_at(monkeypatch, chunk, send):
    """Have Engine.advance send the signal of Ctrl-C while it computes this chunk."""
    advance = Engine.advance

    def patched(self, watch):
        if self.chunks + 1 == chunk:
            send()
        return advance(self, watch)

    monkeypatch.setattr(Engine, "advance", patched)


def test_ctrl_c(monkeypatch):
    """The chunk is finished, what was measured is returned, and Ctrl-C is as it was before."""
    interrupt_at(monkeypatch, 3, lambda: signal.raise_signal(signal.SIGINT))
    before = signal.getsignal(signal.SIGINT)
    result = simulate(collisions=1e6)
    assert result.attrs["stopped"].startswith("interrupted after")
    # three chunks of eight records, as far as the clocks of all realizations have come
    assert 2 * 8 < result.series.sizes["sample"] <= 3 * 8
    assert signal.getsignal(signal.SIGINT) is before
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_ctrl_c_from_outside(monkeypatch):
    """The signal comes when it comes, while the main thread waits for XLA, late in a run."""
    timer = threading.Timer(0.02, os.kill, (os.getpid(), signal.SIGINT))
    interrupt_at(monkeypatch, 80, timer.start)
    result = simulate(rtol=1e-9, budget=1e9)
    assert result.attrs["stopped"].startswith("interrupted")
    assert result.is_steady, "by then it was: each chunk is more than a collision"


def test_second_ctrl_c_stops_at_once(monkeypatch):
    def twice():
        for _ in range(2):
            signal.raise_signal(signal.SIGINT)

    interrupt_at(monkeypatch, 3, twice)
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        simulate(collisions=1e6)
    assert signal.getsignal(signal.SIGINT) is before


def test_in_a_thread():
    """Only the main thread can handle signals: elsewhere a run works without."""
    results = []
    thread = threading.Thread(target=lambda: results.append(simulate(duration=1.0)))
    thread.start()
    thread.join()
    assert_same(results[0], simulate(duration=1.0))


def test_a_handler_that_was_set_from_c(monkeypatch):
    """Python cannot put it back, so it stays, and the run works without."""
    monkeypatch.setattr(signal, "getsignal", lambda _: None)
    monkeypatch.setattr(signal, "signal", lambda *_: pytest.fail("the handler was replaced"))
    with interruptible() as interrupted:
        assert not interrupted.is_set()
