"""What derivatives are asked for, checked before a run."""

from typing import NamedTuple

from ..scenarios.base import AbstractScene
from ..scenarios.homogeneous import AbstractHomogeneous
from .numbers import chosen_paths
from .response import Facts
from .sampling import Sampler

DEGREE = 6
"""Of the trial functions. Degree 8 is too ill-conditioned for sampled sums."""


class Request(NamedTuple):
    """Numbers by their short names, what is sampled for them, the exact facts that are used."""

    paths: dict[str, str]
    sampler: Sampler
    facts: Facts = Facts()


def requested(
    scene: AbstractScene,
    scenes: list[AbstractScene],
    wrt: bool | str | tuple[str, ...],
    facts: Facts = Facts(),  # noqa: B008 (immutable)
    along: bool = False,
) -> Request:
    """The request for a scene as the user made it, and at every point of its sweep.

    `along`: derivatives along the time series too.

    Raises ValueError for a scene whose linearised generator is not known, and for numbers that are
    none.
    """
    name = type(scene).__name__
    if scene.in_space:
        raise ValueError(
            f"{name} is a gas in space, of which a single run gives no derivatives: ask "
            "jdsmc.sensitivity(scene, wrt), which fits a sweep."
        )
    if not isinstance(scene, AbstractHomogeneous) or scene.symmetry is None:
        raise ValueError(
            f"{name} has no sensitivity: it states no `symmetry` of its distribution and no "
            "`moment_drift` (docs/own_scene.md)."
        )
    paths = chosen_paths(scene, wrt)
    own = [path.removeprefix("gas.") for path in paths.values() if path.startswith("gas.")]
    held = all(isinstance(s, AbstractHomogeneous) and s.holds_temperature() for s in scenes)
    sampler = Sampler(scene.symmetry, DEGREE, tuple(own), held, each=along and not held)
    return Request(paths, sampler, facts)
