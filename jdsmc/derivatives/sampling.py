"""What is sampled of a gas for its derivatives: sums over particles and pairs, on the device.

Pairs of different particles are drawn from the present velocities, and scattered in all directions
or in a random one and its opposite (`after`). The distribution has a symmetry: the second particle
might as well have any of the mirrored velocities, `Symmetry.images`, with which the pair is looked
at too. All velocities are divided by a thermal speed before powers are taken, so that float32 is
enough; the host multiplies it back.
"""

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from .. import random
from ..collisions.sampled import pairs_per_particle, random_pairs, sampling_key, with_images
from ..gases.base import AbstractGas, pair_rate
from ..measure.polynomials import Powers, Symmetry
from ..motion.drive import centred, temperature_of
from ..types import Key, Pairs, Scalar, Velocity
from .after import after, both
from .numbers import tangent


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
        return sums | self._of_pairs(sampling_key(key), gas, velocity, reference)

    def _of_pairs(self, key: Key, gas, velocity: Velocity, reference) -> dict:
        images = with_images(random_pairs(key, velocity), self.symmetry.images)
        before = both(self.symmetry, self.basis, *images[0])  # the same for all images
        arrays, rest = eqx.partition(gas, eqx.is_array)

        def changes(arrays):
            """Rate times change of every φ_k, and the rate: (trial + 1, pairs), over images."""
            gas = eqx.combine(arrays, rest)
            found = [
                self._changes(random.fold_in(key, number), gas, pair, before, reference)
                for number, pair in enumerate(images)
            ]
            return pairs_per_particle(velocity[0].size) * _mean(found)

        # the changes are worked out once, for all tangents too
        rates, along = jax.linearize(changes, arrays)
        found = [_average(along(tangent(arrays, path))) for path in self.paths]
        sums = _matrix(before)
        cubed = _mean([_speed(pair) ** 3 for pair in images]).reshape(1, -1)
        pairs = cubed.size
        return {
            "source": _average(rates),
            "response": rates @ sums.T / pairs,
            "cubed": _average(cubed)[0],
            "cubed_response": (cubed @ sums.T / pairs)[0],
            "tangents": jnp.stack(found) if found else jnp.zeros((0, len(self.basis) + 1)),
        }

    def _changes(self, key: Key, gas, pair: Pairs, before: list, reference):
        speed = _speed(pair)
        rate = pair_rate(gas, speed * reference)
        then = after(self.symmetry, self.basis, key, gas, pair, reference)
        return _matrix([*(rate * (a - b) for a, b in zip(then, before, strict=True)), rate])


def _speed(pair: Pairs):
    """The relative speed."""
    return jnp.sqrt(sum((a - b) ** 2 for a, b in zip(*pair, strict=True)))


def _mean(values: list) -> Any:
    return sum(values) / len(values)


def _matrix(values: list) -> Any:
    return jnp.stack([value.reshape(-1) for value in values])


def _average(values):
    """Along the last axis, in two stages for float32."""
    return jnp.mean(values, axis=-1)
