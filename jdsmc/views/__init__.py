"""How results are shown to people: tables and pictures, one file a scene."""

from ..impulse import view as navier_stokes
from . import fourier_flow, heat_flux_force, homogeneous_cooling, sheared_slab, uniform_shear

_SCENES = {
    "FourierFlow": fourier_flow,
    "ShearedSlab": sheared_slab,
    "UniformShear": uniform_shear,
    "HomogeneousCooling": homogeneous_cooling,
    "HeatFluxForce": heat_flux_force,
    "NavierStokes": navier_stokes,
}


def _view(result):
    return _SCENES[result.attrs["scene"]]


def table(result) -> str:
    """Steady values with errors, beside theory."""
    return _view(result).table(result)


def draw(result):
    """The matplotlib figure of a result."""
    return _view(result).draw(result)
