"""The tables of table.md, each as lines of Markdown."""

import numpy as np

from jdsmc.theory import bgk_shear_flow

from ..claims import shown
from ..markdown import grid, score
from ..numbers import each
from . import independent
from .cases import BOTH, FAST, LABELS, POINTS, STARTS
from .checks import (
    AGAIN,
    LAYER_PARTICLES,
    OBSERVABLES,
    PAPER_LAYERS,
    REPEATED,
    Runs,
    evidence,
    paper_error,
    sequential,
)
from .data import PAPER, Shear
from .measured import SHARES
from .slab import TIMES

PAPER_RECORD = 0.16
"""The paper records every 160 steps of 0.001 τ(T̄): section IV A."""


def paper_records(data: Shear) -> list[str]:
    """When the paper can have measured in the slab, and what s was then."""
    rows = []
    for start, equation in STARTS.items():
        series = data.slab("early", "ihs", start)
        time, s = series["time"].values, series["collisions"].values
        speed = np.sqrt(series["mean_temperature"].values)
        records = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))])
        for nominal in TIMES:
            first = max(1, int(np.interp(nominal, time, records) / PAPER_RECORD))
            cells = []
            for number in (first, first + 1):
                when = float(np.interp(number * PAPER_RECORD, records, time))
                found = float(np.interp(when, time, s))
                high = found * (1.0 + 1.0 / LAYER_PARTICLES)
                cells += [number, f"{when:.3f}", f"{found:.3f}", f"{high:.3f}"]
            rows.append([equation, f"{nominal:g}", *cells])
    return grid(["from", "t quoted", *(2 * ["record", "t", "s", "s with N_I²"])], rows)


def slab_steady_states(data: Shear) -> list[str]:
    """Slab and homogeneous gas side by side."""
    same = ("shear_stress", "normal_stress_xy", "normal_stress_zy", "reduced_shear_rate")
    pairs = {"mean_temperature": "temperature", **{name: name for name in same}}
    cases = [(gas, f"slab_late_{gas}_equilibrium", gas.upper()) for gas in BOTH]
    cases += [("ihs", "slab_half_step_ihs_equilibrium", "IHS, half the time step")]
    rows = []
    for gas, case, label in cases:
        if case in data.results:
            for mine, name in pairs.items():
                slab, flat = data.results[case][mine], data.steady(gas, 0.9, FAST, name)
                rows.append([label, mine, slab, flat, score(float(slab.distance(flat)))])
    return grid(["gas", "observable", "slab", "homogeneous", "difference/σ"], rows)


def disagreements(data: Shear) -> list[str]:
    """Every disagreement with what the same point gives with other numerical choices."""
    numbers, sentences = (PAPER.verdicts(data, h) for h in ("Quoted numbers", "Statements"))
    apart = [verdict for verdict in numbers if not verdict.holds]
    lines = [
        f"{len(apart)} of {len(numbers)} quoted numbers differ, and "
        f"{sum(v.holds is False for v in sentences)} of {len(sentences)} statements do not hold.",
        "",
    ]
    rows = []
    for key, text, _, expected, _ in (v.claim for v in apart if v.claim.key in REPEATED):
        what = f"EHS minus IHS at α = 0.7 for: {text}" if key.startswith("crossing") else text
        rows.append([what, f"{expected:g}", *evidence(data, key), f"{paper_error(data, key):.2g}"])
    if rows:
        header = ["quantity", "paper", "as above", *AGAIN, "paper's error"]
        lines += [*grid(header, rows), ""]
    return lines + [
        f"- {v.claim.text}: {shown(v.measured)} against {v.claim.expected:g}; from a whole time "
        "series or sweep, not repeated."
        for v in apart
        if v.claim.key not in REPEATED
    ]


def layer_temperature(data: Shear) -> str:
    """T_s expected from the candidates of eq. (4.13a), N_I² instead of N_I(N_I - 1) a layer.

    With a fluctuating N_I (binomial, mean n) the collision rate is too high by 1 + (1 - 1/M)/n,
    and T_s ∝ (a τ0)² falls with its square.
    """
    excess = 1.0 + (1.0 - 1.0 / PAPER_LAYERS) / LAYER_PARTICLES
    return str(REPEATED["temperature"](data) / excess**2)


def implied_ratios(_: Shear) -> str:
    """R_0 and R_1 that the paper's own shares of 51% and 42% imply, with their rounding."""
    return " and ".join(
        f"{s / e:.3f} ± {0.005 / e:.3f}" for s, e in zip((0.51, 0.42), SHARES, strict=False)
    )


