"""table.md: all tables with what the reader must know to read them."""

from pathlib import Path

from .. import markdown
from ..compare import compare
from . import table
from .data import Measurements
from .measured import SHARE_FIELD, measure, theory
from .reference import MISPRINTS, NUMBERS, THEORY
from .statements import CLAIMS


def write(data: Measurements, folder: Path) -> Path:
    """Make every comparison and write FOLDER/table.md."""
    ours, formulas = measure(data), theory()
    comparisons = [compare(quoted, ours[quoted.key]) for quoted in NUMBERS]
    checks = [compare(quoted, float(formulas[quoted.key])) for quoted in THEORY]
    findings = [(claim, claim.check(data)) for claim in CLAIMS]
    sections = {
        f"Heat-flux force: paper and jdsmc ({data.size.name} run)": provenance(data),
        "Quoted numbers": [NUMBERS_NOTE, "", *markdown.numbers(comparisons)],
        "Quoted formulas (theory, not measured)": markdown.numbers(checks),
        "Statements": markdown.statements(findings),
        "Steady values against the field": [STEADY_NOTE, "", *table.steady(data)],
        "Elastic limit": [ELASTIC_NOTE, "", *table.elastic(data)],
        "κ' and the Sonine approximations": table.theory(data),
        "Share of c_x² <= 6 in the heat flux": [SHARE_NOTE, "", *table.shares(data)],
        "Navier-Stokes coefficients": [KICK_NOTE, "", *table.navier_stokes(data)],
        "Two routes to κ'": table.routes(data),
        "Cooling state": [COOLING_NOTE, "", *table.cooling(data)],
        "Time step": [*table.time_step_verdict(data), "", *table.time_steps(data)],
        "Particle number": [NUMBER_NOTE, "", *table.particle_numbers(data)],
        "Work and precision": [WORK_NOTE, "", *table.precision(data)],
        "Misprints in the paper": markdown.grid(["place", "what was taken"], MISPRINTS),
        "Simulations": [SIMULATIONS_NOTE, "", *table.simulations(data)],
    }
    path = folder / "table.md"
    path.write_text(markdown.document(sections))
    return path


NUMBERS_NOTE = (
    "Paper: the value and half a unit of its last digit (the paper gives no errors). Ours: limits "
    "of weak fields with one standard error in units of the last digits; for a time, where the "
    "paper states no criterion, the value at 2% from the steady state and the range from 5% to 1%. "
    '"Agrees": within the rounding plus two standard errors.'
)

STEADY_NOTE = (
    "Odd averages over ε* are even in ε*: fitted with 1, ε*² and ε*⁴; values in brackets are not "
    "used (high moments feel the algebraic tail that the force feeds). The last column is how far "
    "the fit at the paper's field is from its limit, relative to the limit."
)

ELASTIC_NOTE = (
    "At α = 1 all b'_k are known from the Sonine expansion (`jdsmc.theory.sonine_elastic`, order "
    "10). The limits of weak fields must agree with it; what is measured at the paper's field need "
    "not."
)

SHARE_NOTE = f"From β1, eq. (4.6); fields up to {SHARE_FIELD:g} fitted with 1 and ε*²."

KICK_NOTE = (
    "By impulse response (`jdsmc.transport.navier_stokes`, docs/impulse_response.md), units of the "
    "elastic first Sonine values. Kicks are extrapolated with ε². Tail: the part of the value that "
    "is extrapolated in time, at the smallest kick."
)

COOLING_NOTE = (
    "`HomogeneousCooling`. ζ over ζ_M, that of a Maxwellian at the same temperature, from random "
    "pairs and from the energy lost; (2.14) is 1 + 3 a2/16 with a2 of (2.16)."
)

NUMBER_NOTE = (
    "The same gas with fewer particles in more realizations, against the run at the default step "
    "above, and what it implies for the number of particles of all other runs."
)

WORK_NOTE = (
    "κ' at α = 0.5 (`work.py`). Bias of the field and of the time step, from the fits above; "
    "particle-steps, the approach to the steady state included, until bias and statistical error, "
    "in quadrature, are below 1%, 0.5%, 0.3%."
)

SIMULATIONS_NOTE = (
    "Parts are equal simulations with different seeds. χ²/ν, the scatter of the parts over their "
    "own error bars, is 1 on average if these are honest (main observable, mean over α)."
)


def provenance(data: Measurements) -> list[str]:
    """Versions, commits and machine."""
    results = [result for pool in data.pools.values() for result in pool.results]
    seconds = sum(pool.seconds for pool in data.pools.values())
    return [
        "Montanero, Santos and Garzó, Physica A 376, 75 (2007). Made by "
        "`python -m experiments.heat_flux_force`; do not edit.",
        "",
        f"{markdown.versions(results)} The simulations took {seconds / 60:.0f} minutes.",
    ]
