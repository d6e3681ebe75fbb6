"""Heat conduction between two walls under gravity.

Tahiri, Tij and Santos, "Monte Carlo simulation of a hard-sphere gas in the planar Fourier flow with
a gravity field" (2000). Units as everywhere, T0 being the temperature T_+ of the hot wall at z = L;
gravity is an acceleration -g ẑ, so that g > 0 presses the gas to the cold wall.
"""

from typing import Any, ClassVar, Literal

import jax.numpy as jnp
import numpy as np

from ..fields import choice, number
from ..gases import AbstractGas, ElasticHardSpheres
from ..gases.base import check_gas, conserves_energy, pair_rate, power_law, speed_exponent
from ..measure import conduction
from ..measure.observable import Observable
from ..motion.flight import Exchange
from ..motion.walls import Walls, check_gradients, made_before
from ..types import Key
from .approach import Approach, of_conduction
from .layers import WIDEST, thin_layers
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

TOO_WIDE = 0.005
"""Share of the heat flux that layers may carry unseen before a run remarks on it."""


class FourierFlow(AbstractWalled):
    """A gas between walls at T_- (z = 0) and T_+ = T0 (z = L), started from Fourier's law (eq. 31).

    Arguments:
        gas: one without drag that conserves energy (`InelasticHardSpheres(1.0)`, the default, or
            `MaxwellMolecules()`).
        cold_temperature: T_-/T_+ in (0, 1].
        gravity: g in v0²/λ0, positive towards the cold wall; between -1 and 1.
        length: L in λ0, in (0, 1000].
        wall: "maxwell" (type I) or "bgk" (type II: the emitted particles come from a gas that
            conducts heat, eq. 18).
        layers: number of layers; by default 100, 200, 400, ...: none is wider than half
            a mean free path where the gas is densest. All points of a sweep must need the same,
            else give them.
    Numbers or, for a sweep, 1-D arrays. Raises ValueError for values outside these, and before a
    run for type II walls of a gradient that is too large (`walls.STEEPEST`).
    """

    command: ClassVar[str] = "fourier"
    reports: ClassVar[tuple[Observable, ...]] = conduction.OBSERVABLES
    monitored: ClassVar[tuple[str, ...]] = ("energy", "height", "mean_heat_flux")
    counted: ClassVar[tuple[str, ...]] = ("heat_flux_cold_wall", "heat_flux_hot_wall")

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
    length: Any = distance_of_walls()
    wall: Literal["maxwell", "bgk"] = choice(
        "what the walls emit: a Maxwellian (type I), or the BGK gas that conducts heat (type II)",
        ("maxwell", "bgk"),
        default="maxwell",
    )
    layers: int = layers_between_walls()

    def __post_init__(self):
        if self.layers is None:
            slab = self.gas, self.cold_temperature, self.gravity, self.length
            self.layers = thin_layers(*slab, jump=str(self.wall) == "maxwell")

    def __check_init__(self):
        check_gas(self.gas)
        if isinstance(self.gas, ElasticHardSpheres) or not conserves_energy(self.gas):
            raise ValueError("FourierFlow needs an elastic gas without drag: restitution = 1.")
        if speed_exponent(self.gas) is None:
            raise ValueError(
                "FourierFlow needs a gas whose pair rate is a power of the relative speed: κ*, ε "
                f"and g* stand on κ ∝ T^ω; {type(self.gas).__name__} has no such law."
            )

    def fit_options(self, options: Options) -> Options:
        """Raise ValueError for walls that are too steep, too, and for too long a step."""
        if self.wall == "bgk":
            check_gradients(float(self.cold_temperature), float(self.length))
        return super().fit_options(options)

    def approach(self, options: Options) -> Approach:
        """Diffusion of heat across the slab."""
        return of_conduction(self.gas, self.cold_temperature, self.gravity, self.length)

    def initial(self, key: Key, options: Options) -> WalledState:
        """Local equilibrium with n ∝ 1/T and T^{3/2} linear between the walls: eq. (31)."""
        gas = conducting(key, options, self.cold_temperature, self.length)
        fast = jnp.asarray(FIRST_SPEED, options.dtype)
        crowding = FIRST_DENSITY * pair_rate(self.gas, fast)
        return WalledState(*gas, crowding, self.walls(), Exchange.none(options.dtype))

    def walls(self) -> Walls:
        """Walls of either type."""
        return Walls.of(self.wall, self.cold_temperature, self.length)

    def motion(self) -> float:
        """None."""
        return 0.0

    def same_walls(self, made: Walls) -> Walls:
        """The walls, with derivatives of their tables where these are asked for."""
        return made_before(self.wall, self.cold_temperature, self.length, made)

    def measure(self, state: SlabState) -> Conduction:
        """Sums over each layer."""
        return self.conduction(state)

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

    def averages(self, record: WalledRecord) -> dict[str, np.ndarray]:
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
            "heat_flux_cold_wall": record.exchange.lower_energy * per_area,
            "heat_flux_hot_wall": -record.exchange.upper_energy * per_area,
            "energy": np.sum(m.square, axis=-1) / n_particles / 2.0,
            "height": m.height / n_particles,
        }

    def observables(self, means: dict) -> dict:
        """Profiles, and their reduced form."""
        profiles = conduction.profiles(means)
        exponent = 1.0 - 0.5 * power_law(self.gas)
        return profiles | conduction.reduced(profiles, self.gravity, self.length, exponent)
