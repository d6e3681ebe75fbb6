"""The tables of table.md, each as lines of Markdown."""

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import bgk_shear_flow

from ..markdown import grid
from .convergence import OBSERVABLES, POINTS, Limit, runs
from .correlation import mean_over_rates
from .data import Measurements, Term, actual_steps, measured_collisions
from .systems import FAST, LABELS, SLOW

STEADY_COLUMNS = {
    "reduced_shear_rate": "a*",
    "shear_stress": "-P_xy/nT",
    "normal_stress_xy": "(P_xx-P_yy)/nT",
    "normal_stress_zy": "(P_zz-P_yy)/nT",
    "relative_speed_cubed": "⟨V12³⟩/⟨V12³⟩0",
    "a2": "a2",
    "a3": "-a3",
}


def steady_states(data: Measurements) -> list[str]:
    """All steady values: the data of Figs. 14 and 16, with T_s/T0."""
    rows = []
    for gas in ("ihs", "ehs", "ehs_measured", "ehs_viscosity"):
        for alpha in data.restitutions(gas):
            for rate in data.steady_case(gas).shear_rate:
                rows.append(_steady_row(data, gas, alpha, rate))
    for alpha in data.restitutions():
        model = bgk_shear_flow.steady_state(alpha)
        cells = [
            f"{-model.a3:.4f}"
            if name == "a3"
            else f"{getattr(model, name):.4f}"
            if hasattr(model, name)
            else ""
            for name in STEADY_COLUMNS
        ]
        temperature = bgk_shear_flow.steady_state(alpha, FAST).temperature
        rows.append(["BGK", f"{alpha:g}", f"{FAST:g}", f"{temperature:.2f}", *cells])
    return grid(["gas", "α", "a τ0", "T_s/T0", *STEADY_COLUMNS.values()], rows)


def _steady_row(data: Measurements, gas: str, alpha: float, rate: float) -> list[str]:
    cells = []
    for name in ("temperature", *STEADY_COLUMNS):
        value, error = data.lookup(Term(gas, alpha, rate, name))
        cells.append(str(Estimate(-value if name == "a3" else value, error)))
    return [LABELS[gas], f"{alpha:g}", f"{rate:g}", *cells]


def viscometric(data: Measurements) -> list[str]:
    """The data of Fig. 15, averaged over both shear rates."""
    names = ("reduced_shear_rate", "reduced_viscosity", "first_viscometric", "second_viscometric")
    rows = []
    for gas in ("ihs", "ehs", "ehs_measured"):
        columns = [mean_over_rates(data, gas, name) for name in names]
        for place, alpha in enumerate(data.restitutions(gas)):
            cells = [str(Estimate(c.value[place], c.error[place])) for c in columns]
            rows.append([LABELS[gas], f"{alpha:g}", *cells])
    return grid(["gas", "α", "a*_s", "η*_s", "-Ψ1", "Ψ2"], rows)


def limits(found: dict[tuple[str, float, str], Limit]) -> list[str]:
    """The convergence study: limits and how far the defaults are from them."""
    rows = []
    for (gas, alpha, name), limit in found.items():
        rows.append(
            [
                f"{LABELS[gas]} {alpha:g}",
                name,
                str(limit.limit),
                *(
                    f"{100 * part.value:.2f} ± {100 * part.error:.2f}"
                    for part in (limit.by_step, limit.by_number, limit.deviation)
                ),
                f"{limit.misfit:.1f}",
                limit.verdict(),
            ]
        )
    return grid(
        [
            *("system", "observable", "limit dt → 0, N → ∞", "default dt: %", "default N: %"),
            *("both: %", "χ²/ν", "default within 0.3%?"),
        ],
        rows,
    )


def study_values(study) -> list[str]:
    """What the convergence study measured, run by run."""
    rows = []
    for gas, alpha in POINTS:
        columns = [runs(study, gas, alpha, name) for name in OBSERVABLES]
        for parts in zip(*columns, strict=True):
            first = parts[0]
            settings = [f"{first.number}", f"{first.asked:g}", f"{first.step:.4f}"]
            rows.append([f"{LABELS[gas]} {alpha:g}", *settings, *(str(p.estimate) for p in parts)])
    return grid(["system", "N", "dt asked", "dt made (τ)", *OBSERVABLES], rows)


def simulations(data: Measurements) -> list[str]:
    """What was run: sizes, collisions measured, time steps, seconds."""
    rows = []
    for name, result in data.results.items():
        options, attrs = data.cases[name].options, result.attrs
        steady = result.is_steady and "rtol" in options
        collisions, steps = (
            (measured_collisions(result), actual_steps(result)) if steady else (np.array([]),) * 2
        )
        rows.append(
            [
                name,
                f"{options['n_particles']} x {options['n_realizations']}",
                f"{collisions.min():.0f} to {collisions.max():.0f}" if steady else "",
                f"{steps.min():.3f} to {steps.max():.3f}" if steady else "",
                f"{attrs['seconds']:.0f}",
                str(attrs["stopped"]),
            ]
        )
    header = ["simulation", "N x realizations", "collisions averaged", "dt made (τ)", "s", "ended"]
    return grid(header, rows)


def both_rates() -> str:
    """The two shear rates, as text."""
    return f"a τ0 = {FAST:g} and {SLOW:g}"
