"""Statements of the paper without a number, each with the measurement that decides it."""

import numpy as np

from jdsmc.theory.transport import first_sonine, modified_first_sonine

from ..claims import Claim, Finding, decide, percent
from .coefficients import both_routes
from .data import Measurements
from .distribution import odd_part, phi, truncated
from .limits import CONDUCTIVITY, MARGINAL, SONINE, limit
from .relaxation import approach
from .systems import PAPER_FIELD

WEAK = 0.7
"""α from which the paper finds the first Sonine approximation good."""

THERMAL = (4.0, 9.0)
"""c_x² where φ_p and φ are compared: beyond 4, as in the paper, and where φ is still known."""


def weakly_nonlinear(data: Measurements) -> Finding:
    one, two = (data.steady(f).value(CONDUCTIVITY.name, 0.3) for f in (PAPER_FIELD, 0.05))
    change = two.value / one.value - 1.0
    error = np.hypot(one.error / one.value, two.error / two.value)
    found = limit(data, CONDUCTIVITY, 0.3).excess(0.05)
    return Finding(
        f"κ' at ε* = 0.05 over that at 0.025: {percent(change)} ± {percent(error)}; fit: "
        f"{percent(found.value)} above the limit",
        bool(abs(change) < 0.03 + 2 * error),
    )


def linear_for_all(data: Measurements) -> Finding:
    texts, linear = [], True
    for quantity in (CONDUCTIVITY, *SONINE):
        excess = [limit(data, quantity, a).excess(PAPER_FIELD) for a in data.restitutions]
        worst = max(excess, key=lambda e: abs(e.value))
        texts.append(f"{quantity.label} {percent(worst.value)} ± {percent(worst.error)}")
        linear &= bool(abs(worst.value) < 0.01 + 2 * worst.error)
    return Finding("worst distance of ε* = 0.025 from the limit: " + ", ".join(texts), linear)


def ways_differ(data: Measurements, restitution: float) -> list[str]:
    """(3.12) minus (3.10) at the paper's field, in percent and in errors of (3.12)."""
    pool, texts = data.steady(PAPER_FIELD), []
    for full, marginal in zip(SONINE, MARGINAL, strict=True):
        a, b = (pool.value(q.name, restitution, q.order) for q in (full, marginal))
        error = np.hypot(a.error, b.error)
        texts.append(f"{full.label} {b.value - a.value:+.3f} ± {error:.3f}")
    return texts


def both_ways(data: Measurements) -> Finding:
    pool, scores = data.steady(PAPER_FIELD), {}
    for alpha in (0.3, 1.0):
        for full, marginal in zip(SONINE, MARGINAL, strict=True):
            a, b = (pool.value(q.name, alpha, q.order) for q in (full, marginal))
            scores[alpha, full.order] = (b.value - a.value) / np.hypot(a.error, b.error)
    others = [abs(s) for key, s in scores.items() if key != (0.3, 3)]
    text = "; ".join(f"α = {a}: " + ", ".join(ways_differ(data, a)) for a in (0.3, 1.0))
    return Finding(f"(3.12) - (3.10), errors as if independent: {text}", bool(max(others) < 3.0))


def limits_of_both_ways(data: Measurements) -> Finding:
    scores = []
    for alpha in data.restitutions:
        for full, marginal in zip(SONINE, MARGINAL, strict=True):
            a, b = (limit(data, q, alpha).value for q in (full, marginal))
            scores.append((b.value - a.value) / np.hypot(a.error, b.error))
    worst = float(np.max(np.abs(scores)))
    return Finding(f"for ε* → 0 they differ by at most {worst:.1f} errors", bool(worst < 3.5))


def fluctuations(data: Measurements) -> Finding:
    pool, ratios = data.steady(PAPER_FIELD), []
    for full, marginal in zip(SONINE, MARGINAL, strict=True):
        errors = [
            [pool.value(q.name, a, q.order).error for a in data.restitutions]
            for q in (full, marginal)
        ]
        ratios.append(float(np.sqrt(np.mean(np.square(errors[1])) / np.mean(np.square(errors[0])))))
    text = ", ".join(f"b'_{k + 1} {r:.2f}" for k, r in enumerate(ratios))
    return Finding(f"error of (3.12) over that of (3.10): {text}", bool(min(ratios) > 1.0))


def same_relaxation(data: Measurements) -> Finding:
    cases = [(alpha, q) for alpha in (1.0, 0.3) for q in SONINE[:2]]
    found = [approach(data, q, alpha, PAPER_FIELD).time for alpha, q in cases]
    text = ", ".join(f"{q.label} at {a}: {t}" for (a, q), t in zip(cases, found, strict=True))
    values = [t.value for t in found]
    return Finding(f"relaxation times/τ0: {text}", bool(max(values) < 2.0 * min(values)))


def sonine_good_above(data: Measurements) -> Finding:
    rows = [(a, *_off(data, a, first_sonine)) for a in data.restitutions]
    good = all(abs(off) < 0.04 + 2 * error for a, off, error in rows if a >= WEAK - 1e-9)
    return Finding("first Sonine over ours: " + _percents(rows), good)


def sonine_overestimates(data: Measurements) -> Finding:
    rows = [(a, *_off(data, a, first_sonine)) for a in data.restitutions if a < WEAK - 1e-9]
    _, off, error = rows[0]
    return Finding("first Sonine over ours: " + _percents(rows), bool(off - 2 * error > 0.1))


def sonine_underestimates_elastic(data: Measurements) -> Finding:
    off, error = _off(data, 1.0, first_sonine)
    return Finding(
        f"first Sonine over ours: {percent(off)} ± {percent(error)}", decide(-off, error)
    )


