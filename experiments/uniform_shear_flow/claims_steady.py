"""Statements of sections III to VI on steady values of the two gases."""

import numpy as np
from jdsmc.observables import VISCOSITY_TIME

from ..claims import Claim, Finding, percent
from . import correlation
from .correlation import mean_over_rates
from .data import Measurements, Term, propagate
from .systems import FAST, SLOW

INTRINSIC = (
    *("shear_stress", "normal_stress_xy", "normal_stress_zy"),
    *("relative_speed_cubed", "a2", "a3"),
)
"""Observables that depend on α alone."""


def independent_of_shear_rate(data: Measurements) -> Finding:
    scores = []
    for gas in ("ihs", "ehs"):
        for name in INTRINSIC:
            fast, slow = (data.steady_values(gas, rate, name) for rate in (FAST, SLOW))
            scores.append((fast.value - slow.value) / np.hypot(fast.error, slow.error))
        fast, slow = (data.steady_values(gas, rate, "temperature") for rate in (FAST, SLOW))
        ratio = fast.value / slow.value * (SLOW / FAST) ** 2
        error = np.hypot(fast.error / fast.value, slow.error / slow.value)
        scores.append((ratio - 1.0) / error)
    scores = np.concatenate(scores)
    share = float(np.mean(np.abs(scores) < 2.0))
    return Finding(
        f"{100 * share:.0f}% of {scores.size} values at both a within 2 combined errors, all "
        f"within {np.abs(scores).max():.1f}",
        bool(share > 0.85 and np.abs(scores).max() < 5.0),
    )


def order_of_pressures(data: Measurements) -> Finding:
    rows = []
    for gas in ("ihs", "ehs"):
        xx, yy, zz = (mean_over_rates(data, gas, f"pressure_{k}").value for k in ("xx", "yy", "zz"))
        rows.append(np.array([xx - 1.0, 1.0 - zz, zz - yy]).min(axis=1))
    least = np.min(rows, axis=0)
    return Finding(
        "least P_xx-nT, nT-P_zz, P_zz-P_yy over nT: " + ", ".join(f"{x:.4f}" for x in least),
        bool(np.all(least > 0)),
    )


def gases_agree_above(data: Measurements) -> Finding:
    texts, good = [], True
    for name, limit in (("reduced_shear_rate", 0.7), ("shear_stress", 0.7)):
        ratio = mean_over_rates(data, "ehs", name).value / mean_over_rates(data, "ihs", name).value
        alpha = np.array(data.restitutions())
        above = np.abs(ratio - 1.0)[alpha >= limit - 1e-9].max()
        below = np.abs(ratio - 1.0)[0]
        texts.append(f"{name} {percent(above)} for α >= {limit}, {percent(below)} at {alpha[0]}")
        good &= bool(above < 0.03 and above < below)
    return Finding("largest |EHS/IHS - 1|: " + "; ".join(texts), good)


def normal_stresses_differ_below(data: Measurements) -> Finding:
    alpha = np.array(data.restitutions())
    texts = []
    for name in ("normal_stress_xy", "normal_stress_zy", "a3"):
        ihs, ehs = (mean_over_rates(data, gas, name) for gas in ("ihs", "ehs"))
        score = np.abs(ihs.value - ehs.value) / np.hypot(ihs.error, ehs.error)
        relative = ehs.value / ihs.value - 1.0
        texts.append(
            name
            + ": "
            + ", ".join(
                f"{percent(r, 0)} ({s:.0f}σ) at {a:g}"
                for a, r, s in zip(alpha, relative, score, strict=True)
            )
        )
    xy = mean_over_rates(data, "ehs", "normal_stress_xy").value
    other = mean_over_rates(data, "ihs", "normal_stress_xy").value
    relative = np.abs(xy / other - 1.0)
    good = relative[0] > 0.1 and np.all(relative[alpha > 0.84] < 0.05)
    return Finding("EHS/IHS - 1 of " + "; ".join(texts), bool(good))


def cooling_rate_few_percent(data: Measurements) -> Finding:
    values = mean_over_rates(data, "ihs", "relative_speed_cubed").value
    return Finding(
        f"ζ/ζ0 - 1 from {percent(values.min() - 1)} to {percent(values.max() - 1)}",
        bool(values.min() > 1.0 and values.max() < 1.15),
    )


