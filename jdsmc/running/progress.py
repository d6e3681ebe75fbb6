"""How far a run is: a bar, or on what is no terminal a line now and then; Ctrl-C as an event."""

import contextlib
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable

import numpy as np

FIRST_LINE = 60.0
"""Seconds until the first line on what is no terminal: shorter runs say nothing."""

GROWTH = 1.5
"""Every line comes so many times as late as the one before: a run of a day has 19."""

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
        self._bar.set_description_str(phase(session))
        self._bar.set_postfix(facts(session), refresh=False)
        self._bar.update(100.0 * session.progress() - self._bar.n)


class Lines:
    """A line now and then, for logs."""

    def __init__(self, write: Callable[[str], object], clock: Callable[[], float] = time.monotonic):
        self._write, self._clock, self._start = write, clock, clock()
        self._next = FIRST_LINE

    def show(self, session) -> None:
        """Write a line if it is time for one."""
        elapsed = self._clock() - self._start
        if elapsed < self._next:
            return
        self._next = GROWTH * elapsed
        known = ", ".join(f"{name} {value}" for name, value in facts(session).items())
        percent = f"{100.0 * session.progress():.0f}%"
        self._write(f"jdsmc: {phase(session)}, {percent} after {elapsed:.0f} s, {known}\n")


def phase(session) -> str:
    """What is being done, in words."""
    if session.limits.fixed:
        return "running"
    return "measuring" if session.tracker.all_measuring else "warming up"


def facts(session) -> dict[str, str]:
    """Numbers that tell how far a session has come."""
    found = {"collisions/particle": f"{session.spent:.0f}"}
    if np.isfinite(session.precision):
        found[session.limits.named] = f"±{session.precision:.2g}"
    return found


@contextlib.contextmanager
def progress_bar(show: bool):
    """A bar in a notebook or on a terminal, lines elsewhere, or nothing."""
    if not show:
        yield Bar(None)
    elif not (in_notebook() or sys.stderr.isatty()):
        yield Lines(sys.stderr.write)
    else:
        layout = "{desc} {percentage:3.0f}%|{bar}| {elapsed}{postfix}"
        if in_notebook():
            layout = "{l_bar}{bar}| {elapsed}{postfix}"
        with bars()(total=100.0, bar_format=layout, desc="compiling", dynamic_ncols=True) as bar:
            yield Bar(bar)


def bars():
    """The class of bars that suits where we are; of text where a notebook has no widgets."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # ipywidgets is not there: text will do
        from tqdm.auto import tqdm  # noqa: PLC0415 - looks where it is imported
    return tqdm


def in_notebook() -> bool:
    """True in a kernel of Jupyter, whose output is no terminal and can redraw a line."""
    if "ipykernel" not in sys.modules or "IPython" not in sys.modules:
        return False
    shell = sys.modules["IPython"].get_ipython()
    return shell is not None and "IPKernelApp" in shell.config


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
