"""Heat conduction between two walls under gravity.

Tahiri, Tij and Santos, "Monte Carlo simulation of a hard-sphere gas in the planar Fourier flow with
a gravity field" (2000). Units as everywhere, T0 being the temperature T_+ of the hot wall at z = L;
gravity is an acceleration -g ẑ, so that g > 0 presses the gas to the cold wall.
"""

from typing import Any, ClassVar, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from .. import check, conduction, random
from ..collide import Collisions
from ..collide_layers import collide_in_layers
from ..flight import Exchange, fly
from ..gas import INITIAL_TEMPERATURE, AbstractGas
from ..layers import layer_of, populations, totals
from ..options import Options
from ..slab_state import SlabState, maxwellian_at, next_crowding, uniform
from ..types import Key, Physical, Positions, Profile, Scalar, Velocities
from ..walls import Walls

FAST = 4.0
"""Speed (v0) that must not carry a particle across the slab in one step."""

FIRST_CROWDING = 20.0
"""Probability per time assumed at the start: a density of 8 and a relative speed of 3.5."""


class Conduction(eqx.Module):
    """Sums over the particles of each layer at one instant, or their mean over several.

    `number`; `square`: Σ v²; `zz`: Σ v_z²; `flux`: Σ v² v_z/2; and over all of them `height`: Σ z.
    """

    number: Profile
    square: Profile
    zz: Profile
    flux: Profile
    height: Scalar


class FourierRecord(eqx.Module):
    """One record: sums averaged over its samples, collisions, wall exchange, and its length."""

    moments: Conduction
    tally: Collisions
    exchange: Exchange
    elapsed: Scalar


class WalledState(eqx.Module):
    """A gas, and its walls: they never change, but their tables take time to make."""

    gas: SlabState
    walls: Walls


