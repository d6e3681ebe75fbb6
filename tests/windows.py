"""Averages of each realization over a window: what exact balances are tested with."""

import numpy as np

from jdsmc import sweep
from jdsmc.running.engine import Engine
from jdsmc.running.history import History
from jdsmc.scenarios.options import Options


def window(scene, chunks, skip, **options):
    """Averages (realizations, ...) of one scene over its chunks from `skip` on."""
    history, records = simulate(scene, chunks, **options)
    return history.point(0, skip * records, history.length)


def simulate(scene, chunks, *, n_particles=4000, n_realizations=16, seed=1, **options):
    """The history of one scene, and the records of a chunk."""
    chosen = dict(time_step=0.1, splitting="strang", dtype="float32", steps=8) | options
    scenes, _ = sweep.points(scene)
    sizes = {"samples": scene.samples_per_record, "in_space": scene.in_space}
    fitted = scenes[0].fit_options(Options.checked(n_particles, **chosen, **sizes))
    engine = Engine(scenes, n_realizations, seed, fitted)
    history = History(scenes, n_particles, fitted.steps)
    for _ in range(chunks):
        history.append(*engine.advance())
    return history, fitted.records


def within(difference, sigmas=4.5):
    """The mean over realizations is zero within that many of its standard errors."""
    error = np.std(difference, ddof=1) / np.sqrt(len(difference))
    return abs(np.mean(difference)) < sigmas * error


def relative_error(values):
    """Standard error of the mean over realizations, relative to the mean."""
    return np.std(values, ddof=1) / np.sqrt(len(values)) / abs(np.mean(values))
