"""The figures of the paper and of our checks, one function each; `draw_all` makes every PNG."""

from pathlib import Path

from ...style import save
from ..data import Measurements
from . import checks, effect, profiles

DRAW = {
    "fig2_temperature": profiles.temperature,
    "fig3_heat_flux": profiles.heat_flux,
    "fig4_pressures": profiles.pressures,
    "fig5_density": profiles.density,
    "fig6_kinds_of_wall": profiles.kinds_of_wall,
    "fig7_gravity_effect": effect.gravity_effect,
    "rows": effect.rows,
    "balance": checks.balance,
    "budget": checks.budget,
    "maxwell_molecules": checks.maxwell_molecules,
}


def draw_all(data: Measurements, folder: Path) -> list[Path]:
    """Every figure as FOLDER/<name>.png."""
    return [save(draw(data), folder / f"{name}.png") for name, draw in DRAW.items()]
