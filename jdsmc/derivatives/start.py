"""Derivatives along a time series begin at zero: the start must not depend on the numbers."""

import equinox as eqx
import jax
import jax.numpy as jnp

from .. import random, sweep
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from .numbers import shifted


def check_fixed_start(scene: AbstractScene, options: Options, paths: dict[str, str]) -> None:
    """Raise ValueError for a scene whose first velocities depend on one of these numbers.

    Arguments: the scene of one point; numbers by their short names. Nothing is computed: it is
    looked up in the traced start which inputs reach the velocities.
    """
    for name, path in paths.items():
        if _reaches(scene, options, path):
            raise ValueError(
                f"the derivative with respect to {name} along the time series is not known: the "
                f"start of {type(scene).__name__} depends on it. Start from a state that does not "
                '(initial_state = "equilibrium" of a sheared gas), or leave out duration and '
                "collisions for derivatives of steady values."
            )


def _reaches(scene: AbstractScene, options: Options, path: str) -> bool:
    numbers, rest = eqx.partition(scene, sweep.is_number)
    scene = eqx.combine(jax.tree.map(lambda x: jnp.asarray(x, options.dtype), numbers), rest)

    def velocities(by):
        return shifted(scene, path, by).initial(random.key_from_seed(0), options).velocity

    traced = jax.make_jaxpr(velocities)(jnp.zeros((), options.dtype)).jaxpr
    reached = {id(variable) for variable in traced.invars}
    for equation in traced.eqns:
        if any(id(x) in reached for x in equation.invars):
            reached.update(id(x) for x in equation.outvars)
    return any(id(x) in reached for x in traced.outvars)
