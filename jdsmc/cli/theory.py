"""`jdsmc theory`: the Boltzmann equation solved without simulation, as a table."""

import csv

import numpy as np

from ..files.writable import check_writable
from ..theory import boltzmann
from ..views.page import Block, Page, as_text
from .arguments import Parser
from .numbers import numbers

COLUMNS = {
    "cooling_rate": "ζτ",
    "a2": "a2",
    "a3": "a3",
    "modified_conductivity": "κ'/κ0",
    "conductivity": "κ/κ0",
    "density_coefficient": "nμ/(Tκ0)",
    "viscosity": "η/η0",
    "sonine_1": "b'_1",
    "sonine_2": "b'_2",
    "sonine_3": "b'_3",
}
LEAST_SHOWN = 1e-8
"""Digits beyond this are not shown, however well they are known."""
DEFAULT = "0.3:1:0.1"


def parser() -> Parser:
    """The options of the command."""
    made = Parser(
        prog="jdsmc theory",
        description=(
            "Cooling state and Navier-Stokes coefficients of inelastic hard spheres from the "
            "Boltzmann equation, without simulation. Figures in parentheses: the truncation error, "
            "in units of the last digits."
        ),
    )
    text = f"coefficients of normal restitution in [0.3, 1], number, range or list ({DEFAULT})"
    made.add_argument("--restitution", default=DEFAULT, help=text)
    made.add_argument("--order", type=int, default=boltzmann.ORDER, help="of the expansion, 12-48")
    made.add_argument("--out", metavar="FILE", help="write a CSV file, truncation errors included")
    return made


def values_of(alpha: float, order: int) -> dict[str, tuple[float, float]]:
    """Value and truncation error by the names of `COLUMNS`."""
    found = boltzmann.navier_stokes(alpha, order=order)
    values = {n: getattr(found, n) for n in COLUMNS if not n.startswith("sonine")}
    errors = dict(found.truncation)
    sonine = np.atleast_1d(np.asarray(errors.pop("sonine"), dtype=float))
    for k, (value, error) in enumerate(zip(found.sonine, sonine, strict=True), start=1):
        values[f"sonine_{k}"], errors[f"sonine_{k}"] = value, float(error)
    return {name: (float(values[name]), float(np.asarray(errors[name]))) for name in COLUMNS}


def shown(value: float, truncation: float) -> str:
    """The value with the digits that are known."""
    error = max(truncation, LEAST_SHOWN)
    digits = max(0, int(np.ceil(-np.log10(error))))
    return f"{round(value, digits) + 0.0:.{digits}f}({int(np.ceil(error * 10**digits))})"


def theory(words: list[str]) -> int:
    """Print the table, and write the file that was asked for."""
    asked = parser().parse_args(words)
    alphas = np.atleast_1d(np.asarray(numbers("restitution", asked.restitution), dtype=float))
    path = None if asked.out is None else check_writable(asked.out)
    rows = [values_of(float(alpha), asked.order) for alpha in alphas]
    if path is not None:
        head = ["restitution", *(f"{n}{end}" for n in COLUMNS for end in ("", "_truncation"))]
        with path.open("w", newline="") as file:
            table = [
                [alpha, *np.ravel([*row.values()])] for alpha, row in zip(alphas, rows, strict=True)
            ]
            csv.writer(file).writerows([head, *table])
    cells = [
        [f"{a:g}", *(shown(*one) for one in row.values())]
        for a, row in zip(alphas, rows, strict=True)
    ]
    notes = [] if path is None else [f"Table: {path}"]
    print(as_text(Page([Block(["α", *COLUMNS.values()], cells)], notes)))
    return 0
