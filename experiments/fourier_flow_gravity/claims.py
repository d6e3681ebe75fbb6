"""Our value of every number of the text, and the test of every statement (`claims.txt`).

The paper has no error bars.
"""

from collections.abc import Iterable
from functools import partial
from itertools import pairwise

import numpy as np

from jdsmc import Estimate

from ..case import estimate
from ..claims import Finding, all_positive, every, positive
from ..numbers import Span, over_parts
from . import balance, profiles
from .cases import BEYOND, COMBINATIONS, EXAMPLE, EXAMPLE_GRAVITY, FIGURE_6, Combination
from .data import PAPER, Fourier


def crossing(data: Fourier) -> Span:
    """Where p and P_zz cross, over the gravities of Fig. 4: the middle one and the range."""
    each = [profiles.crossing(data.realizations(EXAMPLE, g)) for g in EXAMPLE_GRAVITY]
    value, error = np.array([[*one] for one in each]).T
    low, high = float(np.nanmin(value - error)), float(np.nanmax(value + error))
    return Span(float(np.nanmedian(value)), low, high, "g of Fig. 4")


def _fitted(name: str, combination: Combination, data: Fourier) -> Estimate:
    return data.responses[combination][name]


def _jump(gravity: float, cold: bool, data: Fourier) -> Span:
    return profiles.jump(data.state(EXAMPLE, gravity), EXAMPLE.cold, cold)


def _density(gravity: float, cold: bool, data: Fourier) -> Span:
    return profiles.density(data.state(EXAMPLE, gravity), cold)


PAPER.measures |= {
    f"{kind} {c.cold:g} {c.wall}": partial(_fitted, name, c)
    for c in COMBINATIONS
    for kind, name in (("gradient", "reduced_gradient"), ("response", "B"))
}
PAPER.measures |= {
    f"{kind} {side} {g:g}": partial(function, g, side == "cold")
    for kind, function in (("jump", _jump), ("density", _density))
    for side in ("cold", "hot")
    for g in (-0.016, 0.012)
}
PAPER.measures["paths"] = lambda _: (15.0 * np.pi**0.5 / 16.0) ** 2

LISTED = ", ".join(f"{g:g}" for g in EXAMPLE_GRAVITY)

UNLIKELY = 0.01
"""Probability below which a profile is called non-uniform, shared among all that are tested."""


def relaxed(data: Fourier) -> Finding:
    worst = max(float(data.sweep(c).steady["steady_from_time"].max()) for c in COMBINATIONS)
    return Finding(f"no drift is found from t = {worst:.0f} on, in all states", worst < 200 or None)


def _uniform(test, what: str, data: Fourier) -> Finding:
    """A balance law in layers that are thin enough, and in all."""
    states = [data.realizations(c, float(g)) for c in COMBINATIONS for g in data.gravity[c]]
    tested, everywhere = ([test(state, thin=t) for state in states] for t in (True, False))
    text = f"{what} in layers thinner than {balance.THIN:g} λ': {_described(tested)}"
    return Finding(f"{text}; in all: {_described(everywhere)}", _not_too_small(tested, data))


def _described(tested: list[balance.Uniformity]) -> str:
    found, expected = (np.mean([getattr(t, n) for t in tested]) for n in ("statistic", "expected"))
    least = min(test.probability for test in tested)
    return (
        f"mean Q {found:.2f} in {len(tested)} states, expected {expected:.2f}, smallest "
        f"probability {least:.4f}"
    )


def _not_too_small(tested: list[balance.Uniformity], data: Fourier) -> bool | None:
    """No probability too small for so many tests; None if so few realizations cannot tell."""
    finest = 2.0 ** (1 - data.size.gas["n_realizations"])
    limit = UNLIKELY / len(tested)
    if min(test.probability for test in tested) > max(limit, finest):
        return True
    return None if finest > limit else False


def uniform_flux(data: Fourier) -> Finding:
    return _uniform(balance.energy, "q_z", data)


def momentum_law(data: Fourier) -> Finding:
    return _uniform(balance.momentum, "P_zz + g ∫n dz", data)


