"""Shear flow of a gas in space, between Lees-Edwards planes.

Astillero and Santos, "Uniform shear flow in dissipative gases" (2005), sections III and IV A: the
inhomogeneous transient problem. y runs across the slab from 0 to L, velocities are those of the
laboratory, in which the planes move at ∓aL/2.
"""

from typing import Any, ClassVar, Literal

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax

from .. import check, initial_flow, random
from ..collide import Collisions
from ..collide_layers import collide_in_layers
from ..flight import cross_planes
from ..gas import INITIAL_TEMPERATURE, AbstractGas
from ..layer_flow import LayerFlow, friction, others, peculiar, slowed, slowing
from ..layers import layer_of, totals
from ..observables import rheology
from ..options import Options
from ..slab_state import SlabState, next_crowding, uniform
from ..types import Key, Layer, Physical, Profile, Scalar, Velocities

FIRST_CROWDING = 2.5
"""Probability per time assumed at the start, over the largest relative speed: 1.55 times the
density (`trios`), which is at most 1.5."""

FASTEST_PAIR = 6.0
"""Largest relative speed at T0 (v0): a Maxwellian exceeds it once in 6e7 pairs."""

GLOBAL = ("shear_stress", "normal_stress_xy", "normal_stress_zy")
REDUCED = ("reduced_shear_rate", "reduced_viscosity", "first_viscometric", "second_viscometric")


class Stresses(eqx.Module):
    """Sums over the particles of each layer at one instant.

    `number`; `momentum_x`, `momentum_y`: Σ v; `xx`..`xy`: Σ (v-u)_i (v-u)_j times N/(N-1), u being
    the mean velocity of the layer at that instant (see `LayerFlow` for the factor).
    """

    number: Profile
    momentum_x: Profile
    momentum_y: Profile
    xx: Profile
    yy: Profile
    zz: Profile
    xy: Profile

    def mean_temperature(self) -> Scalar:
        """T (m v0²) averaged over the particles: eq. (4.8)."""
        return jnp.sum(self.xx + self.yy + self.zz) / (3.0 * jnp.sum(self.number))


class SlabRecord(eqx.Module):
    """One record: sums over the layers at its start, its collisions, and its length (τ0)."""

    moments: Stresses
    tally: Collisions
    elapsed: Scalar


