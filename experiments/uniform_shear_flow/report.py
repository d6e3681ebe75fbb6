"""table.md: all tables, and what stands behind every disagreement."""

import hashlib
import json
from pathlib import Path

import numpy as np

from jdsmc import Estimate

from .. import markdown
from ..compare import Comparison, compare, shown
from . import claims_distribution, claims_models, claims_steady, claims_transient, table
from . import independent as independent_program
from .convergence import all_limits
from .data import Measurements
from .evidence import (
    LAYER_PARTICLES,
    LAYERS,
    REPEATED,
    evidence,
    implied_by_shares,
    layer_temperature,
    paper_error,
    repeatable,
)
from .independent import available, steady
from .measured import SHARES, measure, theory
from .reference import NUMBERS, THEORY
from .systems import FAST, Size

CLAIMS = (
    *claims_transient.CLAIMS,
    *claims_steady.CLAIMS,
    *claims_models.CLAIMS,
    *claims_distribution.CLAIMS,
)


def write(
    data: Measurements,
    study: list,
    inhomogeneous: dict[str, list[str]],
    size: Size,
    folder: Path,
    fresh: bool,
) -> Path:
    """Make every comparison, run the evidence, and write FOLDER/table.md.

    `inhomogeneous`: the sections of `report_slab`.
    """
    ours = measure(data)
    comparisons = [compare(quoted, ours[quoted.key]) for quoted in NUMBERS]
    formulas = theory()
    checks = [compare(quoted, float(formulas[quoted.key])) for quoted in THEORY]
    findings = [(claim, claim.check(data)) for claim in CLAIMS]
    sections = {
        f"Uniform shear flow: paper and jdsmc ({size.name} run)": provenance(data),
        "Quoted numbers": [NUMBERS_NOTE, "", *markdown.numbers(comparisons)],
        "Quoted formulas (theory, not measured)": markdown.numbers(checks),
        "Statements": markdown.statements(findings),
        **inhomogeneous,
        "Disagreements": disagreements(data, comparisons, findings, folder, fresh),
        "Independent check": independent(data, size, folder, fresh),
        "Convergence": [CONVERGENCE_NOTE, "", *table.limits(all_limits(study))],
        "Runs of the convergence study": table.study_values(study),
        "Steady states": table.steady_states(data),
        "Viscometric functions": table.viscometric(data),
        "Simulations": table.simulations(data),
    }
    path = folder / "table.md"
    path.write_text(markdown.document(sections))
    return path


NUMBERS_NOTE = (
    "Paper: the value and half a unit of its last digit (the paper gives no errors). Ours: one "
    "standard error in units of the last digits; for a time, where the paper states no criterion, "
    'the value at 2% from the steady state and the range from 5% to 1%. "Agrees": within the '
    "rounding plus two standard errors. P_xy and the like without a gas are of IHS."
)

CONVERGENCE_NOTE = (
    "Weighted fit of v + c dt² + b/N to all runs below; dt is the step really made, as `run` "
    'shortens the step asked for (0.2 and 0.4 then give the same step as 0.1). "yes" and "no" '
    "hold at two standard errors."
)


def provenance(data: Measurements) -> list[str]:
    """Versions, commits and machine."""
    return [
        "Astillero and Santos (2005). Made by "
        "`python -m experiments.uniform_shear_flow`; do not edit.",
        "",
        markdown.versions(list(data.results.values())),
    ]


def disagreements(
    data: Measurements, comparisons: list[Comparison], findings: list, folder: Path, fresh: bool
) -> list[str]:
    """Every disagreement with what the same point gives with other numerical choices."""
    apart = [c for c in comparisons if not c.agrees]
    lines = [
        f"{len(apart)} of {len(comparisons)} quoted numbers differ, and "
        f"{sum(not f.holds for _, f in findings if f.holds is not None)} of {len(findings)} "
        "statements do not hold. Repeated with another seed, with 4 N, and with half the time step "
        '(errors: one standard error); "paper\'s error" is what one run of 1e4 particles averaged '
        "over 50 collisions per particle would have, scaled from ours.",
        "",
    ]
    keys = repeatable(c.quoted.key for c in apart)
    rows = []
    for comparison in apart:
        key = comparison.quoted.key
        if key not in keys:
            continue
        found = evidence(data, REPEATED[key], folder, fresh)
        what = comparison.quoted.what
        if key.startswith("crossing"):
            what = f"EHS minus IHS at α = 0.7 for: {what}"
        rows.append(
            [
                what,
                f"{comparison.quoted.value:g}",
                *(str(value) for value in found.values()),
                f"{paper_error(data, REPEATED[key]):.2g}",
            ]
        )
    if rows:
        header = ["quantity", "paper", "as above", "another seed", "4 N", "dt/2", "paper's error"]
        lines += [*markdown.grid(header, rows), ""]
    return lines + remarks(data, apart)


