"""The tables of table.md that belong to this paper, each as lines of Markdown."""

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import homogeneous_cooling, sonine_elastic
from jdsmc.theory.transport import first_sonine, modified_first_sonine

from ..markdown import grid
from . import coefficients, convergence, work
from .data import Measurements
from .limits import CONDUCTIVITY, FITS, MARGINAL, SONINE, Quantity, limit
from .measured import share_limit
from .systems import DEFAULT_STEP, PAPER_FIELD, STUDY_FIELD, STUDY_RESTITUTION


def percent(estimate: Estimate) -> str:
    """A fraction with its error, in percent."""
    return str(Estimate(100 * estimate.value, 100 * estimate.error)) + "%"


def steady(data: Measurements) -> list[str]:
    """κ' and b'_k at every field and their limits, with the distance of the paper's field."""
    rows = []
    for quantity in (CONDUCTIVITY, *SONINE, *MARGINAL):
        for alpha in data.restitutions:
            rows.append(_steady_row(data, quantity, alpha))
    header = ["quantity", "α", *(f"ε* = {f:g}" for f in data.fields), "ε* → 0", "χ²/ν"]
    return grid([*header, f"{PAPER_FIELD:g} off by"], rows)


def _steady_row(data: Measurements, quantity: Quantity, alpha: float) -> list[str]:
    value, error = data.against_field(quantity.name, alpha, quantity.order)
    found = limit(data, quantity, alpha)
    strongest = FITS[quantity.order].strongest
    cells = [
        str(Estimate(v, e)) if f <= strongest + 1e-12 else f"({Estimate(v, e)})"
        for f, v, e in zip(data.fields, value, error, strict=True)
    ]
    off = percent(found.excess(PAPER_FIELD))
    misfit = "" if np.isnan(found.misfit) else f"{found.misfit:.1f}"
    return [quantity.label, f"{alpha:g}", *cells, str(found.value), misfit, off]


def theory(data: Measurements) -> list[str]:
    """κ'/κ0 for ε* → 0 beside both Sonine approximations; shares of the heat flux."""
    rows = []
    for alpha in data.restitutions:
        value, error = limit(data, CONDUCTIVITY, alpha).value
        models = [float(m(alpha).modified_conductivity) for m in _MODELS]
        off = [f"{m:.4f} ({100 * (m / value - 1):+.1f}%)" for m in models]
        rows.append([f"{alpha:g}", str(Estimate(value, error)), *off])
    return grid(["α", "κ'/κ0, ε* → 0", "first Sonine (off by)", "modified (off by)"], rows)


_MODELS = (first_sonine, modified_first_sonine)


def elastic(data: Measurements) -> list[str]:
    """b'_k at α = 1 beside the converged Sonine expansion: a test of the extrapolation."""
    exact = sonine_elastic.sonine_coefficients(coefficients.ELASTIC_ORDER)
    rows = []
    for quantity in (*SONINE, *MARGINAL):
        known = float(exact[(quantity.order or 1) - 1])
        value, error = limit(data, quantity, 1.0).value
        at_field = data.steady(PAPER_FIELD).value(quantity.name, 1.0, quantity.order)
        rows.append(
            [
                quantity.label,
                f"{known:.5f}",
                str(Estimate(value, error)),
                f"{(value - known) / error:+.1f}",
                str(at_field),
                f"{(at_field.value - known) / at_field.error:+.1f}",
            ]
        )
    header = ["quantity", "exact", "ε* → 0", "off/σ", f"ε* = {PAPER_FIELD:g}", "off/σ"]
    return grid(header, rows)


def shares(data: Measurements) -> list[str]:
    """The share of c_x² <= 6 in the heat flux."""
    rows = []
    for alpha in data.restitutions:
        found = share_limit(data, alpha)
        at_field = percent(found.at(PAPER_FIELD))
        rows.append([f"{alpha:g}", at_field, percent(found.value), f"{found.misfit:.1f}"])
    return grid(["α", f"fit at ε* = {PAPER_FIELD:g}", "ε* → 0", "χ²/ν"], rows)


def cooling(data: Measurements) -> list[str]:
    """a2, a3 and ζ of the cooling state beside (2.16) and (2.14)."""
    rows = []
    for alpha in data.restitutions:
        pool = data["cooling"]
        a2, a3, pairs = (pool.value(n, alpha) for n in ("a2", "a3", "relative_speed_cubed"))
        lost = "" if alpha == 1 else str(pool.value("relative_speed_cubed_collisional", alpha))
        known = float(homogeneous_cooling.kurtosis(alpha))
        largest = max(a2.error, a3.error, pairs.error)
        rows.append(
            [
                *(f"{alpha:g}", str(a2), f"{known:.5f}", str(a3), str(pairs), lost),
                *(f"{1 + 3 / 16 * known:.5f}", f"{largest:.1g}"),
            ]
        )
    header = ["α", "a2", "(2.16)", "a3", "ζ/ζ_M from ⟨V12³⟩", "from energy lost", "(2.14)"]
    return grid([*header, "largest error"], rows)


