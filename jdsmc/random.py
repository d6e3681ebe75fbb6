"""Counter-based random numbers: Threefry-2x32 written out, so that XLA fuses it.

`jax.random.bits` costs 14 to 18 ns a number on a CPU; this costs about 0.4 ns, because the
rounds are unrolled elementwise integer arithmetic. Algorithm and constants: Salmon, Moraes, Dror
and Shaw, "Parallel random numbers: as easy as 1, 2, 3" (SC11); 13 rounds is the fewest that
passes BigCrush there, 20 is the recommended safety margin (used for keys).
"""

from enum import IntEnum

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Int

from .types import Key, Word


class Stream(IntEnum):
    """Who uses which random numbers of the key of one step.

    A scene takes its own from `OWN` on: `bits(key, shape, Stream.OWN + k)` for any k >= 0.
    """

    ROWS = 0  # which rows of a homogeneous gas are candidates
    SHIFT = 1  # how their lanes are shifted
    FIRST_WAVE = 2  # acceptance and direction of the first wave of pairs
    SECOND_WAVE = 3
    SEATS = 4  # who sits where in a cell
    FIRST_SEATS = 5  # acceptance and direction of the pairs in the seats
    SECOND_SEATS = 6
    FLIGHT = 16  # emission at walls: two streams for each hit of a step, up to 215
    OWN = 1024  # free for the scenes of users, and for what a scene draws beside collisions


_ROTATIONS = (13, 15, 26, 6, 17, 29, 16, 24)
_PARITY = 0x1BD11BDA
_FOLD = 0x6A64736D


def threefry(key: Key, high: Word, low: Word, rounds: int = 13) -> tuple[Word, Word]:
    """Two random words for each pair of counter words.

    Arguments: `key`, two scalar words; `high`, `low`, counter words of broadcastable shape.
    Returns: two uint32 arrays of that shape. Different counters give independent words.
    """
    return _threefry((key.high, key.low), high, low, rounds)


def _threefry(key: tuple, high, low, rounds: int) -> tuple:
    """The same of arrays of NumPy or JAX."""
    schedule = (*key, key[0] ^ key[1] ^ np.uint32(_PARITY))
    high, low = high + schedule[0], low + schedule[1]
    for i in range(rounds):
        high = high + low
        rotation = _ROTATIONS[i % 8]
        low = ((low << rotation) | (low >> (32 - rotation))) ^ high
        if i % 4 == 3:
            j = i // 4 + 1
            high = high + schedule[j % 3]
            low = low + schedule[(j + 1) % 3] + np.uint32(j)
    return high, low


def key_from_seed(seed: int) -> Key:
    """The key of a run. `seed` is any integer from 0 to 2^64 - 1."""
    if not 0 <= seed < 2**64:
        raise ValueError(f"seed = {seed} is outside the allowed range [0, 2^64).")
    return Key(jnp.uint32(seed >> 32), jnp.uint32(seed & 0xFFFFFFFF))


def fold_in(key: Key, data) -> Key:
    """A new key for each integer `data`: the n-th realization, record or step of a run."""
    return Key(*threefry(key, jnp.asarray(data, jnp.uint32), jnp.uint32(_FOLD), rounds=20))


def keys_of_run(seed: int, number: tuple[int, ...], count: int) -> list[Key]:
    """Keys of the realizations of one point: its numbers, then that of each, folded in.

    On the host: for a few keys, tracing takes longer than all rounds.
    """
    words = [np.asarray(word)[None] for word in key_from_seed(seed)]
    fold = np.uint32(_FOLD)
    for one in number:
        words = _threefry(tuple(words), np.array([one], np.uint32), fold, 20)
    high, low = _threefry(tuple(words), np.arange(count, dtype=np.uint32), fold, 20)
    return [Key(*both) for both in zip(high, low, strict=True)]


def bits(key: Key, shape: tuple[int, ...], stream=0) -> tuple[Word, Word]:
    """Two independent arrays of 32 random bits, of the given shape (at most 2^32 elements).

    What needs several such arrays within a step takes them from different `stream`s of one key:
    that costs nothing, where a new key costs twenty rounds in scalars, to compile and to run.
    """
    return words(key, jnp.arange(int(np.prod(shape)), dtype=jnp.uint32).reshape(shape), stream)


