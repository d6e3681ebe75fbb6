"""The tables of table.md that belong to this paper, each as lines of Markdown."""

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import homogeneous_cooling, sonine_elastic
from jdsmc.theory.transport import first_sonine, modified_first_sonine
from jdsmc.units import CONVERGED_ORDER

from ..markdown import grid
from ..numbers import within
from . import coefficients, numerics
from .cases import DEFAULT_STEP, PAPER_FIELD
from .data import Heat, Pool
from .distribution import share_limit
from .limits import CONDUCTIVITY, MARGINAL, SONINE, at_field, limit, used


def percent(estimate: Estimate) -> str:
    """A fraction with its error, in percent."""
    return f"{100 * estimate}%"


def steady(data: Heat) -> list[str]:
    """κ' and b'_k at every field and their limits, with the distance of the paper's field."""
    rows = []
    for quantity in (CONDUCTIVITY, *SONINE, *MARGINAL):
        for alpha in data.restitutions:
            values = {f: at_field(data, quantity, alpha, f) for f in data.fields}
            fitted = used(data, quantity)
            cells = [str(v) if f in fitted else f"({v})" for f, v in values.items()]
            found = limit(data, quantity, alpha)
            misfit = "" if np.isnan(found.misfit) else f"{found.misfit:.1f}"
            off = percent(found.excess(PAPER_FIELD))
            rows.append([quantity.label, f"{alpha:g}", *cells, found.limit, misfit, off])
    header = ["quantity", "α", *(f"ε* = {f:g}" for f in data.fields), "ε* → 0", "χ²/ν"]
    return grid([*header, f"{PAPER_FIELD:g} off by"], rows)


def elastic(data: Heat) -> list[str]:
    """b'_k at α = 1 beside the converged Sonine expansion: a test of the extrapolation."""
    exact, rows = sonine_elastic.sonine_coefficients(CONVERGED_ORDER), []
    for quantity in (*SONINE, *MARGINAL):
        known = float(exact[(quantity.order or 1) - 1])
        cells: list = [quantity.label, f"{known:.5f}"]
        for value in (limit(data, quantity, 1.0).limit, at_field(data, quantity, 1.0, PAPER_FIELD)):
            cells += [value, f"{value.distance(known):+.1f}"]
        rows.append(cells)
    header = ["quantity", "exact", "ε* → 0", "off/σ", f"ε* = {PAPER_FIELD:g}", "off/σ"]
    return grid(header, rows)


def theory(data: Heat) -> list[str]:
    """κ'/κ0 for ε* → 0 beside both Sonine approximations; shares of the heat flux."""
    rows = []
    for alpha in data.restitutions:
        found = limit(data, CONDUCTIVITY, alpha).limit
        models = (m(alpha).modified_conductivity for m in (first_sonine, modified_first_sonine))
        off = [f"{float(m):.4f} ({100 * (float(m) / found.value - 1):+.1f}%)" for m in models]
        rows.append([f"{alpha:g}", found, *off])
    return grid(["α", "κ'/κ0, ε* → 0", "first Sonine (off by)", "modified (off by)"], rows)


def shares(data: Heat) -> list[str]:
    """The share of c_x² <= 6 in the heat flux."""
    rows = []
    for alpha in data.restitutions:
        found = share_limit(data, alpha)
        at_paper = percent(found.value(PAPER_FIELD))
        rows.append([f"{alpha:g}", at_paper, percent(found.limit), f"{found.misfit:.1f}"])
    return grid(["α", f"fit at ε* = {PAPER_FIELD:g}", "ε* → 0", "χ²/ν"], rows)


def navier_stokes(data: Heat) -> list[str]:
    """All coefficients from kicks with their checks, beside theory."""
    strengths, rows = coefficients.kick_strengths(data), []
    for name, label in coefficients.NAMES.items():
        for alpha in data.restitutions:
            found = coefficients.coefficient(data, name, alpha)
            by_step = _signed(found.by_step) if found.by_step else ""
            checks = [_signed(found.excess), by_step, f"{found.tail:.4f}"]
            models = [f"{x:.4f}" for x in found.theory]
            known = f"{sonine_elastic.converged(name):.5f}" if alpha == 1 else ""
            rows.append([label, f"{alpha:g}", *found.kicks, found.limit, *checks, *models, known])
    header = ["coefficient", "α", *(f"ε = {k:g}" for k in strengths), "ε → 0"]
    header += [f"ε = {strengths[0]:g} minus limit", "dt minus dt/2", "tail in time"]
    return grid([*header, "first Sonine", "modified", "exact"], rows)


