"""Starts from the steady state of the kinetic model: homogeneous shear and the sheared slab."""

import equinox as eqx
import jax
import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres, MaxwellMolecules, random
from jdsmc.scenarios import Options, ShearedSlab, UniformShear
from jdsmc.scenarios.approach import of_sheared_gas, of_sheared_slab
from jdsmc.theory.bgk_shear_flow import steady_state

from ..helpers import f32

GASES = [InelasticHardSpheres, ElasticHardSpheres]


def _velocities(scene, n_particles=40_960):
    """Those of the start, (components, particles), float64."""
    options = Options.checked(n_particles, 0.05, "strang", "float32", 16)
    numbers = jax.tree.map(lambda x: f32(x) if isinstance(x, float) else x, scene)
    state = eqx.filter_jit(lambda s: s.initial(random.key_from_seed(3), options))(numbers)
    return np.stack([np.ravel(np.asarray(v, float)) for v in jax.device_get(state.velocity)]), state


@pytest.mark.parametrize("gas", GASES)
@pytest.mark.parametrize(("alpha", "rate"), [(0.3, 4.0), (0.9, 1e-10), (0.9999, 1e6)])
def test_it_is_that_of_the_model(gas, alpha, rate):
    """Temperature and momentum to rounding, stresses to the scatter of N velocities.

    float32: 1-α has the rounding of α. A stress of N normal velocities scatters by at most √(2/N)
    of the largest, three times that of equilibrium: 0.021; five of these. The frictional gas has
    the model's own ζτ/β, hence T_s.
    """
    velocity, _ = _velocities(UniformShear(gas(alpha), rate, "steady"))
    model = steady_state(alpha, rate)
    square = velocity @ velocity.T / velocity.shape[1]
    heat = np.trace(square) / 3.0
    rounding = 1e-4 + 2.0**-24 / (1.0 - alpha)
    assert heat / 0.5 == pytest.approx(float(model.temperature), rel=rounding)
    assert np.all(np.abs(np.mean(velocity, axis=1)) < 1e-5 * np.sqrt(heat))
    yy = 1.0 - float(model.normal_stress_xy) / 3.0
    found = square / heat
    expected = [3.0 - 2.0 * yy, yy, yy, -float(model.shear_stress)]
    scatter = 5.0 * 3.0 * np.sqrt(2.0 / velocity.shape[1])
    np.testing.assert_allclose([*np.diag(found), found[0, 1]], expected, rtol=0, atol=scatter)


@pytest.mark.parametrize("gas", GASES)
def test_a_slab_starts_in_uniform_shear(gas):
    """The same about the linear profile, with the density of places uniform."""
    scene = ShearedSlab(gas(0.7), 4.0, 2.5, "steady")
    velocity, state = _velocities(scene)
    place = np.asarray(state.position, float)
    velocity[0] -= 4.0 * (place - 1.25)
    square = velocity @ velocity.T / velocity.shape[1]
    model = steady_state(0.7, 4.0)
    heat = np.trace(square) / 3.0
    assert heat / 0.5 == pytest.approx(float(model.temperature), rel=1e-4)
    scatter = 5.0 * 2.0 * np.sqrt(2.0 / velocity.shape[1])
    assert -square[0, 1] / heat == pytest.approx(float(model.shear_stress), abs=scatter)
    # crowding bounds the pairs of the hot gas: its first step is as short as it then must be
    cold = _velocities(ShearedSlab(gas(0.7), 4.0, 2.5))[1]
    assert float(state.crowding) > 3.0 * float(cold.crowding)


def test_the_way_is_shorter():
    """The slowest relaxation is the same; from T0 = 266 T_s it starts further off."""
    gas = InelasticHardSpheres(0.9)
    for near, far in (
        (of_sheared_gas(gas, 0.02, True), of_sheared_gas(gas, 0.02)),
        (of_sheared_slab(gas, 0.02, 5.0, True), of_sheared_slab(gas, 0.02, 5.0)),
    ):
        assert near.collisions == far.collisions
        assert near.distance == 0.0 < far.distance


@pytest.mark.parametrize("scene", [UniformShear, ShearedSlab])
@pytest.mark.parametrize(
    ("gas", "rate", "what"),
    [
        (MaxwellMolecules(), 1.0, "gases of hard spheres, not for MaxwellMolecules"),
        (InelasticHardSpheres(1.0), 1.0, "needs a steady state: shear_rate > 0"),
        (InelasticHardSpheres(0.9), 0.0, "needs a steady state: shear_rate > 0"),
        (InelasticHardSpheres([0.9, 1.0]), 1.0, "needs a steady state: shear_rate > 0"),
    ],
)
def test_what_has_no_such_start_is_refused(scene, gas, rate, what):
    with pytest.raises(ValueError, match=what):
        jdsmc.run(scene(gas, rate, initial_state="steady"), n_particles=4096, progress=False)


def test_steady_values_are_those_from_equilibrium():
    """Both ways to one steady state, five errors of the difference; the short way is shorter.

    N = 1280 biases neither against the other.
    """
    gas, small = InelasticHardSpheres(0.8), {"n_particles": 1280, "progress": False, "rtol": 2e-3}
    far = jdsmc.run(UniformShear(gas, 1.0), seed=1, **small)
    near = jdsmc.run(UniformShear(gas, 1.0, "steady"), seed=2, **small)
    for name in ("shear_stress", "temperature", "normal_stress_xy", "a2"):
        (a, error_a), (b, error_b) = far[name], near[name]
        assert abs(a - b) < 5.0 * np.hypot(error_a, error_b), name
    starts = [float(r.to_xarray()["steady_from_collisions"]) for r in (near, far)]
    assert starts[0] < starts[1]
