"""Heat flux and the first-order distribution: sums on the device, ratios on the host.

Equation numbers: Montanero, Santos and Garzó, Physica A 376, 75 (2007). c = V/√(2T/m).
"""

from functools import cache

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from scipy.special import gamma, genlaguerre

from ..sums import mean
from ..types import Velocity
from ..units import CONDUCTIVITY
from .distributions import histogram
from .moments import Moments, moments
from .observable import Observable

ORDERS = (1, 2, 3)
"""Sonine orders k."""

RESPONSES = (
    Observable("modified_conductivity", "modified thermal conductivity κ'/κ0", symbol="κ'/κ0"),
    Observable("sonine", "Sonine coefficients b'_k, eq. (3.10)", dims=("sonine_order",)),
    Observable("sonine_marginal", "Sonine coefficients b'_k, eq. (3.12)", dims=("sonine_order",)),
)


class HeatMoments(eqx.Module):
    """Moments odd in V_x at one instant, beside the even ones.

    `flux`: ⟨V_x V^{2j}⟩, `marginal`: ⟨V_x^{2j+1}⟩, j = 1, 2, 3 (units of v0).
    """

    isotropic: Moments
    flux: Float[Array, "3"]
    marginal: Float[Array, "3"]


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


def odd_averages(m: HeatMoments, temperature: np.ndarray) -> dict[str, np.ndarray]:
    """Odd moments of c at each record."""
    thermal = np.sqrt(2.0 * temperature)
    odd = {}
    for j, power in enumerate((3, 5, 7)):
        odd[f"flux{power}"] = m.flux[..., j] / thermal**power
        odd[f"marginal{power}"] = m.marginal[..., j] / thermal**power
    return odd


def responses(means: dict, field) -> dict:
    """κ'/κ0 = -q_x/(T ε κ0), eq. (3.9); b'_k from (3.10) and from (3.12).

    All are divided by the field, at zero field they are not defined (NaN).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = -means["flux3"] / (field * CONDUCTIVITY)
        full = [sonine(means, "flux", k, 1.5) / field for k in ORDERS]
        marginal = [sonine(means, "marginal", k, 0.5) / field for k in ORDERS]
    return {
        "modified_conductivity": ratio,
        "sonine": np.stack(full, axis=-1),
        "sonine_marginal": np.stack(marginal, axis=-1),
    }


def sonine(means: dict, kind: str, order: int, index: float):
    """2Γ(1+index) k!/Γ(k+1+index) ⟨c_x L_k^{(index)}⟩; ⟨c_x⟩ = 0 exactly."""
    polynomial = _laguerre(order, index)
    average = sum(polynomial[j] * means[f"{kind}{2 * j + 1}"] for j in range(1, order + 1))
    return 2.0 * gamma(1 + index) * gamma(order + 1) / gamma(order + 1 + index) * average


@cache
def _laguerre(order: int, index: float) -> np.ndarray:
    """Coefficients of L_k^{(index)}, that of x^0 first."""
    return genlaguerre(order, index).coeffs[::-1]
