"""The sheared gas of the benchmarks, and its bare step without measurement."""

from functools import partial

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from jdsmc import InelasticHardSpheres, random
from jdsmc.collisions.meet import Collisions
from jdsmc.collisions.whole import hits_per_particle
from jdsmc.motion.drive import temperature_of
from jdsmc.scenarios import Options, UniformShear
from jdsmc.scenarios.homogeneous import HomogeneousState
from jdsmc.scenarios.options import STEPS_PER_RECORD, TIME_STEP
from jdsmc.scenarios.pace import pace

SHEAR_RATE = 4.0
RECORDS_PER_CHUNK = 64 // STEPS_PER_RECORD  # as in jdsmc.run: 64 steps a chunk
SETTLING_RECORDS = 100  # 45 collisions per particle at the default step; the paper needs 40


def sheared_gas(restitution) -> UniformShear:
    """Inelastic hard spheres at a τ0 = 4; an array of restitutions is a sweep."""
    return UniformShear(InelasticHardSpheres(restitution), SHEAR_RATE)


def options(n_particles: int, time_step: float = TIME_STEP) -> Options:
    """The defaults of jdsmc.run."""
    return Options.checked(n_particles, time_step, "strang", "float32", STEPS_PER_RECORD)


class BareGas:
    """A batch of settled gases of which nothing but the step is computed.

    `advance` scans `scene.step` at a fixed time step and a fixed majorant, those of the steady
    state; of what happens only the tally of the collisions is kept.
    """

    def __init__(self, n_particles: int, gases: int, seed: int, restitution: float = 0.9):
        self.n_particles, self.options = n_particles, options(n_particles)
        scene = sheared_gas(restitution)
        self._scene = jax.tree.map(partial(jnp.asarray, dtype=jnp.float32), scene)
        base = random.key_from_seed(seed)
        self._keys = jax.vmap(partial(random.fold_in, base))(jnp.arange(gases, dtype=jnp.uint32))
        self._states = _settled(self._scene, self._keys, self.options)
        self._done = 0

    def advance(self, steps: int) -> tuple[float, float]:
        """That many steps. Returns: accepted collisions, candidates, both over all gases."""
        first = jnp.uint32(self._done)
        self._states, accepted, candidates = _steps(
            self._scene, self._keys, self._states, first, steps, self.options
        )
        self._done += steps
        return float(accepted), float(candidates)


@eqx.filter_jit
def _settled(scene, keys, options: Options):
    """Steady gases, one for each key."""

    def one_gas(key):
        def one_record(state, count):
            state, _ = scene.advance(random.fold_in(key, count), state, options)
            return state, None

        start = scene.initial(random.fold_in(key, 0), options)
        counts = jnp.arange(1, SETTLING_RECORDS + 1, dtype=jnp.uint32)
        return lax.scan(one_record, start, counts)[0]

    return jax.vmap(one_gas)(keys)


@eqx.filter_jit
def _steps(scene, keys, states, first, steps: int, options: Options):
    """`steps` steps of every gas, numbered from `first`; accepted collisions and candidates."""

    def one_gas(key, state):
        temperature = temperature_of(state.velocity)
        majorant, duration = pace(temperature, state.majorant, scene.shear_rate, options)
        key = random.fold_in(key, SETTLING_RECORDS + 1)

        def one_step(velocity, count):
            step_key = random.fold_in(key, first + count)
            return scene.step(step_key, velocity, majorant, duration, options)

        counts = jnp.arange(steps, dtype=jnp.uint32)
        velocity, tallies = lax.scan(one_step, state.velocity, counts)
        tally = Collisions.over(tallies)
        n_particles = options.rows.rows * options.rows.lanes
        hits = hits_per_particle(options.rows, majorant, duration) * steps
        return (
            HomogeneousState(velocity, state.majorant),
            tally,
            hits * n_particles / 2.0,
        )

    states, tally, candidates = jax.vmap(one_gas)(keys, states)
    return states, jnp.sum(tally.accepted), jnp.sum(candidates)
