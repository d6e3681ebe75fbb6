"""Navier-Stokes coefficients from pairs, against the solved Boltzmann equation."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jdsmc import InelasticHardSpheres, MaxwellMolecules, random
from jdsmc.measure.linear_response import ORDER, _scaling, coefficients, functions
from jdsmc.scenarios.cooling_response import CoolingResponse
from jdsmc.stats import jackknife
from jdsmc.theory import boltzmann
from jdsmc.transport import linear_response

from ..helpers import Viscoelastic, keys, maxwellian, options

NAMES = ("modified_conductivity", "conductivity", "density_coefficient", "viscosity")


def test_functions_scale_as_stated():
    """V·∂φ_k/∂V = Σ_j D_kj φ_j, by jvp along V itself."""
    velocity = tuple(
        jnp.asarray(x, jnp.float32) for x in np.random.default_rng(1).normal(size=(3, 8))
    )
    values, along = jax.jvp(functions, (velocity,), (velocity,))
    for rank, value, slope in zip((1, 2), values, along, strict=True):
        expected = _scaling(ORDER, rank) @ np.asarray(value, float)
        # single precision of functions up to a hundred
        np.testing.assert_allclose(slope, expected, atol=1e-3)


def test_elastic_gas_in_equilibrium():
    """A Maxwellian needs no simulation: pairs of it give κ and η of elastic spheres, and μ = 0."""
    scene, made = CoolingResponse(InelasticHardSpheres(1.0)), options(16_384)

    @jax.jit
    def sums(key):
        velocity = maxwellian(random.fold_in(key, 0), made)
        return scene.pairs(random.fold_in(key, 1), velocity)

    each = [sums(jax.tree.map(lambda x, r=r: x[r], keys(3, 16))) for r in range(16)]
    means = {n: np.stack([np.asarray(vars(g)[n], float) for g in each]) for n in vars(each[0])}
    value, error, _ = jackknife(means, coefficients, axis=0)
    exact = boltzmann.navier_stokes(1.0)
    for name in ("conductivity", "modified_conductivity", "viscosity"):
        assert 0 < error[name] < 0.015
        # four functions leave out 1e-4; fixed seed, 16 realizations
        assert abs(value[name] - getattr(exact, name)) < 4.0 * error[name] + 2e-4
    # finite samples are not quite Maxwellian; κ and κ' see the same fluctuations
    assert abs(value["density_coefficient"]) < 4.0 * error["density_coefficient"]


@pytest.mark.parametrize("gas", [MaxwellMolecules(), Viscoelastic(0.2)])
def test_other_gases_are_refused(gas):
    with pytest.raises(TypeError, match="CoolingResponse needs a gas that collides"):
        linear_response(gas)


@pytest.mark.slow
def test_inelastic_gases():
    """Two gases at once; error, and what the last function changes, together. Mean of z too."""
    run = {"n_particles": 10_240, "collisions": 60.0, "progress": False}
    result = linear_response(InelasticHardSpheres([0.5, 0.8]), **run)
    scores = []
    for alpha in (0.5, 0.8):
        exact, found = boltzmann.navier_stokes(alpha), result.at(restitution=alpha)
        for name in NAMES:
            value, error = found[name]
            whole = np.hypot(error, found[f"{name}_truncation"].value)
            assert error < 0.02 * max(1.0, value)
            scores.append((value - getattr(exact, name)) / whole)
    assert np.max(np.abs(scores)) < 4.0  # fixed seed; eight values, error bars good to 25%


@pytest.mark.slow
def test_chapman_enskog_to_a_thousandth():
    """Elastic spheres: κ = 1.025218 and η = 1.016034 of their first approximations, to 0.1%.

    Chapman and Cowling's limits of all orders.
    """
    found = linear_response(InelasticHardSpheres(1.0), rtol=1e-3, progress=False)
    for name, known in (("conductivity", 1.025218), ("viscosity", 1.016034)):
        value, error = (float(x) for x in found[name])
        assert error < 1.05e-3 * known
        assert abs(value - known) < 3.0 * error, name