class FourierFlow(eqx.Module):
    """A gas between walls at T_- (z = 0) and T_+ = T0 (z = L), started from Fourier's law (eq. 31).

    Arguments:
        gas: one without drag that conserves energy (`InelasticHardSpheres(1.0)`, the default, or
            `MaxwellMolecules()`).
        cold_temperature: T_-/T_+ in (0, 1].
        gravity: g in v0²/λ0, positive towards the cold wall; between -1 and 1.
        length: L in λ0, in (0, 1000].
        wall: "maxwell" (type I) or "bgk" (type II: the emitted particles come from a gas that
            conducts heat, eq. 18).
        layers: number of layers.
    Numbers or, for a sweep, 1-D arrays. Raises ValueError for values outside these.
    """

    steady_observables: ClassVar[tuple[str, ...]] = (
        *("mean_heat_flux", "heat_flux_cold_wall", "heat_flux_hot_wall"),
        *("temperature", "density", "pressure", "pressure_zz", "heat_flux"),
        *("kappa_star", "reduced_gradient", "reduced_gravity", "mean_free_paths"),
    )
    densities: ClassVar[dict[str, float]] = {}
    monitored: ClassVar[tuple[str, ...]] = ("energy", "height", "mean_heat_flux")
    default_observable: ClassVar[str] = "mean_heat_flux"
    in_space: ClassVar[bool] = True
    samples_per_record: ClassVar[int] = 8
    axis: ClassVar[str] = "z"
    profiles: ClassVar[tuple[str, ...]] = steady_observables[3:]
    descriptions: ClassVar[dict[str, tuple[str, str]]] = {
        "pressure_zz": ("pressure P_zz", "n̄ m v0²"),
    }
    additive: ClassVar[tuple[str, ...]] = (
        *("density", "pressure", "pressure_zz", "heat_flux"),
        *("mean_heat_flux", "heat_flux_cold_wall", "heat_flux_hot_wall"),
    )

    gas: AbstractGas
    cold_temperature: Physical = eqx.field(converter=check.physical)
    gravity: Physical = eqx.field(default=0.0, converter=check.physical)
    length: Physical = eqx.field(default=10.0, converter=check.physical)
    wall: Literal["maxwell", "bgk"] = eqx.field(default="maxwell", static=True)
    layers: int = eqx.field(default=100, static=True)

    def __check_init__(self):
        if not isinstance(self.gas, AbstractGas):
            raise TypeError(f"gas must be a jdsmc gas, got {self.gas!r}.")
        if self.gas.frictional or self.gas.is_dissipative():
            raise ValueError("FourierFlow needs an elastic gas without drag: restitution = 1.")
        check.in_range("cold_temperature", self.cold_temperature, 0.0, 1.0, low_included=False)
        check.in_range("gravity", self.gravity, -1.0, 1.0)
        check.in_range("length", self.length, 0.0, 1000.0, low_included=False)
        check.one_of("wall", self.wall, ("maxwell", "bgk"))
        check.at_least("layers", self.layers, 1)

    @property
    def default_particles(self) -> int:
        """Fifty in a layer, at least 5000 as in the paper.

        More would only spend their time on the way to the steady state: the heat flux is off by
        0.6% with ten in a layer, by less than 0.15% with fifty (experiments/conduction_limits).
        """
        return max(5_000, 50 * self.layers)

    def has_steady_state(self) -> bool:
        """Always: the walls see to it."""
        return True

    def check_options(self, options: Options) -> None:
        """Raise ValueError for a step in which a particle of 4 v0 may cross the slab."""
        longest = float(np.min(self.length)) / FAST
        if options.time_step > longest:
            raise ValueError(
                f"time_step = {options.time_step:g} lets a particle cross the slab of length "
                f"{np.min(self.length):g} in one step; the allowed range is (0, {longest:.3g}]."
            )

    def shortest_warm_up(self) -> float:
        """Collisions per particle before the first test for a steady state.

        Heat and particles diffuse across the slab in L²/(π² D) = 0.15 L² τ0 or so; a collision per
        particle takes 1.8 τ0 on average. This is six such times.
        """
        return 0.5 * float(np.max(self.length)) ** 2

    def initial(self, key: Key, options: Options) -> WalledState:
        """Local equilibrium with n ∝ 1/T and T^{3/2} linear between the walls: eq. (31)."""
        share = uniform(random.fold_in(key, 0), options.n_particles, options.dtype)
        # z(share) of that density, free of the cancellation at T_- = T_+
        excess = 1.0 / jnp.sqrt(self.cold_temperature) - 1.0
        rise = share * excess
        place = share * (3.0 + 3.0 * rise + rise**2) / (3.0 + 3.0 * excess + excess**2)
        temperature = self.cold_temperature * (1.0 + rise) ** 2
        velocity = maxwellian_at(random.fold_in(key, 1), INITIAL_TEMPERATURE * temperature)
        crowding = jnp.asarray(FIRST_CROWDING, options.dtype)
        return WalledState(SlabState(place * self.length, velocity, crowding), self.walls())

    def walls(self) -> Walls:
        """The two walls."""
        if self.wall == "bgk":
            return Walls.bgk(self.cold_temperature, self.length)
        return Walls.maxwell(self.cold_temperature)

    def advance(
        self, key: Key, state: WalledState, options: Options
    ) -> tuple[WalledState, FourierRecord]:
        """One record: samples, each after `options.steps` time steps."""

        def one_sample(gas, number):
            return self.sample(random.fold_in(key, number), gas, state.walls, options)

        samples = jnp.arange(self.samples_per_record, dtype=jnp.uint32)
        gas, (moments, tally, exchange, elapsed) = lax.scan(one_sample, state.gas, samples)
        moments = jax.tree.map(lambda x: jnp.mean(x, axis=0), moments)
        exchange = jax.tree.map(jnp.sum, exchange)
        record = FourierRecord(moments, Collisions.over(tally), exchange, jnp.sum(elapsed))
        return WalledState(gas, state.walls), record

    def sample(self, key: Key, state: SlabState, walls: Walls, options: Options):
        """Time steps, and what the layers hold after them.

        Strang: flights end half a step before and after the collisions, so a sample taken between
        two flights sees stress and heat flux halfway between two collision stages.
        """
        duration = jnp.minimum(options.time_step, state.longest_step())
        halves = 0.5 if options.splitting == "strang" else 1.0
        flights = jnp.ones(options.steps, options.dtype).at[0].set(halves)

        def step(carry, inputs):
            state, exchange = carry
            number, share = inputs
            key_here = random.fold_in(key, number)
            state, now = self.move(key_here, state, walls, share * duration)
            layer = layer_of(state.position, self.length, self.layers)
            velocity, tally, met = collide_in_layers(
                key_here, self.gas, layer, self.layers, state.velocity, duration
            )
            crowding = next_crowding(state.crowding, met)
            state = SlabState(state.position, velocity, crowding)
            return (state, exchange.then(now)), tally

        zero = jnp.zeros((), options.dtype)
        start = (state, Exchange(zero, zero, zero, zero))
        counts = jnp.arange(options.steps, dtype=jnp.uint32)
        (state, exchange), tally = lax.scan(step, start, (counts, flights))
        if options.splitting == "strang":
            last = random.fold_in(key, options.steps)
            state, now = self.move(last, state, walls, 0.5 * duration)
            exchange = exchange.then(now)
        moments = self.measure(state.position, state.velocity)
        return state, (moments, Collisions.over(tally), exchange, options.steps * duration)

    def move(
        self, key: Key, state: SlabState, walls: Walls, duration: Scalar
    ) -> tuple[SlabState, Exchange]:
        """Free flight between the walls."""
        position, velocity, exchange = fly(
            *(key, walls, state.position, state.velocity),
            *(self.gravity, self.length, duration),
        )
        return SlabState(position, velocity, state.crowding), exchange

    def measure(self, position: Positions, velocity: Velocities) -> Conduction:
        """Sums over each layer."""
        layer = layer_of(position, self.length, self.layers)
        vx, vy, vz = velocity
        square = vx * vx + vy * vy + vz * vz
        return Conduction(
            populations(layer, self.layers).astype(vz.dtype),
            totals(layer, square, self.layers),
            totals(layer, vz * vz, self.layers),
            totals(layer, 0.5 * square * vz, self.layers),
            jnp.sum(position),
        )

    def finish_chunk(self, state: WalledState) -> tuple[WalledState, None]:
        """Nothing to do between chunks."""
        return state, None

    def faults(self, record: FourierRecord) -> str:
        """Particles that bounce on without end."""
        lost = float(np.sum(record.exchange.lost))
        if lost == 0:
            return ""
        return (
            f"{lost:.0f} particles hit a wall again and again within one step; reduce time_step, "
            "or gravity."
        )

    def averages(self, record: FourierRecord) -> dict[str, np.ndarray]:
        """Densities, pressures and fluxes of each record: all add up."""
        m: Any = record.moments  # on the host: arrays (points, realizations, records, layers)
        n_particles = np.sum(m.number, axis=-1)
        per_volume = self.layers / n_particles[..., None]
        lengths = np.asarray(self.length, dtype=float)[:, None, None]
        per_area = lengths / n_particles / record.elapsed
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

    def evolution(self, means: dict) -> dict:
        """Nothing but the observables."""
        return {}

    def observables(self, means: dict) -> dict:
        """Profiles, and their reduced form."""
        profiles = conduction.profiles(means)
        exponent = self.gas.viscosity_exponent
        return {
            **profiles,
            **conduction.reduced(profiles, self.gravity, self.length, exponent),
        }
