"""Simulations that must end with steady values."""

from dataclasses import replace
from pathlib import Path

from jdsmc import Result

from ..store import obtain
from .systems import Case


def obtain_steady(case: Case, folder: Path, fresh: bool = False) -> tuple[Case, Result]:
    """A case of given length that ends with steady values, made longer until there are some."""
    result = obtain(case, folder, fresh)
    while not result.is_steady:
        options = {**case.options, "collisions": 1.5 * case.options["collisions"]}
        case = replace(case, name=f"{case.name}_longer", options=options)
        result = obtain(case, folder, fresh)
    return case, result