def _signed(estimate: Estimate) -> str:
    return str(estimate) if estimate.value < 0 else f"+{estimate}"


def routes(data: Heat) -> list[str]:
    """κ' by kicks and by the force."""
    rows = []
    for alpha in data.restitutions:
        impulse, force, score = coefficients.both_routes(data, alpha)
        rows.append([f"{alpha:g}", impulse, force, f"{score:+.1f}"])
    return grid(["α", "κ'/κ0 by kicks, ε → 0", "by the force, ε* → 0", "difference/σ"], rows)


def cooling(data: Heat) -> list[str]:
    """a2, a3 and ζ of the cooling state beside (2.16) and (2.14)."""
    rows = []
    for alpha in data.restitutions:
        pool = data["cooling"]
        a2, a3, pairs = (pool.value(n, alpha) for n in ("a2", "a3", "relative_speed_cubed"))
        lost = "" if alpha == 1 else pool.value("relative_speed_cubed_collisional", alpha)
        known = float(homogeneous_cooling.kurtosis(alpha))
        largest = max(a2.error, a3.error, pairs.error)
        models = f"{known:.5f}", f"{1 + 3 / 16 * known:.5f}"
        rows.append([f"{alpha:g}", a2, models[0], a3, pairs, lost, models[1], f"{largest:.1g}"])
    header = ["α", "a2", "(2.16)", "a3", "ζ/ζ_M from ⟨V12³⟩", "from energy lost", "(2.14)"]
    return grid([*header, "largest error"], rows)


def step_is_short(data: Heat) -> str:
    """Whether the default step is short enough."""
    deviation = numerics.scheme(data, "exact").deviation(DEFAULT_STEP)
    return within(deviation, numerics.TOLERANCE)


def schemes_apart(data: Heat) -> str:
    """The limits of both schemes, in errors."""
    one, other = (numerics.scheme(data, name).fit.limit for name in ("exact", "paper"))
    return f"{one.distance(other):.1f}"


def time_steps(data: Heat) -> list[str]:
    """κ' against the time step in both schemes."""
    schemes = {name: numerics.scheme(data, name) for name in ("exact", "paper")}
    rows = [
        [name, f"{asked:g}", f"{made:.4f}", value, found.fit.limit, percent(found.deviation(asked))]
        for name, found in schemes.items()
        for asked, made, value in zip(found.asked, found.made, found.values, strict=True)
    ]
    header = ["scheme", "dt asked", "dt made (τ)", "κ'/κ0", "dt → 0", "off by"]
    return grid(header, rows)


def particle_numbers(data: Heat) -> list[str]:
    """κ' with few particles."""
    usual = f"N = {data.size.gas['n_particles']}"
    rows = [[number, few, percent(implied)] for number, few, implied in numerics.numbers(data)]
    return grid(["N", "κ'/κ0", f"{usual} off by, if as 1/N"], rows)


def precision(data: Heat) -> list[str]:
    """Work that each method of the picture needs, and its bias."""
    rows, effort = [], np.geomspace(1e7, 1e14, 2000)
    for method in numerics.methods(data):
        error = method.error(effort)
        reached = [
            f"{effort[np.argmax(error < goal)]:.1e}" if np.any(error < goal) else "never"
            for goal in (0.01, 0.005, 0.003)
        ]
        rows.append([method.label, f"{100 * method.bias:+.2f}%", f"{method.noise:.2f}", *reached])
    header = ["method", "bias of κ'", "error x √(N T/τ0)", "to 1%", "to 0.5%", "to 0.3%"]
    return grid(header, rows)


def simulations(data: Heat) -> list[str]:
    """What was run: sizes, times, seconds, and whether equal parts scatter as their errors say."""
    rows = []
    for name, pool in data.pools.items():
        options, attrs = pool.cases[0].options, [result.attrs for result in pool.results]
        size = f"{options['n_particles']} x {options['n_realizations']} x {len(attrs)}"
        seconds = sum(float(one["seconds"]) for one in attrs)
        rows.append([name, size, options.get("duration", ""), _scatter(pool), f"{seconds:.0f}"])
    header = ["simulation", "N x realizations x parts", "τ0", "χ²/ν of the parts", "s"]
    return grid(header, rows)


def _scatter(pool: Pool) -> str:
    """χ²/ν of the main observable over all restitutions."""
    case = pool.cases[0]
    if not case.steady or len(pool.results) < 2:
        return ""
    name = "a2" if case.name.startswith("cooling") else CONDUCTIVITY.name
    values = [pool.misfit(name, alpha) for alpha in case.scene.gas.restitution]
    return f"{np.mean(values):.1f}"
