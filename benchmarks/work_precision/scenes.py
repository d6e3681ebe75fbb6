"""What is run: scenes at one point each, their knobs, and the truth their errors are taken from."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from jdsmc import InelasticHardDisks, InelasticHardSpheres
from jdsmc.scenarios import (
    CoolingDisks,
    CouetteFlow,
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    MolecularDynamics,
    NavierStokes,
    ShearedSlab,
    UniformShear,
    WhiteNoiseThermostat,
)
from jdsmc.scenarios.cooling_response import CoolingResponse
from jdsmc.scenarios.navier_stokes import duration_for
from jdsmc.theory import boltzmann, langevin

GAS = InelasticHardSpheres(0.7)


@dataclass(frozen=True)
class Studied:
    """A scene with its knobs.

    Arguments: its name; `make`, the scene with some of its own sizes changed; observables; options
    of `run` for the length of a row; knobs, by name the settings that are tried one at a time,
    of `run` or of the scene; `truth`, values of the observables by deterministic theory (which:
    `truth_by`), or the settings of a run that is closer to the limit (a reference), `longer` times
    as long.
    """

    name: str
    make: Callable[..., Any]
    observables: tuple[str, ...]
    length: dict[str, float]
    knobs: dict[str, tuple]
    truth: dict[str, float] = field(default_factory=dict)
    truth_by: str = "theory"
    reference: dict[str, Any] = field(default_factory=dict)
    longer: float = 10.0


def _mode() -> dict[str, float]:
    mode = langevin.transverse_mode(0.8, 10.0)
    names = ("viscosity_ratio", "noise_viscosity_ratio")
    return {name: float(getattr(mode, name)) for name in names} | {"temperature": 1.0}


def _sizes(given: dict, *names: str) -> dict:
    """Those of the given settings that are the scene's own."""
    return {name: given[name] for name in names if name in given}


def _disks(**given):
    own = _sizes(given, "copies", "real_per_cell")
    return CoolingDisks(InelasticHardDisks(0.8), density=0.01, **own)


def _slab(**given):
    return ShearedSlab(GAS, 4.0, 2.5, **_sizes(given, "layers"))


def _fourier(**given):
    own = _sizes(given, "layers")
    return FourierFlow(InelasticHardSpheres(1.0), length=10.0, cold_temperature=0.5, **own)


def _couette(**given):
    own = _sizes(given, "layers")
    return CouetteFlow(InelasticHardSpheres(1.0), wall_velocity=0.8, length=4.0, **own)


def _kicks(**given):
    usual = duration_for(NavierStokes.default_rtol)
    return NavierStokes(GAS, given.get("kick", 0.2), given.get("followed", usual))


def _molecules(**given):
    """Denser with fewer disks: N n σ², which fixes the mode, stays at 10."""
    return MolecularDynamics(InelasticHardDisks(0.8), 10.0 / given.get("n_particles", 1000))


def _coefficients(*names: str) -> dict[str, float]:
    found = boltzmann.navier_stokes(0.7)
    return {name: getattr(found, name) for name in names}


COEFFICIENTS = ("modified_conductivity", "conductivity", "viscosity")
STEPS = (0.0125, 0.025, 0.05, 0.1, 0.2)
SPLITTING = ("strang", "lie")
HOMOGENEOUS = {
    "time_step": STEPS,
    "n_particles": (640, 1280, 2560, 5120, 20000),
    "steps_per_record": (4, 8, 16, 32),
}