CHECKED = ("temperature", "shear_stress", "normal_stress_xy", "normal_stress_zy", "a2", "a3")


def independent_check(data: Shear) -> list[str]:
    """Our steady values at a τ0 = 4 beside those of a plain sequential loop."""
    if not independent.available():
        return ["Left out: numba is not installed."]
    found, rows = sequential(data), []
    for gas, alpha in POINTS:
        mine = {name: data.steady(gas, alpha, FAST, name) for name in CHECKED}
        mine["below_1"] = data.steady(gas, alpha, FAST, "speed_ratio")[0] * SHARES[0]
        for name, value in mine.items():
            other = found[f"{gas} {alpha}"][name]
            apart = score(float(value.distance(other)))
            rows.append([f"{gas.upper()} {alpha}", name, value, other, apart])
    return grid(["system", "observable", "jdsmc", "sequential loop", "difference/σ"], rows)


def limits(data: Shear) -> list[str]:
    """The convergence study: limits and how far the defaults are from them."""
    rows = []
    for gas, alpha in POINTS:
        runs = Runs(data, gas, alpha)
        for name in OBSERVABLES:
            found = runs.limit(name)
            parts = found.by_step, found.by_number, found.by_step + found.by_number
            texts = [f"{100 * float(x):.2f} ± {100 * x.error:.2f}" for x in parts]
            cells = [found.terms[0], *texts, f"{found.misfit:.1f}", found.verdict()]
            rows.append([f"{LABELS[gas]} {alpha}", name, *cells])
    header = ["system", "observable", "limit dt → 0, N → ∞", "default dt: %", "default N: %"]
    return grid([*header, "both: %", "χ²/ν", "default within 0.3%?"], rows)


def study_values(data: Shear) -> list[str]:
    """What the convergence study measured, run by run."""
    rows = []
    for gas, alpha in POINTS:
        runs = Runs(data, gas, alpha)
        columns = zip(*(runs.values(name) for name in OBSERVABLES), strict=True)
        for number, asked, step, values in zip(
            runs.number, runs.asked, runs.step, columns, strict=True
        ):
            setting = number, f"{asked:g}", f"{step:.4f}"
            rows.append([f"{LABELS[gas]} {alpha}", *setting, *values])
    return grid(["system", "N", "dt asked", "dt made (τ)", *OBSERVABLES], rows)


STEADY_COLUMNS = {
    "reduced_shear_rate": "a*",
    "shear_stress": "-P_xy/nT",
    "normal_stress_xy": "(P_xx-P_yy)/nT",
    "normal_stress_zy": "(P_zz-P_yy)/nT",
    "relative_speed_cubed": "⟨V12³⟩/⟨V12³⟩0",
    "a2": "a2",
    "a3": "-a3",
}


def steady_states(data: Shear) -> list[str]:
    """All steady values: the data of Figs. 14 and 16, with T_s/T0."""
    rows, names = [], ("temperature", *STEADY_COLUMNS)
    for gas, label in LABELS.items():
        for alpha in data.restitutions(gas):
            for rate in data.rates(gas):
                found = {name: data.steady(gas, alpha, rate, name) for name in names}
                found["a3"] = -found["a3"]
                rows.append([label, f"{alpha:g}", f"{rate:g}", *found.values()])
    for alpha in data.restitutions():
        model = bgk_shear_flow.steady_state(float(alpha), FAST)
        found = {name: float(getattr(model, name, np.nan)) for name in names}
        found["a3"] = -found["a3"]
        cells = ["" if np.isnan(x) else f"{x:.4f}" for x in found.values()]
        rows.append(["BGK", f"{alpha:g}", f"{FAST:g}", *cells])
    return grid(["gas", "α", "a τ0", "T_s/T0", *STEADY_COLUMNS.values()], rows)


def viscometric(data: Shear) -> list[str]:
    """The data of Fig. 15, averaged over both shear rates."""
    names = ("reduced_shear_rate", "reduced_viscosity", "first_viscometric", "second_viscometric")
    rows = []
    for gas in ("ihs", "ehs", "ehs_measured"):
        columns = [data.restitutions(gas), *(each(data.against(gas, name)) for name in names)]
        rows += [[LABELS[gas], *row] for row in zip(*columns, strict=True)]
    return grid(["gas", "α", "a*_s", "η*_s", "-Ψ1", "Ψ2"], rows)
