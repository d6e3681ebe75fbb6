"""Our value of every number the text quotes, and the test of every statement (`claims.txt`).

The paper gives no error bars. Numbers in brackets in the statements are our reading of the words.
"""

from functools import partial

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import sonine_elastic
from jdsmc.theory.transport import first_sonine, modified_first_sonine

from ..claims import Finding, percent, positive
from ..numbers import Span, total
from .cases import PAPER_FIELD
from .coefficients import both_routes
from .data import PAPER, Heat
from .distribution import approach, odd_part, phi, share_limit, truncated
from .limits import CONDUCTIVITY, MARGINAL, SONINE, Quantity, at_field, limit


def settled(quantity: Quantity, alpha: float, data: Heat) -> Span:
    """When a quantity has come near its steady value at the paper's field."""
    return approach(data, quantity, alpha, PAPER_FIELD).within


PAPER.measures |= {
    "relaxation": partial(settled, CONDUCTIVITY, 0.3),
    "relaxation_sonine_03": partial(settled, SONINE[1], 0.3),
    "relaxation_sonine_1": partial(settled, SONINE[0], 1.0),
    "elastic": lambda data: limit(data, CONDUCTIVITY, 1.0).limit,
    "share_elastic": lambda data: share_limit(data, 1.0).limit,
    "share_03": lambda data: share_limit(data, 0.3).limit,
    "sonine": lambda _: sonine_elastic.converged("conductivity"),
}

WEAK = 0.7 - 1e-9
"""α from which the paper finds the first Sonine approximation good."""

THERMAL = (4.0, 9.0)
"""c_x² where φ_p and φ are compared: beyond 4, as in the paper, and where φ is still known."""


def weakly_nonlinear(data: Heat) -> Finding:
    one, two = (at_field(data, CONDUCTIVITY, 0.3, f) for f in (PAPER_FIELD, 0.05))
    change = two / one - 1.0
    fitted = limit(data, CONDUCTIVITY, 0.3).excess(0.05)
    return Finding(
        f"κ' at ε* = 0.05 over that at 0.025: {percent(change)}; fit: "
        f"{percent(float(fitted))} above the limit",
        abs(change.value) < 0.03 + 2 * change.error,
    )


def linear_for_all(data: Heat) -> Finding:
    texts, linear = [], True
    for quantity in (CONDUCTIVITY, *SONINE):
        excess = [limit(data, quantity, a).excess(PAPER_FIELD) for a in data.restitutions]
        worst = max(excess, key=lambda e: abs(e.value))
        texts.append(f"{quantity.label} {percent(worst)}")
        linear &= abs(worst.value) < 0.01 + 2 * worst.error
    return Finding("worst distance of ε* = 0.025 from the limit: " + ", ".join(texts), linear)


def apart(data: Heat, alpha: float) -> list[Estimate]:
    """(3.12) minus (3.10) at the paper's field, errors as if independent: as one sees them."""
    pairs = [
        [at_field(data, q, alpha, PAPER_FIELD) for q in both]
        for both in zip(SONINE, MARGINAL, strict=True)
    ]
    return [Estimate(b.value - a.value, np.hypot(a.error, b.error)) for a, b in pairs]


def both_ways(data: Heat) -> Finding:
    found = {alpha: apart(data, alpha) for alpha in (0.3, 1.0)}
    texts = [
        f"α = {alpha}: "
        + ", ".join(
            f"{q.label} {d.value:+.3f} ± {d.error:.3f}" for q, d in zip(SONINE, ds, strict=True)
        )
        for alpha, ds in found.items()
    ]
    others = [abs(d.distance(0.0)) for d in (*found[0.3][:2], *found[1.0])]
    return Finding(
        f"(3.12) - (3.10), errors as if independent: {'; '.join(texts)}", max(others) < 3.0
    )


def limits_of_both_ways(data: Heat) -> Finding:
    worst = max(
        abs(float(limit(data, b, alpha).limit.distance(limit(data, a, alpha).limit)))
        for alpha in data.restitutions
        for a, b in zip(SONINE, MARGINAL, strict=True)
    )
    return Finding(f"for ε* → 0 they differ by at most {worst:.1f} errors", worst < 3.5)


def fluctuations(data: Heat) -> Finding:
    def error(quantity: Quantity) -> float:
        found = [at_field(data, quantity, a, PAPER_FIELD).error for a in data.restitutions]
        return float(np.sqrt(np.mean(np.square(found))))

    ratios = [error(b) / error(a) for a, b in zip(SONINE, MARGINAL, strict=True)]
    text = ", ".join(f"b'_{k + 1} {r:.2f}" for k, r in enumerate(ratios))
    return Finding(f"error of (3.12) over that of (3.10): {text}", min(ratios) > 1.0)


