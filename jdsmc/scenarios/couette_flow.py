"""Flow and heat between two walls that may move: plane Couette flow, or granular Fourier flow.

The walls move at -U/2 and U/2 along x. A particle that hits one is absorbed with probability χ and
emitted as from a bath behind the wall, else reflected as by a mirror: Maxwell, "On stresses in
rarified gases arising from inequalities of temperature", Phil. Trans. 170, 231 (1879), appendix.
Values to hold it against are in `docs/couette_flow.md`.
"""

from dataclasses import replace
from typing import Any, ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from ..fields import number
from ..gases import AbstractGas
from ..gases.base import conserves_energy, pair_rate
from ..gases.hard_spheres import loses_energy
from ..gases.relaxation import mean_free_paths
from ..measure import couette
from ..measure.observable import Observable
from ..motion.cells import totals
from ..motion.flight import Exchange
from ..motion.walls import Walls
from ..types import Key, Profile, Scalar
from ..units import INITIAL_TEMPERATURE
from .approach import Approach, of_couette_flow
from .layers import remark_on_layers, thin_layers
from .options import Options
from .slab import SlabState
from .walled import (
    FIRST_DENSITY,
    FIRST_SPEED,
    AbstractWalled,
    Conduction,
    WalledRecord,
    WalledState,
    conducting,
    distance_of_walls,
    layers_between_walls,
)


class Flow(eqx.Module):
    """Sums over the particles of each layer: those of conduction, and `momentum` Σ v_x, `xz`."""

    conduction: Conduction
    momentum: Profile
    xz: Profile


