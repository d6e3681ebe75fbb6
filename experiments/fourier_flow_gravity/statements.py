"""Statements of the paper without a number, each with the measurement that decides it."""

import itertools

import numpy as np
import xarray as xr

from jdsmc import Estimate

from ..claims import Claim, Finding, decide
from . import balance, profiles
from .data import Measurements, plain
from .systems import BEYOND, COMBINATIONS, EXAMPLE, EXAMPLE_GRAVITY, FIGURE_6, Combination

LISTED = ", ".join(f"{g:g}" for g in EXAMPLE_GRAVITY)

UNLIKELY = 0.01
"""Probability below which a profile is called non-uniform, shared among all that are tested."""


def uniform_flux(data: Measurements) -> Finding:
    return _uniform(data, balance.energy, "q_z")


def momentum_law(data: Measurements) -> Finding:
    return _uniform(data, balance.momentum, "P_zz + g ∫n dz")


def _uniform(data: Measurements, test, what: str) -> Finding:
    """A balance law in layers that are thin enough, and in all."""
    everywhere = [test(state, thin=False) for state in _states(data)]
    tested = [test(state) for state in _states(data)]
    text = f"{what} in layers thinner than {balance.THIN:g} λ': {_described(tested)}"
    return Finding(f"{text}; in all: {_described(everywhere)}", _not_too_small(tested, data))


def _states(data: Measurements):
    return [data.realizations(c, float(g)) for c in COMBINATIONS for g in data.size.gravity[c]]


def _described(tested: list[balance.Uniformity]) -> str:
    found, expected = (np.mean([getattr(t, n) for t in tested]) for n in ("statistic", "expected"))
    least = min(test.probability for test in tested)
    return (
        f"mean Q {found:.2f} in {len(tested)} states, expected {expected:.2f}, smallest "
        f"probability {least:.4f}"
    )


def _not_too_small(tested: list[balance.Uniformity], data: Measurements) -> bool | None:
    """No probability too small for so many tests; None if so few realizations cannot tell."""
    probabilities = [test.probability for test in tested]
    finest = 2.0 ** (1 - data.size.options["n_realizations"])
    limit = UNLIKELY / len(probabilities)
    if min(probabilities) > max(limit, finest):
        return True
    return None if finest > limit else False


def stress_without_gravity(data: Measurements) -> Finding:
    realizations = data.realizations(EXAMPLE, 0.0)
    test = balance.momentum(realizations)
    size = 100 * np.sqrt(np.mean(test.deviation**2))
    level = float(realizations["pressure_zz"].mean())
    return Finding(
        f"P_zz uniform within {size / level:.2f}% (root mean square); probability "
        f"{test.probability:.2f}",
        test.probability > UNLIKELY,
    )


def stress_with_gravity(data: Measurements) -> Finding:
    texts, signs = [], []
    for gravity in EXAMPLE_GRAVITY:
        if gravity:
            stress = data.realizations(EXAMPLE, gravity)["pressure_zz"]
            stress = stress.transpose("realization", "z").values
            gain = stress[:, -20:].mean(axis=1) - stress[:, :20].mean(axis=1)
            error = np.std(gain, ddof=1) / np.sqrt(len(gain))
            texts.append(f"g = {gravity:g}: {np.mean(gain):+.4f} ± {error:.4f}")
            signs.append(decide(float(np.mean(gain)), float(error), positive=gravity < 0))
    return Finding("P_zz, last fifth minus first: " + "; ".join(texts), _all(signs))


