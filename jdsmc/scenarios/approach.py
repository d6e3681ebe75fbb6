"""How long a gas takes to its steady state: from kinetic models, not from the run itself.

Early in a run nothing in its numbers tells that they will change: all realizations start with one
temperature, and near the elastic limit it moves by a percent while each particle collides ten
times. So a scene says beforehand what its slowest relaxation is. All numbers are host scalars, of
one gas at one point of a sweep; times are in accepted collisions per particle.
"""

from math import exp, inf, log, pi, sqrt
from typing import NamedTuple

import numpy as np
import scipy

from ..gases import AbstractGas, InelasticHardDisks, InelasticHardSpheres, MaxwellMolecules
from ..gases.hard_spheres import loses_energy
from ..gases.relaxation import mean_free_paths, relaxation
from ..units import COOLING, INITIAL_TEMPERATURE, VISCOSITY_TIME
from .kinetic_model import HardSpheres, rates_of_model, steady_shear


class Approach(NamedTuple):
    """The slowest relaxation: deviations are at most exp(distance - s/collisions) late in it.

    `collisions`: its e-folding time in accepted collisions per particle. `distance`: logarithm of
    the relative deviation at the start, at least 0. `certain`: False if there may be slower ones,
    so that the run itself must tell.
    """

    collisions: float
    distance: float = 0.0
    certain: bool = True


UNKNOWN = Approach(2.0, 0.0, certain=False)
"""Of a scene that says nothing: any distribution of velocities needs a collision or two."""

VELOCITIES = Approach(2.0)
"""Of the reduced distribution of a cooling gas: its slowest mode of those measured, the heat flux,
decays with ν_κ' - 3ζ/2, 0.59/τ0 (α = 1) to 0.44/τ0 (α = 0.3), and √π τ0 is one collision."""

NEVER = Approach(inf, 0.0, certain=False)
"""Of disturbances that grow."""

MEASURED = InelasticHardSpheres | InelasticHardDisks | MaxwellMolecules
"""Gases for which `VELOCITIES` is known to hold."""


def of_velocities(gas: AbstractGas, *ranks: int, fed: bool = False) -> Approach:
    """Of the reduced velocity distribution of a gas that cools, and of disturbances of it.

    Of gases that nobody measured: the slowest of the first modes of the collision operator about a
    Maxwellian (`gases.relaxation`), 0 isotropic, 1 of heat flux and 2 of stress. There may be
    slower ones far from it. `fed`: what keeps it warm does not stretch its velocities.
    """
    if isinstance(gas, MEASURED):
        return VELOCITIES
    cooling = 0.0 if fed else cooling_rate(gas)
    rates = [relaxation(gas, INITIAL_TEMPERATURE, rank).slowest(cooling) for rank in ranks]
    if not min(rates) > 0:
        return NEVER
    slow = _at_start(gas.collision_rate) / min(rates)
    return Approach(max(VELOCITIES.collisions, slow), certain=False)


def cooling_rate(gas: AbstractGas) -> float:
    """ζ of the Maxwellian at T0 (1/τ0)."""
    return 2.0 / (gas.dimension * INITIAL_TEMPERATURE) * _at_start(gas.energy_loss_rate)


def of_sheared_gas(gas: AbstractGas, shear_rate: float, steady: bool = False) -> Approach:
    """Of T, hence of a*, in uniform shear: of the kinetic model, linear about T_s.

    Near the elastic limit T - T_s decays as exp(-2(1-α²)s/3) from any start; at α = 0.3 the slowest
    rate of the moment equations is 1.8 times less. The start is T0, or `steady`: the state of the
    model, off by less than its own size. Of other gases the same model, with their own rates of
    stress and energy; the run itself must tell whether there is more to them.
    """
    if not isinstance(gas, HardSpheres):
        return _of_other_sheared_gas(gas, shear_rate)
    cooling, beta = rates_of_model(gas)
    rate, temperature = slowest_rate(float(cooling), float(beta), shear_rate)
    per_time = (1.0 if isinstance(gas, InelasticHardSpheres) else beta) / sqrt(pi)
    return Approach(
        float(per_time) / rate, 0.0 if steady else log(max(1.0, 1.0 / temperature - 1.0))
    )


