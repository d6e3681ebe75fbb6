"""The figures of the paper, one function each; `draw_all` makes every PNG."""

from pathlib import Path

from ...style import save
from ..data import Measurements
from . import convergence, distributions, steady, transients

DRAW = {
    "fig05_collisions": transients.collisions,
    "fig06_collision_ratio": transients.collision_ratio,
    "fig07_transient_0.9": transients.transient_quasielastic,
    "fig08_transient_0.5": transients.transient_dissipative,
    "fig10_viscosity": transients.viscosity,
    "fig11_cumulants_0.9": transients.cumulants_quasielastic,
    "fig12_cumulants_0.5": transients.cumulants_dissipative,
    "fig13_speed_ratios": transients.speed_ratios,
    "fig14_steady_stresses": steady.stresses,
    "fig15_viscometric": steady.viscometric,
    "fig16_steady_cumulants": steady.cumulants,
    "fig17_distributions": distributions.linear,
    "fig18_distributions_log": distributions.logarithmic,
}


def draw_all(data: Measurements, study: list, folder: Path) -> list[Path]:
    """Every figure as FOLDER/<name>.png."""
    paths = [save(draw(data), folder / f"{name}.png") for name, draw in DRAW.items()]
    return [*paths, save(convergence.convergence(study), folder / "convergence.png")]
