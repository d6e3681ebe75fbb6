"""What is measured of a cooling gas of disks, whoever moves them: transverse modes and moments.

Costantini and Puglisi, "Hydrodynamic noise of a cooling gas", PRE 82, 011305 (2010), eqs. (6) to
(13); the formulas lost in print are rebuilt in docs/cooling_fluctuations.md. Everything is in the
stationary representation: s = ln(1 + μt)/μ, w = v e^{μs}.
"""

import math
from typing import Any, ClassVar

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float

from .. import check
from ..fields import number
from ..gases import AbstractGas, InelasticHardDisks
from ..measure.mode_series import block_means, mode_observables, remarks
from ..measure.observable import Observable
from ..theory import langevin
from ..types import Scalar
from ..units import INITIAL_TEMPERATURE
from .approach import Approach
from .base import AbstractScene, Record, weighted_means
from .options import Options

LOWEST_RESTITUTION = 0.4
"""Below it the deterministic theory, which says what is stable, does not converge."""

SPACING = 0.7
"""Time between samples of the modes (τ0), 0.25/(nσ v0)."""

COLLISIONS_PER_TIME = 0.5 * math.sqrt(math.pi) / 2.0
"""Pair collisions per particle and τ0 in equilibrium: half of 2√π nσ√(T/m) = 0.8862."""

LAG = ("lag",)
OBSERVABLES = (
    Observable("viscosity_ratio", "viscosity η/η0", symbol="η/η0"),
    Observable("noise_viscosity_ratio", "viscosity of the noise η1/η0, from C(0)", symbol="η1/η0"),
    Observable("noise_over_viscosity", "violation of the fluctuation relation η1/η", symbol="η1/η"),
    Observable("mode_amplitude", "amplitude of the mode C(0)/(N T~/m)", symbol="C(0)"),
    Observable("mode_decay_rate", "decay rate of the mode 1/τ", "1/τ0", symbol="1/τ"),
    Observable("tail_amplitude", "amplitude A of the tail of C(s)", symbol="A"),
    Observable(
        "tail_noise_viscosity_ratio", "η1/η0 with A for C(0) (white noise)", symbol="η1/η0 (tail)"
    ),
    Observable(
        "tail_noise_over_viscosity", "η1/η with A for C(0) (white noise)", symbol="η1/η (tail)"
    ),
    Observable("temperature", "temperature T~/T0", symbol="T~/T0"),
    Observable("a2", "fourth cumulant a2", symbol="a2"),
    Observable("cooling_rate", "cooling rate ζ from the energy lost", "1/τ0", symbol="ζ"),
    Observable("collision_rate_ratio", "collision rate over its local-equilibrium value"),
    Observable("autocorrelation", "C(s)/(N T~/m)", dims=LAG, symbol="C(s)"),
)
MODE_POWER = Observable("mode_power", "power of the slowest modes |ξ|²/(N T0/m)", symbol="|ξ|²/NT")


class DiskMoments(eqx.Module):
    """One instant: modes Σ w_⊥ exp(ik·r) over all simulated disks, T~ (m v0²) and ⟨w⁴⟩."""

    modes: Float[Array, "4 2"]
    temperature: Scalar
    fourth: Scalar


class AbstractCoolingDisks(AbstractScene):
    """A cooling gas of disks in a periodic square, and its slowest transverse modes.

    N real disks of n σ² = `density`; what matters in the dilute limit is N n σ² alone: the side is
    √(8 N nσ²) λ0.
    """

    density: eqx.AbstractVar[Any]
    growth_rate: eqx.AbstractVar[Any]

    dimensions: ClassVar[tuple[int, ...]] = (2,)
    in_space: ClassVar[bool] = True
    correlated: ClassVar[bool] = True
    reports: ClassVar[tuple[Observable, ...]] = OBSERVABLES
    evolves: ClassVar[tuple[Observable, ...]] = (MODE_POWER,)
    monitored: ClassVar[tuple[str, ...]] = ("temperature", "fourth")
    default_rtol: ClassVar[float] = 0.02

    def __check_init__(self):
        if not isinstance(self.gas, InelasticHardDisks):
            raise TypeError(
                f"{type(self).__name__} needs InelasticHardDisks; got {type(self.gas).__name__}."
            )
        check.in_range("restitution", self.gas.restitution, LOWEST_RESTITUTION, 1.0)

    def default_particles(self) -> int:
        """Real disks: as many as a mode that decays well needs."""
        return 1000

    def prepared(self) -> "AbstractCoolingDisks":
        """With the growth rate that holds the dilute gas at T0, if none was given."""
        if not isinstance(self.growth_rate, str):
            return self
        own = langevin.cooling_state(float(self.gas.restitution)).growth_rate
        return eqx.tree_at(lambda s: s.growth_rate, self, np.float64(own))

    def check_stability(self, n_particles: int) -> None:
        """Raise ValueError for a system whose slowest mode grows, with the N that would do."""
        alpha = float(self.gas.restitution)
        limit = langevin.stability_limit(alpha)
        if n_particles * self.density >= limit:
            raise ValueError(
                f"n_particles = {n_particles} at density = {self.density:g} is unstable at "
                f"restitution = {alpha:g}: N n σ² = {n_particles * self.density:.4g}, and the "
                f"slowest mode grows beyond {limit:.4g}. Take at most "
                f"{math.ceil(limit / self.density) - 1} particles."
            )

    def side(self, n_real: int):
        """L in λ0."""
        return (8.0 * n_real * self.density) ** 0.5

    def companion(self, n_real: int) -> langevin.TransverseMode:
        """The deterministic theory of this system."""
        return langevin.transverse_mode(float(self.gas.restitution), n_real * float(self.density))

    def approach(self) -> Approach:
        """T~ comes to its fixed point at the rate μ; the mode decays at a rate that N decides.

        N is not known here. Half way to the instability the mode is no slower than three times
        T~; nearer to it, the tests for drift and the length of blocks take over.
        """
        growth = float(self.growth_rate)
        slowest = 1.0 / max(growth, 0.01)
        return Approach(2.0 * COLLISIONS_PER_TIME * max(slowest, 20.0))

    def averages(self, record: Record) -> dict[str, np.ndarray]:
        """Modes (complex) and moments of each sample."""
        m = record.moments
        heat = np.asarray(m.temperature)
        modes = np.asarray(m.modes)
        return {
            "modes": modes[..., 0] + 1j * modes[..., 1],
            "temperature": heat,
            "fourth": np.asarray(m.fourth),
            "instant_rate": self.gas.collision_rate(heat),
            "real_particles": np.asarray(record.real_particles),
        }

    def evolution(self, means: dict) -> dict:
        """Temperature, a2 and the power of the slowest modes."""
        heat = means["temperature"]
        return {
            "temperature": heat / INITIAL_TEMPERATURE,
            "a2": means["fourth"] / (8.0 * heat**2) - 1.0,
            "cooling_rate": means["energy_lost"] / heat,
            "collision_rate_ratio": means["accepted"] / means["instant_rate"],
        }
