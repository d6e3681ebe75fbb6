"""Processes that share the gases of a run: one a host, or several on one.

Each advances its own gases and hands what they gave to all others, as bytes: so every process holds
the whole result, to the bit that of a single process, and takes the same decisions.
"""

import os
from typing import Any

import jax
import numpy as np
from jax.experimental import multihost_utils

from .devices import check_devices

BY_HAND = ("JAX_COORDINATOR_ADDRESS", "JAX_NUM_PROCESSES", "JAX_PROCESS_ID")
"""Environment of processes that were started by hand: host:port of the first, how many, which."""

STEP = ("SLURM_STEP_NODELIST", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID")
"""The same where `srun` starts them."""


def join_hosts() -> bool:
    """Join the other processes of this run, if the environment tells of any; True if there are.

    To be called before anything is computed: `jdsmc` on the command line does. Raises ValueError
    if the environment tells only a part, or of devices that are not here; RuntimeError if JAX was
    used before.
    """
    told = [name for name in BY_HAND if os.environ.get(name)]
    if told and len(told) < len(BY_HAND):
        missing = next(name for name in BY_HAND if name not in told)
        raise ValueError(
            f"{missing} is not set, but {told[0]} is; set all of {', '.join(BY_HAND)}."
        )
    if told:
        address, count, rank = (os.environ[name] for name in BY_HAND)
        jax.distributed.initialize(address, int(count), int(rank))
    elif all(name in os.environ for name in STEP) and int(os.environ[STEP[1]]) > 1:
        jax.distributed.initialize()
    check_devices()
    return jax.process_count() > 1


def is_first() -> bool:
    """True for the one process that writes files and shows progress."""
    return jax.process_index() == 0


def own(total: int) -> list[int]:
    """Numbers of the parts of a batch that this process advances; the first if it has no other."""
    return list(range(jax.process_index(), total, jax.process_count())) or [0]


def everywhere(parts: list, total: int) -> list:
    """All parts of a batch in order, on every process, from the `own` parts of each.

    Parts are pytrees of arrays, alike in shape.
    """
    if jax.process_count() == 1:
        return parts
    slots = -(-total // jax.process_count())
    texts = [b"".join(_bytes(leaf) for leaf in jax.tree.leaves(part)) for part in parts]
    length = len(texts[0])
    packed = b"".join(texts)[: slots * length].ljust(slots * length, b"\0")
    every = _gathered(packed)
    return [
        _like(parts[0], every[n % len(every)][(n // len(every)) * length :][:length])
        for n in range(total)
    ]


def any_of(*flags: bool) -> list[bool]:
    """For each flag, True if it is True in any process."""
    if jax.process_count() == 1:
        return list(flags)
    every = _gathered(bytes(flags))
    return [any(one[k] for one in every) for k in range(len(flags))]


def _gathered(text: bytes) -> list[bytes]:
    """The bytes of every process, as many from each."""
    words = np.frombuffer(text + b"\0" * (-len(text) % 4), np.uint32)
    return [np.asarray(one).tobytes() for one in multihost_utils.process_allgather(words)]


def _bytes(leaf: Any) -> bytes:
    return np.ascontiguousarray(leaf).tobytes()


def _like(part: Any, text: bytes) -> Any:
    """A part from its bytes; its structure, shapes and kinds are those of another."""
    leaves, structure = jax.tree.flatten(part)
    found, first = [], 0
    for leaf in leaves:
        one = np.asarray(leaf)
        found.append(np.frombuffer(text, one.dtype, one.size, first).reshape(one.shape))
        first += one.nbytes
    return jax.tree.unflatten(structure, found)
