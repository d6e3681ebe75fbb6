"""How far frictional elastic spheres can mimic inelastic ones: docs/calibration.md."""

from . import study
from .study import PAPER

__all__ = ["PAPER"]
PAPER.take([study], [study])
