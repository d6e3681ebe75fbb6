"""table.md: all tables with what the reader must know to read them."""

from pathlib import Path

from jdsmc.conduction import WINDOW

from .. import markdown
from ..compare import compare
from . import balance, effect, molecules, table
from .data import Measurements
from .measured import measure, theory
from .reference import MISPRINTS, NUMBERS, THEORY
from .statements import CLAIMS
from .systems import COMBINATIONS, EXAMPLE, MAXWELL_COLD


def write(data: Measurements, folder: Path) -> Path:
    """Make every comparison and write FOLDER/table.md."""
    ours, formulas = measure(data), theory()
    comparisons = [compare(quoted, ours[quoted.key]) for quoted in NUMBERS]
    checks = [compare(quoted, float(formulas[quoted.key])) for quoted in THEORY]
    findings = [(claim, claim.check(data)) for claim in CLAIMS]
    sections = {
        f"Fourier flow under gravity: paper and jdsmc ({data.size.name} run)": provenance(data),
        "Quoted numbers": [NUMBERS_NOTE, "", *markdown.numbers(comparisons)],
        "Quoted formulas (theory, not measured)": markdown.numbers(checks),
        "Statements": markdown.statements(findings),
        "Tables 2 to 5": [rows_note(data), "", *table.summary(data)],
        **{
            f"Table {k + 2}: {combination.label}": table.states(data, combination)
            for k, combination in enumerate(COMBINATIONS)
        },
        "The coefficient B": [RESPONSE_NOTE, "", *table.response(data)],
        "Balance laws": [BALANCE_NOTE, "", *table.balances(data)],
        "Error budget: the window of the slope": [
            WINDOW_NOTE,
            "",
            *table.windows(data),
            "",
            WINDOW_RESPONSE_NOTE,
            "",
            *table.responses_by_window(data),
        ],
        "Error budget: time step, layers, particles": [BUDGET_NOTE, "", *table.variants(data)],
        "Maxwell molecules and eq. (6)": [MAXWELL_NOTE, "", *table.maxwell(data)],
        "Misprints in the paper": markdown.grid(["place", "what was taken"], MISPRINTS),
        "Simulations": table.simulations(data),
    }
    path = folder / "table.md"
    path.write_text(markdown.document(sections))
    return path


NUMBERS_NOTE = (
    "Paper: the value and half a unit of its last digit, for B half the range 2 to 2.5 plus that "
    "(the paper gives no errors). Ours: one standard error in units of the last digits. Where the "
    "paper reads a number off a curve at a wall, ours is a range: from the layer at the wall to "
    "the continuation of the profile (temperature) or the mean of 0.5 λ' (density). "
    '"Agrees": within the rounding plus two standard errors.'
)

RESPONSE_NOTE = (
    "Fit of κ* = κ*(g = 0) + B ε0 g* + C g*² to all states of a sweep; errors from a jackknife of "
    "the rule for z0 and the fit together. The same fit to the paper's tables, with errors from "
    "its misfit. Boundary effects of this slab are in all of them."
)

BALANCE_NOTE = (
    "Slope: the gradient of P_zz over -g n, weighted with n; (12) says 1. Q: mean over the layers "
    "of (deviation from uniformity over its error)², of P_zz + g ∫n dz and of q_z; in brackets the "
    "probability of a Q as large in a uniform profile, from random signs of the realizations "
    "(`balance.py`). Wall fluxes: from the energy exchanged there, minus q_z of the gas, paired by "
    "realization. "
    f"Layers thicker than {balance.THIN:g} λ' (at the cold wall, where the paper's Δz = 0.1 is "
    "coarse) are left out: there the sampled fluxes miss what partners exchange across the layer, "
    "of the heat flux about (32/225π)(Δz/λ')², which is added in the other layers (`balance.png`)."
)

WINDOW_NOTE = (
    f"{EXAMPLE.label}. Width over which T^(3/2) is fitted with a straight line; {WINDOW:g} λ' "
    "everywhere else (the paper does not say how it took the slope). The same simulations, so that "
    "the errors of the changes are those of the differences."
)

WINDOW_RESPONSE_NOTE = "B in all combinations, from the same simulations:"

BUDGET_NOTE = (
    f"{EXAMPLE.label}. Independent simulations; changes from the default in percent, that of Δκ* "
    "as it is."
)

MAXWELL_NOTE = (
    f"`MaxwellMolecules` between type II walls, T_- = {MAXWELL_COLD:g}, conductivity ∝ T: κ* at "
    "the point halfway in mean free paths at g = 0, and at the points with the same ε0. In "
    "brackets the distance from eq. (6) in errors. Eq. (6) holds far from walls and to second "
    "order in g; what is left of the walls shows in κ*(g = 0), which should be 1, in the change "
    f"with L and in the window (λ'; {molecules.WINDOW:g} L in the figure)."
)


def rows_note(data: Measurements) -> str:
    """How rows of tables 2 to 5 are judged, with the sizes of the errors."""
    rough, scaled = table.paper_noise(data)
    return (
        "The paper has no error bars. Its errors are estimated from its own numbers: the scatter "
        f"of a column about a polynomial of degree {effect.DEGREE} in g (`effect.py`), {rough:.4f} "
        f"for κ* in the mean of the tables; ours, scaled to its particles and its time, gives "
        f"{scaled:.4f}. A number agrees if it is within {effect.AGREEMENT:g} combined errors: "
        "ours, this scatter, and the rounding. Rows of a table share ε0, hence part of their "
        "errors, ours and the paper's: their verdicts are not independent, and the error of the "
        "mean difference is a lower bound."
    )


def provenance(data: Measurements) -> list[str]:
    """Versions, commits and machine."""
    results = list(data.results.values())
    seconds = sum(float(result.attrs["seconds"]) for result in results)
    return [
        "Tahiri, Tij and Santos, heat conduction under gravity (2000). Made by "
        "`python -m experiments.fourier_flow_gravity`; do not edit.",
        "",
        f"{markdown.versions(results)} The simulations took {seconds / 60:.0f} minutes.",
    ]