def time_steps(data: Measurements) -> list[str]:
    """κ' against the time step in both schemes."""
    rows = []
    for name in ("exact", "paper"):
        found = convergence.scheme(data, name)
        for place, asked in enumerate(found.asked):
            value = Estimate(found.values.value[place], found.values.error[place])
            off = percent(convergence.deviation(found, asked))
            made = f"{found.made[place]:.4f}"
            rows.append([name, f"{asked:g}", made, str(value), str(found.limit.value), off])
    return grid(["scheme", "dt asked", "dt made (τ)", "κ'/κ0", "dt → 0", "off by"], rows)


def time_step_verdict(data: Measurements) -> list[str]:
    """Whether the default step is short enough, and whether both schemes have one limit."""
    exact, paper = (convergence.scheme(data, name) for name in ("exact", "paper"))
    return [
        f"α = {STUDY_RESTITUTION:g}, ε* = {STUDY_FIELD:g}. The exact flow with symmetric splitting "
        "is fitted with dt², the paper's explicit step (4.1) with dt. The step asked for is "
        "shortened where particles would be hit too often. κ' at the default step "
        f"{DEFAULT_STEP:g} within {100 * convergence.TOLERANCE:g}% of dt → 0, at two standard "
        f"errors: {convergence.verdict(exact)}. The limits of the schemes differ by "
        f"{convergence.agreement(exact, paper):.1f} errors."
    ]


def particle_numbers(data: Measurements) -> list[str]:
    """κ' with few particles."""
    usual = f"N = {data.size.gas['n_particles']}"
    rows = [
        [f"{n.n_particles}", str(n.value), percent(n.implied)] for n in convergence.numbers(data)
    ]
    return grid(["N", "κ'/κ0", f"{usual} off by, if as 1/N"], rows)


def navier_stokes(data: Measurements) -> list[str]:
    """All coefficients from kicks with their checks, beside theory."""
    strengths = coefficients.kick_strengths(data)
    rows = []
    for name, label in coefficients.NAMES.items():
        for alpha in data.restitutions:
            found = coefficients.coefficient(data, name, alpha)
            known = f"{coefficients.elastic(name):.5f}" if alpha == 1 else ""
            by_step = "" if np.isnan(found.by_step.value) else _signed(found.by_step)
            rows.append(
                [
                    *(label, f"{alpha:g}", *map(str, found.kicks), str(found.limit)),
                    *(_signed(found.excess), by_step, f"{found.tail:.4f}"),
                    *(f"{x:.4f}" for x in found.theory),
                    known,
                ]
            )
    header = ["coefficient", "α", *(f"ε = {k:g}" for k in strengths), "ε → 0"]
    header += [f"ε = {strengths[0]:g} minus limit", "dt minus dt/2", "tail in time"]
    return grid([*header, "first Sonine", "modified", "exact"], rows)


def _signed(estimate: Estimate) -> str:
    text = str(estimate)
    return text if estimate.value < 0 else f"+{text}"


def routes(data: Measurements) -> list[str]:
    """κ' by kicks and by the force."""
    rows = []
    for alpha in data.restitutions:
        impulse, force, score = coefficients.both_routes(data, alpha)
        rows.append([f"{alpha:g}", str(impulse), str(force), f"{score:+.1f}"])
    return grid(["α", "κ'/κ0 by kicks, ε → 0", "by the force, ε* → 0", "difference/σ"], rows)


def precision(data: Measurements) -> list[str]:
    """Work that each method of the picture needs, and its bias."""
    rows, effort = [], np.geomspace(1e7, 1e14, 2000)
    for method in work.methods(data):
        error = method.error(effort)
        reached = [
            f"{effort[np.argmax(error < goal)]:.1e}" if np.any(error < goal) else "never"
            for goal in (0.01, 0.005, 0.003)
        ]
        rows.append([method.label, f"{100 * method.bias:+.2f}%", f"{method.noise:.2f}", *reached])
    header = ["method", "bias of κ'", "error x √(N T/τ0)", "to 1%", "to 0.5%", "to 0.3%"]
    return grid(header, rows)


def simulations(data: Measurements) -> list[str]:
    """What was run: sizes, times, seconds, and whether equal parts scatter as their errors say."""
    rows = []
    for name, pool in data.pools.items():
        case = pool.study.case
        counts = case.options["n_particles"], case.options["n_realizations"], len(pool.results)
        duration = f"{case.options.get('duration', '')}"
        size = " x ".join(map(str, counts))
        rows.append([name, size, duration, _scatter(pool), f"{pool.seconds:.0f}"])
    header = ["simulation", "N x realizations x parts", "τ0", "χ²/ν of the parts", "s"]
    return grid(header, rows)


def _scatter(pool) -> str:
    """χ²/ν of the main observable over all restitutions."""
    names = {"kicks": "modified_conductivity", "cooling": "a2", "force": "conductivity_ratio"}
    case = pool.study.case
    if not case.steady:
        return ""
    values = [pool.misfit(names[case.scene], alpha) for alpha in case.restitution]
    return "" if np.isnan(values).any() else f"{np.mean(values):.1f}"
