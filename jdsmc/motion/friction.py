"""Flow, temperature and stress of each layer of a slab, and friction towards its flow."""

import equinox as eqx
import jax.numpy as jnp

from ..gases import ElasticHardSpheres
from ..gases.scatter import root
from ..types import Layer, Profile, Scalar, Velocities
from .cells import populations, totals


class LayerFlow(eqx.Module):
    """What the particles of each layer share.

    `number` N; `mean`: velocity components of their centre of mass (v0), 0 where there is none;
    `temperature` T (m v0²) = Σ(v-u)²/3(N-1), 0 for fewer than two particles. The paper divides by
    N (eq. 4.6); but u is the mean of the same N velocities, which leaves 3(N-1) degrees of freedom:
    N would make a gas in equilibrium too cold by 1/N, half a percent with 200 particles.
    """

    number: Profile
    mean: tuple[Profile, ...]
    temperature: Profile

    @staticmethod
    def of(layer: Layer, velocity: Velocities, count: int) -> "LayerFlow":
        """Of the particles in each of `count` layers."""
        number = populations(layer, count).astype(velocity[0].dtype)
        some = jnp.maximum(number, 1.0)
        mean = tuple(totals(layer, v, count) / some for v in velocity)
        vx, vy, vz = peculiar(layer, velocity, mean)
        square = vx * vx + vy * vy + vz * vz
        return LayerFlow(number, mean, totals(layer, square, count) / (3.0 * others(number)))


def others(number: Profile) -> Profile:
    """N - 1, or infinitely many where N < 2: what is divided by it is then zero."""
    return jnp.where(number > 1, number - 1.0, jnp.inf)


def peculiar(layer: Layer, velocity: Velocities, mean: tuple[Profile, ...]) -> Velocities:
    """Velocities of the particles relative to the flow of their layer."""
    return tuple(v - u[layer] for v, u in zip(velocity, mean, strict=True))


def friction(gas: ElasticHardSpheres, flow: LayerFlow) -> Profile:
    """Rate ζ0/2 = (c/2) n √(2T) at which peculiar velocities decay in each layer: eq. (2.16).

    The energy lost by N particles, ζ0 Σ(v-u)²/2, is proportional to N (N-1) T^{3/2}. So is the
    number of their collisions, and like it has the right mean whatever the layers' populations
    (⟨N(N-1)⟩ = ⟨N⟩² if they fluctuate as in an ideal gas), except that T fluctuates too: with
    k = 3(N-1) degrees of freedom ⟨T^{3/2}⟩ of a Maxwellian is too large by
    (2/k)^{3/2} Γ((k+3)/2)/Γ(k/2) = √((k+1)²(k - 1/2 + 1/8k)/k³), 1 + 1/4N for large N. That is
    divided out. What is left is of order 1/N²: fast particles slow their own layer (α = 0.5 cools
    to T/8 0.1% too hot with 20 particles a layer, 0.7% with 4).
    """
    number = flow.number
    freedom = 3.0 * jnp.maximum(number - 1.0, 1.0)
    excess = (freedom + 1.0) ** 2 * (freedom - 0.5 + 0.125 / freedom) / freedom**3
    density = number / jnp.mean(number)
    return 0.5 * gas.drag_coefficient() * density * root(2.0 * flow.temperature / excess)


def slowing(rate: Profile, duration: Scalar) -> Profile:
    """Factor of the peculiar velocities after `duration` of friction alone, starting at `rate`.

    dT/dt = -ζ0 T with ζ0 ∝ √T has the solution √T(t) = √T(0)/(1 + ζ0(0) t/2), Haff's law.
    """
    return 1.0 / (1.0 + rate * duration)


def slowed(
    layer: Layer, velocity: Velocities, mean: tuple[Profile, ...], factor: Profile
) -> Velocities:
    """Velocities whose peculiar part is multiplied with the factor of their layer: eq. (4.12)."""
    parts = zip(peculiar(layer, velocity, mean), mean, strict=True)
    return tuple(u[layer] + factor[layer] * part for part, u in parts)