def words(key: Key, number: Array, stream=0) -> tuple[Word, Word]:
    """What `bits` has at these places of its arrays: for those few that need random numbers."""
    return threefry(key, number.astype(jnp.uint32), jnp.asarray(stream, jnp.uint32))


def unit_interval(word: Word, dtype, n_bits: int = 23):
    """Uniform numbers in (0, 1) from the leading `n_bits` of each word: midpoints of 2^n cells.

    23 bits are the most whose midpoints are float32 numbers: that of the last of 2^24 cells is 1.
    """
    return ((word >> (32 - n_bits)).astype(dtype) + 0.5) * 2.0**-n_bits


def below(word: Word, count: Word) -> Word:
    """Integers from 0 to count - 1: the upper word of the product of each word with its `count`.

    Each is as likely as the others to count/2^32, where a number of 23 bits times `count` misses
    some beyond 2^23 and has others twice as often before.
    """
    low, high = word & 0xFFFF, word >> 16
    count_low, count_high = count & 0xFFFF, count >> 16
    upper = high * count_low + (low * count_low >> 16)
    lower = low * count_high + (upper & 0xFFFF)
    return high * count_high + (upper >> 16) + (lower >> 16)


def three_uniforms(words: tuple[Word, Word], dtype):
    """Three uniform numbers in (0, 1) of 21, 21 and 22 bits from two words.

    A collision needs one number to accept and two for a direction. Midpoints make their means
    exact; the discreteness changes a variance by a factor 1 - 2^-42.
    """
    first, second = words
    middle = ((first & 0x7FF) << 10) | (second >> 22)
    return (
        unit_interval(first, dtype, 21),
        (middle.astype(dtype) + 0.5) * 2.0**-21,
        ((second & 0x3FFFFF).astype(dtype) + 0.5) * 2.0**-22,
    )


def normal_pair(words: tuple[Word, Word], dtype):
    """Two independent standard normal numbers from two words (Box and Muller)."""
    radius = jnp.sqrt(-2.0 * jnp.log(unit_interval(words[0], dtype)))
    angle = (2.0 * np.pi) * unit_interval(words[1], dtype)
    return radius * jnp.cos(angle), radius * jnp.sin(angle)


def sin_cos_turns(turns):
    """sin and cos of 2π·turns for 0 <= turns <= 1, to 1e-6, an order faster than XLA's on a CPU.

    Taylor polynomials of a quarter of the angle, shifted to [-π/4, π/4], doubled twice; the shift
    by half a turn is a change of sign that a uniform angle would not notice, undone all the same.
    """
    t = (turns - 0.5) * (np.pi / 2.0)
    s = t * t
    sine = t * (1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0))))
    cosine = 1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0)))
    for _ in range(2):
        sine, cosine = 2.0 * sine * cosine, 1.0 - 2.0 * sine * sine
    return -sine, -cosine


def permutation(key: Key, n: int, stream=0) -> Int[Array, " n"]:
    """A random permutation of n by sorting random words: for few elements (rows, not particles).

    Ties of 32-bit words (probability n^2 / 2^33) are broken by position, a bias below 10^-6 for
    the at most 2^11 rows used here.
    """
    return jnp.argsort(bits(key, (n,), stream)[0])


def normals(key: Key, like: tuple, stream: int) -> tuple:
    """Independent standard normal numbers, one array for each of `like`, of its shape and dtype.

    Drawn in every step: four times as fast as `normal_pair`, by polynomials for the angle.
    """
    shape, dtype, numbers = like[0].shape, like[0].dtype, []
    for k in range((len(like) + 1) // 2):
        first, second = bits(key, shape, stream + k)
        radius = jnp.sqrt(-2.0 * jnp.log(unit_interval(first, dtype)))
        sine, cosine = sin_cos_turns(unit_interval(second, dtype))
        numbers += [radius * cosine, radius * sine]
    return tuple(numbers[: len(like)])
