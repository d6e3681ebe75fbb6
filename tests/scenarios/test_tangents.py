"""Derivatives along a path, through `jax.jvp` of `advance`: finite, and right where known.

They are no derivatives of averages, since accepting a pair is a jump (docs/method.md). What is
tested is that what they do see, they see rightly: flow, drag, flight, walls.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardDisks, InelasticHardSpheres, random, sweep
from jdsmc.motion.walls import Walls
from jdsmc.scenarios import (
    CoolingDisks,
    CouetteFlow,
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    NavierStokes,
    ShearedSlab,
    UniformShear,
    WhiteNoiseThermostat,
)

from ..helpers import Viscoelastic, options

SPHERES, ELASTIC = InelasticHardSpheres(0.7), InelasticHardSpheres(1.0)


class Collisionless(jdsmc.AbstractGas):
    """Particles that never meet: 1e-20 of the rate of hard spheres, a power of the speed too."""

    def rate(self, speed):
        return 1e-20 * speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


class Record:
    """One record of a scene from its initial state, and its change with each of its numbers.

    `before`; `after`, `record`; `state_change[number]`, `record_change[number]`. The initial state
    is held fixed unless `from_the_start`.
    """

    def __init__(self, scene, n_particles=256, steps=1, from_the_start=False, time_step=0.1):
        made = options(n_particles, time_step, steps=steps, in_space=scene.in_space)
        self.options = scene.fit_options(made)
        names = list(sweep.parameters(scene))
        numbers, rest = eqx.partition(scene, sweep.is_number)
        numbers = jax.tree.map(lambda x: jnp.asarray(x, jnp.float32), numbers)
        leaves, form = jax.tree.flatten(numbers)
        key = random.key_from_seed(5)

        @jax.jit
        def begin(leaves):
            return eqx.combine(jax.tree.unflatten(form, leaves), rest).initial(key, self.options)

        self.before = begin(leaves)

        @jax.jit
        def change(leaves, tangent):
            def one(leaves):
                one_scene = eqx.combine(jax.tree.unflatten(form, leaves), rest)
                state = begin(leaves) if from_the_start else self.before
                return one_scene.advance(random.fold_in(key, 1), state, self.options)

            return jax.jvp(one, (leaves,), (tangent,))

        self.state_change, self.record_change = {}, {}
        for k, name in enumerate(names):
            tangent = [jnp.float32(k == j) for j in range(len(leaves))]
            (self.after, self.record), changed = change(leaves, tangent)
            self.state_change[name], self.record_change[name] = changed

    def not_finite(self) -> list[str]:
        """Where there is an infinity or none of numbers, by number of the scene."""
        both = {name: (self.state_change[name], self.record_change[name]) for name in self.names()}
        return [
            jax.tree_util.keystr(path)
            for path, leaf in jax.tree_util.tree_flatten_with_path(both)[0]
            if leaf.dtype != jax.dtypes.float0 and not np.all(np.isfinite(leaf))
        ]

    def names(self):
        return self.state_change


IN_SPACE = {
    "slab": ShearedSlab(SPHERES, shear_rate=1.0, layers=20),
    # layers of a few particles, of one and of none
    "dragged slab": ShearedSlab(ElasticHardSpheres(0.7, 0.8), shear_rate=1.0, layers=120),
    "fourier": FourierFlow(ELASTIC, cold_temperature=0.3, gravity=0.01, layers=20),
    "bgk walls": FourierFlow(ELASTIC, cold_temperature=0.3, gravity=0.0, wall="bgk", layers=20),
    "moving walls": CouetteFlow(ELASTIC, 0.5, 0.3, 0.6, layers=20),
    "upwards": FourierFlow(
        jdsmc.MaxwellMolecules(), cold_temperature=0.3, gravity=-0.01, layers=120
    ),
    "disks in a plane": CoolingDisks(InelasticHardDisks(0.9), 0.05, 0.1),
}
HOMOGENEOUS = {
    "shear": UniformShear(SPHERES, 1.0),
    "shear at rest": UniformShear(ElasticHardSpheres(0.7, 0.8), 0.0),
    "measured drag": UniformShear(ElasticHardSpheres(0.7, drag="measured"), 1.0),
    "cooling": HomogeneousCooling(SPHERES),
    "viscoelastic": HomogeneousCooling(Viscoelastic(0.3)),
    "disks": HomogeneousCooling(InelasticHardDisks(0.7)),
    "heat flux": HeatFluxForce(SPHERES, 0.05),
    "explicit heat flux": HeatFluxForce(SPHERES, 0.05, "paper"),
    "thermostat": WhiteNoiseThermostat(SPHERES, 0.2),
    "kicks": NavierStokes(SPHERES, 0.14, 0.5),
}
QUICK = ("dragged slab",)


@pytest.mark.parametrize(
    "name",
    [
        name if name in QUICK else pytest.param(name, marks=pytest.mark.slow)
        for name in IN_SPACE | HOMOGENEOUS
    ],
)
def test_finite_for_every_number(name):
    """Also where seats and layers are empty, and two roots of zero would be infinite."""
    scene = (IN_SPACE | HOMOGENEOUS)[name]
    record = Record(scene, 256, steps=2, from_the_start=True)
    assert record.names() and not record.not_finite()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["dragged slab", "fourier", "shear", "cooling"])
def test_numerics_have_no_derivative(name):
    """The length of a step and the bound on pair rates are chosen, also where a cap binds."""
    scene = (IN_SPACE | HOMOGENEOUS)[name]
    record = Record(scene, 256, steps=4, time_step=1.0)
    assert float(record.record.elapsed) < 3.9  # steps of 1 were asked: some were capped
    for number in record.names():
        assert float(record.record_change[number].elapsed) == 0.0
        for bound in ("majorant", "crowding"):
            changes = vars(record.state_change[number])
            assert bound not in changes or float(changes[bound]) == 0.0


@pytest.mark.slow
def test_shear_of_a_gas_without_collisions():
    """V_x = V_x(0) - a t V_y: its derivative is -t V_y."""
    record = Record(UniformShear(Collisionless(), 1.0), steps=4)
    _, vy, _ = record.after.velocity  # as before, but particles change their places in memory
    change = record.state_change["shear_rate"].velocity
    expected = -float(record.record.elapsed) * vy
    # single precision of numbers of order one
    np.testing.assert_allclose(change[0], expected, atol=2e-6)
    assert not np.any(change[1]) and not np.any(change[2])


@pytest.mark.slow
def test_drag_without_collisions():
    """Haff's law V = V(0)/(1 + c h), h = √(2 T0) t/2, so that d ln V/dα = -c' h/(1 + c h).

    With drag alone the elastic gas has its collisions at a rate of 1e-7; c ∝ 1 - α².
    """
    record = Record(UniformShear(ElasticHardSpheres(0.7, 1e-7), 0.0), steps=4)
    half = 0.5 * float(record.record.elapsed) * 2.0 / (3.0 * np.sqrt(np.pi))  # √(2 T0) = 1
    ratio = half * 2.0 * 0.7 / (1.0 + half * (1.0 - 0.7**2))
    changes = record.state_change["restitution"].velocity
    for v, change in zip(record.after.velocity, changes, strict=True):
        # Simpson's rule and single precision
        np.testing.assert_allclose(change, ratio * v, rtol=1e-4, atol=1e-6)


@pytest.mark.slow
def test_force_without_collisions():
    """At zero field dV/dε = -t (V V_x - ⟨V V_x⟩)/2: the force, and the mean taken out again."""
    record = Record(HeatFluxForce(Collisionless(), 0.0), steps=1)
    velocity = [np.asarray(v, float) for v in record.after.velocity]
    time = float(record.record.step)
    for v, change in zip(velocity, record.state_change["field"].velocity, strict=True):
        product = v * velocity[0]
        expected = -0.5 * time * (product - product.mean())
        np.testing.assert_allclose(change, expected, atol=2e-6)  # single precision


@pytest.mark.slow
def test_flight_and_walls_of_a_gas_without_collisions():
    """Gravity moves what hits no wall by -t²/2, and the cold wall emits energy ∝ T_-.

    Exactly: T_- d(energy given by the cold wall)/dT_- is the energy that it emits, hence exceeds
    the energy given by that of the particles which arrived there. Both from the states alone.
    """
    record = Record(
        FourierFlow(Collisionless(), cold_temperature=0.3, gravity=0.01, layers=4), 512, steps=1
    )
    place, (vx, vy, vz) = record.before.position, record.before.velocity
    given = record.record.exchange.lower_energy
    change = record.record_change["cold_temperature"].exchange
    emitted = 0.3 * float(change.lower_energy)
    assert float(record.record_change["cold_temperature"].elapsed) == 0.0
    assert float(change.upper_energy) == 0.0  # nobody crosses the slab in 0.8 τ0
    samples = FourierFlow.samples_per_record
    time = float(record.record.elapsed)
    assert time == pytest.approx(0.1 * samples, rel=1e-5)
    height = place + vz * time - 0.005 * time**2
    down = np.asarray(height < 0)
    assert np.sum(down) > 10
    arriving = 0.5 * np.sum((vx**2 + vy**2 + vz**2 + 2 * 0.01 * place)[down])
    # a few of those emitted fall back? gravity is too weak: they do not
    assert emitted - float(given) == pytest.approx(float(arriving), rel=1e-5)  # single precision
    free = ~down & np.asarray(height < 10.0)
    fallen = np.asarray(record.state_change["gravity"].position)[free]
    np.testing.assert_allclose(fallen, -0.5 * time**2, rtol=1e-5)


@pytest.mark.slow
def test_walls_of_a_conducting_gas_change_with_both_temperatures():
    """The table of either wall, by central differences (h = 0.01)."""

    def emitted(cold):
        return Walls.of("bgk", jnp.float32(cold), jnp.float32(10.0)).table

    record = Record(
        FourierFlow(Collisionless(), cold_temperature=0.3, gravity=0.0, wall="bgk", layers=4), 256
    )
    walls = record.state_change["cold_temperature"].walls
    high, low = (np.asarray(emitted(0.3 + h)) for h in (0.01, -0.01))
    difference = (high - low) / 0.02
    # single precision of a survival of 1e-7, at the end of the table
    np.testing.assert_allclose(walls.table, difference, atol=6e-3 * np.max(np.abs(difference)))
    assert float(walls.speed[0]) == pytest.approx(0.5 / np.sqrt(0.3), rel=1e-6)


@pytest.mark.slow
def test_planes_of_a_gas_without_collisions():
    """Every image passed changes v_x by -a L: by -L per shear rate, by -a per length."""
    record = Record(
        ShearedSlab(Collisionless(), shear_rate=1.0, length=0.3, layers=4), 256, steps=4
    )
    start, end = (np.asarray(s.velocity[0]) for s in (record.before, record.after))
    images = np.round((start - end) / 0.3)
    assert np.sum(images != 0) > 20
    for name, each in (("shear_rate", 0.3), ("length", 1.0)):
        change = record.state_change[name].velocity[0]
        np.testing.assert_allclose(change, -each * images, atol=1e-5)  # single precision


@pytest.mark.slow
def test_growth_of_disks_without_collisions():
    """w = w(0) e^{μs}, so that d ln w/dμ = s.

    What collisions there are keep energy: d⟨w²⟩/dμ = 2 s ⟨w²⟩.
    """
    scene = CoolingDisks(InelasticHardDisks(1.0), 0.05, 0.1)
    record = Record(scene, 256, steps=4)
    time = float(record.record.elapsed)
    w, change = record.after.velocity, record.state_change["growth_rate"].velocity
    energy = sum(float(jnp.mean(v * v)) for v in w)
    slope = sum(float(jnp.mean(2.0 * v * d)) for v, d in zip(w, change, strict=True))
    assert slope == pytest.approx(2.0 * time * energy, rel=1e-4)  # single precision
