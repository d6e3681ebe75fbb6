"""Scenes: one physical situation a file."""

from .heat_flux_force import HeatFluxForce
from .homogeneous_cooling import HomogeneousCooling
from .uniform_shear import UniformShear

__all__ = ["HeatFluxForce", "HomogeneousCooling", "UniformShear"]
