"""The queue: every flagged particle once, in the order of the numbers."""

import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc.motion.queue import Queue


@pytest.mark.parametrize("share", [0.0, 0.003, 0.4, 1.0])
@pytest.mark.parametrize("count", [1, 31, 32, 33, 1000])
def test_everybody_is_served_once_and_in_order(count, share):
    """Also in the last word, which is not full, and where words without a flag lie between."""
    flags = np.random.default_rng(count).random(count) < share
    queue, served, first = Queue.of(jnp.asarray(flags)), [], 0
    assert int(queue.length) == np.sum(flags)
    while first <= np.sum(flags):  # one round more than needed: it serves nobody
        number, taken = queue.next(jnp.asarray(first, jnp.int32), 16)
        assert np.all((np.asarray(number) >= 0) & (np.asarray(number) < count))
        served += list(np.asarray(number)[np.asarray(taken)])
        first += 16
    assert served == list(np.flatnonzero(flags))