def same_relaxation(data: Heat) -> Finding:
    found = {
        f"{q.label} at {alpha}": approach(data, q, alpha, PAPER_FIELD).time
        for alpha in (1.0, 0.3)
        for q in SONINE[:2]
    }
    values = [float(time) for time in found.values()]
    text = ", ".join(f"{name}: {time}" for name, time in found.items())
    return Finding(f"relaxation times/τ0: {text}", max(values) < 2.0 * min(values))


def over_ours(data: Heat, model) -> dict[float, Estimate]:
    """A Sonine approximation of κ' over our limit, minus 1, at every restitution."""
    return {
        a: float(model(a).modified_conductivity) / limit(data, CONDUCTIVITY, a).limit - 1.0
        for a in data.restitutions
    }


def _listed(rows: dict[float, Estimate]) -> str:
    return ", ".join(f"{percent(off)} at {a:g}" for a, off in rows.items())


def _all_near(rows: dict[float, Estimate], limit: float) -> bool:
    return all(abs(off.value) < limit + 2 * off.error for off in rows.values())


def sonine_good_above(data: Heat) -> Finding:
    rows = over_ours(data, first_sonine)
    good = _all_near({a: off for a, off in rows.items() if a >= WEAK}, 0.04)
    return Finding("first Sonine over ours: " + _listed(rows), good)


def sonine_overestimates(data: Heat) -> Finding:
    rows = {a: off for a, off in over_ours(data, first_sonine).items() if a < WEAK}
    strongest = rows[min(rows)]
    text = "first Sonine over ours: " + _listed(rows)
    return Finding(text, strongest.value - 2 * strongest.error > 0.1)


def sonine_underestimates_elastic(data: Heat) -> Finding:
    off = over_ours(data, first_sonine)[1.0]
    return Finding(f"first Sonine over ours: {percent(off)}", positive(-off))


def modified_sonine_good(data: Heat) -> Finding:
    rows = over_ours(data, modified_first_sonine)
    return Finding("modified first Sonine over ours: " + _listed(rows), _all_near(rows, 0.07))


def sonine_growth(data: Heat) -> Finding:
    texts, good = [], True
    for alpha in data.restitutions:
        b = [limit(data, q, alpha).limit for q in SONINE]
        texts.append(f"{alpha:g}: " + ", ".join(map(str, b)))
        small = max(abs(b[1].value), abs(b[2].value)) / b[0].value
        good &= small < 0.15 if alpha >= WEAK else True
        good &= small > 0.4 if alpha <= 0.3 + 1e-9 else True
    return Finding("b'_1, b'_2, b'_3 for ε* → 0 at " + "; ".join(texts), good)


def first_polynomial(data: Heat) -> Finding:
    texts, good = [], True
    for alpha, side in ((1.0, -1), (0.9, -1), (0.5, 1), (0.3, 1)):
        odd = odd_part(data, alpha, PAPER_FIELD)
        squared = odd.centres**2
        chosen = (squared > THERMAL[0]) & (squared < THERMAL[1])
        first = at_field(data, SONINE[0], alpha, PAPER_FIELD).value
        found = total(truncated([first], squared[chosen]) - phi(odd)[chosen]) / np.sum(chosen)
        texts.append(f"{found.value:+.3f} ± {found.error:.3f} at {alpha}")
        good &= side * found.value > 2 * found.error
    return Finding("mean of φ_1 - φ for 4 < c_x² < 9: " + ", ".join(texts), good)


def third_polynomial(data: Heat) -> Finding:
    odd = odd_part(data, 1.0, PAPER_FIELD)
    squared = odd.centres**2
    chosen = squared < THERMAL[1]
    b = [at_field(data, q, 1.0, PAPER_FIELD).value for q in SONINE]
    value, error = phi(odd)[chosen]
    residue = value - truncated(b, squared[chosen])
    size, noise, far = (float(np.sqrt(np.mean(x**2))) for x in (value, error, residue))
    return Finding(
        f"root mean square of φ_3 - φ for c_x² < 9: {percent(far / size)} of that of φ, of which "
        f"noise {percent(noise / size)}",
        None if noise > 0.03 * size else far < 0.05 * size,
    )


def routes_agree(data: Heat) -> Finding:
    found = {a: both_routes(data, a) for a in data.restitutions}
    text = ", ".join(f"{i} and {f} at {a:g}" for a, (i, f, _) in found.items())
    worst = max(abs(score) for *_, score in found.values())
    return Finding(f"kicks and force: {text}; at most {worst:.1f} errors", worst < 3.0)
