"""A compiled scan inside vmap equals the plain Python loop (jax 0.10.x fails this on CPUs)."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import ElasticHardSpheres, InelasticHardSpheres, random
from jdsmc.scenarios import UniformShear

from . import helpers
from .helpers import f32, keys


@pytest.mark.parametrize("gas", [InelasticHardSpheres(0.7), ElasticHardSpheres(0.7, 0.85)])
def test_compiled_records_equal_the_loop(gas):
    """Three records of four steps, three realizations.

    Fused arithmetic rounds differently (1e-7 a step); the accept decisions are the same for this
    seed, so velocities agree to a few roundings: 1e-5.
    """
    options = helpers.options(512, steps=4)
    scene = jax.tree.map(f32, UniformShear(gas, 4.0))

    def simulate(key, loop):
        state = scene.initial(key, options)
        if not loop:
            state, records = jax.lax.scan(
                lambda s, n: scene.advance(random.fold_in(key, n), s, options),
                state,
                jnp.arange(3),
            )
            return state.velocity, records.tally.accepted
        accepted = []
        for n in range(3):
            state, record = scene.advance(random.fold_in(key, jnp.int32(n)), state, options)
            accepted.append(record.tally.accepted)
        return state.velocity, jnp.stack(accepted)

    three = keys(1, 3)
    compiled, accepted = jax.jit(jax.vmap(lambda k: simulate(k, loop=False)))(three)
    assert np.all(np.asarray(accepted) > 0)
    for r in range(3):
        with jax.disable_jit():
            velocity, count = simulate(jax.tree.map(lambda x, r=r: x[r], three), loop=True)
        np.testing.assert_array_equal(count, accepted[r])
        for ours, plain in zip(compiled, velocity, strict=True):
            np.testing.assert_allclose(ours[r], plain, atol=1e-5)
