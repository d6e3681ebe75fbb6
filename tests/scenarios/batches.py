"""Batches of one scene without a run around them: what exact balances are tested with."""

from dataclasses import replace

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from jdsmc import random, sweep
from jdsmc.running.engine import Engine
from jdsmc.running.estimates import estimates_of
from jdsmc.running.history import History
from jdsmc.scenarios import Options


def window(scene, chunks, skip, **options):
    """Averages (realizations, ...) of one scene over its chunks from `skip` on."""
    history, records = simulate(scene, chunks, **options)
    return history.point(0, skip * records, history.length)


def observed(scene, chunks, skip, **options):
    """Observables and their errors over the chunks from `skip` on, whether or not it is steady."""
    history, records = simulate(scene, chunks, **options)
    means = history.point(0, skip * records, history.length)
    value, error, _ = estimates_of(history.scenes[0], means, None)
    return value, error


def simulate(scene, chunks, *, n_particles=4000, n_realizations=16, seed=1, records=8, **options):
    """The history of one scene, and the records of a chunk."""
    chosen = dict(time_step=0.1, splitting="strang", dtype="float32", steps=8) | options
    sizes = replace(Options.checked(n_particles, **chosen), records=records)
    scenes, _ = sweep.points(scene)
    engine = Engine(scenes, n_realizations, seed, sizes)
    history = History(scenes, n_particles, sizes.steps)
    for _ in range(chunks):
        history.append(*engine.advance())
    return history, records


def within(difference, sigmas=4.5):
    """The mean over realizations is zero within that many of its standard errors."""
    return abs(np.mean(difference)) < sigmas * standard_error(difference)


def standard_error(values, axis=0):
    """Of the mean over realizations."""
    return np.std(values, axis=axis, ddof=1) / np.sqrt(np.shape(values)[axis])


def relative_error(values):
    """Standard error of the mean over realizations, relative to the mean."""
    return standard_error(values) / abs(np.mean(values))


def keys(seed, count):
    """Keys of several realizations."""
    base = random.key_from_seed(seed)
    return jax.vmap(lambda r: random.fold_in(base, r))(jnp.arange(count))


def f32(x):
    """A number as the step sees it."""
    return jnp.asarray(x, jnp.float32)


def traced(scene):
    """The scene with its numbers as the step sees them."""
    numbers, rest = eqx.partition(scene, sweep.is_number)
    return eqx.combine(jax.tree.map(f32, numbers), rest)
