"""The direction of collisions: what is easy to get wrong in DSMC (spheres and disks)."""

import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import InelasticHardSpheres, random
from jdsmc.gases.scatter import elastic_outgoing
from jdsmc.random import sin_cos_turns

N = 2**20


def _outgoing(relative):
    """Outgoing relative velocities of N collisions with the same ingoing one, in float64."""
    words = random.bits(random.key_from_seed(1), (N,))
    a, b, _ = random.three_uniforms(words, jnp.float32)
    g = tuple(jnp.full(N, x, jnp.float32) for x in relative)
    speed = jnp.sqrt(sum(x * x for x in g))
    return g, elastic_outgoing(g, speed, a, b)


def test_sin_and_cos():
    """Truncation of the polynomials is 4e-8; doubling twice and float32 leave 1e-6."""
    turns = jnp.linspace(0, 1, 10_001, dtype=jnp.float32)
    sine, cosine = sin_cos_turns(turns)
    exact = 2 * np.pi * np.asarray(turns, float)
    np.testing.assert_allclose(sine, np.sin(exact), atol=1e-6)
    np.testing.assert_allclose(cosine, np.cos(exact), atol=1e-6)


@pytest.mark.parametrize("relative", [(0.3, -1.2, 0.8), (0.0, 0.0, 2.0), (0.5, -1.5), (1.0, 0.0)])
def test_elastic_collision_keeps_the_relative_speed(relative):
    """To float32 rounding and the 1e-6 of the sine and cosine."""
    _, outgoing = _outgoing(relative)
    speed = np.sqrt(sum(np.asarray(x, float) ** 2 for x in outgoing))
    np.testing.assert_allclose(speed, np.linalg.norm(relative), rtol=4e-6)


def test_spheres_scatter_isotropically():
    """⟨e_i⟩ = 0 and ⟨e_i e_j⟩ = δ_ij/3 within 4.5 standard errors of N directions."""
    relative = (0.3, -1.2, 0.8)
    _, outgoing = _outgoing(relative)
    e = np.array([np.asarray(x, float) for x in outgoing]) / np.linalg.norm(relative)
    assert np.all(np.abs(e.mean(axis=1)) < 4.5 * np.sqrt(1 / 3 / N))
    second = e @ e.T / N
    # Var(e_i²) = 4/45, Var(e_i e_j) = 1/15
    assert np.all(np.abs(second - np.eye(3) / 3) < 4.5 * np.sqrt(4 / 45 / N))


def test_disks_have_a_uniform_impact_parameter():
    """σ̂ = (g - g')/|g - g'|: the sine of its angle to g is uniform in (-1, 1).

    First four moments within 4.5 standard errors. A uniform *angle* would give ⟨b²⟩ = 1/2.
    """
    relative = np.array([0.5, -1.5])
    _, outgoing = _outgoing(tuple(relative))
    change = relative[:, None] - np.array([np.asarray(x, float) for x in outgoing])
    normal = change / np.linalg.norm(change, axis=0)
    b = (relative[0] * normal[1] - relative[1] * normal[0]) / np.linalg.norm(relative)
    for power, mean in ((1, 0), (2, 1 / 3), (3, 0), (4, 1 / 5)):
        variance = 1 / (2 * power + 1) - mean**2
        assert abs(np.mean(b**power) - mean) < 4.5 * np.sqrt(variance / N)


@pytest.mark.parametrize(
    "relative, cosine_squared", [((0.3, -1.2, 0.8), 1 / 2), ((0.5, -1.5), 2 / 3)]
)
@pytest.mark.parametrize("restitution", [0.5, 0.9])
def test_energy_loss_per_collision(relative, cosine_squared, restitution):
    """(1-α²) m g²/4 ⟨cos²θ⟩, with ⟨cos²θ⟩ = 1/2 for spheres and 2/3 for disks.

    A uniform line of centres would give 1/3 and 1/2. Within 4.5 standard errors; the variance of
    cos²θ is 1/12 for spheres (uniform in cos²θ) and 4/45 for disks.
    """
    gas = InelasticHardSpheres(np.float32(restitution))
    g, outgoing = _outgoing(relative)
    transfer = gas.momentum_transfer(g, outgoing)
    exact = [np.asarray(x, float) for x in transfer]
    lost = sum(t * (x - t) for t, x in zip(exact, relative, strict=True))
    scale = (1 - restitution**2) / 4 * np.dot(relative, relative)
    error = np.sqrt((1 / 12 if len(relative) == 3 else 4 / 45) / N)
    assert abs(lost.mean() / scale - cosine_squared) < 4.5 * error


@pytest.mark.parametrize("relative", [(0.3, -1.2, 0.8), (0.5, -1.5)])
def test_collision_rule(relative):
    """Eq. (2.8): after the collision g'·σ̂ = -α g·σ̂ and the tangential part is unchanged."""
    restitution = 0.6
    g, outgoing = _outgoing(relative)
    transfer = InelasticHardSpheres(np.float32(restitution)).momentum_transfer(g, outgoing)
    t = np.array([np.asarray(x, float) for x in transfer])[:, :1000]
    normal = t / np.linalg.norm(t, axis=0)
    before = np.array(relative)[:, None]
    after = before - 2 * t
    # float32 rounding of the transfer, magnified by the division with small transfers
    np.testing.assert_allclose(
        np.sum(after * normal, axis=0),
        -restitution * np.sum(before * normal, axis=0),
        atol=2e-5,
    )
