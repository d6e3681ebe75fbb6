"""Sums over layers."""

import jax
import jax.numpy as jnp
import numpy as np

from jdsmc.motion.cells import PART, totals


def test_sums_of_millions_in_a_layer_do_not_round_away():
    """One after the other, 2.5 million squares in a layer lose a part in a thousand."""
    rng = np.random.default_rng(0)
    number = 5_000_000
    square = rng.chisquare(1, number).astype(np.float32)
    layer = (rng.random(number) < 0.5).astype(np.int32)
    found = jax.jit(lambda i, x: totals(i, x, 2))(jnp.asarray(layer), jnp.asarray(square))
    exact = np.bincount(layer, square.astype(float))
    # a part has 32,000 in a layer: rounding of its last terms is 2^-24 of 2^15 times as much
    assert np.all(np.abs(np.asarray(found) / exact - 1.0) < 2e-5)
    one_by_one = np.cumsum(square[layer == 0], dtype=np.float32)[-1] / exact[0] - 1.0
    assert one_by_one < -1e-3


def test_parts_add_up():
    """Whole numbers are exact, whatever the last part has."""
    for number in (1, PART, PART + 1, 3 * PART - 7):
        layer = jnp.arange(number, dtype=jnp.int32) % 5
        found = totals(layer, jnp.ones(number), 5)
        assert np.array_equal(np.asarray(found), np.bincount(np.asarray(layer), minlength=5))
