"""From the response of averages to that of everything a scene reports, by the chain rule."""

from typing import Any, NamedTuple

import numpy as np

from ..measure.polynomials import Averages, on_host
from ..scenarios.heat_flux_force import HeatFluxForce, HeatRecord
from ..scenarios.homogeneous import AbstractHomogeneous, HomogeneousRecord
from .numbers import shifted, slope
from .response import Change, Generator, value_at
from .sampling import Sampler

STEP = 1e-3
"""Relative, of the averages and the number together; differences are exact to h⁴."""

ZERO = 1e-8
"""Relative size of a derivative along a pure scaling that is rounding, not physics."""

NOT_DIFFERENTIATED = ("time_step", "speed_ratio")
"""Numerics, and shares of particles in classes of speed: no smooth function of averages."""


class State(NamedTuple):
    """Averages of one instant or window: as `Change`; leading axes of the averages come last."""

    moments: Any
    cubed: Any
    source: Any


def reported_names(scene: AbstractHomogeneous) -> list[str]:
    """Observables that can have derivatives."""
    return [one.name for one in scene.reports if one.name not in NOT_DIFFERENTIATED]


def values(scene: AbstractHomogeneous, sampler: Sampler, state: State) -> dict[str, np.ndarray]:
    """What a scene reports, from averages of polynomials and of collisions."""
    if np.ndim(state.moments) == 1:  # averages have an axis on the host
        one = State(*(np.asarray(x)[..., None] for x in state))
        return {name: np.asarray(x[0]) for name, x in values(scene, sampler, one).items()}
    mean = Averages(sampler.rows, state.moments, {"cubed": state.cubed})
    moments = sampler.symmetry.moments(mean, scene.gas.dimension)
    heat = sum(mean[powers] for powers in sampler.symmetry.squares) / scene.gas.dimension
    one, none = np.ones_like(heat), np.zeros_like(heat)
    record = on_host(
        HeatRecord if isinstance(scene, HeatFluxForce) else HomogeneousRecord,
        **{"moments": moments, "elapsed": one, "log_scale": none},
        **{"slowing": np.stack([one, one], -1), "final": heat},
    )
    means = dict(scene.averages(record))
    squares = [sampler.rows.index(powers) for powers in sampler.symmetry.squares]
    means["accepted"] = state.source[-1]
    means["energy_lost"] = -0.5 * np.sum(state.source[squares], axis=0)
    means["time_step"] = one
    found = scene.observables(means)
    return {name: np.asarray(found[name], dtype=float) for name in reported_names(scene)}


def slopes(
    scene: AbstractHomogeneous, sampler: Sampler, path: str, state: State, change: Change
) -> dict[str, np.ndarray]:
    """Derivatives of all that is reported: through the averages, and as it stands there itself."""
    size = np.sqrt(np.max(_heat(sampler, state.moments, scene.gas.dimension)))
    degrees = np.array([sampler.symmetry.degree(powers) for powers in sampler.rows])
    scale = (size**degrees).reshape(-1, *(1,) * (np.ndim(state.moments) - 1))
    number = abs(float(value_at(scene, path)))
    fastest = np.max(np.abs(change.moments[: len(sampler.basis)] / scale[: len(sampler.basis)]))
    step = STEP / max(float(fastest), 1.0 / number if number else 1.0)

    def along(by):
        there = State(
            state.moments + by * change.moments,
            state.cubed + by * change.cubed,
            state.source + by * change.source,
        )
        with np.errstate(divide="ignore", invalid="ignore"):
            return values(shifted(scene, path, by), sampler, there)

    found = slope(along, step)
    if change.pure:
        here = values(scene, sampler, state)
        found = {n: _without_rounding(x, here[n] / (number or 1.0)) for n, x in found.items()}
    return {name: np.asarray(x) for name, x in found.items()}


def _without_rounding(change, scale) -> Any:
    return np.where(np.abs(change) <= ZERO * np.maximum(np.abs(scale), 1e-3), 0.0, change)


def _heat(sampler: Sampler, moments: np.ndarray, dimension: int) -> Any:
    rows = [sampler.rows.index(powers) for powers in sampler.symmetry.squares]
    return np.sum(moments[rows], axis=0) / dimension


def state_of(generator: Generator) -> State:
    """The averages that a generator was made from; collisions undo the flow if that is used."""
    return State(generator.moments, generator.cubed, generator.balanced)