def _of_other_sheared_gas(gas: AbstractGas, shear_rate: float) -> Approach:
    """From the stress's decay per collision at T0 and the energy lost at each temperature."""
    velocities = of_velocities(gas, 0, 2, fed=True)
    stress = relaxation(gas, INITIAL_TEMPERATURE, 2).collisions[0, 0]
    per_collision = stress / _at_start(gas.collision_rate)

    def rates(log_temperature: float) -> tuple[float, float, float]:
        """ζ, the decay of reduced stress and the collision rate, in 1/τ0, at ln T/T0."""
        temperature = INITIAL_TEMPERATURE * exp(log_temperature)
        collisions = float(gas.collision_rate(temperature))
        lost = 2.0 / 3.0 / temperature * float(gas.energy_loss_rate(temperature))
        return lost, per_collision * collisions - lost, collisions

    def excess(log_temperature: float) -> float:
        lost, decay, _ = rates(log_temperature)
        strain = steady_shear(lost, decay * VISCOSITY_TIME)[0] if min(lost, decay) > 0 else 0.0
        return log(max(strain, 1e-300) / shear_rate)

    low, high = -30.0, 30.0
    if not excess(low) < 0.0 < excess(high):
        return velocities._replace(certain=False)
    hot = scipy.optimize.root_scalar(excess, bracket=(low, high), xtol=1e-6).root
    lost, decay, collisions = rates(hot)
    powers = [log(b / a) / 0.02 for a, b in zip(rates(hot - 0.01), rates(hot + 0.01), strict=True)]
    slow = collisions / _slowest(lost, decay * VISCOSITY_TIME, powers[0], powers[1])
    distance = log(max(1.0, exp(-hot) - 1.0))
    return Approach(max(velocities.collisions, slow), distance, certain=False)


def slowest_rate(cooling: float, beta: float, shear_rate: float) -> tuple[float, float]:
    """Slowest relaxation of the kinetic model of a sheared gas, in 1/τ(T_s), and T_s/T0.

    Arguments: ζτ > 0, collision rate over that of the elastic gas, a τ0. The moment
    equations of `theory.bgk_shear_flow` for ln T, Π = -P_xy/nT and Y = P_yy/nT are, with
    q = a τ(T), c = ζτ and r = ντ,

        (ln T)' = 2qΠ/3 - c,   Π' = qY - (r + 2qΠ/3)Π,   Y' = r - (r + 2qΠ/3)Y,

    and at rest 2qΠ/3 = c; ln q follows -ln T/2.
    """
    q = steady_shear(cooling, beta)[0]
    return _slowest(cooling, beta, 0.5, 0.5), (shear_rate / q) ** 2


def _slowest(cooling: float, beta: float, cools: float, decays: float) -> float:
    """The first of `slowest_rate`, with c ∝ T^cools and r ∝ T^decays; both 1/2 of hard spheres.

    In time of its own (a constant, c and r changing) the equations are those there.
    """
    c, r = cooling, beta / VISCOSITY_TIME
    q, stress, yy = steady_shear(cooling, beta)
    jacobian = [
        [-cools * c, 2.0 * q / 3.0, 0.0],
        [-decays * r * stress, -r - 2.0 * c, q],
        [decays * r * (1.0 - yy), -2.0 * q * yy / 3.0, -r - c],
    ]
    return float(np.min(-np.linalg.eigvals(jacobian).real))


