"""Processes that are ended at random instants, and go on."""

import json
import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import jdsmc

from ..helpers import differences
from .table import LOST, SAME, SILENT, Table

SCENES = {
    "shear": "sweep shear --restitution 0.6,0.8 --particles 256 --collisions 60",
    "cooling": "run cooling --restitution 0.8 --particles 256 --collisions 60",
    "thermostat": "run thermostat --restitution 0.8 --particles 256 --collisions 60",
    "heat-flux": "run heat-flux --restitution 0.8 --particles 256 --collisions 50",
    "fourier": "run fourier --length 5 --particles 500 --duration 60",
    "couette": "run couette --length 3 --layers 6 --particles 300 --duration 60",
    "sheared-slab": "run sheared-slab --restitution 0.9 --particles 500 --layers 10 --duration 12",
    "navier-stokes": "run navier-stokes --particles 256 --collisions 200 --duration 2",
    "cooling-disks": "run cooling-disks --particles 200 --density 0.05 --copies 2 "
    "--real-per-cell 2 --duration 90",
    "molecular-dynamics": "run molecular-dynamics --particles 160 --density 0.05 --duration 100",
}
"""A small run of every scene that can be named on the command line."""

SIGNALS = {"SIGKILL": signal.SIGKILL, "SIGTERM": signal.SIGTERM}

OFTEN = "import sys; from jdsmc.running import checkpoint as c; c.SHARE = 1.0"
"""For half of the time checkpoints are written, so that many runs are ended within one."""

ALONE = OFTEN + "; from jdsmc.cli import main; sys.exit(main(sys.argv[1:]))"
"""`jdsmc` in a process of its own."""

MANY = (
    OFTEN
    + """
import json, os
from jdsmc.cli import main
for line in sys.stdin:
    folder, words = json.loads(line)
    child = os.fork()
    if child == 0:
        os.chdir(folder)
        for number, name in ((1, os.devnull), (2, "said.txt")):
            os.dup2(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        status = 1
        try:
            status = main(words)
        finally:
            os._exit(status)
    print(child, flush=True)
    print(os.waitpid(child, 0)[1], flush=True)
"""
)
"""The same again and again: processes that need not import anything, as nothing is computed before
they are forked."""

ATTEMPTS = 20


def jdsmc_process(words: str, folder: Path) -> subprocess.Popen:
    """`jdsmc WORDS` in a process of its own, which writes whenever it can."""
    command = [sys.executable, "-c", ALONE, *words.split(), "--no-progress"]
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(command, cwd=folder, **pipes)


class Processes:
    """`jdsmc` in one process after the other; a `with` block has them."""

    def __enter__(self):
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "bufsize": 0}
        self._parent: Any = subprocess.Popen([sys.executable, "-c", MANY], **pipes)
        return self

    def __exit__(self, *_):
        self._parent.stdin.close()
        self._parent.wait()

    def begin(self, words: str, folder: Path) -> int:
        """Begin one; its number. The one before must have ended."""
        line = json.dumps([str(folder), [*words.split(), "--no-progress"]])
        self._parent.stdin.write(line.encode() + b"\n")
        return int(self._parent.stdout.readline())

    def status(self, seconds: float | None = None) -> int | None:
        """How it ended, as `os.waitpid` says it; None if it goes on after so many seconds."""
        if not select.select([self._parent.stdout], [], [], seconds)[0]:
            return None
        return int(self._parent.stdout.readline())


class Scene:
    """A scene to be killed: its undisturbed result, and how long it runs after a checkpoint.

    Arguments: its name in `SCENES`, a folder, what begins processes.
    """

    def __init__(self, name: str, folder: Path, processes: Processes):
        self.words, self.folder, self.processes = SCENES[name], folder / name, processes
        self.folder.mkdir(exist_ok=True)
        self.kept, whole = self.folder / "kept.h5", self.folder / "whole.h5"
        if not whole.exists():
            processes.begin(f"{self.words} --out {whole.name}", self.folder)
            assert processes.status() == 0, (self.folder / "said.txt").read_text()
        self.whole = jdsmc.load(whole)
        self.begin()
        began = time.monotonic()
        processes.status()
        self.seconds = time.monotonic() - began

    def begin(self) -> int:
        """A process that has kept a first checkpoint just now."""
        for old in self.folder.glob("*kept*"):
            old.unlink()
        kept = f"{self.words} --checkpoint {self.kept.name} --every 1e-6"
        number = self.processes.begin(kept, self.folder)
        while not self.kept.exists():
            if self.processes.status(0.002) is not None:
                raise RuntimeError((self.folder / "said.txt").read_text())
        return number

    def ended(self, kind: str, number: int) -> str:
        """End a process at a random instant, resume its run here, compare."""
        rng = np.random.default_rng((len(self.words), number))
        for attempt in range(ATTEMPTS):
            process = self.begin()
            longest = self.seconds / (1 + attempt)  # it may be faster than the first one was
            status = self.processes.status(rng.uniform(0.0, longest))
            if status is None:
                os.kill(process, SIGNALS[kind])
                status = self.processes.status()
                if kind == "SIGTERM" or status == signal.SIGKILL:
                    break
        else:
            raise RuntimeError(f"{self.words}: it always ended before it could be killed")
        within = " (within a write)" if any(self.folder.glob(".kept*.partial")) else ""
        try:
            again = jdsmc.resume(self.kept, progress=False)
        except Exception as error:
            return f"{LOST}: {type(error).__name__}: {error}{within}"
        saved = jdsmc.load(again.save(self.folder / "resumed.h5", overwrite=True))
        # the code may be committed meanwhile
        other = differences(self.whole, saved, besides=("commit",))
        return f"{SILENT}: {other} differ{within}" if other else f"{SAME}{within}"


def inject(table: Table, kills: int, terms: int) -> None:
    """So many SIGKILL and SIGTERM over all scenes, those of one scene after the other."""
    with Processes() as processes:
        _inject(table, kills, terms, processes)


def _inject(table: Table, kills: int, terms: int, processes: Processes) -> None:
    names = list(SCENES)
    for place, name in enumerate(names):
        own = [
            (kind, number)
            for kind, count in (("SIGKILL", kills), ("SIGTERM", terms))
            for number in range(place, count, len(names))
            if not table.has(kind, name, number)
        ]
        if own:
            scene = Scene(name, table.folder, processes)
        for kind, number in own:
            table.note(kind, name, number, lambda s=scene, k=kind, n=number: s.ended(k, n))
