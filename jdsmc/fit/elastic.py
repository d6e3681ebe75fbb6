"""Steady targets of a sheared elastic gas: the exact scaling, one sweep for all restitutions."""

import numpy as np

from ..estimate import Estimate
from ..gases import ElasticHardSpheres
from ..results.result import Result
from ..scenarios import UniformShear
from .elastic_curve import Curve
from .labelled import Match
from .match import Elastic, match
from .numbers import replaced, value_of
from .targets import FREE, Target


def scales(model, free: tuple[str, ...]) -> bool:
    """True if the exact scaling serves."""
    sheared = isinstance(model, UniformShear) and isinstance(model.gas, ElasticHardSpheres)
    return sheared and set(free) <= set(FREE)


def matches(
    alpha: np.ndarray,
    fits: list[Target],
    free: tuple[str, ...],
    wanted: dict[str, list[Estimate]],
    model: UniformShear,
    sweep: Result,
) -> list[Match]:
    """A match at every restitution, for every target.

    Arguments: α; the fits; the free numbers; what each observable is to be, at every α; the model;
    a result of `elastic_sweep`.
    """
    curves = {name: Curve(sweep, name) for name in wanted}
    found = []
    for k, a in enumerate(alpha):
        here = replaced(model, {"restitution": float(a)})
        fixed = {name: value_of(here, name) for name in FREE if name not in free}
        for fit in fits:
            elastic = Elastic(1.0 - a**2, [curves[n] for n in fit.names], free, fixed)
            found.append(match(elastic, fit, [wanted[name][k] for name in fit.names]))
    return found
