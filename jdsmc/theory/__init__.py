"""Closed forms and kinetic-model solutions, one problem a file; nothing here runs a simulation."""

from . import (
    bgk_shear_flow,
    boltzmann,
    chapman_enskog,
    closed_langevin,
    frictional,
    homogeneous_cooling,
    langevin,
    sonine_elastic,
    transport,
)

__all__ = [
    "bgk_shear_flow",
    "boltzmann",
    "chapman_enskog",
    "closed_langevin",
    "frictional",
    "homogeneous_cooling",
    "langevin",
    "sonine_elastic",
    "transport",
]
