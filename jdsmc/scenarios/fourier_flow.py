"""Heat conduction between two walls under gravity.

Tahiri, Tij and Santos, "Monte Carlo simulation of a hard-sphere gas in the planar Fourier flow with
a gravity field" (2000). Units as everywhere, T0 being the temperature T_+ of the hot wall at z = L;
gravity is an acceleration -g ẑ, so that g > 0 presses the gas to the cold wall.
"""

from dataclasses import replace
from typing import Any, ClassVar, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from .. import random
from ..collisions.bound import next_bound
from ..collisions.meet import Collisions
from ..fields import choice, count, number
from ..gases import AbstractGas, ElasticHardSpheres
from ..gases.base import check_gas, conserves_energy, power_law, speed_exponent
from ..measure import conduction
from ..measure.observable import Observable
from ..motion.cells import populations, totals
from ..motion.flight import Exchange, fly
from ..motion.walls import Walls, check_gradients, made_before
from ..types import Key, Profile, Scalar
from ..units import INITIAL_TEMPERATURE
from .approach import Approach, of_conduction
from .base import Record
from .layers import WIDEST, thin_layers
from .options import Options
from .slab import AbstractSlab, SlabState, maxwellian_at, uniform

FAST = 4.0
"""Speed (v0) that must not carry a particle across the slab in one step."""

FIRST_DENSITY, FIRST_SPEED = 5.0, 4.0
"""What the first step is made short for: probabilities per time of 5 times the rate at 4 v0, a
density of 3 and a fast pair."""


TOO_WIDE = 0.005
"""Share of the heat flux that layers may carry unseen before a run remarks on it."""


class Conduction(eqx.Module):
    """Sums over the particles of each layer at one instant, or their mean over several.

    `number`; `square`: Σ v²; `zz`: Σ v_z²; `flux`: Σ v² v_z/2; and over all of them `height`: Σ z.
    """

    number: Profile
    square: Profile
    zz: Profile
    flux: Profile
    height: Scalar


class FourierRecord(Record):
    """One record: sums averaged over its samples, collisions, its length, and wall exchange."""

    exchange: Exchange


class WalledState(SlabState):
    """A gas and its walls: they never change, but their tables take time to make.

    `exchange`: what the walls did since it was last reported.
    """

    walls: Walls
    exchange: Exchange


