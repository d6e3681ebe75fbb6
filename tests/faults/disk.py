"""Disks that fill, folders that nobody may write to, two runs that want one file."""

import contextlib
import os
import resource
import shutil
import subprocess
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc.files import seal
from jdsmc.running.checkpoint import previous

from ..helpers import differences
from .kills import jdsmc_process
from .table import LOST, SAME, SILENT, TOLD, Table

SHEAR = jdsmc.scenarios.UniformShear(jdsmc.InelasticHardSpheres(0.7), 4.0)
OPTIONS = {"n_particles": 256, "steps_per_record": 8, "seed": 2, "progress": False}
PART, ALL = {"collisions": 10.0}, {"collisions": 20.0}
WORDS = "run shear --restitution 0.7 --particles 256 --collisions 300"
NOBODY = 65534
"""Number of the user who owns nothing."""


@contextmanager
def room_for(size: int) -> Iterator[None]:
    """No file grows beyond so many bytes, as on a disk that fills."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@contextmanager
def nobody_may_write(folder: Path) -> Iterator[None]:
    """A folder that can be read alone; root, who may write everywhere, becomes nobody."""
    root = os.geteuid() == 0
    folder.chmod(0o555)
    if root:
        os.seteuid(NOBODY)
    try:
        yield
    finally:
        if root:
            os.seteuid(0)
        folder.chmod(0o755)


class Place:
    """An empty folder, an undisturbed run, and one that has come half-way.

    Arguments: the folder; it may be read by all.
    """

    def __init__(self, folder: Path):
        self.folder, self.kept = folder, folder / "run.h5"
        self.whole = jdsmc.run(SHEAR, **ALL, **OPTIONS)

    @cached_property
    def alone(self) -> jdsmc.Result:
        """What a process gives that nobody disturbs."""
        self.emptied()
        jdsmc_process(f"{WORDS} --out alone.h5", self.folder).communicate()
        return jdsmc.load(self.folder / "alone.h5")

    def emptied(self) -> None:
        """Begin anew."""
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def half_way(self) -> bytes:
        """A checkpoint of the first half of the run, and what is in it."""
        self.emptied()
        jdsmc.run(SHEAR, checkpoint=self.kept, every=1e-9, **PART, **OPTIONS)
        return self.kept.read_bytes()

    def judged(self, result: jdsmc.Result | None) -> str:
        """What became of a run."""
        if result is None:
            return LOST
        other = differences(self.whole, result)
        return f"{SILENT}: {other} differ" if other else SAME

    def went_on(self, kept: bytes, obstacle) -> str:
        """Go on where checkpoints cannot be written: a warning, the right result, the old file; and
        then once more without the obstacle."""
        with warnings.catch_warnings(record=True) as caught, obstacle:
            warnings.simplefilter("always")
            result = jdsmc.resume(self.kept, every=1e-9, progress=False, **ALL)
        if not any("could not be written" in str(one.message) for one in caught):
            return f"{SILENT}: no warning"
        if self.kept.read_bytes() != kept or not seal.is_whole(previous(self.kept)):
            return f"{LOST}: the file before it"
        if left := [path.name for path in self.folder.glob(".*.partial")]:
            return f"{LOST}: {left} left behind"
        again = jdsmc.resume(self.kept, progress=False, **ALL)
        return max(self.judged(result), self.judged(again), key=len)

    def checkpoint_on_a_full_disk(self, share: float) -> str:
        """It fills when so much of a checkpoint is written."""
        kept = self.half_way()
        return self.went_on(kept, room_for(int(share * len(kept))))

    def checkpoint_in_a_read_only_folder(self) -> str:
        """It can no longer be written to, from the second checkpoint on."""
        kept = self.half_way()
        self.folder.chmod(0o755)
        write, calls, stack = seal.write, [], contextlib.ExitStack()

        def later(*arguments, **options):
            if len(calls) == 0:
                stack.enter_context(nobody_may_write(self.folder))
            calls.append(None)
            write(*arguments, **options)

        seal.write = later
        try:
            return self.went_on(kept, stack)
        finally:
            seal.write = write

    def save_on_a_full_disk(self, share: float) -> str:
        """It fills when so much of a result is written; then there is room again."""
        self.emptied()
        path = self.folder / "result.h5"
        size = len(self.whole.save(path).read_bytes())
        path.unlink()
        try:
            with room_for(int(share * size)):
                self.whole.save(path)
        except OSError:
            pass
        else:
            return f"{SILENT}: no error"
        if left := os.listdir(self.folder):
            return f"{LOST}: {left} left behind"
        found = self.judged(jdsmc.load(self.whole.save(path)))
        return TOLD if found == SAME else found

    def refused(self, work, *errors: type[Exception]) -> str:
        """A sentence, before anything is run or changed."""
        before = {path: path.read_bytes() for path in self.folder.iterdir()}
        try:
            with nobody_may_write(self.folder):
                work()
        except errors as error:
            told = str(error).endswith(".")
        else:
            return f"{SILENT}: no error"
        same = {path: path.read_bytes() for path in self.folder.iterdir()} == before
        return TOLD if told and same else f"{SILENT if same else LOST}: {errors}"

    def read_only_from_the_start(self) -> list[str]:
        """A new run, one that goes on, and a result that is saved."""
        self.half_way()
        new = self.folder / "new.h5"
        return [
            self.refused(work, PermissionError)
            for work in (
                lambda: jdsmc.run(SHEAR, checkpoint=new, **ALL, **OPTIONS),
                lambda: jdsmc.resume(self.kept, progress=False, **ALL),
                lambda: self.whole.save(new),
            )
        ]

    def two_runs_onto_one_checkpoint(self) -> str:
        """While a process writes, nobody else begins or goes on; its own result is right."""
        alone = self.alone
        self.emptied()
        kept = f"{WORDS} --checkpoint run.h5 --every 1e-6 --out first.h5"
        process = jdsmc_process(kept, self.folder)
        while not self.kept.exists() and process.poll() is None:
            time.sleep(0.002)
        refused = 0
        for work, error in (
            (lambda: jdsmc.run(SHEAR, checkpoint=self.kept, **ALL, **OPTIONS), FileExistsError),
            (lambda: jdsmc.resume(self.kept, collisions=1e5, progress=False), BlockingIOError),
        ):
            try:
                work()
            except error as told:
                refused += str(told).endswith(".")
        alive = process.poll() is None
        process.communicate()
        if refused < 2 or not alive:
            return f"{SILENT}: {refused} refused of 2, the first {'' if alive else 'not '}alive"
        wrong = differences(alone, jdsmc.load(self.folder / "first.h5"), besides=("commit",))
        return f"{SILENT}: {wrong} differ" if wrong else TOLD

    def two_runs_onto_one_result(self) -> str:
        """Started at once with other seeds: both are kept, the later one under another name."""
        self.emptied()
        both = [
            jdsmc_process(f"{WORDS} --seed {seed} --out both.h5", self.folder) for seed in (1, 2)
        ]
        said = [process.communicate()[1] for process in both]
        files = sorted(self.folder.glob("both*.h5"))
        seeds = {jdsmc.load(path).attrs["seed"] for path in files}
        if seeds != {1, 2}:
            return f"{LOST}: of seeds 1 and 2 there are {seeds}"
        return TOLD if any("saved as" in text for text in said) else f"{SILENT}: {said}"

    def process_on_a_full_disk(self, number: int) -> str:
        """A disk that fills at a random instant and stays full: the result cannot be saved, and is
        made from the checkpoint once there is room."""
        alone = self.alone
        self.emptied()
        kept = f"{WORDS} --checkpoint run.h5 --every 1e-6 --out result.h5"
        process = jdsmc_process(kept, self.folder)
        while not self.kept.exists() and process.poll() is None:
            time.sleep(0.002)
        rng = np.random.default_rng(number)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(rng.uniform(0.0, 0.3))
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (10_000, 10_000))
        said = process.communicate()[1]
        if process.returncode != 1 or "could not be saved" not in said:
            return f"{SILENT}: {process.returncode} {said}"
        if left := [path.name for path in self.folder.glob("result*")]:
            return f"{LOST}: {left} left behind"
        again = jdsmc.resume(self.kept, progress=False).save(self.folder / "result.h5")
        wrong = differences(alone, jdsmc.load(again), besides=("commit",))
        return f"{SILENT}: {wrong} differ" if wrong else TOLD


def inject(table: Table, times: int, processes: int) -> None:
    """Full disks at so many sizes; read-only folders; so many pairs of runs onto one file."""
    place = Place(table.folder / "disk")
    table.folder.chmod(0o755)
    for number in range(times):
        share = number / times
        table.note(
            "disk full during a checkpoint",
            "shear",
            number,
            lambda s=share: place.checkpoint_on_a_full_disk(s),
        )
        table.note(
            "disk full during a save", "shear", number, lambda s=share: place.save_on_a_full_disk(s)
        )
    if os.geteuid() == 0 or table.folder.stat().st_uid == os.geteuid():
        whats = ("run", "resume", "save")
        if not all(table.has("read-only folder", what, 0) for what in whats):
            outcomes = place.read_only_from_the_start()
            for what, outcome in zip(whats, outcomes, strict=True):
                table.note("read-only folder", what, 0, lambda o=outcome: o)
        table.note(
            "folder that becomes read-only", "shear", 0, place.checkpoint_in_a_read_only_folder
        )
    for number in range(processes):
        table.note(
            "two runs onto one checkpoint", "shear", number, place.two_runs_onto_one_checkpoint
        )
        table.note("two runs onto one result", "shear", number, place.two_runs_onto_one_result)
        if hasattr(resource, "prlimit"):
            table.note(
                "disk full from an instant on",
                "shear",
                number,
                lambda n=number: place.process_on_a_full_disk(n),
            )
