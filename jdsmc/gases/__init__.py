"""Gases: the physics of one pair."""

from .base import AbstractGas
from .hard_spheres import ElasticHardSpheres, InelasticHardDisks, InelasticHardSpheres
from .maxwell import MaxwellMolecules

__all__ = [
    "AbstractGas",
    "ElasticHardSpheres",
    "InelasticHardDisks",
    "InelasticHardSpheres",
    "MaxwellMolecules",
]
