"""Scenes: one physical situation a file, and what a scene of your own derives from."""

from .approach import Approach
from .base import AbstractScene, Record
from .cooling_disks import CoolingDisks
from .couette_flow import CouetteFlow
from .fourier_flow import FourierFlow
from .heat_flux_force import HeatFluxForce
from .homogeneous import AbstractHomogeneous, homogeneous_observables
from .homogeneous_cooling import HomogeneousCooling
from .molecular_dynamics import MolecularDynamics
from .navier_stokes import NavierStokes
from .options import Options
from .sheared_slab import ShearedSlab
from .slab import AbstractSlab, SlabState
from .uniform_shear import UniformShear
from .white_noise_thermostat import WhiteNoiseThermostat

SCENES = (
    UniformShear,
    HomogeneousCooling,
    WhiteNoiseThermostat,
    HeatFluxForce,
    FourierFlow,
    CouetteFlow,
    ShearedSlab,
    NavierStokes,
    CoolingDisks,
    MolecularDynamics,
)
"""Those of the library, in the order of the command line."""

__all__ = [
    "SCENES",
    "AbstractHomogeneous",
    "AbstractScene",
    "AbstractSlab",
    "Approach",
    "CoolingDisks",
    "CouetteFlow",
    "FourierFlow",
    "HeatFluxForce",
    "HomogeneousCooling",
    "MolecularDynamics",
    "NavierStokes",
    "Options",
    "Record",
    "ShearedSlab",
    "SlabState",
    "UniformShear",
    "WhiteNoiseThermostat",
    "homogeneous_observables",
]
