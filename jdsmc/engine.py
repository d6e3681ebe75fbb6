"""Compiled chunks of a batch of gases, shared among the cores or devices.

Every gas of the batch (sweep point x realization) has its own key and clock and never sees the
others, so the batch is cut into equal parts: one per device, or on a CPU one per core, run in
threads. An accelerator advances all gases of a part at once, a CPU one after the other. Random
numbers depend on point, realization and record alone, hence not on the cutting.
"""

import itertools
import os
from concurrent.futures import ThreadPoolExecutor

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from . import grid, random
from .options import Options


@eqx.filter_jit
def _start(scene, keys, options: Options):
    return eqx.filter_vmap(lambda s, k: s.initial(k, options), in_axes=(eqx.if_array(0), 0))(
        scene, keys
    )


TOGETHER = 20_000
"""Particles of a homogeneous gas that a CPU advances at once: with fewer, starting each operation
costs more than the operation."""


@eqx.filter_jit
def _advance(scene, keys, states, first_record, options: Options, together: int | None):
    """One chunk for every gas: records are (gases, records), samples (gases, ...)."""

    def one_gas(scene, key, state):
        key = random.fold_in(key, 1)

        def one_record(state, count):
            return scene.advance(random.fold_in(key, first_record + count), state, options)

        state, records = lax.scan(one_record, state, jnp.arange(options.records, dtype=jnp.uint32))
        state, sample = scene.finish_chunk(state)
        return state, (records, sample)

    each, common = eqx.partition((scene, keys, states), eqx.is_array)
    return lax.map(lambda gas: one_gas(*eqx.combine(gas, common)), each, batch_size=together)


class Engine:
    """A batch of gases under way. `advance` makes one chunk and returns its records as float64.

    Arguments: a scene whose numbers have shape (points,) (see `grid.flatten`), the number of
    realizations of each, the seed of the run, the options.
    """

    def __init__(self, scene, n_realizations: int, seed: int, options: Options):
        points = len(next(iter(grid.parameters(scene).values())))
        self.shape = (points, n_realizations)
        self.options = options
        self.chunks = 0
        batch = _cast(grid.take(scene, np.repeat(np.arange(points), n_realizations)), options)
        keys = _keys(seed, points, n_realizations)
        self._parts = _cut(points * n_realizations)
        self._devices = jax.devices()
        self._scenes = [self._place(batch, part) for part in self._parts]
        self._keys = [self._place(keys, part) for part in self._parts]
        self._states = [
            _start(s, k, options) for s, k in zip(self._scenes, self._keys, strict=True)
        ]
        self._pool = ThreadPoolExecutor(len(self._parts))

    def _place(self, tree, part: slice):
        number = self._parts.index(part)
        device = self._devices[number % len(self._devices)]
        arrays, rest = eqx.partition(tree, eqx.is_array)
        return eqx.combine(jax.device_put(jax.tree.map(lambda x: x[part], arrays), device), rest)

    def advance(self):
        """One chunk. Returns (records, sample): pytrees of arrays (points, realizations, ...)."""
        first = jnp.uint32(self.chunks * self.options.records)

        def work(number: int):
            state, output = _advance(
                self._scenes[number],
                self._keys[number],
                self._states[number],
                first,
                self.options,
                _together(self._parts[number], self.options),
            )
            return state, jax.tree.map(lambda x: np.asarray(x, dtype=float), output)

        numbers = range(len(self._parts))
        # The first part compiles for all; threads that start together would compile twice.
        compiled = [work(n) for n in numbers] if self.chunks == 0 else None
        done = compiled or list(self._pool.map(work, numbers))
        self._states = [state for state, _ in done]
        self.chunks += 1
        outputs = [output for _, output in done]
        return jax.tree.map(
            lambda *parts: np.concatenate(parts).reshape(self.shape + parts[0].shape[1:]),
            *outputs,
        )


def _cast(scene, options: Options):
    numbers, rest = eqx.partition(scene, grid.is_number)
    return eqx.combine(jax.tree.map(lambda x: jnp.asarray(x, options.dtype), numbers), rest)


def _keys(seed: int, points: int, n_realizations: int):
    base = random.key_from_seed(seed)
    point, realization = np.divmod(np.arange(points * n_realizations), n_realizations)
    each = jax.vmap(lambda p, r: random.fold_in(random.fold_in(base, p), r))
    return each(jnp.asarray(point, jnp.uint32), jnp.asarray(realization, jnp.uint32))


def _cut(size: int) -> list[slice]:
    """Parts of the batch: one per device, or per core of the machine if the device is a CPU."""
    on_cpu = jax.default_backend() == "cpu"
    workers = _cores() if on_cpu else len(jax.devices())
    edges = np.linspace(0, size, min(workers, size) + 1).astype(int)
    return [slice(int(a), int(b)) for a, b in itertools.pairwise(edges)]


def _together(part: slice, options: Options) -> int | None:
    """How many gases of a part are advanced as one; None for one after the other.

    A CPU is fastest with one gas at a time, which stays in its cache and whose scatters have plain
    indices (1.3 to 1.8 times as fast in space). Many small homogeneous gases are put together, as
    many as divide the part.
    """
    gases = part.stop - part.start
    if jax.default_backend() != "cpu":
        return gases
    largest = 1 if options.in_space else max(1, TOGETHER // options.n_particles)
    return max((n for n in range(2, largest + 1) if gases % n == 0), default=None)


def _cores() -> int:
    """Cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