SCENES = (
    Studied(
        "shear",
        lambda **_: UniformShear(GAS, 4.0),
        ("shear_stress", "temperature", "a2"),
        {"collisions": 400.0},
        HOMOGENEOUS | {"splitting": SPLITTING},
        reference={"time_step": 0.0125, "n_particles": 20000},
    ),
    Studied(
        "cooling",
        lambda **_: HomogeneousCooling(InelasticHardSpheres(0.5)),
        ("a2",),
        {"collisions": 400.0},
        HOMOGENEOUS,
        truth={"a2": boltzmann.navier_stokes(0.5).a2},
    ),
    Studied(
        "heat-flux",
        lambda **_: HeatFluxForce(GAS, 0.025),
        ("modified_conductivity",),
        {"collisions": 300.0},
        {
            "time_step": STEPS,
            "n_particles": (5120, 20000, 40000),
            "splitting": SPLITTING,
            "steps_per_record": (4, 8, 16),
        },
        truth={"modified_conductivity": boltzmann.navier_stokes(0.7).modified_conductivity},
        truth_by="theory at zero field",
    ),
    Studied(
        "sheared-slab",
        _slab,
        ("shear_stress", "mean_temperature"),
        {"collisions": 150.0},
        {
            "time_step": (0.025, 0.05, 0.1),
            "n_particles": (1000, 2500, 5000),
            "layers": (5, 10, 25, 50),
            "splitting": SPLITTING,
        },
        reference={"time_step": 0.025, "n_particles": 10000, "layers": 50},
        longer=4.0,
    ),
    Studied(
        "fourier",
        _fourier,
        ("mean_heat_flux",),
        {"duration": 600.0},
        {
            "time_step": (0.0125, 0.025, 0.05),
            "n_particles": (1250, 2500, 5000),
            "layers": (25, 50, 100),
            "splitting": SPLITTING,
        },
        reference={"time_step": 0.0125, "n_particles": 10000, "layers": 100},
        longer=4.0,
    ),
    Studied(
        "white-noise",
        lambda **_: WhiteNoiseThermostat(InelasticHardSpheres(0.4), 0.1),
        ("temperature", "a2"),
        {"collisions": 400.0},
        {"time_step": STEPS[1:], "n_particles": (640, 1280, 2560, 5120, 20000)},
        reference={"time_step": 0.025, "n_particles": 20000},
        longer=3.0,
    ),
    Studied(
        "couette",
        _couette,
        ("shear_stress", "heat_flux_upper_wall"),
        {"duration": 600.0},
        {
            "time_step": (0.0125, 0.025, 0.05),
            "n_particles": (1250, 2500, 5000),
            "layers": (10, 20, 40, 80),
            "splitting": SPLITTING,
        },
        reference={"time_step": 0.0125, "n_particles": 10000, "layers": 80},
        longer=4.0,
    ),
    Studied(
        "cooling-disks",
        _disks,
        ("viscosity_ratio", "noise_viscosity_ratio", "temperature"),
        {"duration": 600.0, "n_particles": 1000},
        {
            "time_step": (0.035, 0.07, 0.1),
            "copies": (2, 5, 10, 20),
            "real_per_cell": (0.5, 1.0, 2.0, 4.0),
        },
        truth=_mode(),
    ),
    Studied(
        "molecular-dynamics",
        _molecules,
        ("viscosity_ratio", "noise_viscosity_ratio"),
        {"duration": 1000.0, "n_particles": 1000},
        {"n_particles": (500, 2000)},
        truth=_mode(),
        truth_by="theory of the dilute gas",
    ),
    Studied(
        "navier-stokes",
        _kicks,
        COEFFICIENTS,
        {"collisions": 400.0, "n_particles": 5120},
        {
            "time_step": (0.02, 0.04),
            "n_particles": (1280, 2560, 20480),
            "kick": (0.05, 0.1, 0.4),
            "followed": (5.0, 6.0, 10.0, 15.0),
        },
        truth=_coefficients(*COEFFICIENTS),
    ),
    Studied(
        "linear-response",
        lambda **_: CoolingResponse(GAS),
        COEFFICIENTS,
        {"collisions": 200.0},
        {
            "time_step": STEPS[1:],
            "n_particles": (640, 1280, 2560, 10240),
            "steps_per_record": (4, 8, 32),
        },
        truth=_coefficients(*COEFFICIENTS),
    ),
)
