"""What a gas of the user's own must return, asked on the host before anything is compiled."""

import jax
import jax.core
import numpy as np

from .. import sweep

OURS = __package__
"""Gases of this package have tests instead."""

PROBES = np.geomspace(0.02, 20.0, 7)
"""Relative speeds (v0) at which a gas must return numbers."""


def check_rules(gas) -> None:
    """Raise TypeError or ValueError, with the name of the method, for a gas that returns nonsense.

    Numbers that are traced cannot be looked at, and pass.
    """
    kind = type(gas)
    traced = any(isinstance(leaf, jax.core.Tracer) for leaf in jax.tree.leaves(gas))
    if kind.__module__.startswith(f"{OURS}.") or traced:
        return
    points = sweep.points(gas)[0]
    _check_compiles(points[0], kind.__name__)
    for one in points:
        _check_rate(one, kind.__name__)
        _check_transfer(one, kind.__name__)


def _check_rate(gas, name: str) -> None:
    every, first = gas.rate(PROBES), gas.rate(PROBES[:1])
    rates = _numbers(f"{name}.rate must return a real number for each relative speed", every)
    if rates.shape not in {(), PROBES.shape}:
        raise TypeError(
            f"{name}.rate must return an array of the shape of its argument, {PROBES.shape} here, "
            f"got {rates.shape}."
        )
    rates = np.broadcast_to(rates, PROBES.shape)
    wrong = ~(np.isfinite(rates) & (rates >= 0))
    if np.any(wrong):
        raise ValueError(
            f"{name}.rate gives {rates[wrong][0]:g} at the relative speed {PROBES[wrong][0]:g} v0; "
            "the allowed range is [0, inf)."
        )
    if not np.any(rates > 0):
        raise ValueError(f"{name}.rate is 0 at every speed: such a gas has no collisions.")
    alone = np.ravel(_numbers(f"{name}.rate must return a real number", first))[0]
    if not np.isclose(alone, rates[0], rtol=1e-4):
        raise ValueError(
            f"{name}.rate gives {rates[0]:g} and {alone:g} for one pair, beside others and alone: "
            "it must be a function of each speed by itself."
        )


def _check_transfer(gas, name: str) -> None:
    found = gas.momentum_transfer(*_pairs(gas.dimension))
    must = (
        f"{name}.momentum_transfer must return {gas.dimension} components, an array of real "
        "numbers each"
    )
    if not isinstance(found, tuple | list) or len(found) != gas.dimension:
        raise TypeError(f"{must}, got {found!r}.")
    for one in found:
        transfer = _numbers(must, one)
        if transfer.shape not in {(), PROBES.shape}:
            raise TypeError(f"{must}, of the shape {PROBES.shape} here; got {transfer.shape}.")
        if not np.all(np.isfinite(transfer)):
            raise ValueError(
                f"{name}.momentum_transfer gives a number that is not finite for relative speeds "
                f"of {PROBES[0]:g} to {PROBES[-1]:g} v0."
            )


def _pairs(dimension: int) -> tuple[tuple, tuple]:
    """Relative velocities of pairs, and those after an elastic collision."""
    none = (np.zeros_like(PROBES),) * (dimension - 1)
    return (PROBES, *none), (0.6 * PROBES, 0.8 * PROBES, *none[1:])


def _check_compiles(gas, name: str) -> None:
    """Trace the methods, of one point of a sweep: whether that can be done hangs on no number."""
    rate, transfer = (gas.rate, (PROBES,)), (gas.momentum_transfer, _pairs(gas.dimension))
    for called, (method, given) in {"rate": rate, "momentum_transfer": transfer}.items():
        try:
            jax.eval_shape(lambda *x, method=method: (method(*x), None)[1], *given)
        except (jax.errors.JAXTypeError, ValueError) as error:
            refuse_untraced(f"{name}.{called}", error)
            raise


def refuse_untraced(name: str, error: Exception) -> None:
    """Raise TypeError, with the name of the method, for one that asks for values of arrays."""
    if isinstance(error, jax.errors.JAXTypeError) or "truth value of an array" in str(error):
        raise TypeError(
            f"{name} cannot be compiled: it asks for the values of arrays, by `if`, `float` or a "
            "function of NumPy; use jax.numpy, and jnp.where in place of `if`."
        ) from error


def _numbers(must: str, found) -> np.ndarray:
    """As an array; TypeError for what is none."""
    try:
        array = np.asarray(found)
    except (TypeError, ValueError):
        array = np.asarray(None)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{must}, got {found!r}.")
    return array
