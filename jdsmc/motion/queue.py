"""Those few particles that something happens to, in the order of their numbers.

Flags of neighbours are packed into words and counted. The k-th flagged particle is then found by
bisection in the sums over words, and in the bits of one word: no sort, and no work for the other
particles but to count them.
"""

import equinox as eqx
import jax.numpy as jnp
from jax import lax
from jaxtyping import Array, Bool, Int32, UInt32

WORD = 32
"""Neighbours whose flags make a word."""

PARTICLES_A_PLACE = 64
"""One place for so many particles: five times those that hit a wall in a step of the default."""


def places_for(n_particles: int) -> int:
    """Places that are served at once: a size of arrays, not a limit."""
    return max(16, -(-n_particles // PARTICLES_A_PLACE))


class Queue(eqx.Module):
    """Flagged particles: `flags` in words, how many there are `before` each word, and in all."""

    flags: UInt32[Array, " words"]
    before: Int32[Array, " words"]
    length: Int32[Array, ""]

    @staticmethod
    def of(flags: Bool[Array, " particles"]) -> "Queue":
        """Those whose flag is set."""
        (count,) = flags.shape
        lanes = jnp.pad(flags, (0, -count % WORD)).reshape(-1, WORD).astype(jnp.uint32)
        words = jnp.sum(lanes << jnp.arange(WORD, dtype=jnp.uint32)[None], axis=1, dtype=jnp.uint32)
        number = lax.population_count(words).astype(jnp.int32)
        up_to = jnp.cumsum(number)
        return Queue(words, up_to - number, up_to[-1])

    def next(
        self, first: Int32[Array, ""], places: int
    ) -> tuple[Int32[Array, " places"], Bool[Array, " places"]]:
        """Numbers of the flagged particles from the `first` on, and which places are taken.

        An empty place has the number 0.
        """
        rank = first + jnp.arange(places, dtype=jnp.int32)
        taken = rank < self.length
        word = _last(lambda k: self.before[k] <= rank, self.before.shape[0], places)
        flags, rank = self.flags[word], rank - self.before[word]
        # the bit that has just `rank` others below it
        bit = _last(lambda k: _set_below(flags, k) <= rank, WORD, places)
        return jnp.where(taken, WORD * word + bit, 0), taken


def _last(holds, count: int, places: int) -> Int32[Array, " places"]:
    """The last index below `count` for which it holds, of what holds at first (at 0, too).

    Barriers keep XLA from computing each step again for every one that follows.
    """
    found = jnp.zeros(places, jnp.int32)
    for power in reversed(range((count - 1).bit_length())):
        probe = found + 2**power
        inside = probe < count
        better = inside & holds(jnp.minimum(probe, count - 1))
        found = lax.optimization_barrier(jnp.where(better, probe, found))
    return found


def _set_below(flags: UInt32[Array, " places"], bit: Int32[Array, " places"]):
    """Bits set below one of each word."""
    below = (jnp.uint32(1) << bit.astype(jnp.uint32)) - jnp.uint32(1)
    return lax.population_count(flags & below).astype(jnp.int32)
