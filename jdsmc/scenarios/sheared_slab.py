"""Shear flow of a gas in space, between Lees-Edwards planes.

Astillero and Santos, "Uniform shear flow in dissipative gases" (2005), sections III and IV A: the
inhomogeneous transient problem. y runs across the slab from 0 to L, velocities are those of the
laboratory, in which the planes move at ∓aL/2.
"""

from dataclasses import replace
from typing import Any, ClassVar, Literal

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jax import lax
from scipy.special import gammaln

from .. import check, random
from ..collisions.bound import FASTEST_PAIR
from ..collisions.meet import Collisions
from ..fields import choice, count, number
from ..gases import AbstractGas, ElasticHardSpheres
from ..gases.base import check_gas, pair_rate
from ..gases.hard_spheres import loses_energy
from ..measure.distributions import DISTRIBUTIONS, Distributions, bin_centres, over_slab
from ..measure.observable import Observable
from ..measure.observables import RHEOLOGY, rheology
from ..motion import initial_flow
from ..motion.cells import totals
from ..motion.drive import temperature_of
from ..motion.flight import cross_planes
from ..motion.friction import LayerFlow, friction, peculiar, slowed, slowing
from ..types import Key, Layer, Profile, Scalar, Velocities
from ..units import INITIAL_TEMPERATURE
from .approach import Approach, of_sheared_slab
from .base import Record
from .kinetic_model import check_start, sheared
from .layers import common_layers, own_mean_free_paths, remark_on_layers
from .options import Options
from .slab import AbstractSlab, SlabState, uniform

FIRST_CROWDING = 2.5
"""Probability per time assumed at the start, over the largest pair rate: 1.55 times the density
(`trios`), which is at most 1.5."""

WIDEST, FEWEST = 0.1, 50
"""Width (λ0) of the layers by default: one of Δy adds (16/45π)(Δy/λ)² to the viscosity, 1e-3. At
least as many as in the paper."""

FEWEST_PARTICLES = 20_000
"""Default of all layers together: 400 in each of the fewest."""

GLOBAL = (
    next(one for one in RHEOLOGY if one.name == "shear_stress"),
    Observable("mean_temperature", "temperature T/T0 averaged over the particles", symbol="T̄/T0"),
    *(one for one in RHEOLOGY if one.name != "shear_stress"),
)
ALONG = ("y",)
PROFILES = (
    Observable("density", "density n/n̄", dims=ALONG, symbol="n/n̄"),
    Observable("velocity_x", "flow velocity u_x", "v0", ALONG, "u_x"),
    Observable("velocity_y", "flow velocity u_y", "v0", ALONG, "u_y"),
    Observable("temperature", "temperature T/T0", dims=ALONG, symbol="T/T0"),
    *(
        Observable(f"pressure_{ij}", f"P_{ij}/nT", dims=ALONG, symbol=f"P{ij}/nT")
        for ij in ("xx", "yy", "zz", "xy")
    ),
)


class Stresses(eqx.Module):
    """Sums over the particles of each layer at one instant.

    `number` N; `others`: N - 1, or 0 in an empty layer; `momentum_x`, `momentum_y`: Σ v;
    `xx`..`xy`: Σ (v-u)_i (v-u)_j, u being the mean velocity of the layer at that instant.
    The mean of such a sum is (N-1) T_ij, whatever N: T_ij is the ratio of two averages, and a layer
    with one particle, which shows no temperature, counts in neither.
    """

    number: Profile
    others: Profile
    momentum_x: Profile
    momentum_y: Profile
    xx: Profile
    yy: Profile
    zz: Profile
    xy: Profile

    def mean_temperature(self) -> Scalar:
        """T (m v0²) averaged over the particles: eq. (4.8)."""
        return jnp.sum(self.xx + self.yy + self.zz) / (3.0 * jnp.sum(self.others))


