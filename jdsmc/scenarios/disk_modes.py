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
from ..gases import InelasticHardDisks
from ..measure import modes
from ..measure.mode_spectrum import Spectrum
from ..measure.observable import Observable
from ..measure.runaway import runs_away
from ..theory import langevin
from ..types import Scalar
from ..units import INITIAL_TEMPERATURE
from .approach import Approach
from .base import AbstractScene, Record
from .options import Options

LOWEST_RESTITUTION = 0.4
"""Below it the deterministic theory, which says what is stable, does not converge."""

SMALLEST = 8.0
"""N n σ² from which the theory finds a hydrodynamic mode at every restitution."""

SLOWEST_MODE = 5.0
"""Decay times of the mode that are discarded, divided by the 3.6 slow times of any warm-up."""

LAGS = 65
"""Lags at which C(s) is reported, from 0 to five decay times."""

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


def density_field():
    """n σ² in (0, 0.5]."""
    return number("density n σ²", low=0.0, high=0.5, low_included=False, default=0.01)


def growth_rate_field():
    """μ in 1/τ0, or "cooling": the one that holds the dilute gas at T0."""
    facts = {"low": 0.0, "high": 1.0, "names": ("cooling",), "default": "cooling"}
    return number("growth rate μ of the scaled velocities", "1/τ0", **facts)


class DiskMoments(eqx.Module):
    """One instant: modes Σ w_⊥ exp(ik·r) over all simulated disks, T~ (m v0²) and ⟨w⁴⟩."""

    modes: Float[Array, "4 2"]
    temperature: Scalar
    fourth: Scalar


class DiskRecord(Record):
    """One sample, what the steps after it did, and `counts`: real disks and simulated ones."""

    counts: Float[Array, "2"]


