"""A gas of one's own states pair physics alone: what the base class finds by quadrature."""

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardDisks, InelasticHardSpheres, MaxwellMolecules, sweep
from jdsmc.gases import local
from jdsmc.scenarios import HomogeneousCooling, UniformShear

from ..helpers import IsotropicMolecules, PlainDisks, PlainSpheres, Viscoelastic

TEMPERATURES = np.array([1e-4, 0.02, 0.5, 3.0, 100.0])


class SoftSpheres(PlainSpheres):
    """A pair rate ∝ √g: repulsion with a power of the distance."""

    def rate(self, speed):
        return jnp.sqrt(jnp.asarray(speed))


class Cored(PlainSpheres):
    """A pair rate with a scale of speed."""

    def rate(self, speed):
        return speed / (1.0 + speed)


class Sticky(jdsmc.AbstractGas):
    """Elastic, but slow pairs pass through each other: a scale of speed in the transfer alone."""

    threshold: Any = jdsmc.number("slowest pair that collides", "v0", low=0.0)

    def rate(self, speed):
        return speed

    def momentum_transfer(self, relative_velocity, outgoing):
        speed = sum(g * g for g in relative_velocity) ** 0.5
        share = 0.5 * (speed > self.threshold)
        return tuple(share * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


CLOSED = [
    *(InelasticHardSpheres(alpha) for alpha in (0.3, 0.7, 0.999, 1.0)),
    *(InelasticHardDisks(alpha) for alpha in (0.3, 0.7, 0.999, 1.0)),
    MaxwellMolecules(),
]


@pytest.mark.parametrize("gas", CLOSED, ids=repr)
def test_quadrature_against_closed_forms(gas):
    """Collision rate and energy loss of a Maxwellian: to 1e-6, and elastic gases lose nothing."""
    rate, loss = (f(gas, TEMPERATURES) for f in (local.collision_rate, local.energy_loss_rate))
    np.testing.assert_allclose(rate, gas.collision_rate(TEMPERATURES), rtol=1e-6)
    np.testing.assert_allclose(loss, gas.energy_loss_rate(TEMPERATURES), rtol=1e-6, atol=0.0)
    one = local.collision_rate(gas, 0.5)
    assert np.ndim(one) == 0 and one == pytest.approx(float(gas.collision_rate(0.5)), rel=1e-6)


@pytest.mark.parametrize(
    "gas, exponent",
    [
        (PlainSpheres(0.7), 1.0),
        (PlainDisks(0.7), 1.0),
        (IsotropicMolecules(2.0), 0.0),
        (SoftSpheres(0.7), 0.5),
        (Viscoelastic(0.4), None),
        (Viscoelastic(0.0), 1.0),
        (Cored(0.7), None),
        (Sticky(0.5), None),
        (IsotropicMolecules(0.0), None),  # never collides
    ],
    ids=repr,
)
def test_speed_exponent(gas, exponent):
    """How a rate scales with the speed, and whether the collision rule knows a speed of its own."""
    assert gas.speed_exponent() == exponent


@pytest.mark.parametrize("gas", CLOSED, ids=repr)
def test_stated_exponents_are_those_found(gas):
    assert local.speed_exponent(gas) == gas.speed_exponent()


@pytest.mark.parametrize(
    "own, ours",
    [
        (PlainSpheres(0.7), InelasticHardSpheres(0.7)),
        (PlainDisks(0.7), InelasticHardDisks(0.7)),
        (IsotropicMolecules(float(MaxwellMolecules().rate(np.ones(())))), MaxwellMolecules()),
    ],
    ids=repr,
)
def test_the_same_gas_by_another_name(own, ours):
    """What a gas states in closed form, one without finds: to the 1e-6 of the quadrature."""
    for name in ("collision_rate", "energy_loss_rate"):
        found, stated = (getattr(gas, name)(TEMPERATURES) for gas in (own, ours))
        np.testing.assert_allclose(found, stated, rtol=1e-6)


def test_losses_of_a_viscoelastic_gas():
    """Against the integral over impact speeds: a rate ∝ g_n, density g_n exp(-g_n²/4T) of these.

    A collision takes (1-α²) g_n²/4; there are √(2T/π) of them per particle and τ0.
    The 64 speeds and 33 directions see the kink at g_n = 0: 1e-5.
    """
    for heat in (0.01, 0.5, 5.0):
        normal = np.linspace(0.0, 14.0 * np.sqrt(heat), 200_001)
        weight = normal * np.exp(-(normal**2) / (4.0 * heat))
        restitution = 1.0 - 0.1 * normal**0.2
        lost = np.trapezoid(weight * (1 - restitution**2) * normal**2 / 4.0, normal)
        lost /= np.trapezoid(weight, normal)
        exact = np.sqrt(2.0 * heat / np.pi) * lost
        assert Viscoelastic(0.1).energy_loss_rate(heat) == pytest.approx(exact, rel=1e-5)


SMALL = {"n_particles": 512, "time_step": 0.1, "steps_per_record": 8, "progress": False}


class TellingSpheres(PlainSpheres):
    """They say what share they transfer: the same operations as those of the built-in gas."""

    def transfer_share(self):
        return (1.0 + self.alpha) / 4.0


def test_a_gas_with_a_field_of_its_own_gives_the_same_numbers(monkeypatch):
    """`alpha` instead of `restitution`: with the same keys all that is measured is the same.

    To the 1e-6 of the quadrature where a local-equilibrium value divides.
    """
    monkeypatch.setattr(sweep, "fingerprint", lambda scene: (1, 2))
    own, ours = (
        jdsmc.run(UniformShear(gas, 4.0), collisions=20.0, **SMALL).series
        for gas in (TellingSpheres(0.7), InelasticHardSpheres(0.7))
    )
    assert set(own) == set(ours)
    for name in ours.data_vars:
        np.testing.assert_allclose(own[name], ours[name], rtol=2e-6, err_msg=str(name))


def test_what_an_own_gas_reports():
    """Until precise: the cooling rate is finite, and there is a table, for every kind of gas."""
    for gas in (PlainSpheres(0.7), Viscoelastic(0.4)):
        result = jdsmc.run(UniformShear(gas, 4.0), rtol=0.1, **SMALL)
        value, error = result["relative_speed_cubed_collisional"]
        assert 0 < error < 0.2 * value < np.inf
        assert "Ended because" in result.table()
    maxwell = jdsmc.run(UniformShear(MaxwellMolecules(), 1.0), duration=2.0, **SMALL)
    assert "No steady values" in maxwell.table()
    assert np.all(np.isnan(maxwell.series["relative_speed_cubed_collisional"]))


def test_cooling_of_a_gas_with_a_speed_of_its_own():
    """The viscoelastic gas left alone is the viscoelastic gas sheared with a = 0, in T(t).

    Sixteen realizations, at five times: Student's t with 14 degrees of freedom passes 5.3 once in
    10⁴. Held at T0, which is right for hard spheres only, T would be off by a quarter.
    """
    gas = Viscoelastic(0.4)
    sizes = SMALL | {"n_particles": 4096, "duration": 30.0}
    cooling = jdsmc.run(HomogeneousCooling(gas), **sizes).series
    sheared = jdsmc.run(UniformShear(gas, 0.0), seed=1, **sizes).series
    assert min(s["time"].values[-1] for s in (cooling, sheared)) > 20.0
    for time in (2.0, 5.0, 10.0, 15.0, 20.0):
        (a, ea), (b, eb) = (
            [np.interp(time, s["time"], s[n]) for n in ("temperature", "temperature_error")]
            for s in (cooling, sheared)
        )
        assert np.hypot(ea, eb) < 0.01 * b
        assert abs(a - b) < 5.3 * np.hypot(ea, eb)
    assert b < 0.15


def test_cooling_of_such_a_gas_has_no_steady_state():
    with pytest.raises(ValueError, match=r"speed of its own.*changes for ever; give duration"):
        jdsmc.run(HomogeneousCooling(Viscoelastic(0.4)))
    assert HomogeneousCooling(PlainSpheres(0.7)).has_steady_state()
    assert not HomogeneousCooling(Viscoelastic([0.1, 0.4])).has_steady_state()