def of_sheared_slab(
    gas: AbstractGas, shear_rate: float, length: float, steady: bool = False
) -> Approach:
    """Of a slab: its temperature as in uniform shear, and its flow, which diffuses across it.

    The longest wave of momentum decays in L²/(4π² η/nm), 0.05 L² τ(T) or 0.03 L² collisions per
    particle. Until then friction heats the gas by no more than the flow's energy, (aL)²/18 T0;
    not so from the uniform and `steady` state of the model.
    Long waves decay ever more slowly towards the length from which on uniform shear is unstable,
    about 11/√(1-α²) (25 at α = 0.9): from half of it the run itself must tell.
    """
    shear = of_sheared_gas(gas, shear_rate)
    if not isinstance(gas, HardSpheres):
        own = mean_free_paths(gas, INITIAL_TEMPERATURE)
        across = own_collisions(gas, own, length, 0.03 * (own * length) ** 2)
        return shear._replace(collisions=shear.collisions + across)
    cooling, beta = (float(x) for x in rates_of_model(gas))
    hottest = 1.0 + (shear_rate * length) ** 2 / 18.0
    _, temperature = slowest_rate(cooling, beta, shear_rate)
    return Approach(
        shear.collisions + 0.03 * length**2,
        0.0 if steady else log(max(1.0, hottest / temperature)),
        certain=length**2 * cooling / COOLING < 30.0,
    )


def own_collisions(gas: AbstractGas, own: float, length: float, collisions: float) -> float:
    """Collisions per particle of a gas in the time in which those of hard spheres are so many.

    A slab of hard spheres as many mean free paths long takes so many τ0 times `own`, those in one
    λ0; a gas that hardly collides forgets its start by crossing the slab.
    """
    each = min(1.0 / max(own, 1e-300), max(length, 1.0))
    return collisions * each * sqrt(pi) * _at_start(gas.collision_rate)


def _at_start(rate) -> float:
    """A rate of a gas at T0."""
    return float(rate(INITIAL_TEMPERATURE))


def of_conduction(
    gas: AbstractGas, cold_temperature: float, gravity: float, length: float
) -> Approach:
    """Of a gas between walls, started from Fourier's law without gravity.

    In the coordinate M = ∫n dz heat diffuses with 0.83 p/√T (T = p = 1 at T0 and the mean density)
    across L and two temperature jumps of 2 λ0 each, and sound is damped a little less fast: the
    longest wave takes (L+4)²/(π² 0.65) √T/p τ0. The collision rate per particle and τ0 is p/√(πT);
    averages over the particles, of which √T has equal numbers in equal intervals from √T_- to 1,
    give the factor below (1 at T_- = 1, 1.4 at 0.01). With gravity the layers fill first, and a
    side of the slab may empty: then the run itself must tell.
    """
    own, root = mean_free_paths(gas, INITIAL_TEMPERATURE), sqrt(cold_temperature)
    spread = 1.0 if root > 0.99 else (1.0 + root) * log(1.0 / root) / (2.0 * (1.0 - root))
    return Approach(
        own_collisions(gas, own, length, 0.088 * (own * length + 4.0) ** 2 * spread),
        log(max(1.0, 2.0 * abs(gravity) * length)),
        certain=abs(gravity) * length < 0.5 and isinstance(gas, MEASURED),
    )


def of_couette_flow(
    gas: AbstractGas, cold_temperature: float, motion: float, accommodation: float, length: float
) -> Approach:
    """Of momentum and heat between moving walls, started from a linear profile.

    Momentum diffuses with 0.56 √T/n, the slower of the two, across L and a slip of about 2 λ0 at
    either wall, (2-χ)/χ times as long if a share χ of the particles is absorbed: the longest wave
    takes L²/π² + bL/2 over that, b being the slip. The work of the walls, relative to T, is at most
    of order U². A gas that loses energy has a time of its own: then the run itself must tell.
    """
    slip = 2.0 * (2.0 - accommodation) / accommodation
    own, root = mean_free_paths(gas, INITIAL_TEMPERATURE), sqrt(cold_temperature)
    diffusing = 2.0 + 0.102 * own * length * (own * length + 5.0 * slip) / root
    return Approach(
        own_collisions(gas, own, length, diffusing),
        log(1.0 + motion**2),
        certain=isinstance(gas, MEASURED) and not loses_energy(gas) and motion < 2.0,
    )


def of_heat_flux_force(gas: AbstractGas, field: float) -> Approach:
    """Of a gas under the force: as without it if weak; a strong one slows it down or runs away."""
    free = of_velocities(gas, 0, 1)
    return free._replace(certain=free.certain and abs(field) < 0.3)