class AbstractCoolingDisks(AbstractScene):
    """A cooling gas of disks in a periodic square, and its slowest transverse modes.

    N real disks of n σ² = `density`; what matters in the dilute limit is N n σ² alone: the side is
    √(8 N nσ²) λ0.
    """

    gas: eqx.AbstractVar[InelasticHardDisks]
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
        """The deterministic theory of this system; ValueError where it is so small that the mode
        has no exponential tail."""
        share = n_real * float(self.density)
        try:
            return langevin.transverse_mode(float(self.gas.restitution), share)
        except ValueError as error:
            raise ValueError(
                f"n_particles = {n_real} at density = {float(self.density):g} is too small a "
                f"system: at N n σ² = {share:.4g} the mode decays as fast as the stress behind it, "
                f"so there is no viscosity. Take {np.ceil(SMALLEST / float(self.density)):.9g} "
                "particles or more."
            ) from error

    def approach(self, options: Options) -> Approach:
        """T~ comes to its fixed point at the rate μ, the mode to its amplitude at the rate 1/τ."""
        per_time = float(self.gas.collision_rate(INITIAL_TEMPERATURE))
        growth = float(self.growth_rate)
        slowest = SLOWEST_MODE / 3.6 / self.companion(options.n_particles).decay_rate
        return Approach(per_time * max(slowest, 1.0 / growth if growth > 0 else 0.0))

    def axes(self, options: Options) -> dict:
        """Lags of C(s): multiples of the time between samples."""
        _, lags = self.lags(options.n_particles, options.steps * options.time_step)
        return {"lag": (lags, {"long_name": "lag s", "units": "τ0"})}

    def lags(self, n_real: int, spacing: float) -> tuple[int, np.ndarray]:
        """Samples between two lags, and the lags (τ0)."""
        return lags_of(self.companion(n_real).decay_rate, spacing)

    def averages(self, record: DiskRecord) -> dict[str, np.ndarray]:
        """Modes (complex) and moments of each sample."""
        m: Any = record.moments
        counts = np.asarray(record.counts)
        modes_now = m.modes[..., 0] + 1j * m.modes[..., 1]
        return {
            "modes": modes_now,
            "slowest_power": np.mean(np.abs(modes_now[..., :2]) ** 2, axis=-1),
            "temperature": m.temperature,
            "square": m.temperature**2,
            "fourth": m.fourth,
            "instant_rate": self.gas.collision_rate(m.temperature),
            "real": counts[..., 0],
            "simulated": counts[..., 1],
        }

    def evolution(self, means: dict) -> dict:
        """Temperature, a2 and rates against time, and the power of the slowest modes."""
        norm = means["simulated"] * INITIAL_TEMPERATURE
        return self.moments(means) | {"mode_power": means["slowest_power"] / norm}

    def moments(self, means: dict) -> dict:
        """T~, a2 and the rates."""
        heat = means["temperature"]
        return {
            "temperature": heat / INITIAL_TEMPERATURE,
            "a2": means["fourth"] / (8.0 * means["square"]) - 1.0,
            "cooling_rate": means["energy_lost"] / heat,
            "collision_rate_ratio": means["accepted"] / means["instant_rate"],
        }

    def window(self, series: dict[str, np.ndarray], weights: np.ndarray) -> dict[str, np.ndarray]:
        """Averages of blocks of some 25 decay times: arrays (realizations x blocks, ...)."""
        spacing = float(np.mean(weights))
        means, plan = modes.block_means(_slowest(series), spacing, series["temperature"])
        length, blocks = plan.spectrum.length, len(means["power"])
        stride, _ = self.lags(int(np.mean(series["real"])), spacing)
        correlation = np.full((blocks, LAGS), np.nan)
        reached = min(LAGS, (means["correlation"].shape[1] - 1) // stride + 1)
        correlation[:, :reached] = means["correlation"][:, : reached * stride : stride]
        for name in ("square", "fourth", "energy_lost", "accepted", "instant_rate"):
            means[name] = np.mean(modes.cut(series[name][:, None], length), axis=(1, 2))
        fixed = {
            "frequency": plan.spectrum.frequency,
            "weight": plan.spectrum.weight,
            "pooled": plan.pooled,
            "sizes": np.array([length, spacing, plan.pace]),
            "counts": np.array([np.mean(series["real"]), np.mean(series["simulated"])]),
        }
        repeated = {name: np.broadcast_to(v, (blocks, *v.shape)) for name, v in fixed.items()}
        return means | {"correlation": correlation} | repeated

    def observables(self, means: dict) -> dict:
        """The mode's numbers by eqs. (9) to (11), refitted to the averages given; and moments."""
        length, spacing, pace = means["sizes"]
        spectrum = Spectrum(means["frequency"], means["weight"], round(length), spacing)
        plan = modes.Plan(spectrum, pace, means["pooled"])
        n_real, simulated = means["counts"]
        wave_number = 2.0 * math.pi / self.side(round(n_real))
        found = modes.mode_observables(means, plan, simulated, self.growth_rate, wave_number)
        if modes.no_tail(plan.pooled):
            found |= dict.fromkeys(modes.FITTED, np.nan)
        return found | self.moments(means)

    def trouble(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """A mode that grows without bound."""
        spacing, simulated = float(np.mean(weights)), round(np.mean(series["simulated"]))
        modes_now = _slowest(series)
        if modes_now.shape[-1] * spacing < 20.0:
            return ""
        if not runs_away(modes_now, spacing, simulated, series["temperature"]):
            return ""
        limit = langevin.stability_limit(float(self.gas.restitution))
        return (
            "The slowest mode runs away: it grows without bound. This system is too near to its "
            f"limit of stability, N n σ² = {limit:.4g}; take fewer particles."
        )

    def long_enough(self, series: dict[str, np.ndarray], weights: np.ndarray) -> bool:
        """Each realization lasts 20 decay times of theory, all together 100."""
        decay_times = (
            np.sum(weights, axis=1) * self.companion(round(np.mean(series["real"]))).decay_rate
        )
        least, whole = modes.SHORTEST_BLOCK, modes.SHORTEST_RUN
        return bool(np.min(decay_times) >= least and np.sum(decay_times) >= whole)

    def remarks(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """How long the run was against the decay of the mode, if it was short; its distance from
        the limit of stability."""
        spacing, simulated = float(np.mean(weights)), _slowest(series)
        means, plan = modes.block_means(simulated, spacing, series["temperature"])
        decay = float(np.exp(-plan.pooled[1]))
        run = simulated.shape[0] * simulated.shape[2] * spacing / decay
        block = plan.spectrum.length * spacing / decay
        share = np.mean(series["real"]) * self.density
        limit = langevin.stability_limit(float(self.gas.restitution))
        place = f"N n σ² = {share:.4g}" + (
            f", {1.0 - share / limit:.0%} below the limit of stability {limit:.4g}."
            if math.isfinite(limit)
            else "; an elastic gas is stable at any size."
        )
        return " ".join([place, *modes.doubts(run, block, len(means["power"]), plan.pooled)])


def lags_of(decay_rate: float, spacing: float) -> tuple[int, np.ndarray]:
    """Samples between two lags, and the lags (τ0), of a mode that decays so fast."""
    stride = max(1, math.ceil(5.0 / decay_rate / (LAGS - 1) / spacing))
    return stride, stride * spacing * np.arange(LAGS)


def _slowest(series: dict[str, np.ndarray]) -> np.ndarray:
    """The two modes of the smallest wave number: (realizations, modes, samples)."""
    return np.swapaxes(series["modes"][..., :2], 1, 2)
