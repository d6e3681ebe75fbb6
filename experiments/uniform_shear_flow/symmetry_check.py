"""The symmetry (3.21) of the marginal distributions, which `Result.distribution` has folded in.

`jdsmc` adds the two halves of eq. (5.3), so the check needs particles: the steps of the scene are
run here by hand, many small independent gases at once.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from jdsmc import random
from jdsmc.scenarios.options import Options

from .cases import FAST, scene

EDGES = np.linspace(-3.0, 3.0, 61)
RECORDS, STEPS = 16, 8
"""Records of a block and steps of a record."""

WARM_BLOCKS = 8
"""Blocks before the first sample: some 40 collisions per particle, twice the transient at 0.5."""


def check(n_gases: int, n_samples: int, restitution: float = 0.5, seed: int = 7) -> dict:
    """χ²/ν of g_x^(+)(C) - g_x^(-)(-C), and of g_y, for IHS.

    Every gas of 4096 particles gives one value in each bin, the mean of `n_samples` samples; the
    variance among gases gives the error, so that correlations in time do not matter.
    """
    gas = jax.tree.map(jnp.float32, scene("ihs", restitution, FAST))
    options = Options.checked(4096, 0.1, "strang", "float32", STEPS)
    keys = jax.vmap(lambda k: random.fold_in(random.key_from_seed(seed), k))(
        jnp.arange(n_gases, dtype=jnp.uint32)
    )
    states = _start(gas, keys, options)
    counts = []
    for block in range(n_samples + WARM_BLOCKS):
        states, halves = _block(gas, keys, states, jnp.uint32(block * RECORDS), options)
        if block >= WARM_BLOCKS:
            counts.append({name: np.asarray(value, float) for name, value in halves.items()})
    means = {name: np.mean([c[name] for c in counts], axis=0) for name in counts[0]}
    misfits = {k: _misfit(means[f"{k}+"], means[f"{k}-"][:, ::-1]) for k in "xy"}
    return {f"misfit_{k}": misfits[k][0] for k in "xy"} | {f"bins_{k}": misfits[k][1] for k in "xy"}


@eqx.filter_jit
def _start(gas, keys, options):
    return jax.vmap(lambda key: gas.initial(key, options))(keys)


@eqx.filter_jit
def _block(gas, keys, states, first, options):
    def one_gas(key, state):
        def record(state, count):
            state, _ = gas.advance(random.fold_in(key, 1 + first + count), state, options)
            return state, None

        state, _ = lax.scan(record, state, jnp.arange(RECORDS, dtype=jnp.uint32))
        state, _ = gas.finish_chunk(state)
        return state, _halves(state.velocity)

    return jax.vmap(one_gas)(keys, states)


def _halves(velocity) -> dict:
    """Histograms of C_x for C_y > 0 and C_y < 0, and of C_y for C_x > 0 and C_x < 0."""
    scale = jnp.sqrt(1.5 / jnp.mean(sum(v * v for v in velocity)))
    cx, cy = (scale * v.ravel() for v in velocity[:2])

    def histogram(values, chosen):
        return jnp.histogram(values, jnp.asarray(EDGES), weights=chosen.astype(values.dtype))[0]

    return {
        "x+": histogram(cx, cy > 0),
        "x-": histogram(cx, cy < 0),
        "y+": histogram(cy, cx > 0),
        "y-": histogram(cy, cx < 0),
    }


def _misfit(plus: np.ndarray, minus: np.ndarray) -> tuple[float, int]:
    """Mean square of (difference/error) over the bins with enough particles, and their number."""
    difference = plus - minus
    count = len(difference)
    error = np.std(difference, axis=0, ddof=1) / np.sqrt(count)
    filled = np.mean(plus + minus, axis=0) > 1.0
    score = np.mean(difference, axis=0)[filled] / error[filled]
    expected = (count - 1) / (count - 3)  # mean square of Student's t
    return float(np.mean(score**2) / expected), int(filled.sum())