def energy_loss_agrees(data: Measurements) -> Finding:
    pairs, lost = (
        mean_over_rates(data, "ihs", name)
        for name in ("relative_speed_cubed", "relative_speed_cubed_collisional")
    )
    score = (lost.value - pairs.value) / np.hypot(lost.error, pairs.error)
    relative = np.abs(lost.value / pairs.value - 1.0).max()
    return Finding(
        f"they differ by at most {percent(relative, 2)}, {np.abs(score).max():.1f} combined errors",
        bool(np.abs(score).max() < 3.5),
    )


def energy_loss_noisier(data: Measurements) -> Finding:
    pairs, lost = (
        mean_over_rates(data, "ihs", name)
        for name in ("relative_speed_cubed", "relative_speed_cubed_collisional")
    )
    ratio = float(np.sqrt(np.mean(lost.error**2) / np.mean(pairs.error**2)))
    return Finding(f"error of the energy loss over that of the pairs: {ratio:.2f}", ratio > 1.2)


def a3_zero(data: Measurements) -> Finding:
    alpha = np.array(data.restitutions())
    a3 = mean_over_rates(data, "ihs", "a3")
    quasi, strong = (int(np.argmin(np.abs(alpha - a))) for a in (0.9, 0.5))
    return Finding(
        f"-a3 = {-a3.value[quasi]:.4f} ± {a3.error[quasi]:.4f} at 0.9, "
        f"{-a3.value[strong]:.3f} ± {a3.error[strong]:.3f} at 0.5",
        bool(abs(a3.value[quasi]) < 0.03 * abs(a3.value[strong]) and a3.value[strong] < 0),
    )


def isotropic_slope_fails(data: Measurements) -> Finding:
    found = correlation.fits(data)
    texts = [
        f"{name}: k = {fit.slope} (point by point {fit.least:.3f} to {fit.largest:.3f}), "
        f"χ²/ν = {fit.misfit:.0f}, with 3/16 {fit.misfit_isotropic:.0f}"
        for name, fit in found.items()
    ]
    return Finding("; ".join(texts), bool(found["both"].least > correlation.ISOTROPIC_SLOPE))


def energy_balance(data: Measurements) -> Finding:
    """Exact in the steady state: (2/3) a (-P_xy/nT) = ζ, which nothing in the program imposes."""
    worst, significance = 0.0, 0.0
    for gas in ("ihs", "ehs"):
        for alpha in data.restitutions(gas):
            terms = [
                Term(gas, alpha, FAST, name)
                for name in ("reduced_shear_rate", "shear_stress", "relative_speed_cubed")
            ]
            cooling = 2.0 * (1 - alpha**2) / (3.0 * np.sqrt(np.pi)) * VISCOSITY_TIME

            def imbalance(reduced, stress, cubed, cooling=cooling, gas=gas):
                return (2 / 3) * reduced * stress / (cooling * (cubed if gas == "ihs" else 1)) - 1

            off = propagate(imbalance, [data.lookup(term) for term in terms])
            worst = max(worst, abs(off.value))
            significance = max(significance, abs(off.value) / off.error)
    return Finding(
        f"off by at most {percent(worst, 2)}, {significance:.1f} errors", bool(worst < 0.005)
    )


CLAIMS = (
    Claim("viscous heating balances cooling: (2/3) a |P_xy| = ζ nT", "III", energy_balance),
    Claim("intrinsic values do not depend on a", "V C, Figs. 14, 16", independent_of_shear_rate),
    Claim("P_xx > nT > P_zz > P_yy", "VI", order_of_pressures),
    Claim("a* and P_xy of IHS and EHS agree for α >= 0.7", "V C, Fig. 14", gases_agree_above),
    Claim(
        "normal stress differences and a3 of IHS and EHS differ for α <= 0.85",
        "V C, Figs. 14, 16",
        normal_stresses_differ_below,
    ),
    Claim("ζ exceeds ζ0 by a few percent", "V C, Fig. 16", cooling_rate_few_percent),
    Claim("ζ from the energy loss equals ζ from ⟨V12³⟩", "V B", energy_loss_agrees),
    Claim("the energy loss is much noisier than ⟨V12³⟩", "V B", energy_loss_noisier),
    Claim("a3 is practically zero at α = 0.9, -a3 > 0 at 0.5", "V B, Figs. 11, 12", a3_zero),
    Claim(
        "⟨V12³⟩/⟨V12³⟩0 = 1 + 0.27 a2 in both gases; 3/16 does not fit",
        "V C, Fig. 16",
        isotropic_slope_fails,
    ),
)
