"""Arguments of the command line: what each scene can be told. Used by `jdsmc.cli` only."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Literal

import tyro

from ..gases.base import RATE_FACTORS, ElasticHardSpheres, InelasticHardSpheres, MaxwellMolecules
from ..scenarios import FourierFlow, HeatFluxForce, HomogeneousCooling, ShearedSlab, UniformShear
from ..scenarios.options import STEPS_PER_RECORD, TIME_STEP

GASES = ("ihs", "ehs", "ehs-measured")


@dataclass(frozen=True, kw_only=True)
class Numerics:
    """How a run is made."""

    particles: int | None = None
    """Particles of one realization (at least 64, in a homogeneous gas with a divisor from 64 to
    1024); by default 20000, or 50 for each layer of a Fourier flow."""
    realizations: int = 8
    """Independent realizations (at least 4); the error bars come from them."""
    seed: int = 0
    """Seed of all random numbers."""
    duration: float | None = None
    """Time to simulate, in units of tau0; if not given, run until steady and precise."""
    collisions: float | None = None
    """Time to simulate, in accepted collisions per particle."""
    observable: str | None = None
    """Observable whose precision ends the run; by default the main one of the scene."""
    rtol: float = 1e-3
    """Relative standard error asked of that observable (dimensionless)."""
    budget: float = 5_000.0
    """Most collisions per particle to spend."""
    time_step: float = TIME_STEP
    """Largest time step as a fraction of tau(T), and of 1/shear_rate, in (0, 1]."""
    splitting: Literal["strang", "lie"] = "strang"
    """Order of flow (or flight) and collisions in a step: second order, or first as in the
    papers."""
    dtype: Literal["float32", "float64"] = "float32"
    """Precision of the velocities."""
    steps_per_record: int = STEPS_PER_RECORD
    """Time steps between two measurements."""
    progress: bool = True
    """Show a progress bar."""


@dataclass(frozen=True, kw_only=True)
class Output:
    """Files to write."""

    out: Path | None = None
    """File to write (HDF5); it must not exist."""
    plot: Path | None = None
    """Picture to write (PNG, PDF or SVG)."""


@dataclass(frozen=True)
class Scene:
    """What every command that simulates is told; a scene adds its own numbers.

    `swept` names the fields that hold numbers as text: `scenes` takes their values.
    """

    swept: ClassVar[tuple[str, ...]]
    has_gases: ClassVar[bool] = False

    numerics: tyro.conf.OmitArgPrefixes[Numerics]
    output: tyro.conf.OmitArgPrefixes[Output]

    def scenes(self, values: dict[str, Any]) -> dict[str, Any]:
        """The scene of every gas by its name, made of the numbers in `values`."""
        raise NotImplementedError


@dataclass(frozen=True)
class Granular(Scene):
    """A scene whose gas has a restitution."""

    swept: ClassVar[tuple[str, ...]] = ("restitution",)

    restitution: str = "0.9"
    """Coefficient of normal restitution, in (0, 1]. Sweeps take ranges first:last:step and lists
    separated by commas, e.g. 0.5:0.95:0.05 or 0.5,0.7."""


@dataclass(frozen=True)
class Sheared(Granular):
    """A scene whose gas, one of two kinds, is sheared."""

    swept: ClassVar[tuple[str, ...]] = ("restitution", "shear_rate", "rate_factor")
    has_gases: ClassVar[bool] = True

    shear_rate: str = "4"
    """Shear rate a, in units of 1/tau0, at least 0; sweeps take ranges and lists."""
    gas: str = "ihs"
    """Gas: ihs (inelastic hard spheres), ehs (frictional elastic hard spheres), ehs-measured (the
    same with the measured drag); sweeps take a list."""
    rate_factor: str = "linear"
    """Collision rate of the elastic gas over the inelastic one: linear, viscosity, or a number."""

    def gases(self, values: dict[str, Any]) -> dict[str, Any]:
        """The gases asked for, by name."""
        return {name: _gas(name, values) for name in self.gas.split(",")}


@dataclass(frozen=True)
class Shear(Sheared):
    """Uniform shear flow of a granular gas, or (sweep) many of them.

    Lengths are in mean free paths lambda0, times in tau0 = lambda0/v0, v0 = sqrt(2 T0/m).
    """

    def scenes(self, values):
        gases = self.gases(values)
        return {name: UniformShear(gas, values["shear_rate"]) for name, gas in gases.items()}


@dataclass(frozen=True)
class Slab(Sheared):
    """A granular gas between Lees-Edwards planes, or (sweep) many of them.

    Lengths are in mean free paths lambda0, times in tau0 = lambda0/v0, v0 = sqrt(2 T0/m), at the
    mean density. With `--duration` the profiles are followed in time.
    """

    swept: ClassVar[tuple[str, ...]] = ("restitution", "shear_rate", "rate_factor", "length")

    length: str = "2.5"
    """Distance of the planes in lambda0, in (0, 1000]; sweeps take ranges and lists."""
    initial_state: Literal["equilibrium", "nonequilibrium", "local_equilibrium"] = "equilibrium"
    """A gas at rest (eq. 3.5), the paper's state far from equilibrium (3.6), or uniform shear."""
    layers: int = 50
    """Layers across the slab: collisions take place, and profiles are measured, within them."""

    def scenes(self, values):
        numbers = (values["shear_rate"], values["length"])
        switches = {"initial_state": self.initial_state, "layers": self.layers}
        gases = self.gases(values)
        return {name: ShearedSlab(gas, *numbers, **switches) for name, gas in gases.items()}


