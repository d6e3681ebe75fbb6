"""The generator against published vectors and jax's own, and the numbers made from its words."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import random
from jdsmc.types import Key

# Known-answer tests of Random123 1.14 (file kat_vectors): rounds, counter, key, answer.
PI = (0x243F6A88, 0x85A308D3), (0x13198A2E, 0x03707344)
VECTORS = [
    (13, (0, 0), (0, 0), (0x9D1C5EC6, 0x8BD50731)),
    (13, (0xFFFFFFFF, 0xFFFFFFFF), (0xFFFFFFFF, 0xFFFFFFFF), (0xFD36D048, 0x2D17272C)),
    (13, *PI, (0xBA3E4725, 0xF27D669E)),
    (20, (0, 0), (0, 0), (0x6B200159, 0x99BA4EFE)),
    (20, (0xFFFFFFFF, 0xFFFFFFFF), (0xFFFFFFFF, 0xFFFFFFFF), (0x1CB996FC, 0xBB002BE7)),
    (20, *PI, (0xC4923A9C, 0x483DF7A0)),
]


@pytest.mark.parametrize("rounds, counter, key, answer", VECTORS)
def test_known_answers(rounds, counter, key, answer):
    words = random.threefry(Key(*map(jnp.uint32, key)), *map(jnp.uint32, counter), rounds=rounds)
    assert tuple(int(w) for w in words) == answer


def test_twenty_rounds_equal_jax():
    """jax.random's threefry on the same key and counter gives the same words."""
    key = jnp.array([123, 456], jnp.uint32)
    theirs = jax.extend.random.threefry_2x32(key, jnp.array([7, 8], jnp.uint32))
    ours = random.threefry(Key(key[0], key[1]), jnp.uint32(7), jnp.uint32(8), rounds=20)
    assert [int(w) for w in ours] == [int(w) for w in theirs]


def test_uniform_numbers():
    """Mean 1/2, variance 1/12, no correlation: each within 4.5 standard errors of n = 2^20."""
    n = 2**20
    words = random.bits(random.key_from_seed(1), (1024, 1024))
    numbers = [np.asarray(u, float).ravel() for u in random.three_uniforms(words, jnp.float32)]
    for u in numbers:
        assert u.min() > 0 and u.max() < 1
        assert abs(u.mean() - 0.5) < 4.5 / np.sqrt(12 * n)
        assert abs(u.var() - 1 / 12) < 4.5 / np.sqrt(180 * n)
    for a, b in ((0, 1), (0, 2), (1, 2)):
        assert abs(np.corrcoef(numbers[a], numbers[b])[0, 1]) < 4.5 / np.sqrt(n)


def test_whole_numbers_below_are_the_exact_upper_words():
    rng = np.random.default_rng(0)
    ends = np.array([0, 1, 0xFFFF, 0x10000, 0x7FFFFFFF, 0xFFFFFFFF], np.uint32)
    word, count = np.meshgrid(np.append(ends, rng.integers(0, 2**32, 500)), ends[1:])
    found = random.below(jnp.asarray(word, jnp.uint32), jnp.asarray(count, jnp.uint32))
    exact = word.astype(object) * count.astype(object) // 2**32
    assert np.array_equal(np.asarray(found).astype(object), exact)


def test_three_uniforms_use_every_bit_once():
    """21 + 21 + 22 bits: the words can be put together again from the three numbers."""
    words = random.bits(random.key_from_seed(2), (64,))
    with jax.enable_x64(True):
        a, b, c = (np.asarray(u) for u in random.three_uniforms(words, jnp.float64))
    whole = [(u * 2.0**n - 0.5).astype(np.uint64) for u, n in ((a, 21), (b, 21), (c, 22))]
    first = (whole[0] << np.uint64(11)) | (whole[1] >> np.uint64(10))
    second = ((whole[1] & np.uint64(0x3FF)) << np.uint64(22)) | whole[2]
    np.testing.assert_array_equal(first, np.asarray(words[0]))
    np.testing.assert_array_equal(second, np.asarray(words[1]))


def test_normal_numbers():
    """First four moments of 2^20 normal pairs within 4.5 standard errors."""
    n = 2**20
    x, y = random.normal_pair(random.bits(random.key_from_seed(3), (n,)), jnp.float32)
    for z in (np.asarray(x, float), np.asarray(y, float)):
        for power, mean, variance in ((1, 0, 1), (2, 1, 2), (3, 0, 15), (4, 3, 96)):
            assert abs(np.mean(z**power) - mean) < 4.5 * np.sqrt(variance / n)


@pytest.mark.parametrize("n", [2, 3, 7, 80])
def test_permutation_is_uniform(n):
    """Where the first element goes, and which pair comes first: chi-square at 4.5 sigma."""
    draws = 4000
    keys = jax.vmap(lambda i: random.fold_in(random.key_from_seed(4), i))(jnp.arange(draws))
    orders = np.asarray(jax.vmap(lambda k: random.permutation(k, n))(keys))
    assert np.all(np.sort(orders, axis=1) == np.arange(n))
    pairs = orders[:, 0] * n + orders[:, 1]
    counts = np.bincount(pairs, minlength=n * n).reshape(n, n)
    assert np.all(np.diag(counts) == 0)
    expected = draws / (n * (n - 1))
    chi = np.sum((counts[~np.eye(n, dtype=bool)] - expected) ** 2 / expected)
    freedom = n * (n - 1) - 1
    assert abs(chi - freedom) < 4.5 * np.sqrt(2 * freedom)


def test_keys_do_not_repeat():
    """Folding in 10^5 numbers gives 10^5 different keys (a collision has probability 3e-10)."""
    keys = jax.vmap(lambda i: random.fold_in(random.key_from_seed(5), i))(jnp.arange(100_000))
    whole = np.asarray(keys.high).astype(np.uint64) << np.uint64(32) | np.asarray(keys.low)
    assert len(np.unique(whole)) == 100_000


@pytest.mark.parametrize("seed", [-1, 2**64])
def test_bad_seed(seed):
    with pytest.raises(ValueError, match="seed"):
        random.key_from_seed(seed)


def test_uniform_numbers_stay_inside():
    """The last word of all bits set, too: 1 would make an emitted or initial speed of zero."""
    ends = random.unit_interval(jnp.array([0, 0xFFFFFFFF], jnp.uint32), jnp.float32)
    assert 0.0 < float(ends[0]) < float(ends[1]) < 1.0