class ShearedSlab(AbstractSlab):
    """A gas between Lees-Edwards planes in relative motion.

    Arguments:
        gas: `InelasticHardSpheres`, or `ElasticHardSpheres` with the local drag.
        shear_rate: a in units of 1/τ0, at least 0.
        length: L in λ0, in (0, 1000]. Uniform shear is unstable in slabs that are long enough
            (L > 25 at α = 0.9, according to the paper).
        initial_state: "equilibrium" (at rest, eq. 3.5), "nonequilibrium" (eq. 3.6),
            "local_equilibrium" (uniform shear from the start, eq. 3.12), or "steady", for steady
            values sooner: uniform shear, temperature and stresses of the kinetic model's steady
            state.
        layers: number of layers; by default 50, 100, 200, ...: 10 a mean free path at the mean
            density or more. All points of a sweep must need the same, else give them.
    The numbers may be 1-D arrays, for a sweep. Raises ValueError for values outside these.

    The time step follows the temperature averaged over the particles, as in the paper.
    """

    reports: ClassVar[tuple[Observable, ...]] = (*GLOBAL, *PROFILES)
    applies_drag: ClassVar[bool] = True
    sampled: ClassVar[tuple[Observable, ...]] = DISTRIBUTIONS
    monitored: ClassVar[tuple[str, ...]] = ("thermal", "xy", "tilt")
    axis: ClassVar[str] = "y"

    gas: AbstractGas
    shear_rate: Any = number("shear rate a", "1/τ0", low=0.0, high_included=False, example=4.0)
    length: Any = number(
        "distance L of the planes", "λ0", low=0.0, high=1000.0, low_included=False, default=2.5
    )
    initial_state: Literal["equilibrium", "nonequilibrium", "local_equilibrium", "steady"] = choice(
        "a gas at rest (eq. 3.5), the paper's state far from equilibrium (3.6), uniform shear at "
        "T0, or in the steady state of the kinetic model",
        initial_flow.STATES,
        default="equilibrium",
    )
    layers: int = count("layers across the slab, 10 a mean free path if not said", default=None)

    def __post_init__(self):
        if self.layers is None:
            lengths = np.ravel(check.physical(self.length))
            known = lengths.dtype.kind == "f" and np.all(np.isfinite(lengths))  # else refused soon
            wanted = np.clip(lengths, 0.0, 1e3) / WIDEST if known else FEWEST
            check_gas(self.gas)
            own = own_mean_free_paths(self.gas, [1.0])[:, 0]
            self.layers = common_layers(np.maximum(FEWEST, np.multiply.outer(own, wanted)))

    def __check_init__(self):
        if isinstance(self.gas, ElasticHardSpheres) and self.gas.drag == "measured":
            raise ValueError(
                'ShearedSlab has no drag = "measured", which needs ⟨V12³⟩ of every layer; '
                'use drag = "local".'
            )

    def has_steady_state(self) -> bool:
        """True if heating and cooling can balance: a > 0, and a gas that loses energy."""
        return bool(self.shear_rate > 0 and loses_energy(self.gas))

    def no_steady_state(self) -> str:
        """What a steady state needs."""
        return "it needs shear_rate > 0 and a gas that loses energy; else give duration, collisions"

    def default_particles(self) -> int:
        """Fifty in a layer, if that is more than usual."""
        return max(FEWEST_PARTICLES, 50 * self.layers)

    def approach(self, options: Options) -> Approach:
        """That of the kinetic model, and diffusion across the slab."""
        steady = self.initial_state == "steady"
        return of_sheared_slab(self.gas, self.shear_rate, self.length, steady)

    def fit_options(self, options: Options) -> Options:
        """As they are; ValueError for a start that the gas does not have."""
        if self.initial_state == "steady":
            check_start(self.gas, self.has_steady_state())
        return super().fit_options(options)

    def initial(self, key: Key, options: Options) -> SlabState:
        """The asked state, with total momentum zero and exactly its temperature."""
        number, dtype = options.n_particles, options.dtype
        chance = uniform(random.fold_in(key, 0), number, dtype)
        place = initial_flow.places(self.initial_state, chance)
        difference = self.shear_rate * self.length
        velocity = initial_flow.peculiar(self.initial_state, random.fold_in(key, 1), number, dtype)
        fastest = FASTEST_PAIR
        if self.initial_state == "steady":
            velocity = sheared(velocity, self.gas, self.shear_rate)
            fastest = FASTEST_PAIR * jnp.sqrt(temperature_of(velocity) / INITIAL_TEMPERATURE)
        vx, vy, vz = velocity
        velocity = (vx + initial_flow.flow(self.initial_state, place, difference), vy, vz)
        crowding = FIRST_CROWDING * pair_rate(self.gas, fastest + difference)
        return SlabState(place * self.length, velocity, crowding)

    def wanted_step(self, moments: Stresses, options: Options) -> Scalar:
        """The asked fraction of τ(T̄) or of 1/a, whichever is shorter."""
        thermal = jnp.sqrt(2.0 * moments.mean_temperature())
        return options.time_step / lax.stop_gradient(jnp.maximum(thermal, self.shear_rate))

    def move(self, key: Key, state: SlabState, duration: Scalar) -> SlabState:
        """Flight through the planes."""
        position, velocity = cross_planes(
            state.position, state.velocity, self.shear_rate, self.length, duration
        )
        return replace(state, position=position, velocity=velocity)

    def collide(
        self, key: Key, layer: Layer, velocity: Velocities, duration: Scalar, options: Options
    ) -> tuple[Velocities, Collisions, Scalar]:
        """Collisions within the layers, and for a frictional gas the drag around them."""
        if not isinstance(self.gas, ElasticHardSpheres):
            return super().collide(key, layer, velocity, duration, options)
        # Elastic collisions change neither flow nor temperature of a layer, and drag only its
        # temperature: what the layers are like is needed once.
        before, after = options.halves
        flow = LayerFlow.of(layer, velocity, self.layers)
        rate = friction(self.gas, flow)
        factor = slowing(rate, before * duration)
        velocity = slowed(layer, velocity, flow.mean, factor)
        velocity, tally, met = super().collide(key, layer, velocity, duration, options)
        if after:
            later = slowing(rate * factor, after * duration)
            velocity = slowed(layer, velocity, flow.mean, later)
        return velocity, tally, met

    def measure(self, state: SlabState) -> Stresses:
        """Sums over each layer."""
        layer = self.layer(state.position)
        flow = LayerFlow.of(layer, state.velocity, self.layers)
        vx, vy, vz = peculiar(layer, state.velocity, flow.mean)

        def total(product):
            return totals(layer, product, self.layers)

        momentum_x, momentum_y = (flow.number * u for u in flow.mean[:2])
        stresses = (total(vx * vx), total(vy * vy), total(vz * vz), total(vx * vy))
        freedom = jnp.maximum(flow.number - 1.0, 0.0)
        return Stresses(flow.number, freedom, momentum_x, momentum_y, *stresses)

    def finish_chunk(self, state: SlabState) -> tuple[SlabState, Distributions]:
        """Sample distributions of velocities relative to the flow of their layer, over v0(T̄)."""
        return state, over_slab(self.layer(state.position), state.velocity, self.layers)

    def axes(self, options: Options) -> dict:
        """Classes of speed beside those of every slab."""
        return super().axes(options) | {"speed_bin": bin_centres(False)}

    def averages(self, record: Record) -> dict[str, np.ndarray]:
        """Densities of each record: all add up. In n̄ m v0² and n̄ v0; ratios to `others` are T_ij.

        Over all layers: `freedom`, the mean of `others`; `thermal` and `xx`..`xy`, T̄ and T̄_ij times
        it, eqs. (4.8) and (4.9); `tilt`, how far the flow is; `instant_rate`, collisions per
        particle and time in local equilibrium, eq. (3.11).
        """
        m: Any = record.moments  # on the host: arrays (realizations, records, layers)
        per_volume = self.layers / np.sum(m.number, axis=-1, keepdims=True)
        names = ("xx", "yy", "zz", "xy")
        stress = {name: getattr(m, name) * per_volume for name in names}
        means = {name: np.mean(stress[name], axis=-1) for name in names}
        density, others = m.number * per_volume, m.others * per_volume
        trace = stress["xx"] + stress["yy"] + stress["zz"]
        centre = (np.arange(self.layers) + 0.5) / self.layers - 0.5
        return {
            "density": density,
            "others": others,
            "momentum_x": m.momentum_x * per_volume,
            "momentum_y": m.momentum_y * per_volume,
            **{f"stress_{name}": values for name, values in stress.items()},
            **means,
            "freedom": np.mean(others, axis=-1),
            "thermal": np.mean(trace, axis=-1) / 3.0,
            "tilt": np.mean(centre * m.momentum_x * per_volume, axis=-1),
            "instant_rate": np.mean(density * others * self.pair_rate(m), axis=-1),
        }

    def pair_rate(self, m: Stresses) -> np.ndarray:
        """Collisions per particle and time at the mean density and the temperature of each layer.

        For a power law: of k = 3(N-1) squares of normal velocities, ⟨T^{γ/2}⟩ is too small by
        (2/k)^{γ/2} Γ((k+γ)/2)/Γ(k/2), 8% for hard spheres and N = 2, which is divided out.
        """
        freedom = 3.0 * np.maximum(m.others, 1.0)
        rate = self.gas.collision_rate((m.xx + m.yy + m.zz) / freedom)
        exponent = self.gas.speed_exponent() or 0.0
        half = 0.5 * freedom
        return (
            rate * np.exp(gammaln(half) - gammaln(half + 0.5 * exponent)) * half ** (0.5 * exponent)
        )

    def remarks(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """Layers that are too wide for the gas that is in them now."""
        q = {name: np.mean(x, axis=0) for name, x in self.window(series, weights).items()}
        found = self.observables(q)
        length = float(self.length)
        return remark_on_layers(self.gas, found["density"], found["temperature"], length)

    def observables(self, means: dict) -> dict:
        """Global stresses, and the profiles: density, flow, T/T0 and P_ij/nT of each layer."""
        whole = {name: means[name] / means["freedom"] for name in ("xx", "yy", "zz", "xy")}
        heat = {"temperature": means["thermal"] / means["freedom"]}
        reduced = rheology(whole | heat, self.shear_rate, self.gas.speed_exponent())
        density = means["density"]
        stress = {name: means[f"stress_{name}"] for name in whole}
        trace = (stress["xx"] + stress["yy"] + stress["zz"]) / 3.0
        with np.errstate(divide="ignore", invalid="ignore"):
            return {
                "mean_temperature": heat["temperature"] / INITIAL_TEMPERATURE,
                **{one.name: reduced[one.name] for one in GLOBAL if one.name in reduced},
                "density": density,
                "velocity_x": means["momentum_x"] / density,
                "velocity_y": means["momentum_y"] / density,
                "temperature": trace / means["others"] / INITIAL_TEMPERATURE,
                **{f"pressure_{name}": stress[name] / trace for name in whole},
            }
