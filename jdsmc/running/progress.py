"""A progress bar, and Ctrl-C as an event."""

import contextlib
import signal
import threading

import numpy as np
from tqdm import tqdm

SIGNALS = (signal.SIGINT, signal.SIGTERM)
"""Of Ctrl-C, and of a scheduler whose time is up."""


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
    """An event set by Ctrl-C or SIGTERM in place of an end; a second one ends as usual."""
    event = threading.Event()
    usual = {}
    if threading.current_thread() is threading.main_thread():
        handlers = {number: signal.getsignal(number) for number in SIGNALS}
        usual = {n: h for n, h in handlers.items() if h is not None}  # None: set from C

    def on_signal(number, frame):
        event.set()
        signal.signal(number, usual[number])

    for number in usual:
        signal.signal(number, on_signal)
    try:
        yield event
    finally:
        for number, handler in usual.items():
            signal.signal(number, handler)