def stress_without_gravity(data: Fourier) -> Finding:
    realizations = data.realizations(EXAMPLE, 0.0)
    test = balance.momentum(realizations)
    size = 100 * np.sqrt(np.mean(test.deviation.value**2))
    level = float(realizations["pressure_zz"].mean())
    return Finding(
        f"P_zz uniform within {size / level:.2f}% (root mean square); probability "
        f"{test.probability:.2f}",
        test.probability > UNLIKELY,
    )


def stress_with_gravity(data: Fourier) -> Finding:
    gains = {}
    for gravity in EXAMPLE_GRAVITY:
        stress = data.realizations(EXAMPLE, gravity)["pressure_zz"].values
        fifth = stress.shape[1] // 5
        gain = over_parts(stress[:, -fifth:].mean(axis=1) - stress[:, :fifth].mean(axis=1))
        gains[f"g = {gravity:g}"] = gain * -float(np.sign(gravity))
    del gains["g = 0"]
    return all_positive("P_zz, last fifth minus first, times minus the sign of g", gains)


def pressure_against_stress(data: Fourier) -> Finding:
    texts, signs = [], []
    for gravity in EXAMPLE_GRAVITY:
        found = profiles.pressure_difference(data.realizations(EXAMPLE, gravity))
        layers = len(found.value)
        for part, sign in ((slice(0, layers // 5), 1), (slice(layers // 2, None), -1)):
            value, error = (float(np.mean(x)) for x in found[part])
            texts.append(f"{100 * value:+.1f}%")
            signs.append(positive(Estimate(sign * value, error)))
    return Finding(
        "(p - P_zz)/p over z/L < 0.2 and z/L > 0.5, for each g: " + ", ".join(texts), every(signs)
    )


def _falling(values: Iterable[Estimate]) -> bool | None:
    """Each smaller than the one before."""
    return every(positive(a - b) for a, b in pairwise(values))


def _ends(data: Fourier, gravity: float) -> tuple[Estimate, Estimate]:
    """Temperature in the first and the last layer of the example."""
    state = data.state(EXAMPLE, gravity)
    return profiles.layer(state, "temperature", True), profiles.layer(state, "temperature", False)


def steeper(data: Fourier) -> Finding:
    rises = [hot - cold for cold, hot in (_ends(data, g) for g in EXAMPLE_GRAVITY)]
    text = ", ".join(f"{rise.value:.3f}" for rise in rises)
    return Finding(f"T(L) - T(0) for g = {LISTED}: {text}", _falling(rises))


def stronger_flux(data: Fourier) -> Finding:
    fluxes = [-estimate(data.state(EXAMPLE, g), "mean_heat_flux") for g in EXAMPLE_GRAVITY]
    text = ", ".join(f"{flux.value:.4f}" for flux in fluxes)
    return Finding(f"|q_z| for g = {LISTED}: {text}", _falling(fluxes))


def curved(data: Fourier) -> Finding:
    ratio = estimate(data.state(EXAMPLE, 0.0), "kappa_star")
    a, b = (ratio[int(share * len(ratio.value))] for share in (0.1, 0.7))
    return Finding(
        f"q over its Fourier value at z/L = 0.1 and 0.7 (g = 0): {a.value:.3f} ± {a.error:.3f}, "
        f"{b.value:.3f} ± {b.error:.3f}",
        positive(b - a),
    )


def jumps(data: Fourier) -> Finding:
    ends = [_ends(data, gravity) for gravity in EXAMPLE_GRAVITY]
    cold, hot = [low - EXAMPLE.cold for low, _ in ends], [1.0 - high for _, high in ends]
    text = "; ".join(
        f"{side}: " + ", ".join(f"{one.value:.3f}" for one in values)
        for side, values in (("cold", cold), ("hot", hot))
    )
    holds = every([_falling(cold), _falling(reversed(hot))])
    return Finding(f"first and last layer, g = {LISTED}: {text}", holds)


def smaller_jumps(data: Fourier) -> Finding:
    found, shown = {}, {}
    for gravity in FIGURE_6:
        for side, cold in (("cold", True), ("hot", False)):
            states = [data.state(Combination(0.01, wall), gravity) for wall in ("maxwell", "bgk")]
            ends = [profiles.layer(state, "temperature", cold) for state in states]
            one, two = (end - 0.01 if cold else 1.0 - end for end in ends)
            label = f"g = {gravity:g}, {side} wall"
            found[label], shown[label] = one - two, f"{one.value:.3f} and {two.value:.3f}"
    return all_positive("T_- = 0.01, types I and II", found, shown)


def _in_all(data: Fourier, name: str, head: str, expected) -> Finding:
    """A coefficient of the fits, and whether a function of it is positive in all sweeps."""
    found = {f"{c.label}:": data.responses[c][name] for c in COMBINATIONS}
    return all_positive(head, {label: expected(one) for label, one in found.items()}, found)


def below_one(data: Fourier) -> Finding:
    return _in_all(data, "kappa_star", "κ* at g = 0, from the fits", lambda found: 1.0 - found)


def _both_kinds(data: Fourier, cold: float) -> list[dict[str, Estimate]]:
    """Fits of type I and type II."""
    return [data.responses[c] for c in COMBINATIONS if c.cold == cold]


def closer_to_one(data: Fourier) -> Finding:
    both = {f"T_- = {cold:g}": _both_kinds(data, cold) for cold in (0.05, 0.01)}
    found = {label: two["kappa_star"] - one["kappa_star"] for label, (one, two) in both.items()}
    return all_positive("κ* of type II minus type I", found)


def _resolved(data: Fourier) -> list[tuple[float, dict[str, Estimate]]]:
    """g and what is at z0, of every state in which a point has ε0."""
    return [
        (gravity, {name: values[k] for name, values in effect.items()})
        for combination, effect in data.effects.items()
        for k, gravity in enumerate(data.gravity[combination])
        if np.isfinite(effect["kappa_star"].error[k])
    ]


def position(data: Fourier) -> Finding:
    states = _resolved(data)
    signs = [positive(5.0 - here["z0"]) for _, here in states]
    signs += [positive(np.sign(g) * (here["mean_free_paths"] - 5.0)) for g, here in states if g]
    highest = max(float(here["z0"].value) for _, here in states)
    undecided = signs.count(None)
    text = f"largest z0 = {highest:.2f}; {undecided} of {len(signs)} comparisons within 2 errors"
    return Finding(text, False if False in signs else (None if undecided > 3 else True))


def sign_of_effect(data: Fourier) -> Finding:
    states = _resolved(data)
    signs = [positive(np.sign(g) * here["kappa_star_change"]) for g, here in states if g]
    wrong, open_ = signs.count(False), signs.count(None)
    text = f"{len(signs)} states: {signs.count(True)} so, {wrong} not so, {open_} within 2 errors"
    return Finding(text, False if wrong else (True if open_ < len(signs) / 3 else None))


def asymmetry(data: Fourier) -> Finding:
    return _in_all(data, "C", "coefficient of g*² in the fits", lambda found: found)


def walls_matter(data: Fourier) -> Finding:
    found, shown = {}, {}
    for cold in (0.05, 0.01):
        one, two = (fit["B"] * fit["reduced_gradient"] for fit in _both_kinds(data, cold))
        label, found[f"T_- = {cold:g}"] = f"T_- = {cold:g}", two - one
        error = found[label].error
        shown[label] = f"{one.value:.3f} and {two.value:.3f}, difference ± {error:.3f}"
    return all_positive("∂Δκ*/∂g* at g* = 0, types I and II", found, shown)


def weaker_than_molecules(data: Fourier) -> Finding:
    return _in_all(data, "B", "B", lambda found: profiles.FIRST_ORDER - found)


def beyond_table(data: Fourier) -> Finding:
    free = data.gravity[BEYOND].index(0.0)
    gradient = float(data.effects[BEYOND]["reduced_gradient"].value[free])
    found = estimate(data.state(BEYOND, FIGURE_6[1]), "reduced_gradient")
    inner = found.value[: -(len(found.value) // 5)]
    lowest = found[int(np.argmin(inner))]
    text = f"smallest ε for z/L < 0.8: {lowest.value:.3f} ± {lowest.error:.3f}; ε0 = {gradient:.3f}"
    return Finding(text, positive(lowest - gradient))
