"""A progress bar, and Ctrl-C as an event."""

import contextlib
import signal
import threading

import numpy as np
from tqdm import tqdm


class Bar:
    """A progress bar in percent that tells the phase, or nothing."""

    def __init__(self, bar):
        self._bar = bar

    def show(self, session) -> None:
        """Draw what a session has come to."""
        if self._bar is None:
            return
        limits = session.limits
        if limits.fixed:
            phase = "running"
        else:
            phase = "measuring" if session.tracker.all_measuring else "warming up"
        self._bar.set_description_str(phase)
        facts = {"collisions/particle": f"{session.spent:.0f}"}
        if np.isfinite(session.precision):
            facts[limits.named] = f"±{session.precision:.2g}"
        self._bar.set_postfix(facts, refresh=False)
        self._bar.update(100.0 * session.progress() - self._bar.n)


@contextlib.contextmanager
def progress_bar(show: bool):
    """A bar on the terminal, or one that shows nothing."""
    if not show:
        yield Bar(None)
        return
    layout = "{desc} {percentage:3.0f}%|{bar}| {elapsed}{postfix}"
    with tqdm(total=100.0, bar_format=layout, desc="compiling", dynamic_ncols=True) as bar:
        yield Bar(bar)


@contextlib.contextmanager
def interruptible():
    """An event set by Ctrl-C in place of an exception; a second Ctrl-C interrupts as usual."""
    event = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield event
        return
    usual = signal.getsignal(signal.SIGINT)
    if usual is None:  # set from C: it could not be put back
        yield event
        return

    def on_interrupt(number, frame):
        event.set()
        signal.signal(signal.SIGINT, usual)

    signal.signal(signal.SIGINT, on_interrupt)
    try:
        yield event
    finally:
        signal.signal(signal.SIGINT, usual)
