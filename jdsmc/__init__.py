"""Direct simulation Monte Carlo of granular and molecular gases."""

from . import scenarios, theory, transport
from .faults import FaultError, NotSteadyError
from .gas import ElasticHardSpheres, InelasticHardSpheres, MaxwellMolecules
from .result import Estimate, Result, load
from .run import run

__all__ = [
    "ElasticHardSpheres",
    "Estimate",
    "FaultError",
    "InelasticHardSpheres",
    "MaxwellMolecules",
    "NotSteadyError",
    "Result",
    "load",
    "run",
    "scenarios",
    "theory",
    "transport",
]
