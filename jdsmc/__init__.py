"""Direct simulation Monte Carlo of granular and molecular gases."""

from . import fit, random, scenarios, theory, transport
from .derivatives.sensitivity import sensitivity
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
from .results import Derivative, Result, Sensitivity, load
from .running.hosts import join_hosts
from .running.merge import merge
from .running.provenance import version
from .running.resume import resume
from .running.run import run

__version__ = version()
"""Of the installed package; "unknown" in a bare checkout."""

__all__ = [
    "AbstractGas",
    "Derivative",
    "ElasticHardSpheres",
    "Estimate",
    "FaultError",
    "InelasticHardDisks",
    "InelasticHardSpheres",
    "MaxwellMolecules",
    "NotSteadyError",
    "Observable",
    "Result",
    "Sensitivity",
    "__version__",
    "choice",
    "combine",
    "count",
    "fit",
    "join_hosts",
    "load",
    "merge",
    "number",
    "random",
    "resume",
    "run",
    "scenarios",
    "sensitivity",
    "theory",
    "transport",
]
