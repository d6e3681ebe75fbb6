"""Scenes: one physical situation a file."""

from .fourier_flow import FourierFlow
from .heat_flux_force import HeatFluxForce
from .homogeneous_cooling import HomogeneousCooling
from .sheared_slab import ShearedSlab
from .uniform_shear import UniformShear

__all__ = ["FourierFlow", "HeatFluxForce", "HomogeneousCooling", "ShearedSlab", "UniformShear"]