def remarks(data: Measurements, apart: list[Comparison]) -> list[str]:
    """Possible causes that can be computed."""
    keys = {c.quoted.key: c for c in apart}
    lines = []
    if "temperature" in keys:
        expected = layer_temperature(REPEATED["temperature"].of(data.lookup))
        lines.append(
            f"- T_s/T0 = {keys['temperature'].quoted.value:g} comes from the paper's run in "
            f"{LAYERS} layers of {LAYER_PARTICLES} particles, whose eq. (4.13a) draws N_I² "
            "candidates instead of N_I(N_I - 1): the collision rate is then too high by "
            f"1/{LAYER_PARTICLES}, and our value becomes {expected}."
        )
    if "ratio_0" in keys or "ratio_1" in keys:
        quoted = {q.key: q.value for q in NUMBERS}
        shares = (quoted["slow_share"], quoted["middle_share"])
        text = " and ".join(
            f"{e.value:.3f} ± {e.error:.3f}" for e in implied_by_shares(shares, SHARES)
        )
        lines.append(
            f"- The shares of {shares[0]} and {shares[1]} that the paper quotes for the same state "
            f"imply R_0 and R_1 of {text}, not {quoted['ratio_0']} and {quoted['ratio_1']}."
        )
    for comparison in apart:
        if comparison.quoted.key not in REPEATED:
            lines.append(
                f"- {comparison.quoted.what}: {shown(comparison.ours)} against "
                f"{comparison.quoted.value:g}; from a whole time series or sweep, not repeated."
            )
    return lines


CHECKED = ("temperature", "shear_stress", "normal_stress_xy", "normal_stress_zy", "a2", "a3")


INDEPENDENT = (("ihs", 0.5), ("ehs", 0.5), ("ihs", 0.9))
"""Systems of the independent check."""


def independent(data: Measurements, size: Size, folder: Path, fresh: bool) -> list[str]:
    """Our steady values at a τ0 = 4 beside those of a plain sequential loop."""
    if not available():
        return ["Left out: numba is not installed."]
    found = independent_values(data, size, folder, fresh)
    rows = []
    for gas, alpha in INDEPENDENT:
        values = data.steady(gas, alpha, FAST)
        ratios = values["speed_ratio"].values, values["speed_ratio_error"].values
        mine = {n: Estimate(values[n].item(), values[f"{n}_error"].item()) for n in CHECKED}
        mine["below_1"] = Estimate(*(float(part[0] * SHARES[0]) for part in ratios))
        for name, value in mine.items():
            other = Estimate(*found[f"{gas} {alpha}"][name])
            score = (value.value - other.value) / np.hypot(value.error, other.error)
            apart = f"**{score:.1f}**" if abs(score) > 3.0 else f"{score:.1f}"
            rows.append([f"{gas.upper()} {alpha}", name, str(value), str(other), apart])
    header = ["system", "observable", "jdsmc", "sequential loop", "difference/σ"]
    return [
        "Steady states at a τ0 = 4 by a separate sequential program (`independent.py`). It sees "
        "errors of the pair selection, which the extrapolation to dt → 0 below cannot see if they "
        "do not vanish with dt. `below_1` is the share with V < v0.",
        "",
        *markdown.grid(header, rows),
    ]


def independent_values(data: Measurements, size: Size, folder: Path, fresh: bool) -> dict:
    """The sequential program's values, kept in FOLDER/independent.json."""
    path = folder / "independent.json"
    options = size.independent
    fingerprint = hashlib.sha256(Path(independent_program.__file__).read_bytes()).hexdigest()[:16]
    if path.exists() and not fresh:
        kept = json.loads(path.read_text())
        if (kept["options"], kept["program"]) == (options, fingerprint):
            return kept["values"]
    print("independent check: running", flush=True)
    values = {}
    for gas, alpha in INDEPENDENT:
        start = data.steady(gas, alpha, FAST)["temperature"].item()
        values[f"{gas} {alpha}"] = steady(gas, alpha, FAST, start, **options)
    kept = {"options": options, "program": fingerprint, "values": values}
    path.write_text(json.dumps(kept, indent=1))
    return values
