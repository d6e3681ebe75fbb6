"""Compiled chunks of a batch of gases, shared among the cores, devices and hosts.

Every gas of the batch (sweep point x realization) has its own key and clock and never sees the
others. The batch is cut into groups of one size, each advanced by the same program, whatever their
number: so random numbers and roundings depend on the gas alone, not on the sweep, the cores
or the hosts, and a sweep of other length compiles nothing new.
"""

from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from .. import random, sweep
from ..derivatives.sampling import Sampler
from ..own_code import Code
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from . import hosts
from .batch import cores, gathered

TOGETHER = 20_480
"""Particles of a homogeneous gas that a CPU advances at once: with fewer, starting each operation
costs more than the operation."""

MOST_TOGETHER = 4
"""Gases of a group on a CPU: eight realizations still fill two cores."""


class Engine:
    """A batch of gases under way. `advance` makes one chunk and returns its records as float64.

    Arguments: the scene of each point, the number of realizations of each, the seed of the run,
    the options; what is sampled for derivatives, if anything: `watched` then has the averages of
    the last chunk, or of each of its records.
    """

    def __init__(
        self,
        scenes: list[AbstractScene],
        n_realizations: int,
        seed: int,
        options: Options,
        sampler: Sampler | None = None,
    ):
        self.shape = (len(scenes), n_realizations)
        self.options, self.sampler = options, sampler
        self.watched: Any = None
        self.chunks = 0
        batch = [scene for scene in scenes for _ in range(n_realizations)]
        keys = [key for scene in scenes for key in gas_keys(scene, n_realizations, seed)]
        size, devices = group_size(len(batch), scenes[0], options), jax.local_devices()
        self._scenes, self._keys = [], []
        self.parts = -(-len(batch) // size)
        for count, number in enumerate(hosts.own(self.parts)):
            first, device = number * size, devices[count % len(devices)]
            self._scenes.append(_placed(_group(batch, first, size), device, options))
            self._keys.append(jax.device_put(_stacked(_group(keys, first, size)), device))
        self._code, self._wide = Code(scenes[0]), bool(jax.config.read("jax_enable_x64"))
        work = list(zip(self._scenes, self._keys, strict=True))
        self._pool = ThreadPoolExecutor(min(len(work), max(cores(), len(devices))))
        self.states: list[Any] = self._share(
            lambda n: _start(work[n][0], work[n][1], options, self._code)
        )

    def advance(self, watch: bool = True):
        """One chunk. Returns (records, sample): pytrees of arrays (points, realizations, ...).

        `watch`: sample for derivatives too; without it `watched` has zeros.
        """
        first = jnp.uint32(self.chunks * self.options.records)

        def work(number: int):
            kept = self._scenes[number], self._keys[number], first, np.bool_(watch)
            state, output = _advance(
                kept, self.states[number], self.options, self.sampler, self._code
            )
            return state, jax.tree.map(lambda x: np.asarray(x, dtype=float), output)

        done = self._share(work)
        self.states = [state for state, _ in done]
        self.chunks += 1
        outputs = hosts.everywhere([output for _, output in done], self.parts)
        record, sample, self.watched = gathered(outputs, self.shape)
        return record, sample

    def all_states(self) -> list:
        """The states of all groups, of other processes too, as NumPy arrays (copies)."""
        return hosts.everywhere([jax.tree.map(np.array, one) for one in self.states], self.parts)

    def take(self, states: list, chunks: int) -> None:
        """Go on from these states of all groups, after so many chunks."""
        states = [states[number] for number in hosts.own(self.parts)]
        devices = [jax.tree.leaves(keys)[0].device for keys in self._keys]
        placed = zip(states, devices, strict=True)
        own = [(jax.tree.map(np.array, state), device) for state, device in placed]
        self.states = [jax.device_put(state, device) for state, device in own]
        self.chunks = int(chunks)

    def _share(self, work) -> list:
        """Work for every group; the first compiles for all, threads at once would compile twice."""
        numbers = range(len(self._scenes))
        first = [work(0)] if self.chunks == 0 else []

        def in_thread(number: int):
            with jax.enable_x64(self._wide):  # as where the engine was made: threads do not know
                return work(number)

        return first + list(self._pool.map(in_thread, numbers[len(first) :]))


@eqx.filter_jit
def _start(scene, keys, options: Options, code: Code):
    return _each(lambda s, k: s.initial(k, options), scene, keys)


@eqx.filter_jit(donate="all-except-first")
def _advance(kept, states, options: Options, sampler: Sampler | None, code: Code):
    """One chunk for every gas: records are (gases, records, ...), samples (gases, ...).

    `code` tells one program from another: what scene and gas do, if they are the user's own.
    The states are overwritten: two copies of a gas would be half of all memory.
    """
    scene, keys, first_record, watch = kept

    def one_gas(scene, key, state):
        key = random.fold_in(key, 1)
        reference = None if sampler is None else sampler.reference(state.velocity)

        def one_record(state, count):
            own = random.fold_in(key, first_record + count)
            sums = None
            if sampler is not None and reference is not None:
                looked_at = partial(sampler.sample, own, scene.gas, state.velocity, reference)
                sums = _only_if(watch, looked_at)
            state, record = scene.advance(own, state, options)
            return state, (record, sums)

        counts = jnp.arange(options.records, dtype=jnp.uint32)
        state, (records, sums) = lax.scan(one_record, state, counts)
        one = sampler is None or sampler.each
        watched = sums if one else jax.tree.map(lambda x: jnp.mean(x, axis=0)[None], sums)
        state, sample = scene.finish_chunk(state)
        return state, (records, sample, watched)

    return _each(one_gas, scene, keys, states)


def _only_if(asked, function):
    """What a function returns, or zeros without calling it; the same for all gases."""

    def nothing():
        return jax.tree.map(lambda x: jnp.zeros(x.shape, x.dtype), jax.eval_shape(function))

    return lax.cond(asked, function, nothing)


def _each(function, *trees):
    """The function of every gas of a group; of a single one without a batch axis inside.

    A CPU is fastest with one gas at a time, which stays in its cache and whose scatters have plain
    indices (1.3 to 1.8 times as fast in space).
    """
    arrays, rest = eqx.partition(trees, eqx.is_array)

    def one(arrays):
        return function(*eqx.combine(arrays, rest))

    if len(jax.tree.leaves(arrays)[0]) > 1:
        return jax.vmap(one)(arrays)
    single = one(jax.tree.map(lambda x: x[0], arrays))
    return jax.tree.map(lambda x: x[None], single)


def gas_keys(scene: AbstractScene, n_realizations: int, seed: int) -> list:
    """A key for every realization of one point: from the seed and the values of its numbers."""
    return random.keys_of_run(seed, sweep.fingerprint(scene), n_realizations)


def group_size(gases: int, scene: AbstractScene, options: Options) -> int:
    """Gases of a group: few on a CPU, chosen from N alone; an equal share on an accelerator."""
    if jax.default_backend() != "cpu":
        return -(-gases // jax.device_count())
    if scene.in_space:
        return 1
    return min(MOST_TOGETHER, max(1, TOGETHER // options.n_particles))


def _group(items: list, first: int, size: int) -> list:
    """`size` items from `first` on; the last one again where there are too few."""
    return [items[min(k, len(items) - 1)] for k in range(first, first + size)]


def _stacked(keys: list):
    return jax.tree.map(lambda *words: np.stack(words), *keys)


def _placed(scenes: list, device, options: Options):
    numbers, rest = eqx.partition(sweep.stack(scenes), sweep.is_number)
    cast = jax.tree.map(lambda x: jnp.asarray(x, options.dtype), numbers)
    return eqx.combine(jax.device_put(cast, device), rest)