class CouetteFlow(AbstractWalled):
    """A gas between walls that move along x or a force along x drives it.

    It starts from a linear profile of velocity. With wall_velocity = 0 and a force it is plane
    Poiseuille flow; with neither, a gas that loses energy is granular Fourier flow.

    Arguments:
        gas: any without drag, of three velocity components. One that loses energy is fed by the
            walls.
        wall_velocity: U in v0, from 0 to 100: the upper wall moves at U/2, the lower one at -U/2.
        cold_temperature: that of the lower wall over that of the upper one, T0, in (0, 1].
        accommodation: χ in (0, 1] of both walls. (With χ = 0 nothing would hold the gas.)
        gravity: g in v0²/λ0, positive towards the lower wall; between -1 and 1.
        length: L in λ0, in (0, 1000].
        force: acceleration f along x in v0²/λ0, between -1 and 1. It stands for a pressure gradient
            n̄ m f.
        layers: number of layers; by default twice those of the Fourier flow, since layers of Δz
            conduct momentum better by (16/45π)(Δz/λ)². (A gas that loses much energy is denser in
            its middle, and may need more.)
    Numbers or, for a sweep, 1-D arrays. Raises ValueError for values outside these.
    A run ends by the stress between moving walls, else by what flows: particles, or heat.
    """

    command: ClassVar[str] = "couette"
    reports: ClassVar[tuple[Observable, ...]] = couette.OBSERVABLES
    monitored: ClassVar[tuple[str, ...]] = (
        *("energy", "height", "tilt"),
        *("shear_stress", "mean_velocity"),
    )
    counted: ClassVar[tuple[str, ...]] = (
        *("shear_stress_lower_wall", "shear_stress_upper_wall"),
        *("heat_flux_lower_wall", "heat_flux_upper_wall", "wall_work"),
    )

    gas: AbstractGas
    wall_velocity: Any = number(
        "velocity U of the upper wall relative to the lower one",
        "v0",
        low=0.0,
        high=100.0,
        example=0.5,
    )
    cold_temperature: Any = number(
        "temperature of the lower wall over that of the upper one",
        low=0.0,
        high=1.0,
        low_included=False,
        default=1.0,
    )
    accommodation: Any = number(
        "share χ of the particles that a wall absorbs and emits anew, the others being mirrored",
        low=0.0,
        high=1.0,
        low_included=False,
        default=1.0,
    )
    gravity: Any = number(
        "gravity g, positive towards the lower wall", "v0²/λ0", low=-1.0, high=1.0, default=0.0
    )
    length: Any = distance_of_walls()
    force: Any = number("acceleration f along the walls", "v0²/λ0", low=-1.0, high=1.0, default=0.0)
    layers: int = layers_between_walls()

    def __post_init__(self):
        if self.layers is None:
            slab = self.gas, self.cold_temperature, self.gravity, self.length
            self.layers = thin_layers(*slab, jump=True, times=2)

    def ends(self) -> tuple[str, ...]:
        """The stress of moving walls, the flow that a force drives, or the heat of the walls."""
        if self.wall_velocity != 0:
            return ("shear_stress",)
        if self.force != 0:
            return ("mean_velocity",)
        if loses_energy(self.gas):
            return ("dissipation",)
        return ("heat_flux_lower_wall",) if self.cold_temperature < 1 else ("temperature",)

    def approach(self, options: Options) -> Approach:
        """Diffusion of momentum and heat across the slab."""
        own = mean_free_paths(self.gas, INITIAL_TEMPERATURE)
        motion = self.wall_velocity + abs(self.driven(own))
        found = of_couette_flow(
            *(self.gas, self.cold_temperature, motion),
            *(self.accommodation, self.length),
        )
        return found if self.gravity == 0 else found._replace(certain=False)

    def initial(self, key: Key, options: Options) -> WalledState:
        """As of the Fourier flow, and u_x linear between the walls."""
        place, (vx, vy, vz) = conducting(key, options, self.cold_temperature, self.length)
        velocity = (vx + self.wall_velocity * (place / self.length - 0.5), vy, vz)
        fast = jnp.asarray(FIRST_SPEED, options.dtype) + self.wall_velocity
        fast = fast + jnp.abs(self.driven())
        crowding = FIRST_DENSITY * pair_rate(self.gas, fast)
        none = Exchange.none(options.dtype)
        return WalledState(place, velocity, crowding, self.walls(), none)

    def driven(self, own: Any = 1.0) -> Any:
        """Velocity in the middle that the force drives, about: f L²/8 over η/n̄m, and the slip.

        `own`: mean free paths of the gas in one λ0.
        """
        slip = 1.1 * (2.0 - self.accommodation) / self.accommodation
        return self.force * self.length * (own * self.length + 4.0 * slip) / 4.5

    def move(self, key: Key, state: WalledState, duration: Scalar) -> WalledState:
        """Half of the push of the force, flight between the walls, half of the push."""
        state = super().move(key, self.pushed(state, 0.5 * duration), duration)
        return self.pushed(state, 0.5 * duration)

    def pushed(self, state: WalledState, duration: Scalar) -> WalledState:
        """After the force alone has acted for a time."""
        vx, vy, vz = state.velocity
        return replace(state, velocity=(vx + self.force * duration, vy, vz))

    def walls(self) -> Walls:
        """Walls in motion, which reflect a share of the particles."""
        half = 0.5 * jnp.asarray(self.wall_velocity)
        speed = Walls.maxwell(jnp.asarray(self.cold_temperature)).speed
        return Walls(speed, None, jnp.stack([-half, half]), jnp.asarray(self.accommodation))

    def motion(self) -> Any:
        """U."""
        return self.wall_velocity

    def same_walls(self, made: Walls) -> Walls:
        """The walls: numbers only."""
        return self.walls()

    def measure(self, state: SlabState) -> Flow:
        """Sums over each layer."""
        layer = self.layer(state.position)
        vx, _, vz = state.velocity
        return Flow(
            self.conduction(state),
            totals(layer, vx, self.layers),
            totals(layer, vx * vz, self.layers),
        )

    def remarks(self, series: dict[str, np.ndarray], weights: np.ndarray) -> str:
        """Layers that are too wide for the gas that is in them now."""
        q = {name: np.mean(x, axis=0) for name, x in self.window(series, weights).items()}
        found = couette.profiles(q)
        length = float(self.length)
        return remark_on_layers(self.gas, found["density"], found["temperature"], length)

    def averages(self, record: WalledRecord) -> dict[str, np.ndarray]:
        """Densities and fluxes of each record, in the frame of the laboratory: all add up."""
        m: Any = record.moments.conduction  # on the host: arrays (realizations, records, layers)
        momentum, xz = record.moments.momentum, record.moments.xz
        n_particles = np.sum(m.number, axis=-1)
        per_volume = self.layers / n_particles[..., None]
        per_area = self.length / n_particles / record.elapsed
        done, half = record.exchange, 0.5 * self.wall_velocity
        centre = (np.arange(self.layers) + 0.5) / self.layers - 0.5
        heat_below = done.lower_energy + half * done.lower_push
        heat_above = done.upper_energy - half * done.upper_push
        return {
            "density": m.number * per_volume,
            "square": m.square * per_volume,
            "pressure_zz": m.zz * per_volume,
            "flux": m.flux * per_volume,
            "momentum": momentum * per_volume,
            "pressure_xz": xz * per_volume,
            "shear_stress": -np.sum(xz, axis=-1) / n_particles,
            "shear_stress_lower_wall": -done.lower_push * per_area,
            "shear_stress_upper_wall": done.upper_push * per_area,
            "heat_flux_lower_wall": heat_below * per_area,
            "heat_flux_upper_wall": -heat_above * per_area,
            "wall_work": half * (done.upper_push - done.lower_push) * per_area,
            "mean_velocity": np.sum(momentum, axis=-1) / n_particles,
            "energy": np.sum(m.square, axis=-1) / n_particles / 2.0,
            "height": m.height / n_particles,
            "tilt": np.sum(centre * momentum, axis=-1) / n_particles,
        }

    def observables(self, means: dict) -> dict:
        """Profiles, and what the walls tell."""
        found = couette.profiles(means)
        lost = means["energy_lost"]
        lost = np.zeros_like(lost) if conserves_energy(self.gas) else lost  # not roundings
        whole = {one.name: means[one.name] for one in couette.OBSERVABLES if one.name in means}
        return {
            **whole,
            **found,
            **couette.slip(found["velocity_x"], self.wall_velocity, self.length, self.force),
            "force_work": self.force * means["mean_velocity"] * self.length,
            "dissipation": self.length * lost,
        }
