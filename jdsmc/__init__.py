"""Direct simulation Monte Carlo of granular and molecular gases."""

from . import random, scenarios, theory, transport
from .errors import FaultError, NotSteadyError
from .estimate import Estimate, combine
from .fields import choice, count, number
from .gases import (
    AbstractGas,
    ElasticHardSpheres,
    InelasticHardDisks,
    InelasticHardSpheres,
    MaxwellMolecules,
)
from .measure.observable import Observable
from .results import Result, load
from .running.cores import leave_cores_to_gases
from .running.run import resume, run

__all__ = [
    "AbstractGas",
    "ElasticHardSpheres",
    "Estimate",
    "FaultError",
    "InelasticHardDisks",
    "InelasticHardSpheres",
    "MaxwellMolecules",
    "NotSteadyError",
    "Observable",
    "Result",
    "choice",
    "combine",
    "count",
    "leave_cores_to_gases",
    "load",
    "number",
    "random",
    "resume",
    "run",
    "scenarios",
    "theory",
    "transport",
]
