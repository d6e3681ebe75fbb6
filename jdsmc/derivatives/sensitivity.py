"""The call that gives derivatives of any scene."""

from ..results.sensitivity import Sensitivity
from ..running.run import run
from ..scenarios.base import AbstractScene
from .by_sweep import sensitivity_by_sweep


def sensitivity(
    scene: AbstractScene, wrt: bool | str | tuple[str, ...] = True, **options
) -> Sensitivity:
    """Derivatives of everything a scene reports with respect to numbers of its gas or itself.

    Arguments:
        scene: a homogeneous scene, whose swept points each get their own, or one point of a scene
            in space, which is fitted: `derivatives.by_sweep`.
        wrt: names of physical numbers ("restitution", "shear_rate", ...), as in a sweep; True for
            all of them.
        options: as of `jdsmc.run`.
    Returns: `s["shear_stress"]["restitution"]` with `.value`, `.error` (one standard error),
    `.truncation` (what trial functions of degrees above 6 are taken to add; in space the change
    from a fit of degree 2 to one of degree 4) and `.uncertainty`, both together; `s.result` is the
    run. Formulas: docs/sensitivities.md.
    Raises ValueError for what is no number or cannot be had, and what `jdsmc.run` raises.
    """
    if wrt is False:
        raise ValueError("wrt = False asks for no derivatives; give names, or True for all.")
    if isinstance(scene, AbstractScene) and scene.in_space:
        return sensitivity_by_sweep(scene, wrt, **options)
    return run(scene, sensitivity=wrt, **options).sensitivity