@dataclass(frozen=True)
class Cooling(Granular):
    """A granular gas that cools freely, or (sweep) many of them.

    Lengths are in mean free paths lambda0, times in tau0 = lambda0/v0, v0 = sqrt(2 T0/m).
    """

    def scenes(self, values):
        if self.numerics.splitting != "strang":
            raise ValueError("splitting = 'lie' has no meaning here: only collisions act.")
        return {"ihs": HomogeneousCooling(InelasticHardSpheres(values["restitution"]))}


@dataclass(frozen=True)
class HeatFlux(Granular):
    """A granular gas under the heat-flux force, or (sweep) many of them.

    Lengths are in mean free paths lambda0, times in tau0 = lambda0/v0, v0 = sqrt(2 T0/m).
    """

    swept: ClassVar[tuple[str, ...]] = ("restitution", "field")

    field: str = "0.025"
    """Strength of the force, lambda0 eps (dimensionless), in [0, 2]; coefficients are those of the
    limit of weak fields. Sweeps take ranges and lists."""
    scheme: Literal["exact", "paper"] = "exact"
    """The force of a step: its exact flow around the collisions, or the paper's explicit step."""

    def scenes(self, values):
        gas = InelasticHardSpheres(values["restitution"])
        scene = HeatFluxForce(gas, values["field"], self.scheme)
        endless = self.numerics.duration is None and self.numerics.collisions is None
        if endless and (values["field"] == 0).any():
            raise ValueError(
                "field = 0 drives no heat flux to be measured; give field > 0, or duration or "
                "collisions."
            )
        return {"ihs": scene}


@dataclass(frozen=True)
class Fourier(Scene):
    """Heat conduction between two walls under gravity, or (sweep) many such states.

    Lengths are in mean free paths lambda0 at the mean density, times in tau0 = lambda0/v0 with
    v0 = sqrt(2 T0/m), T0 being the temperature of the hot wall.
    """

    swept: ClassVar[tuple[str, ...]] = ("cold_temperature", "gravity", "length")

    cold_temperature: str = "0.05"
    """Temperature of the cold wall over that of the hot one, in (0, 1]. Sweeps take ranges
    first:last:step and lists separated by commas."""
    gravity: str = "0"
    """Gravity in v0^2/lambda0, positive towards the cold wall; in [-1, 1]. Write --gravity=-0.016,
    or a list --gravity=-0.016,0,0.008."""
    length: str = "10"
    """Distance of the walls in lambda0, in (0, 1000]."""
    wall: Literal["maxwell", "bgk"] = "maxwell"
    """What the walls emit: a Maxwellian (type I), or the BGK gas that conducts heat (type II)."""
    gas: Literal["hard-spheres", "maxwell-molecules"] = "hard-spheres"
    """The gas, elastic in both cases."""
    layers: int = 100
    """Layers across the slab: collisions take place, and profiles are measured, within them."""

    def scenes(self, values):
        gas = InelasticHardSpheres(1.0) if self.gas == "hard-spheres" else MaxwellMolecules()
        return {self.gas: FourierFlow(gas, **values, wall=self.wall, layers=self.layers)}


def _gas(name: str, values: dict[str, Any]):
    if name not in GASES:
        raise ValueError(f"gas = {name!r} is unknown; choose from {', '.join(GASES)}.")
    if name == "ihs":
        return InelasticHardSpheres(values["restitution"])
    drag = "measured" if "measured" in name else "local"
    return ElasticHardSpheres(values["restitution"], values["rate_factor"], drag)


def named(name: str, text: str) -> bool:
    """True if a swept field holds a name instead of numbers."""
    return name == "rate_factor" and text in RATE_FACTORS
