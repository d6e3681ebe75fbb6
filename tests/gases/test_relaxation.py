"""What the linearised collision operator says, against closed forms, of any gas."""

from math import pi, sqrt
from typing import Any

import numpy as np
import pytest

import jdsmc
from jdsmc.gases.base import conserves_energy
from jdsmc.gases.hard_spheres import loses_energy
from jdsmc.gases.relaxation import mean_free_paths, relaxation, tail_exponent
from jdsmc.scenarios import CouetteFlow, FourierFlow, HomogeneousCooling, ShearedSlab
from jdsmc.scenarios.approach import (
    of_conduction,
    of_couette_flow,
    of_sheared_gas,
    of_sheared_slab,
)
from jdsmc.scenarios.cooling_response import CoolingResponse
from jdsmc.units import COOLING, INITIAL_TEMPERATURE
from tests.helpers import PlainDisks, PlainSpheres

QUADRATURE = 3e-4
"""Relative: 16 speeds for powers of the speed that are not smooth at zero."""


class Powers(jdsmc.AbstractGas):
    """A share of g - g' at a rate f g^γ."""

    moved: Any = jdsmc.number("share of g - g' that is transferred", low=0.0, high=1.0)
    factor: Any = jdsmc.number("f", low=0.0, default=1.0)
    power: Any = jdsmc.number("γ", low=-2.0, high=4.0, default=1.0)

    def rate(self, speed):
        return self.factor * speed**self.power

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(self.moved * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


class Rattling(Powers):
    """Elastic below, lossy above a normal speed of the pair."""

    from_speed: Any = jdsmc.number("normal speed", low=0.0, default=8.0)

    def momentum_transfer(self, relative_velocity, outgoing):
        pairs = list(zip(relative_velocity, outgoing, strict=True))
        normal = 0.5 * sum((g - e) ** 2 for g, e in pairs) ** 0.5
        share = 0.5 - (0.5 - self.moved) * (normal > self.from_speed)
        return tuple(share * (g - e) for g, e in pairs)


def inelastic_maxwell(alpha: float) -> Powers:
    return Powers((1.0 + alpha) / 4.0, 2.0, 0.0)


def cooling_rate(gas) -> float:
    return 2.0 * float(gas.energy_loss_rate(INITIAL_TEMPERATURE)) / gas.dimension / 0.5


def test_elastic_spheres_have_the_viscosity_and_conductivity_of_chapman_and_cowling():
    """First and second approximations: [η]_2 = 205/202 [η]_1, [κ]_2 = 45/44 [κ]_1; η1 at T0 is
    5√π/16 n m λ0 v0, and κ1 decays 2/3 as fast."""
    gas = PlainSpheres(1.0)
    stress, heat = (relaxation(gas, INITIAL_TEMPERATURE, rank).collisions for rank in (2, 1))
    first = 8.0 / (5.0 * sqrt(pi))
    assert stress[0, 0] == pytest.approx(first, rel=QUADRATURE)
    assert heat[0, 0] == pytest.approx(2.0 / 3.0 * first, rel=QUADRATURE)
    assert np.linalg.inv(stress)[0, 0] * stress[0, 0] == pytest.approx(205 / 202, rel=QUADRATURE)
    assert np.linalg.inv(heat)[0, 0] * heat[0, 0] == pytest.approx(45 / 44, rel=QUADRATURE)


def test_maxwell_molecules_have_the_eigenvalues_of_isotropic_scattering():
    """R is diagonal; heat flux and fourth moment decay by 2/3 of the stress's rate."""
    gas = jdsmc.MaxwellMolecules()
    stress, heat, fourth = (relaxation(gas, 0.1, rank).collisions for rank in (2, 1, 0))
    for one in (stress, heat, fourth):
        # what 16 nodes miss of a density that is smooth in g
        assert abs(one[0, 1]) < 1e-4 and abs(one[1, 0]) < 1e-4
    assert stress[0, 0] == pytest.approx(8.0 / (5.0 * sqrt(pi)), rel=1e-4)
    assert heat[0, 0] / stress[0, 0] == pytest.approx(2.0 / 3.0, rel=1e-4)
    assert fourth[0, 0] / stress[0, 0] == pytest.approx(2.0 / 3.0, rel=1e-4)


def test_stress_of_disks():
    """η1 = √(mT/π)/(2σ), n σ = 1/2√2."""
    decay = relaxation(PlainDisks(1.0), INITIAL_TEMPERATURE, 2).collisions[0, 0]
    pressure = INITIAL_TEMPERATURE
    viscosity = sqrt(INITIAL_TEMPERATURE / pi) / 2.0 * 2.0 * sqrt(2.0)
    assert decay == pytest.approx(pressure / viscosity, rel=QUADRATURE)


@pytest.mark.parametrize("alpha", [0.3, 0.7])
def test_stress_of_inelastic_spheres(alpha):
    """ν_η* = 1 - (1-α)²/4 = (1+α)(3-α)/4 about a Maxwellian: Garzó and Dufty, Phys. Rev. E 59, 5895
    (1999), eq. (3.27)."""
    decay = relaxation(PlainSpheres(alpha), INITIAL_TEMPERATURE, 2).collisions[0, 0]
    elastic = relaxation(PlainSpheres(1.0), INITIAL_TEMPERATURE, 2).collisions[0, 0]
    assert decay / elastic == pytest.approx((1.0 + alpha) * (3.0 - alpha) / 4.0, rel=QUADRATURE)


@pytest.mark.parametrize("alpha", [0.1, 0.5, 0.8, 0.95])
def test_tail_of_the_inelastic_maxwell_gas(alpha):
    """Where p ζ/2 overtakes the loss of ⟨c^p⟩; even p from the collision matrix: 4 from R."""
    gas = inelastic_maxwell(alpha)
    tail = tail_exponent(gas, 0.0)
    fourth = relaxation(gas, INITIAL_TEMPERATURE, 0).slowest(cooling_rate(gas))
    sixth_exists = alpha > 0.25  # Ernst and Brito (2002): a = 5.15 at α = 0.1, 5.6 at 0.2
    assert (tail > 6.0) == sixth_exists
    assert (fourth > 0) == sixth_exists  # the slowest of ⟨c^4⟩ and ⟨c^6⟩
    assert np.isinf(tail_exponent(Powers(0.5, 1.0, 0.0), 0.0))  # elastic
    assert np.isinf(tail_exponent(PlainSpheres(alpha), 1.0))  # fast particles collide more
    assert tail_exponent(Powers(0.4, 1.0, -0.5), -0.5) == 2.0  # nothing holds them


def test_heavy_tails_have_no_steady_a2():
    scene = HomogeneousCooling(inelastic_maxwell(0.2))
    with pytest.raises(ValueError, match=r"averages of c\^p exist up to p = 5.6.*give duration"):
        jdsmc.run(scene, progress=False)
    with pytest.raises(ValueError, match="makes energy"):
        jdsmc.run(HomogeneousCooling(Powers(0.505)), progress=False)
    with pytest.raises(ValueError, match="decays more slowly than its temperature"):
        jdsmc.run(CoolingResponse(Powers(0.03)), progress=False)


def test_a_gas_that_collides_more_often_has_so_many_mean_free_paths():
    for factor in (0.1, 1.0, 20.0):
        found = mean_free_paths(Powers(0.5, factor), INITIAL_TEMPERATURE)
        assert found == pytest.approx(factor, rel=QUADRATURE)
    # a rate that does not fall with T makes a cold gas denser in collisions
    assert mean_free_paths(jdsmc.MaxwellMolecules(), 0.02) == pytest.approx(5.0, rel=1e-3)


def test_own_hard_spheres_approach_shear_as_ours():
    """The same model, of quadrature; r without the Sonine correction 1.016 and α beyond linear."""
    gases = PlainSpheres(0.9), jdsmc.InelasticHardSpheres(0.9)
    own, ours = (of_sheared_gas(gas, 1.0) for gas in gases)
    assert own.collisions == pytest.approx(ours.collisions, rel=0.1)
    assert not own.certain and ours.certain


def test_shear_of_a_gas_that_hardly_loses_energy_is_slow():
    """T - T_s decays with γ ζ/2 + ..., that is in 3/(2 (1-α²)) collisions: linear model."""
    gas = Powers((1.0 + 0.999) / 4.0, 5.0)
    lost = 1.0 - 0.999**2
    assert of_sheared_gas(gas, 1.0).collisions == pytest.approx(1.5 / lost, rel=0.02)
    assert COOLING * lost == pytest.approx(cooling_rate(gas) / 5.0, rel=1e-4)


def test_slabs_count_mean_free_paths_of_their_own_gas():
    """f times the collisions in L is L f."""
    one, other = ShearedSlab(Powers(0.45, 20.0), 0.1, 1.0), ShearedSlab(Powers(0.45), 0.1, 20.0)
    assert one.layers == other.layers == 200
    molecules = jdsmc.MaxwellMolecules()  # colder ones collide more often over a length
    layers = {t: FourierFlow(molecules, t, length=10.0).layers for t in (1.0, 0.05)}
    assert layers == {1.0: 100, 0.05: 400}
    with pytest.raises(ValueError, match="100 to 400 layers"):
        FourierFlow(molecules, [1.0, 0.05], length=10.0)
    couette = (CouetteFlow(Powers(0.5, f), 0.0, length=x) for f, x in ((20.0, 2.0), (1.0, 40.0)))
    assert len({scene.layers for scene in couette}) == 1
    for of in (
        lambda gas, x: of_sheared_slab(gas, 0.1 * 20.0 / x, x),
        lambda gas, x: of_conduction(gas, 0.5, 0.0, x),
        lambda gas, x: of_couette_flow(gas, 0.5, 0.1, 1.0, x),
    ):
        mine, its = of(Powers(0.45, 20.0), 1.0), of(Powers(0.45), 20.0)
        assert mine.collisions == pytest.approx(its.collisions, rel=1e-3)


def test_energy_is_asked_for_at_all_temperatures():
    """Lossy only beyond 8 v0 of normal speed, or making energy: neither conserves it."""
    hot = Rattling(0.3, from_speed=8.0)
    assert float(hot.energy_loss_rate(INITIAL_TEMPERATURE)) == 0.0  # the reason to ask elsewhere
    assert loses_energy(hot) and not conserves_energy(hot)
    assert not conserves_energy(Powers(0.505)) and not loses_energy(Powers(0.505))
    assert conserves_energy(Powers(0.5)) and conserves_energy(jdsmc.MaxwellMolecules())


@pytest.mark.parametrize("speed", [1e-6, 0.002, 0.3, 500.0])
def test_a_speed_of_its_own_is_found(speed):
    """Whatever it is: a gas that cools comes to it."""
    assert Rattling(0.4, from_speed=speed).speed_exponent() is None
    assert Powers(0.4, 3.0, 0.5).speed_exponent() == pytest.approx(0.5)