def pressure_against_stress(data: Measurements) -> Finding:
    texts, signs = [], []
    for gravity in EXAMPLE_GRAVITY:
        value, error = profiles.pressure_difference(data.realizations(EXAMPLE, gravity))
        layers = len(value)
        for part, positive in ((slice(0, layers // 5), True), (slice(layers // 2, None), False)):
            mean = float(np.mean(value[part]))
            texts.append(f"{100 * mean:+.1f}%")
            signs.append(decide(mean, float(np.mean(error[part])), positive))
    return Finding(
        "(p - P_zz)/p over z/L < 0.2 and z/L > 0.5, for each g: " + ", ".join(texts), _all(signs)
    )


def steeper(data: Measurements) -> Finding:
    rises = [_rise(data, g) for g in EXAMPLE_GRAVITY]
    text = ", ".join(f"{value:.3f}" for value, _ in rises)
    return Finding(f"T(L) - T(0) for g = {LISTED}: {text}", _falling(rises))


def stronger_flux(data: Measurements) -> Finding:
    fluxes = []
    for gravity in EXAMPLE_GRAVITY:
        state = data.state(EXAMPLE, gravity)
        fluxes.append((-float(state["mean_heat_flux"]), float(state["mean_heat_flux_error"])))
    text = ", ".join(f"{value:.4f}" for value, _ in fluxes)
    return Finding(f"|q_z| for g = {LISTED}: {text}", _falling(fluxes))


def jumps(data: Measurements) -> Finding:
    cold, hot = [], []
    for gravity in EXAMPLE_GRAVITY:
        state = data.state(EXAMPLE, gravity)
        (low, low_error), _ = profiles.at_wall(state, "temperature", True)
        (high, high_error), _ = profiles.at_wall(state, "temperature", False)
        cold.append((low - EXAMPLE.cold, low_error))
        hot.append((1.0 - high, high_error))
    text = "; ".join(
        f"{side}: " + ", ".join(f"{v:.3f}" for v, _ in values)
        for side, values in (("cold", cold), ("hot", hot))
    )
    holds = _all([_falling(cold), _falling([(-v, e) for v, e in hot])])
    return Finding(f"first and last layer, g = {LISTED}: {text}", holds)


def smaller_jumps(data: Measurements) -> Finding:
    texts, signs = [], []
    for gravity in FIGURE_6:
        for side, cold in (("cold", True), ("hot", False)):
            both = []
            for wall in ("maxwell", "bgk"):
                state = data.state(Combination(0.01, wall), gravity)
                (value, error), _ = profiles.at_wall(state, "temperature", cold)
                both.append((value - 0.01 if cold else 1.0 - value, error))
            (one, one_error), (two, two_error) = both
            texts.append(f"g = {gravity:g}, {side} wall: {one:.3f} and {two:.3f}")
            signs.append(decide(one - two, float(np.hypot(one_error, two_error))))
    return Finding("T_- = 0.01, types I and II, " + "; ".join(texts), _all(signs))


def curved(data: Measurements) -> Finding:
    state = data.state(EXAMPLE, 0.0)
    ratio, error = state["kappa_star"].values, state["kappa_star_error"].values
    a, b = (int(share * len(ratio)) for share in (0.1, 0.7))
    return Finding(
        f"q over its Fourier value at z/L = 0.1 and 0.7 (g = 0): {ratio[a]:.3f} ± {error[a]:.3f}, "
        f"{ratio[b]:.3f} ± {error[b]:.3f}",
        decide(float(ratio[b] - ratio[a]), float(np.hypot(error[a], error[b]))),
    )


def below_one(data: Measurements) -> Finding:
    texts, signs = [], []
    for combination in COMBINATIONS:
        found = data.responses[combination]["kappa_star"]
        texts.append(f"{combination.label}: {found}")
        value, error = plain(found)
        signs.append(decide(1.0 - value, error))
    return Finding("κ* at g = 0, from the fits, " + "; ".join(texts), _all(signs))


def closer_to_one(data: Measurements) -> Finding:
    texts, signs = [], []
    for cold in (0.05, 0.01):
        one, two = (plain(fit["kappa_star"]) for fit in _both_kinds(data, cold))
        gain, error = two[0] - one[0], float(np.hypot(one[1], two[1]))
        texts.append(f"T_- = {cold:g}: {gain:+.4f} ± {error:.4f}")
        signs.append(decide(gain, error))
    return Finding("κ* of type II minus type I, " + "; ".join(texts), _all(signs))


def _both_kinds(data: Measurements, cold: float) -> list[dict[str, Estimate]]:
    """Fits of type I and type II."""
    return [data.responses[c] for c in COMBINATIONS if c.cold == cold]


def position(data: Measurements) -> Finding:
    signs, highest = [], 0.0
    for effect in _resolved(data):
        for gravity in effect["gravity"].values:
            here = effect.sel(gravity=gravity)
            highest = max(highest, float(here["z0"]))
            signs.append(decide(5.0 - float(here["z0"]), float(here["z0_error"])))
            if gravity:
                away = float(here["mean_free_paths"]) - 5.0
                error = float(here["mean_free_paths_error"])
                signs.append(decide(away, error, positive=bool(gravity > 0)))
    undecided = sum(sign is None for sign in signs)
    text = f"largest z0 = {highest:.2f}; {undecided} of {len(signs)} comparisons within 2 errors"
    return Finding(text, False if False in signs else (None if undecided > 3 else True))


def _resolved(data: Measurements) -> list[xr.Dataset]:
    """Every sweep, without states where no point has ε0."""
    known = [np.isfinite(effect["kappa_star_error"].values) for effect in data.effects.values()]
    return [e.isel(gravity=k) for e, k in zip(data.effects.values(), known, strict=True)]


def sign_of_effect(data: Measurements) -> Finding:
    signs = []
    for effect in _resolved(data):
        for gravity in effect["gravity"].values[effect["gravity"].values != 0]:
            here = effect.sel(gravity=gravity)
            change, error = (float(here[f"kappa_star_change{s}"]) for s in ("", "_error"))
            signs.append(decide(change, error, positive=bool(gravity > 0)))
    wrong, open_ = signs.count(False), signs.count(None)
    text = f"{len(signs)} states: {signs.count(True)} so, {wrong} not so, {open_} within 2 errors"
    return Finding(text, False if wrong else (True if open_ < len(signs) / 3 else None))


def asymmetry(data: Measurements) -> Finding:
    texts, signs = [], []
    for combination in COMBINATIONS:
        found = data.responses[combination]["C"]
        texts.append(f"{combination.label}: {found}")
        signs.append(decide(*plain(found)))
    return Finding("coefficient of g*² in the fits, " + "; ".join(texts), _all(signs))


def walls_matter(data: Measurements) -> Finding:
    texts, signs = [], []
    for cold in (0.05, 0.01):
        fits = _both_kinds(data, cold)
        gradients = [plain(fit["reduced_gradient"])[0] for fit in fits]
        (one, two), errors = (
            [plain(fit["B"])[k] * e for fit, e in zip(fits, gradients, strict=True)] for k in (0, 1)
        )
        error = float(np.hypot(errors[0], errors[1]))
        texts.append(f"T_- = {cold:g}: {one:.3f} and {two:.3f}, difference ± {error:.3f}")
        signs.append(decide(two - one, error))
    return Finding("∂Δκ*/∂g* at g* = 0, types I and II, " + "; ".join(texts), _all(signs))


def weaker_than_molecules(data: Measurements) -> Finding:
    texts, signs = [], []
    for combination in COMBINATIONS:
        found = data.responses[combination]["B"]
        texts.append(f"{combination.label}: {found}")
        value, error = plain(found)
        signs.append(decide(46 / 5 - value, error))
    return Finding("B, " + "; ".join(texts), _all(signs))


def relaxed(data: Measurements) -> Finding:
    roots = [result.to_xarray().to_dataset() for result in data.spheres]
    worst = max(float(root["steady_from_time"].max()) for root in roots)
    text = f"no drift is found from t = {worst:.0f} on, in all states"
    return Finding(text, True if worst < 200 else None)


def beyond_table(data: Measurements) -> Finding:
    gradient = float(data.effects[BEYOND]["reduced_gradient"].sel(gravity=0.0))
    state = data.state(BEYOND, FIGURE_6[1])
    edge = state.sizes["z"] // 5
    inner, errors = (state[f"reduced_gradient{suffix}"].values[:-edge] for suffix in ("", "_error"))
    lowest, error = float(np.min(inner)), float(errors[np.argmin(inner)])
    text = f"smallest ε for z/L < 0.8: {lowest:.3f} ± {error:.3f}; ε0 = {gradient:.3f}"
    return Finding(text, decide(lowest - gradient, error))


def _rise(data: Measurements, gravity: float) -> tuple[float, float]:
    state = data.state(EXAMPLE, gravity)
    low, high = (profiles.at_wall(state, "temperature", cold).layer for cold in (True, False))
    return high[0] - low[0], float(np.hypot(low[1], high[1]))


def _falling(values) -> bool | None:
    """Each of (value, error) smaller than the one before."""
    pairs = itertools.pairwise(values)
    return _all([decide(a[0] - b[0], float(np.hypot(a[1], b[1]))) for a, b in pairs])


def _all(signs: list) -> bool | None:
    """True if all hold, False if one does not, else None."""
    return False if False in signs else (None if None in signs else True)


CLAIMS = (
    Claim("The steady state is reached before t = 200", "3", relaxed),
    Claim("The heat flux is uniform: (13)", "4, Fig. 3", uniform_flux),
    Claim("The momentum balance (12) holds", "4, Fig. 4", momentum_law),
    Claim("P_zz is uniform at g = 0", "4, Fig. 4", stress_without_gravity),
    Claim("P_zz rises with z for g < 0 and falls for g > 0", "4, Fig. 4", stress_with_gravity),
    Claim(
        "p is slightly above P_zz near the cold wall and slightly below it farther away",
        "4, Fig. 4",
        pressure_against_stress,
    ),
    Claim("The temperature gradient is larger for g < 0 than for g > 0", "4, Fig. 2", steeper),
    Claim("|q_z| increases as g decreases", "4, 5, Fig. 3", stronger_flux),
    Claim("T^(3/2) is not linear although q_z is uniform", "4, Figs. 2, 3", curved),
    Claim("With g, the cold jump falls and the hot one rises", "5", jumps),
    Claim("Type II walls have much smaller jumps than type I", "4, Fig. 6", smaller_jumps),
    Claim("κ* < 1 at g = 0", "4", below_one),
    Claim("κ* is closer to 1 with type II walls", "4", closer_to_one),
    Claim("z0 is nearer to the cold wall; 𝒩(z0) - 5 has the sign of g", "4, Tables", position),
    Claim("Δκ* has the sign of g", "4, Fig. 7", sign_of_effect),
    Claim("Δκ*(g*) > -Δκ*(-g*): gravity along q does more", "4, Fig. 7", asymmetry),
    Claim("Gravity does less with type I walls", "4, Fig. 7", walls_matter),
    Claim(
        "Gravity does less for hard spheres than B = 46/5 of Maxwell molecules",
        "5",
        weaker_than_molecules,
    ),
    Claim("Beyond table 4 (g = 0.012) no point has ε0", "not stated", beyond_table),
)
