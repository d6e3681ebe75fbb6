"""What is sampled of a gas for its derivatives: sums over particles and pairs, on the device.

Pairs of different particles are drawn from the present velocities, several partners of each, and
scattered in all directions or in a random one and its opposite (`after`). All velocities are
divided by a thermal speed before powers are taken, so that float32 is enough; the host multiplies
it back.
"""

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import lax

from .. import random
from ..collisions.sampled import pairs_per_particle, random_pairs, sampling_key
from ..gases.base import AbstractGas, pair_rate
from ..measure.polynomials import Powers, Symmetry
from ..motion.drive import centred, temperature_of
from ..types import Key, Scalar, Velocity
from .after import after, both
from .numbers import tangent

PAIRINGS = 2
"""Partners of each particle in a sample: the noise is that of pairs much more than of particles."""


class Sampler(NamedTuple):
    """What is sampled, static: polynomials to a degree, numbers of the gas by their path.

    `each`: sums are kept of each record, for derivatives along the time series; else of a chunk.
    `held`: the gas is held at its temperature, in units of whose speed averages then are; else
    they are absolute, and the thermal speed at the start of a chunk serves in between.
    """

    symmetry: Symmetry
    degree: int
    paths: tuple[str, ...]
    held: bool
    each: bool = False

    @property
    def basis(self) -> list[Powers]:
        """The trial functions."""
        return self.symmetry.basis(self.degree)

    @property
    def rows(self) -> list[Powers]:
        """What is averaged; begins with the trial functions."""
        return self.symmetry.basis(max(self.degree, self.symmetry.rows))

    def reference(self, velocity: Velocity) -> Scalar:
        """√T at the start of a chunk."""
        return jnp.sqrt(temperature_of(centred(velocity)))

    def sample(self, key: Key, gas: AbstractGas, velocity: Velocity, reference: Scalar) -> dict:
        """Sums at one instant, by name; units of the reference.

        `moments` (rows,) ⟨φ_k⟩, `second` (rows, trial) ⟨φ_k φ_l⟩. Of pairs: `source`
        (trial + 1,) the change of ⟨φ_k⟩ per time by collisions, and their number per particle;
        `response` (trial + 1, trial) the same times φ_l(1) + φ_l(2); `cubed` ⟨V12³⟩ and
        `cubed_response` (trial,); `tangents` (numbers, trial + 1) derivatives of `source`.
        """
        velocity = centred(velocity)
        if self.held:
            reference = jnp.sqrt(temperature_of(velocity))
        velocity = tuple(v / reference for v in velocity)
        count, trial = velocity[0].size, len(self.basis)
        values = _matrix(self.symmetry.values(velocity, self.rows))
        sums = {
            "reference": reference,
            "moments": _average(values),
            "second": values @ values[:trial].T / count,
        }

        def one(_, own):
            return None, self._of_pairs(own, gas, velocity, reference)

        keys = [random.fold_in(sampling_key(key), k) for k in range(PAIRINGS)]
        _, each = lax.scan(one, None, jax.tree.map(lambda *words: jnp.stack(words), *keys))
        return sums | jax.tree.map(lambda x: jnp.mean(x, axis=0), each)

    def _of_pairs(self, key: Key, gas, velocity: Velocity, reference) -> dict:
        pair = random_pairs(key, velocity)
        speed = jnp.sqrt(sum((a - b) ** 2 for a, b in zip(*pair, strict=True)))
        symmetry, basis = self.symmetry, self.basis
        before = both(symmetry, basis, *pair)
        per_particle = pairs_per_particle(velocity[0].size)

        arrays, rest = eqx.partition(gas, eqx.is_array)

        def changes(arrays):
            """Rate times change of every φ_k, and the rate: (trial + 1, pairs)."""
            gas = eqx.combine(arrays, rest)
            rate = pair_rate(gas, speed * reference) * per_particle
            then = after(symmetry, basis, key, gas, pair, reference)
            each = (rate * (a - b) for a, b in zip(then, before, strict=True))
            return _matrix([*each, rate])

        # the changes are worked out once, for all tangents too
        rates, along = jax.linearize(changes, arrays)
        found = [_average(along(tangent(arrays, path))) for path in self.paths]
        sums = _matrix(before)
        cubed = (speed * speed * speed).reshape(1, -1)
        pairs = speed.size
        return {
            "source": _average(rates),
            "response": rates @ sums.T / pairs,
            "cubed": _average(cubed)[0],
            "cubed_response": (cubed @ sums.T / pairs)[0],
            "tangents": jnp.stack(found) if found else jnp.zeros((0, len(basis) + 1)),
        }


def _matrix(values: list) -> Any:
    return jnp.stack([value.reshape(-1) for value in values])


def _average(values):
    """Along the last axis, in two stages for float32."""
    return jnp.mean(values, axis=-1)
