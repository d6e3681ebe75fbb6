"""A run kept in a file from time to time, to go on from."""

import io
import json
import os
import time
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import jax
import numpy as np

from .. import check
from ..files import look, seal, tree
from ..files.lock import Lock
from ..files.readable import check_readable
from ..files.writable import check_writable
from ..results.rebuild import rebuilt
from ..scenarios.base import AbstractScene
from . import hosts
from .provenance import processor, specification, version
from .session import Session

EVERY = 300.0
"""Seconds between two checkpoints."""

SHARE = 0.01
"""Largest share of a run that is spent on writing."""

KIND, SCHEMA = "jdsmc checkpoint", 2


def check_none(options: dict, made: str) -> None:
    """Raise ValueError for a checkpoint where several runs are made: it keeps one."""
    if options.get("checkpoint") is not None:
        raise ValueError(f"checkpoint keeps one run, and {made} makes several: leave it out.")


def check_every(every) -> None:
    """Raise TypeError or ValueError for what is no number of seconds above zero."""
    check.scalar("every", every, 0.0, np.inf, high_included=False)


class Keeper:
    """Writes a session to a file, which is its own in a `with` block: in time, and at the end.

    Arguments: the file; seconds between two writings; the scene as the user made it; the arguments
    of `run` but for its limits; whether the run is a new one, whose file must not exist yet.
    Raises ValueError, TypeError, FileExistsError; and BlockingIOError, in the block, if another run
    has the file.
    """

    def __init__(self, path: str | Path, every, scene: AbstractScene, chosen: dict, *, new: bool):
        check_every(every)
        self.path = check.path("checkpoint", path)
        check_writable(self.path, overwrite=True)
        if new and hosts.is_first() and self.path.exists():
            raise FileExistsError(
                f"{path} exists; go on with it by jdsmc.resume({str(path)!r}), or choose another "
                "name."
            )
        if new and hosts.is_first() and previous(self.path).exists():
            raise FileExistsError(
                f"{previous(self.path)} exists, where the checkpoint before the last one is kept; "
                "choose another name for checkpoint, or move that file."
            )
        self.every = float(every)
        self._told = {"scene": specification(scene), "chosen": specification(chosen)}
        json.dumps(self._told)  # what cannot be written is refused before the run
        self._lock: Lock | None = None
        self._took, self._last = 0.0, time.monotonic()

    def __enter__(self):
        if hosts.is_first():
            self._lock = Lock(self.path)
        return self

    def __exit__(self, *_):
        if self._lock is not None:
            self._lock.release()

    def is_due(self) -> bool:
        """True if it is time."""
        return time.monotonic() - self._last >= max(self.every, self._took / SHARE)

    def keep(self, session: Session, stopped: str) -> None:
        """Write what the session has come to; every process of a run must call this.

        Warns if the file cannot be written.
        """
        began, state = time.monotonic(), plain(session)
        if not hosts.is_first():
            return
        said = self._told | {"limits": session.limits.given, "stopped": stopped}
        said["made_by"] = made_by()
        content = io.BytesIO()  # over a disk that fills HDF5 would crash the program
        with h5py.File(content, "w") as file:
            file.attrs.update({"kind": KIND, "schema": SCHEMA})
            tree.put_text(file, "run", json.dumps(said))
            tree.write(file.create_group("state"), state)

        def fill(path: Path) -> None:
            path.write_bytes(content.getbuffer())

        try:
            seal.write(self.path, fill, overwrite=True, previous=previous(self.path))
        except OSError as error:  # a full disk, a folder that is gone: no reason to end a run
            warnings.warn(
                f"{self.path} could not be written ({error}); the run goes on, and it is tried "
                "again.",
                stacklevel=4,
            )
        self._last = time.monotonic()
        self._took = self._last - began


class Kept(NamedTuple):
    """What a checkpoint holds: scene, arguments of `run`, limits, how it ended, state."""

    scene: AbstractScene
    chosen: dict
    limits: dict
    stopped: str
    state: dict

    def give(self, session: Session) -> None:
        """Make a new session go on from here."""
        structure = jax.tree.structure(session.engine.states[0])
        engine = [jax.tree.unflatten(structure, leaves) for leaves in self.state["engine"]]
        session.take(self.state | {"engine": engine})


def plain(session: Session) -> dict:
    """The state of a session with the leaves of its engine's states alone."""
    state = session.state()
    return state | {"engine": [jax.tree.leaves(one) for one in state["engine"]]}


def previous(path: Path) -> Path:
    """The checkpoint before the last one."""
    return path.with_name(f"{path.stem}.previous{path.suffix}")


def made_by() -> dict[str, Any]:
    """What decides the roundings of a run."""
    return {
        "jdsmc": version(),
        "jax": jax.__version__,
        "numpy": np.__version__,
        "backend": jax.default_backend(),
        "processor": processor(),
    }


def told(path: Path) -> dict[str, Any]:
    """What a file says of its run: scene, arguments, limits, how it ended, what made it.

    Raises FileNotFoundError, PermissionError; ValueError for a file that is no checkpoint, or was
    changed or cut.
    """
    before = previous(path)
    hint = f" The one before it is {before}." if os.path.isfile(before) else ""
    check_readable(path, hint)
    if not seal.is_sealed(path):
        raise ValueError(f"{path} is no checkpoint of jdsmc, or was cut.{hint}")
    if not seal.is_whole(path):
        raise ValueError(f"{path} was changed after it was written, or the disk failed.{hint}")
    with h5py.File(path, "r") as file:
        look.structure(file)
        if file.attrs.get("kind") != KIND:
            raise ValueError(f"{path} is no checkpoint, but what `run` returned: it holds no gas.")
        if file.attrs["schema"] != SCHEMA:
            raise ValueError(
                f"{path} has schema {file.attrs['schema']}; this version of jdsmc goes on with "
                f"{SCHEMA} only. Go on with the version that wrote it."
            )
        return json.loads(tree.get_text(file, "run"))


def read(path: Path, classes: tuple[type, ...] = ()) -> Kept:
    """What a file keeps of a run.

    Raises what `told` raises, and ValueError for a scene or gas whose class is not there. Warns if
    the run will not go on to the bit.
    """
    said = told(path)
    with h5py.File(path, "r") as file:
        state = tree.read(file["state"])
    there, here = said["made_by"], made_by()
    other = [f"{n} {there[n]} (here {here[n]})" for n in here if there[n] != here[n]]
    if other:
        warnings.warn(
            f"{path} was written with {', '.join(other)}: the run goes on, but not to the bit.",
            stacklevel=4,
        )
    limits = {name: _tupled(value) for name, value in said["limits"].items()}
    chosen = {name: _tupled(value) for name, value in said["chosen"].items()}
    scene: Any = rebuilt(said["scene"], classes)
    return Kept(scene, chosen, limits, said["stopped"], state)


def _tupled(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value
