"""How results are shown to people: tables and pictures, one file a scene."""

from ..impulse import view as navier_stokes
from . import heat_flux_force, homogeneous_cooling, uniform_shear

_SCENES = {
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
