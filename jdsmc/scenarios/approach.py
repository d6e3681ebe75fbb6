"""How long a gas takes to its steady state: from kinetic models, not from the run itself.

Early in a run nothing in its numbers tells that they will change: all realizations start with one
temperature, and near the elastic limit it moves by a percent while each particle collides ten
times. So a scene says beforehand what its slowest relaxation is. All numbers are host scalars, of
one gas at one point of a sweep; times are in accepted collisions per particle.
"""

from math import log, pi, sqrt
from typing import NamedTuple

import numpy as np

from ..gases import AbstractGas, InelasticHardSpheres
from ..gases.hard_spheres import loses_energy
from ..units import COOLING, VISCOSITY_TIME
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


def of_sheared_gas(gas: AbstractGas, shear_rate: float, steady: bool = False) -> Approach:
    """Of T, hence of a*, in uniform shear: of the kinetic model, linear about T_s.

    Near the elastic limit T - T_s decays as exp(-2(1-α²)s/3) from any start; at α = 0.3 the slowest
    rate of the moment equations is 1.8 times less. The start is T0, or `steady`: the state of the
    model, off by less than its own size. Unknown unless the gas is made of hard spheres.
    """
    if not isinstance(gas, HardSpheres):
        return UNKNOWN
    cooling, beta = rates_of_model(gas)
    rate, temperature = slowest_rate(float(cooling), float(beta), shear_rate)
    per_time = (1.0 if isinstance(gas, InelasticHardSpheres) else beta) / sqrt(pi)
    return Approach(
        float(per_time) / rate, 0.0 if steady else log(max(1.0, 1.0 / temperature - 1.0))
    )


def slowest_rate(cooling: float, beta: float, shear_rate: float) -> tuple[float, float]:
    """Slowest relaxation of the kinetic model of a sheared gas, in 1/τ(T_s), and T_s/T0.

    Arguments: ζτ > 0, collision rate over that of the elastic gas, a τ0. The moment
    equations of `theory.bgk_shear_flow` for ln T, Π = -P_xy/nT and Y = P_yy/nT are, with
    q = a τ(T), c = ζτ and r = ντ,

        (ln T)' = 2qΠ/3 - c,   Π' = qY - (r + 2qΠ/3)Π,   Y' = r - (r + 2qΠ/3)Y,

    and at rest 2qΠ/3 = c; ln q follows -ln T/2.
    """
    c, r = cooling, beta / VISCOSITY_TIME
    q, stress, yy = steady_shear(cooling, beta)
    jacobian = [
        [-c / 2.0, 2.0 * q / 3.0, 0.0],
        [-0.5 * (q * yy - c * stress), -r - 2.0 * c, q],
        [c * yy / 2.0, -2.0 * q * yy / 3.0, -r - c],
    ]
    return float(np.min(-np.linalg.eigvals(jacobian).real)), (shear_rate / q) ** 2


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
    if not isinstance(gas, HardSpheres):
        return UNKNOWN
    shear = of_sheared_gas(gas, shear_rate)
    cooling, beta = (float(x) for x in rates_of_model(gas))
    hottest = 1.0 + (shear_rate * length) ** 2 / 18.0
    _, temperature = slowest_rate(cooling, beta, shear_rate)
    return Approach(
        shear.collisions + 0.03 * length**2,
        0.0 if steady else log(max(1.0, hottest / temperature)),
        certain=length**2 * cooling / COOLING < 30.0,
    )


def of_conduction(cold_temperature: float, gravity: float, length: float) -> Approach:
    """Of a gas between walls, started from Fourier's law without gravity.

    In the coordinate M = ∫n dz heat diffuses with 0.83 p/√T (T = p = 1 at T0 and the mean density)
    across L and two temperature jumps of 2 λ0 each, and sound is damped a little less fast: the
    longest wave takes (L+4)²/(π² 0.65) √T/p τ0. The collision rate per particle and τ0 is p/√(πT);
    averages over the particles, of which √T has equal numbers in equal intervals from √T_- to 1,
    give the factor below (1 at T_- = 1, 1.4 at 0.01). With gravity the layers fill first, and a
    side of the slab may empty: then the run itself must tell.
    """
    root = sqrt(cold_temperature)
    spread = 1.0 if root > 0.99 else (1.0 + root) * log(1.0 / root) / (2.0 * (1.0 - root))
    return Approach(
        0.088 * (length + 4.0) ** 2 * spread,
        log(max(1.0, 2.0 * abs(gravity) * length)),
        certain=abs(gravity) * length < 0.5,
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
    root = sqrt(cold_temperature)
    return Approach(
        2.0 + 0.102 * (length**2 + 5.0 * slip * length) / root,
        log(1.0 + motion**2),
        certain=not loses_energy(gas) and motion < 2.0,
    )


def of_heat_flux_force(field: float) -> Approach:
    """Of a gas under the force: as without it if weak; a strong one slows it down or runs away."""
    return VELOCITIES._replace(certain=abs(field) < 0.3)