def modified_sonine_good(data: Measurements) -> Finding:
    rows = [(a, *_off(data, a, modified_first_sonine)) for a in data.restitutions]
    good = all(abs(off) < 0.07 + 2 * error for _, off, error in rows)
    return Finding("modified first Sonine over ours: " + _percents(rows), good)


def _off(data: Measurements, alpha: float, model) -> tuple[float, float]:
    value, error = limit(data, CONDUCTIVITY, alpha).value
    ratio = float(model(alpha).modified_conductivity) / value
    return ratio - 1.0, ratio * error / value


def _percents(rows) -> str:
    return ", ".join(f"{percent(off)} ± {percent(error)} at {a:g}" for a, off, error in rows)


def sonine_growth(data: Measurements) -> Finding:
    texts, good = [], True
    for alpha in data.restitutions:
        b = [limit(data, q, alpha).value for q in SONINE]
        texts.append(f"{alpha:g}: " + ", ".join(map(str, b)))
        small = max(abs(b[1].value), abs(b[2].value)) / b[0].value
        good &= small < 0.15 if alpha >= WEAK - 1e-9 else True
        good &= small > 0.4 if alpha <= 0.3 + 1e-9 else True
    return Finding("b'_1, b'_2, b'_3 for ε* → 0 at " + "; ".join(texts), bool(good))


def first_polynomial(data: Measurements) -> Finding:
    texts, good = [], True
    for alpha, below in ((1.0, True), (0.9, True), (0.5, False), (0.3, False)):
        difference, error = _first_minus_phi(data, alpha)
        texts.append(f"{difference:+.3f} ± {error:.3f} at {alpha}")
        good &= difference + 2 * error < 0 if below else difference - 2 * error > 0
    return Finding("mean of φ_1 - φ for 4 < c_x² < 9: " + ", ".join(texts), bool(good))


def _first_minus_phi(data: Measurements, alpha: float) -> tuple[float, float]:
    pool = data.steady(PAPER_FIELD)
    odd = odd_part(pool, alpha, PAPER_FIELD)
    value, error = phi(odd)
    squared = odd.centres**2
    chosen = (squared > THERMAL[0]) & (squared < THERMAL[1])
    first = truncated([pool.value("sonine", alpha, 1).value], squared[chosen])
    spread = np.sqrt(np.sum(error[chosen] ** 2)) / np.sum(chosen)
    return float(np.mean(first - value[chosen])), float(spread)


def third_polynomial(data: Measurements) -> Finding:
    pool = data.steady(PAPER_FIELD)
    odd = odd_part(pool, 1.0, PAPER_FIELD)
    value, error = phi(odd)
    chosen = odd.centres**2 < THERMAL[1]
    b = [pool.value("sonine", 1.0, k).value for k in (1, 2, 3)]
    residue = (value - truncated(b, odd.centres**2))[chosen]
    size, noise, apart = (
        float(np.sqrt(np.mean(x**2))) for x in (value[chosen], error[chosen], residue)
    )
    return Finding(
        f"root mean square of φ_3 - φ for c_x² < 9: {percent(apart / size)} of that of φ, of which "
        f"noise {percent(noise / size)}",
        None if noise > 0.03 * size else bool(apart < 0.05 * size),
    )


def routes_agree(data: Measurements) -> Finding:
    found = {a: both_routes(data, a) for a in data.restitutions}
    text = ", ".join(f"{i} and {f} at {a:g}" for a, (i, f, _) in found.items())
    worst = max(abs(score) for *_, score in found.values())
    return Finding(f"kicks and force: {text}; at most {worst:.1f} errors", bool(worst < 3.0))


CLAIMS = (
    Claim("κ'(t) depends very weakly on ε*: 0.05 and 0.025", "4, Fig. 1", weakly_nonlinear),
    Claim("ε* = 0.025 is linear for all quantities (1%)", "4", linear_for_all),
    Claim(
        "(3.10) and (3.12) are indistinguishable but for b'_3 at α = 0.3", "4, Fig. 2", both_ways
    ),
    Claim("(3.10) and (3.12) are the same for ε* → 0", "Appendix A", limits_of_both_ways),
    Claim("fluctuations are smaller with (3.10)", "4", fluctuations),
    Claim(
        "the relaxation time hardly depends on α or the Sonine order (factor 2)",
        "4, Fig. 2",
        same_relaxation,
    ),
    Claim("first Sonine κ' good for α >= 0.7 (4%)", "4, Fig. 3", sonine_good_above),
    Claim("it dramatically overestimates below (10% at 0.3)", "4, Fig. 3", sonine_overestimates),
    Claim("it slightly underestimates at α = 1", "4, Fig. 3", sonine_underestimates_elastic),
    Claim("the modified one is good at all α (7%)", "1, Ref. 28", modified_sonine_good),
    Claim(
        "b'_2, b'_3 are small for α >= 0.7 (15% of b'_1), comparable at 0.3 (40%)",
        "4, Fig. 4",
        sonine_growth,
    ),
    Claim(
        "φ_1 underestimates φ at large c_x² for α = 1, 0.9, and overestimates for 0.5, 0.3",
        "4, Figs. 5, 6",
        first_polynomial,
    ),
    Claim("φ_3 is practically φ at α = 1 (5%)", "4, Fig. 5", third_polynomial),
    Claim("two independent routes give the same κ'", "4, Fig. 3", routes_agree),
)
"""Numbers in brackets are our reading of the words."""
