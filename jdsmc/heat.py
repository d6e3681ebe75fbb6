"""Heat flux and the first-order distribution: sums on the device, ratios on the host.

Equation numbers: Montanero, Santos and Garzó, Physica A 376, 75 (2007). c = V/√(2T/m).
"""

import math

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from scipy.special import gamma, genlaguerre

from .collide import Collisions
from .drive import mean
from .measure import Moments, histogram, moments
from .observables import isotropic, moment_averages, rate_averages
from .types import Scalar, Velocity

ELASTIC_CONDUCTIVITY = 75.0 * math.sqrt(math.pi) / 64.0
"""κ0 at T0, eq. (2.47), in n λ0 v0."""

ORDERS = (1, 2, 3)
"""Sonine orders k."""


class HeatMoments(eqx.Module):
    """Moments odd in V_x at one instant, beside the even ones.

    `flux`: ⟨V_x V^{2j}⟩, `marginal`: ⟨V_x^{2j+1}⟩, j = 1, 2, 3 (units of v0).
    """

    isotropic: Moments
    flux: Float[Array, "3"]
    marginal: Float[Array, "3"]


class HeatRecord(eqx.Module):
    """What one record reports; see `Record`.

    `elapsed` is the time of the gas held at T0, ∫ √(T/T0) dt, and `slowing` refers to it.
    `runaway` is the largest -½ ε V_x dt of a particle in a step, `step` the mean dt.
    """

    moments: HeatMoments
    tally: Collisions
    elapsed: Scalar
    slowing: Float[Array, "2"]
    runaway: Scalar
    step: Scalar


class MarginalVelocity(eqx.Module):
    """Fractions of particles in bins of c_x, at one instant."""

    marginal_x: Float[Array, " bins"]


def heat_moments(velocity: Velocity) -> HeatMoments:
    """All moments of one instant."""
    vx = velocity[0]
    square, along = sum(v * v for v in velocity), vx * vx
    flux = [mean(vx * power) for power in _powers(square)]
    marginal = [mean(vx * power) for power in _powers(along)]
    return HeatMoments(moments(velocity), jnp.stack(flux), jnp.stack(marginal))


def _powers(x):
    return x, x * x, x * x * x


def marginal_velocity(velocity: Velocity) -> MarginalVelocity:
    """Histogram of c_x."""
    scale = jnp.sqrt(1.5 / mean(sum(v * v for v in velocity)))
    return MarginalVelocity(histogram(velocity[0] * scale, symmetric=True))


def heat_averages(record: HeatRecord) -> dict[str, np.ndarray]:
    """Averages over the particles at each record; odd moments of c."""
    m = record.moments
    averages = moment_averages(m.isotropic) | rate_averages(m.isotropic, record.slowing)
    thermal = np.sqrt(2.0 * averages["temperature"])
    odd = {}
    for j, power in enumerate((3, 5, 7)):
        odd[f"flux{power}"] = m.flux[..., j] / thermal**power
        odd[f"marginal{power}"] = m.marginal[..., j] / thermal**power
    return averages | odd


def heat_observables(means: dict, field) -> dict:
    """κ'/κ0 = -q_x/(T ε κ0), eq. (3.9); b'_k from (3.10) and from (3.12); cumulants.

    All are divided by the field, at zero field they are not defined (NaN).
    """
    even = isotropic(means)
    even.pop("temperature")
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = -means["flux3"] / (field * ELASTIC_CONDUCTIVITY)
        full = [sonine(means, "flux", k, 1.5) / field for k in ORDERS]
        marginal = [sonine(means, "marginal", k, 0.5) / field for k in ORDERS]
    return {
        "conductivity_ratio": ratio,
        "sonine": np.stack(full, axis=-1),
        "sonine_marginal": np.stack(marginal, axis=-1),
        **even,
    }


def sonine(means: dict, kind: str, order: int, index: float):
    """2Γ(1+index) k!/Γ(k+1+index) ⟨c_x L_k^{(index)}⟩; ⟨c_x⟩ = 0 exactly."""
    polynomial = genlaguerre(order, index).coeffs[::-1]
    average = sum(polynomial[j] * means[f"{kind}{2 * j + 1}"] for j in range(1, order + 1))
    return 2.0 * gamma(1 + index) * gamma(order + 1) / gamma(order + 1 + index) * average