class ShearedSlab(eqx.Module):
    """A gas between Lees-Edwards planes in relative motion.

    Arguments:
        gas: `InelasticHardSpheres`, or `ElasticHardSpheres` with the local drag.
        shear_rate: a in units of 1/τ0, at least 0.
        length: L in λ0, in (0, 1000]. Uniform shear is unstable in slabs that are long enough
            (L > 25 at α = 0.9, according to the paper).
        initial: "equilibrium" (at rest, eq. 3.5), "nonequilibrium" (eq. 3.6), or
            "local_equilibrium" (uniform shear from the start, eq. 3.12).
        layers: number of layers.
    The numbers may be 1-D arrays, for a sweep. Raises ValueError for values outside these.

    The time step follows the temperature averaged over the particles, as in the paper.
    """

    steady_observables: ClassVar[tuple[str, ...]] = (
        *("mean_temperature", *GLOBAL, *REDUCED),
        *("density", "velocity_x", "velocity_y", "temperature"),
        *("pressure_xx", "pressure_yy", "pressure_zz", "pressure_xy"),
    )
    densities: ClassVar[dict[str, float]] = {}
    monitored: ClassVar[tuple[str, ...]] = ("thermal", "shear", "tilt")
    default_observable: ClassVar[str] = "shear_stress"
    default_particles: ClassVar[int] = 20_000
    in_space: ClassVar[bool] = True
    axis: ClassVar[str] = "y"
    additive: ClassVar[tuple[str, ...]] = (
        *("density", "momentum_x", "momentum_y"),
        *("stress_xx", "stress_yy", "stress_zz", "stress_xy"),
    )
    profiles: ClassVar[tuple[str, ...]] = (*steady_observables[8:], *additive[1:])

    gas: AbstractGas
    shear_rate: Physical = eqx.field(converter=check.physical)
    length: Physical = eqx.field(default=2.5, converter=check.physical)
    initial_state: Literal["equilibrium", "nonequilibrium", "local_equilibrium"] = eqx.field(
        default="equilibrium", static=True
    )
    layers: int = eqx.field(default=50, static=True)

    def __check_init__(self):
        if not isinstance(self.gas, AbstractGas):
            raise TypeError(f"gas must be a jdsmc gas, got {self.gas!r}.")
        if self.gas.measured_drag:
            raise ValueError(
                'ShearedSlab has no drag = "measured", which needs ⟨V12³⟩ of every layer; '
                'use drag = "local".'
            )
        check.in_range("shear_rate", self.shear_rate, 0.0, np.inf, high_included=False)
        check.in_range("length", self.length, 0.0, 1000.0, low_included=False)
        check.one_of("initial_state", self.initial_state, initial_flow.STATES)
        check.at_least("layers", self.layers, 1)

    def has_steady_state(self) -> bool:
        """True if heating and cooling can balance at every point: a > 0 and α < 1."""
        return bool(np.all(self.shear_rate > 0) and self.gas.is_dissipative())

    def shortest_warm_up(self) -> float:
        """Collisions per particle before the first test for a steady state.

        The longest wave of momentum decays in L²/(4π² η/n m), 0.05 L² τ(T) or 0.03 L² collisions
        per particle. This is ten such times; the temperature takes longer in a short slab.
        """
        return 0.3 * float(np.max(self.length)) ** 2

    def initial(self, key: Key, options: Options) -> SlabState:
        """The asked state, with total momentum zero and temperature exactly T0."""
        if options.n_particles < 2 * self.layers:
            raise ValueError(
                f"n_particles = {options.n_particles} leaves fewer than 2 particles for each of "
                f"{self.layers} layers; take more particles, or fewer layers."
            )
        count, dtype = options.n_particles, options.dtype
        chance = uniform(random.fold_in(key, 0), count, dtype)
        place = initial_flow.places(self.initial_state, chance)
        difference = self.shear_rate * self.length
        vx, vy, vz = initial_flow.peculiar(self.initial_state, random.fold_in(key, 1), count, dtype)
        velocity = (vx + initial_flow.flow(self.initial_state, place, difference), vy, vz)
        crowding = FIRST_CROWDING * (FASTEST_PAIR + difference)
        return SlabState(place * self.length, velocity, crowding)

    def advance(self, key: Key, state: SlabState, options: Options) -> tuple[SlabState, SlabRecord]:
        """One record: measure, choose the time step, then make `options.steps` of them."""
        moments = self.measure(state)
        thermal = jnp.sqrt(2.0 * moments.mean_temperature())
        wanted = options.time_step / lax.stop_gradient(jnp.maximum(thermal, self.shear_rate))

        def one_step(state, count):
            duration = jnp.minimum(wanted, lax.stop_gradient(state.longest_step()))
            state, tally = self.step(random.fold_in(key, count), state, duration, options)
            return state, (tally, duration)

        counts = jnp.arange(options.steps, dtype=jnp.uint32)
        state, (tally, durations) = lax.scan(one_step, state, counts)
        return state, SlabRecord(moments, Collisions.over(tally), jnp.sum(durations))

    def step(
        self, key: Key, state: SlabState, duration: Scalar, options: Options
    ) -> tuple[SlabState, Collisions]:
        """Half a flight and drag, collisions, half a drag and flight ("strang"); or flight, drag
        and collisions ("lie", as in the paper). Records fall between two steps, so that in the
        symmetric step stress is sampled halfway between two collision stages."""
        before, after = (0.5, 0.5) if options.splitting == "strang" else (1.0, 0.0)
        numbers = (self.shear_rate, self.length)
        position, velocity = cross_planes(
            state.position, state.velocity, *numbers, before * duration
        )
        layer = layer_of(position, self.length, self.layers)
        if self.gas.frictional:
            velocity, tally, met = self.collide_with_drag(
                key, layer, velocity, duration, before, after
            )
        else:
            velocity, tally, met = self.collide(key, layer, velocity, duration)
        if after:
            position, velocity = cross_planes(position, velocity, *numbers, after * duration)
        return SlabState(position, velocity, next_crowding(state.crowding, met)), tally

    def collide(
        self, key: Key, layer: Layer, velocity: Velocities, duration: Scalar
    ) -> tuple[Velocities, Collisions, Scalar]:
        """Collisions within the layers."""
        return collide_in_layers(key, self.gas, layer, self.layers, velocity, duration)

    def collide_with_drag(
        self,
        key: Key,
        layer: Layer,
        velocity: Velocities,
        duration: Scalar,
        before: float,
        after: float,
    ) -> tuple[Velocities, Collisions, Scalar]:
        """Drag for a share of the time before the collisions and a share after.

        Elastic collisions change neither flow nor temperature of a layer, and drag only its
        temperature: what the layers are like is needed once.
        """
        flow = LayerFlow.of(layer, velocity, self.layers)
        rate = friction(self.gas, flow)
        factor = slowing(rate, before * duration)
        velocity = slowed(layer, velocity, flow.mean, factor)
        velocity, tally, met = self.collide(key, layer, velocity, duration)
        if after:
            later = slowing(rate * factor, after * duration)
            velocity = slowed(layer, velocity, flow.mean, later)
        return velocity, tally, met

    def measure(self, state: SlabState) -> Stresses:
        """Sums over each layer."""
        layer = layer_of(state.position, self.length, self.layers)
        flow = LayerFlow.of(layer, state.velocity, self.layers)
        vx, vy, vz = peculiar(layer, state.velocity, flow.mean)
        unbiased = flow.number / others(flow.number)

        def total(product):
            return unbiased * totals(layer, product, self.layers)

        momentum_x, momentum_y = (flow.number * u for u in flow.mean[:2])
        stresses = (total(vx * vx), total(vy * vy), total(vz * vz), total(vx * vy))
        return Stresses(flow.number, momentum_x, momentum_y, *stresses)

    def finish_chunk(self, state: SlabState) -> tuple[SlabState, None]:
        """Nothing to do between chunks."""
        return state, None

    def faults(self, record: SlabRecord) -> str:
        """Nothing can fail here that does not fail in every scene."""
        return ""

    def averages(self, record: SlabRecord) -> dict[str, np.ndarray]:
        """Densities of each record: all add up. P_ij in n̄ m v0², momenta in n̄ v0.

        Over all layers: `thermal` n̄T̄ and `xx`..`xy`, eqs. (4.8) and (4.9); `tilt`, how far the
        flow is; `local_rate`, collisions per particle and time in local equilibrium, eq. (3.11).
        """
        m: Any = record.moments  # on the host: arrays (points, realizations, records, layers)
        per_volume = self.layers / np.sum(m.number, axis=-1, keepdims=True)
        names = ("xx", "yy", "zz", "xy")
        stress = {name: getattr(m, name) * per_volume for name in names}
        means = {name: np.mean(stress[name], axis=-1) for name in names}
        density, trace = m.number * per_volume, stress["xx"] + stress["yy"] + stress["zz"]
        centre = (np.arange(self.layers) + 0.5) / self.layers - 0.5
        thermal = np.sqrt(2.0 * trace / 3.0 / np.maximum(density, 1e-9))
        partners = np.maximum(density - per_volume, 0.0)  # nobody collides with himself
        return {
            "density": density,
            "momentum_x": m.momentum_x * per_volume,
            "momentum_y": m.momentum_y * per_volume,
            **{f"stress_{name}": values for name, values in stress.items()},
            **means,
            "shear": means["xy"],
            "thermal": np.mean(trace, axis=-1) / 3.0,
            "tilt": np.mean(centre * m.momentum_x * per_volume, axis=-1),
            "local_rate": np.mean(density * partners * thermal, axis=-1) / np.sqrt(np.pi),
        }

    def evolution(self, means: dict) -> dict:
        """Nothing but the observables."""
        return {}

    def observables(self, means: dict) -> dict:
        """Global stresses, and the profiles: density, flow, T/T0 and P_ij/nT of each layer."""
        whole = {name: means[name] for name in ("xx", "yy", "zz", "xy")}
        reduced = rheology(whole | {"temperature": means["thermal"]}, self.shear_rate)
        density = means["density"]
        stress = {name: means[f"stress_{name}"] for name in whole}
        pressure = (stress["xx"] + stress["yy"] + stress["zz"]) / 3.0
        with np.errstate(divide="ignore", invalid="ignore"):
            return {
                "mean_temperature": means["thermal"] / INITIAL_TEMPERATURE,
                **{name: reduced[name] for name in (*GLOBAL, *REDUCED)},
                "density": density,
                "velocity_x": means["momentum_x"] / density,
                "velocity_y": means["momentum_y"] / density,
                "temperature": pressure / density / INITIAL_TEMPERATURE,
                **{f"pressure_{name}": stress[name] / pressure for name in whole},
            }