class FourierFlow(AbstractSlab):
    """A gas between walls at T_- (z = 0) and T_+ = T0 (z = L), started from Fourier's law (eq. 31).

    Arguments:
        gas: one without drag that conserves energy (`InelasticHardSpheres(1.0)`, the default, or
            `MaxwellMolecules()`).
        cold_temperature: T_-/T_+ in (0, 1].
        gravity: g in v0²/λ0, positive towards the cold wall; between -1 and 1.
        length: L in λ0, in (0, 1000].
        wall: "maxwell" (type I) or "bgk" (type II: the emitted particles come from a gas that
            conducts heat, eq. 18).
        layers: number of layers; by default so many that none is wider than half a mean free path
            where the gas is densest (that of all points of a sweep).
    Numbers or, for a sweep, 1-D arrays. Raises ValueError for values outside these, and before a
    run for type II walls of a gradient that is too large (`walls.STEEPEST`).
    """

    command: ClassVar[str] = "fourier"
    reports: ClassVar[tuple[Observable, ...]] = conduction.OBSERVABLES
    monitored: ClassVar[tuple[str, ...]] = ("energy", "height", "mean_heat_flux")
    samples_per_record: ClassVar[int] = 8
    axis: ClassVar[str] = "z"

    gas: AbstractGas
    cold_temperature: Any = number(
        "temperature T_- of the cold wall over that of the hot one",
        low=0.0,
        high=1.0,
        low_included=False,
        example=0.05,
    )
    gravity: Any = number(
        "gravity g, positive towards the cold wall", "v0²/λ0", low=-1.0, high=1.0, default=0.0
    )
    length: Any = number(
        "distance L of the walls", "λ0", low=0.0, high=1000.0, low_included=False, default=10.0
    )
    wall: Literal["maxwell", "bgk"] = choice(
        "what the walls emit: a Maxwellian (type I), or the BGK gas that conducts heat (type II)",
        ("maxwell", "bgk"),
        default="maxwell",
    )
    layers: int = count(
        "layers across the slab, as many as its gas needs if not said", default=None
    )

    def __post_init__(self):
        if self.layers is None:
            slab = self.cold_temperature, self.gravity, self.length
            self.layers = thin_layers(*slab, jump=self.wall == "maxwell")

    def __check_init__(self):
        check_gas(self.gas)
        if isinstance(self.gas, ElasticHardSpheres) or not conserves_energy(self.gas):
            raise ValueError("FourierFlow needs an elastic gas without drag: restitution = 1.")
        if speed_exponent(self.gas) is None:
            raise ValueError(
                "FourierFlow needs a gas whose pair rate is a power of the relative speed: κ*, ε "
                f"and g* stand on κ ∝ T^ω; {type(self.gas).__name__} has no such law."
            )

    def default_particles(self) -> int:
        """Fifty in a layer, at least 5000 as in the paper.

        More would only spend their time on the way to the steady state: the heat flux is off by
        0.6% with ten in a layer, by less than 0.15% with fifty (experiments/conduction_limits).
        """
        return max(5_000, 50 * self.layers)

    def fit_options(self, options: Options) -> Options:
        """Raise ValueError for a step in which a particle of 4 v0 may cross the slab."""
        longest = float(self.length) / FAST
        if options.time_step > longest:
            raise ValueError(
                f"time_step = {options.time_step:g} lets a particle cross the slab of length "
                f"{self.length:g} in one step; the allowed range is (0, {longest:.3g}]."
            )
        if self.wall == "bgk":
            check_gradients(float(self.cold_temperature), float(self.length))
        return super().fit_options(options)

    def approach(self, options: Options) -> Approach:
        """Diffusion of heat across the slab."""
        return of_conduction(self.cold_temperature, self.gravity, self.length)

    def initial(self, key: Key, options: Options) -> WalledState:
        """Local equilibrium with n ∝ 1/T and T^{3/2} linear between the walls: eq. (31)."""
        share = uniform(random.fold_in(key, 0), options.n_particles, options.dtype)
        # z(share) of that density, free of the cancellation at T_- = T_+
        excess = 1.0 / jnp.sqrt(self.cold_temperature) - 1.0
        rise = share * excess
        place = share * (3.0 + 3.0 * rise + rise**2) / (3.0 + 3.0 * excess + excess**2)
        temperature = self.cold_temperature * (1.0 + rise) ** 2
        velocity = maxwellian_at(random.fold_in(key, 1), INITIAL_TEMPERATURE * temperature)
        crowding = FIRST_DENSITY * self.gas.rate(jnp.asarray(FIRST_SPEED, options.dtype))
        return WalledState(
            *(place * self.length, velocity, crowding), self.walls(), Exchange.none(options.dtype)
        )

    def walls(self) -> Walls:
        """The two walls."""
        return Walls.of(self.wall, self.cold_temperature, self.length)

    def advance(
        self, key: Key, state: WalledState, options: Options
    ) -> tuple[WalledState, FourierRecord]:
        """One record: samples, each after `options.steps` time steps."""

        def one_sample(state, number):
            return self.sample(random.fold_in(key, number), state, options)

        samples = jnp.arange(self.samples_per_record, dtype=jnp.uint32)
        walls = made_before(self.wall, self.cold_temperature, self.length, state.walls)
        start = replace(state, walls=walls, exchange=Exchange.none(options.dtype))
        state, (moments, tally, elapsed) = lax.scan(one_sample, start, samples)
        moments = jax.tree.map(lambda x: jnp.mean(x, axis=0), moments)
        tally, elapsed = Collisions.over(tally), jnp.sum(elapsed)
        return state, FourierRecord(moments, tally, elapsed, state.exchange)

    def sample(self, key: Key, state: WalledState, options: Options):
        """Time steps, and what the layers hold after them.

        Strang: flights end half a step before and after the collisions, so a sample taken between
        two flights sees stress and heat flux halfway between two collision stages.
        """
        duration = self.wanted_step(state, options)
        before, after = options.halves
        flights = jnp.ones(options.steps, options.dtype).at[0].set(before)

        def step(state, inputs):
            number, share = inputs
            key_here = random.fold_in(key, number)
            state = self.move(key_here, state, share * duration)
            velocity, tally, met = self.collide(
                key_here, self.layer(state.position), state.velocity, duration, options
            )
            crowding = next_bound(state.crowding, met)
            return replace(state, velocity=velocity, crowding=crowding), tally

        counts = jnp.arange(options.steps, dtype=jnp.uint32)
        state, tally = lax.scan(step, state, (counts, flights))
        if after:
            state = self.move(random.fold_in(key, options.steps), state, after * duration)
        return state, (self.measure(state), Collisions.over(tally), options.steps * duration)

    def wanted_step(self, moments: WalledState, options: Options) -> Scalar:
        """The asked fraction of τ0, shorter where a pair would be too likely."""
        return jnp.minimum(options.time_step, moments.longest_step())

    def move(self, key: Key, state: WalledState, duration: Scalar) -> WalledState:
        """Free flight between the walls."""
        position, velocity, now = fly(
            *(key, state.walls, state.position, state.velocity),
            *(self.gravity, self.length, duration),
        )
        return replace(
            state, position=position, velocity=velocity, exchange=state.exchange.then(now)
        )

    def measure(self, state: SlabState) -> Conduction:
        """Sums over each layer."""
        layer = self.layer(state.position)
        vx, vy, vz = state.velocity
        square = vx * vx + vy * vy + vz * vz
        return Conduction(
            populations(layer, self.layers).astype(vz.dtype),
            totals(layer, square, self.layers),
            totals(layer, vz * vz, self.layers),
            totals(layer, 0.5 * square * vz, self.layers),
            jnp.sum(state.position),
        )

    def faults(self, record: FourierRecord) -> str:
        """Particles that bounce on without end."""
        lost = float(np.sum(record.exchange.lost))
        if lost == 0:
            return ""
        return (
            f"{lost:.0f} particles hit a wall again and again within one step; reduce time_step, "
            "or gravity."
        )

    def remarks(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """Layers that are too wide: the sampled heat flux then is below that of the walls."""
        q = self.window(series, weights)
        walls = 0.5 * (q["heat_flux_cold_wall"] + q["heat_flux_hot_wall"])
        lost = 1.0 - np.mean(q["mean_heat_flux"]) / np.mean(walls)
        each = q["mean_heat_flux"] - walls
        error = np.std(each, ddof=1) / np.sqrt(len(each)) / abs(np.mean(walls))
        if not abs(lost) > TOO_WIDE + 5.0 * error:
            return ""
        densest = float(np.max(np.mean(q["density"], axis=0)))
        return (
            f"The heat flux sampled in the gas is {100 * lost:.1f}({100 * error:.1f})% below that "
            f"from the walls: its {self.layers} layers are up to "
            f"{densest * float(self.length) / self.layers:.2g} mean free paths wide; take at least "
            f"{int(np.ceil(densest * float(self.length) / WIDEST))}."
        )

    def averages(self, record: FourierRecord) -> dict[str, np.ndarray]:
        """Densities, pressures and fluxes of each record: all add up."""
        m: Any = record.moments  # on the host: arrays (realizations, records, layers)
        n_particles = np.sum(m.number, axis=-1)
        per_volume = self.layers / n_particles[..., None]
        per_area = self.length / n_particles / record.elapsed
        return {
            "density": m.number * per_volume,
            "pressure": m.square * per_volume / 3.0,
            "pressure_zz": m.zz * per_volume,
            "heat_flux": m.flux * per_volume,
            "mean_heat_flux": np.sum(m.flux, axis=-1) / n_particles,
            "heat_flux_cold_wall": record.exchange.cold_energy * per_area,
            "heat_flux_hot_wall": -record.exchange.hot_energy * per_area,
            "energy": np.sum(m.square, axis=-1) / n_particles / 2.0,
            "height": m.height / n_particles,
        }

    def observables(self, means: dict) -> dict:
        """Profiles, and their reduced form."""
        profiles = conduction.profiles(means)
        exponent = 1.0 - 0.5 * power_law(self.gas)
        return profiles | conduction.reduced(profiles, self.gravity, self.length, exponent)
