"""Processes that are ended at random instants, and go on."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import jdsmc

from ..helpers import differences
from .table import LOST, SAME, SILENT, Table

SCENES = {
    "shear": "sweep shear --restitution 0.6,0.8 --particles 256 --collisions 200",
    "cooling": "run cooling --restitution 0.8 --particles 256 --collisions 200",
    "thermostat": "run thermostat --restitution 0.8 --particles 256 --collisions 200",
    "heat-flux": "run heat-flux --restitution 0.8 --particles 256 --collisions 150",
    "fourier": "run fourier --length 5 --particles 500 --duration 40",
    "couette": "run couette --length 3 --layers 6 --particles 300 --duration 60",
    "sheared-slab": "run sheared-slab --restitution 0.9 --particles 500 --layers 10 --duration 25",
    "navier-stokes": "run navier-stokes --particles 256 --collisions 400 --duration 2",
    "cooling-disks": "run cooling-disks --particles 200 --density 0.05 --copies 2 "
    "--real-per-cell 2 --duration 60",
    "molecular-dynamics": "run molecular-dynamics --particles 160 --density 0.05 --duration 200",
}
"""A small run of every scene that can be named on the command line."""

SIGNALS = {"SIGKILL": signal.SIGKILL, "SIGTERM": signal.SIGTERM}

OFTEN = """
import sys
from jdsmc.cli import main
from jdsmc.running import checkpoint
checkpoint.SHARE = 1.0
sys.exit(main(sys.argv[1:]))
"""
"""`jdsmc`, but for half of its time writing checkpoints, so that many are ended within one."""

ATTEMPTS = 20


def jdsmc_process(words: str, folder: Path) -> subprocess.Popen:
    """`jdsmc WORDS` in a process of its own, which writes whenever it can."""
    command = [sys.executable, "-c", OFTEN, *words.split(), "--no-progress"]
    pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(command, cwd=folder, **pipes)


class Scene:
    """A scene to be killed: its undisturbed result, and how long it runs after a checkpoint.

    Arguments: its name in `SCENES`, a folder.
    """

    def __init__(self, name: str, folder: Path):
        self.words, self.folder = SCENES[name], folder / name
        self.folder.mkdir(exist_ok=True)
        self.kept = self.folder / "kept.h5"
        whole = self.folder / "whole.h5"
        process = jdsmc_process(f"{self.words} --out {whole.name}", self.folder)
        said = process.communicate()[1]
        assert whole.exists(), said
        self.whole = jdsmc.load(whole)
        self.seconds = self._started()[1]

    def _started(self, until: float | None = None) -> tuple[subprocess.Popen, float]:
        """A process that has kept a first checkpoint, so many seconds after that (or at its end);
        and how long that was."""
        for old in self.folder.glob("*kept*"):
            old.unlink()
        kept = f"--checkpoint {self.kept.name} --every 1e-6"
        process = jdsmc_process(f"{self.words} {kept}", self.folder)
        while not self.kept.exists() and process.poll() is None:
            time.sleep(0.002)
        began = time.monotonic()
        if until is None:
            process.wait()
        else:
            time.sleep(until)
        return process, time.monotonic() - began

    def ended(self, kind: str, number: int) -> str:
        """End a process at a random instant, resume its run here, compare."""
        rng = np.random.default_rng((len(self.words), number))
        for attempt in range(ATTEMPTS):
            longest = self.seconds / (1 + attempt)  # it may be faster than the first one was
            process, _ = self._started(rng.uniform(0.0, longest))
            alive = process.poll() is None
            process.send_signal(SIGNALS[kind])
            said = process.communicate()[1]
            if alive and (kind == "SIGTERM" or process.returncode == -signal.SIGKILL):
                break
        else:
            raise RuntimeError(f"{self.words}: it always ended before it could be killed: {said}")
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
    names = list(SCENES)
    for place, name in enumerate(names):
        own = [
            (kind, number)
            for kind, count in (("SIGKILL", kills), ("SIGTERM", terms))
            for number in range(place, count, len(names))
            if not table.has(kind, name, number)
        ]
        if own:
            scene = Scene(name, table.folder)
        for kind, number in own:
            table.note(kind, name, number, lambda s=scene, k=kind, n=number: s.ended(k, n))
