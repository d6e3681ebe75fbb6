"""The figures of the paper and of our checks, one function each; `draw_all` makes every PNG."""

from pathlib import Path

from ...style import save
from ..data import Measurements
from . import checks, coefficients, distributions, transients, work

DRAW = {
    "fig1_transient_conductivity": transients.conductivity,
    "fig2_transient_sonine": transients.sonine,
    "fig3_conductivity": coefficients.conductivity,
    "fig4_sonine": coefficients.sonine,
    "fig5_distribution_weak": distributions.weak,
    "fig6_distribution_strong": distributions.strong,
    "fig7_share": distributions.shares,
    "linearity": checks.linearity,
    "time_step": checks.time_step,
    "cooling_state": checks.cooling,
    "navier_stokes": coefficients.navier_stokes,
    "work_precision": work.work_precision,
}


def draw_all(data: Measurements, folder: Path) -> list[Path]:
    """Every figure as FOLDER/<name>.png."""
    return [save(draw(data), folder / f"{name}.png") for name, draw in DRAW.items()]
