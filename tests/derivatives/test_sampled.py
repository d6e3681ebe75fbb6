"""What is done with sampled pairs: collisions averaged over their directions, noise taken out."""

import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import ElasticHardSpheres, InelasticHardSpheres, MaxwellMolecules, random
from jdsmc.collisions.sampled import random_pairs
from jdsmc.derivatives.after import after, both
from jdsmc.derivatives.controls import controlled, imbalance
from jdsmc.derivatives.sampling import Sampler
from jdsmc.measure.polynomials import AXIAL, ISOTROPIC, SHEARED
from jdsmc.scenarios import HeatFluxForce, UniformShear

from .. import helpers

GASES = (InelasticHardSpheres(0.6), ElasticHardSpheres(0.6, 0.8), MaxwellMolecules())
KEY = random.key_from_seed(3)


@pytest.mark.parametrize("gas", GASES)
def test_share_is_that_of_the_transfer(gas):
    g, e = (jnp.array([0.3, -1.2]),) * 3, (jnp.array([0.5, 0.1]),) * 3
    share = float(gas.transfer_share())
    for ours, a, b in zip(gas.momentum_transfer(g, e), g, e, strict=True):
        np.testing.assert_allclose(ours, share * (a - b), rtol=1e-6)


@pytest.mark.parametrize("symmetry", [SHEARED, AXIAL, ISOTROPIC])
def test_average_over_directions(symmetry):
    """Against a rule that is exact to degree 7: 4 nodes in the cosine, 8 angles. To rounding."""
    gas, basis = InelasticHardSpheres(0.6), symmetry.basis(6)
    vx, vy, vz = helpers.maxwellian(1, helpers.options(1024))
    pair = random_pairs(KEY, (1.2 * vx - 0.4 * vy, 0.9 * vy, vz))
    relative = tuple(a - b for a, b in zip(*pair, strict=True))
    speed = jnp.sqrt(sum(g * g for g in relative))
    nodes, weights = np.polynomial.legendre.leggauss(4)
    expected = 0.0
    for cosine, weight in zip(nodes, weights, strict=True):
        for angle in 0.1 + np.arange(8) * np.pi / 4:
            sine = np.sqrt(1 - cosine**2)
            direction = (sine * np.cos(angle), sine * np.sin(angle), cosine)
            transfer = gas.momentum_transfer(relative, tuple(speed * float(d) for d in direction))
            moved = (
                tuple(v - t for v, t in zip(pair[0], transfer, strict=True)),
                tuple(v + t for v, t in zip(pair[1], transfer, strict=True)),
            )
            expected = expected + weight / 16 * np.stack(both(symmetry, basis, *moved))
    found = np.stack(after(symmetry, basis, KEY, gas, pair, jnp.ones(())))
    scale = np.max(np.abs(expected), axis=(1, 2), keepdims=True)
    np.testing.assert_allclose(found / scale, expected / scale, atol=1e-5)


SAMPLER = Sampler(SHEARED, 4, (), False)
SCENE = UniformShear(InelasticHardSpheres(0.7), 0.8)


def blocks(noise: np.ndarray) -> dict:
    """Averages of a gas whose collisions undo the flow but for some noise."""
    shape, rng = noise.shape[:2], np.random.default_rng(2)
    moments = 1.0 + 0.1 * rng.normal(size=(*shape, len(SAMPLER.rows)))
    means = {"moments": moments, "cubed": np.ones(shape)}
    means["source"] = np.zeros((*shape, len(SAMPLER.basis) + 1))
    means["source"][..., :-1] = noise - imbalance(SCENE, SAMPLER, means)
    return means


def test_noise_that_goes_with_the_imbalance_goes():
    """What is linear in it is left without any; what is independent of it keeps its noise."""
    rng = np.random.default_rng(1)
    noise = rng.normal(size=(8, 40, len(SAMPLER.basis)))
    means = blocks(noise)
    own = rng.normal(size=(8, 40))
    means["linear"] = 3.0 + noise @ rng.normal(size=(noise.shape[-1], 2))
    means["apart"] = 1.0 + own
    found = controlled(SCENE, SAMPLER, means, np.ones((8, 40)))
    np.testing.assert_allclose(found["linear"], 3.0, rtol=1e-10)
    # 13 of 320 directions are fitted away
    assert np.std(found["apart"]) == pytest.approx(np.std(own), rel=0.05)


def test_few_blocks_fit_no_noise():
    """Ten blocks for each that is used: 2 of 20, and none of 8."""
    rng = np.random.default_rng(1)
    for count, used in ((20, 2), (8, 0)):
        means = blocks(rng.normal(size=(2, count // 2, len(SAMPLER.basis))))
        means["apart"] = rng.normal(size=(2, count // 2, 6))
        found = controlled(SCENE, SAMPLER, means, np.ones((2, count // 2)))
        taken = (found["apart"] - means["apart"]).reshape(count, 6)
        assert np.linalg.matrix_rank(taken) == used


def test_momentum_and_held_energy_are_no_controls():
    """Where the temperature is held, no energy is out of balance; momentum never is."""
    scene = HeatFluxForce(InelasticHardSpheres(0.7), 0.05)
    sampler = Sampler(AXIAL, 4, (), True)
    rng, shape = np.random.default_rng(1), (8, 40)
    means = {
        "moments": 1.0 + 0.1 * rng.normal(size=(*shape, len(sampler.rows))),
        "cubed": np.ones(shape),
        "source": rng.normal(size=(*shape, len(sampler.basis) + 1)),
    }
    means["source"][..., 0] = 0.0
    squares = [sampler.rows.index(powers) for powers in AXIAL.squares]
    known = imbalance(scene, sampler, means)
    np.testing.assert_allclose(np.sum(known[..., squares], axis=-1), 0.0, atol=1e-12)
    found = controlled(scene, sampler, means, np.ones(shape))
    assert np.all(np.isfinite(found["moments"]))
    assert np.max(np.abs(found["moments"] - means["moments"])) < 1.0
