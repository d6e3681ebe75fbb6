"""The call that gives derivatives of any scene."""

from ..results.sensitivity import Sensitivity
from ..running.run import run
from ..scenarios.base import AbstractScene


def sensitivity(
    scene: AbstractScene, wrt: bool | str | tuple[str, ...] = True, **options
) -> Sensitivity:
    """Derivatives of everything a scene reports with respect to numbers of its gas or itself.

    Arguments:
        scene: a homogeneous scene (in space: not yet); its swept points each get their own.
        wrt: names of physical numbers ("restitution", "shear_rate", ...), as in a sweep; True for
            all of them.
        options: as of `jdsmc.run`.
    Returns: `s["shear_stress"]["restitution"]` with `.value`, `.error` (one standard error),
    `.truncation` (change from trial functions of degree 4 to those of degree 6) and `.uncertainty`,
    both together; `s.result` is the run. Formulas: docs/sensitivities.md.
    Raises ValueError for what is no number or cannot be had, and what `jdsmc.run` raises.
    """
    if isinstance(scene, AbstractScene) and scene.in_space:
        raise ValueError(
            f"{type(scene).__name__} is a gas in space, of which derivatives are not known yet."
        )
    return run(scene, sensitivity=wrt, **options).sensitivity
