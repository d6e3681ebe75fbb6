"""The steady state that the kinetic model has for a sheared gas: a start, and its relaxation.

Closed forms of `theory.bgk_shear_flow` (Astillero and Santos, "Uniform shear flow in dissipative
gases", 2005), in plain arithmetic: of host numbers, or traced.
"""

from typing import Any

from ..gases import AbstractGas, ElasticHardSpheres, InelasticHardSpheres
from ..motion.drive import held_at
from ..types import Particles, Scalar
from ..units import COOLING, INITIAL_TEMPERATURE, VISCOSITY_TIME

HardSpheres = InelasticHardSpheres | ElasticHardSpheres
"""Gases that the model is made for."""


def rates_of_model(gas: AbstractGas) -> tuple[Any, Any]:
    """ζτ and β, eqs. (2.16) and (2.21); ValueError for a gas that the model is not made for."""
    if isinstance(gas, InelasticHardSpheres):
        return COOLING * (1.0 - gas.restitution**2), (1.0 + gas.restitution) / 2.0
    if isinstance(gas, ElasticHardSpheres):
        return gas.drag_coefficient(), gas.collision_factor()
    raise ValueError(
        'initial_state = "steady" is known for gases of hard spheres, not for '
        f'{type(gas).__name__}; take another, "equilibrium" say.'
    )


def steady_shear(cooling: Any, beta: Any) -> tuple[Any, Any, Any]:
    """a τ(T_s), -P_xy/nT and P_yy/nT of ζτ and β; T_s/T0 is a τ0 over the first, squared."""
    per_time = beta / VISCOSITY_TIME
    z = cooling / per_time
    e = (1.5 * z) ** 0.5 * (1.0 + z)
    return e * per_time, e / (1.0 + z) ** 2, 1.0 / (1.0 + z)


def sheared(normal: Particles, gas: AbstractGas, shear_rate: Scalar) -> Particles:
    """Normal velocities of the model's stresses, of mean zero and exactly its temperature.

    Arguments: standard normal velocities, up to a common factor. With normal x and y,
    V_y = √(P_yy/nT) y and V_x = √(P_xx/nT - (P_xy/nT)²/(P_yy/nT)) x + (P_xy/P_yy) V_y.
    """
    strain, stress, yy = steady_shear(*rates_of_model(gas))
    x, y, z = normal
    vy = yy**0.5 * y
    vx = (3.0 - 2.0 * yy - stress**2 / yy) ** 0.5 * x - stress / yy * vy
    shaped, _ = held_at((vx, vy, yy**0.5 * z), INITIAL_TEMPERATURE)
    return tuple(shear_rate / strain * v for v in shaped)


def check_start(gas: AbstractGas, has_steady_state: bool) -> None:
    """Raise ValueError for a gas whose steady state the model does not know, or that has none."""
    rates_of_model(gas)
    if not has_steady_state:
        raise ValueError(
            'initial_state = "steady" needs a steady state: shear_rate > 0 and a gas that loses '
            'energy; take another, "equilibrium" say.'
        )
