"""Chunks of gases whose steps are plain Python (an event-driven simulation, say), on all cores."""

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import jax
import numpy as np

from .. import sweep
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from . import hosts
from .batch import cores, gathered


class HostEngine:
    """The twin of `Engine` for scenes that are not traced.

    A key is a NumPy seed sequence; `initial` and `advance` of the scene see one gas, and should
    release the interpreter's lock while they work.
    """

    def __init__(
        self, scenes: list[AbstractScene], n_realizations: int, seed: int, options: Options
    ):
        self.shape = (len(scenes), n_realizations)
        self.options = options
        self.chunks = 0
        self.watched: Any = None
        batch = [(scene, r) for scene in scenes for r in range(n_realizations)]
        self.parts = len(batch)
        own = [batch[number] for number in hosts.own(self.parts)]
        self._scenes = [scene for scene, _ in own]
        self._keys = [(seed, *sweep.fingerprint(scene), r) for scene, r in own]
        self._pool = ThreadPoolExecutor(cores())
        work = zip(self._scenes, self._keys, strict=True)
        self.states: list[Any] = list(
            self._pool.map(
                lambda one: one[0].initial(np.random.SeedSequence(one[1]), options), work
            )
        )

    def all_states(self) -> list:
        """The states of all gases, of other processes too."""
        return hosts.everywhere([jax.tree.map(np.asarray, one) for one in self.states], self.parts)

    def take(self, states: list, chunks: int) -> None:
        """Go on from these states of all gases, after so many chunks."""
        own = [states[number] for number in hosts.own(self.parts)]
        self.states = [jax.tree.map(np.array, state) for state in own]
        self.chunks = int(chunks)

    def advance(self, watch: bool = False):
        """One chunk. Returns (records, sample): pytrees of arrays (points, realizations, ...).

        `watch`: as of `Engine`; nothing is sampled for derivatives here.
        """

        def work(number: int):
            scene, state = self._scenes[number], self.states[number]
            records = []
            for count in range(self.options.records):
                index = self.chunks * self.options.records + count
                key = np.random.SeedSequence((*self._keys[number], index))
                state, record = scene.advance(key, state, self.options)
                records.append(record)
            stacked = jax.tree.map(
                lambda *x: np.stack([np.asarray(y, dtype=float) for y in x])[None], *records
            )
            state, sample = scene.finish_chunk(state)
            return state, (stacked, jax.tree.map(lambda x: np.asarray(x)[None], sample))

        done = list(self._pool.map(work, range(len(self._scenes))))
        self.states = [state for state, _ in done]
        self.chunks += 1
        outputs = hosts.everywhere([output for _, output in done], self.parts)
        return gathered(outputs, self.shape)
