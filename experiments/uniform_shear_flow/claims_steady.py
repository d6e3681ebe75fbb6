"""Tests of the statements of sections III to VI on steady values: gases, models, controls."""

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import bgk_shear_flow
from jdsmc.units import VISCOSITY_TIME

from ..claims import Finding, all_positive, percent, positive
from .cases import BOTH, FAST, SLOW
from .data import Shear
from .measured import ISOTROPIC_SLOPE, over_ihs, slopes

INTRINSIC = (
    *("shear_stress", "normal_stress_xy", "normal_stress_zy"),
    *("relative_speed_cubed", "a2", "a3"),
)
"""Observables that depend on α alone."""


def listed(data: Shear, texts) -> str:
    """Texts, one for each restitution."""
    pairs = zip(texts, data.restitutions(), strict=True)
    return ", ".join(f"{text} at {alpha:g}" for text, alpha in pairs)


def energy_balance(data: Shear) -> Finding:
    """Exact in the steady state: (2/3) a (-P_xy/nT) = ζ, which nothing in the program imposes."""
    worst, significance = 0.0, 0.0
    for gas in BOTH:
        cooling = 2.0 * (1 - data.restitutions(gas) ** 2) / (3.0 * np.sqrt(np.pi)) * VISCOSITY_TIME
        reduced, stress, cubed = (
            data.against(gas, name, FAST)
            for name in ("reduced_shear_rate", "shear_stress", "relative_speed_cubed")
        )
        heating = (2 / 3) * reduced * stress / cooling
        off = (heating / cubed if gas == "ihs" else heating) - 1.0
        worst = max(worst, np.abs(off.value).max())
        significance = max(significance, np.abs(off.distance(0.0)).max())
    text = f"off by at most {percent(worst, 2)}, {significance:.1f} errors"
    return Finding(text, worst < 0.005)


def independent_of_shear_rate(data: Shear) -> Finding:
    scores = []
    for gas in BOTH:
        for name in INTRINSIC:
            fast, slow = (data.against(gas, name, rate) for rate in (FAST, SLOW))
            scores.append(fast.distance(slow))
        fast, slow = (data.against(gas, "temperature", rate) for rate in (FAST, SLOW))
        scores.append((fast / slow * (SLOW / FAST) ** 2).distance(1.0))
    scores = np.abs(np.concatenate(scores))
    share = float(np.mean(scores < 2.0))
    return Finding(
        f"{100 * share:.0f}% of {scores.size} values at both a within 2 combined errors, all "
        f"within {scores.max():.1f}",
        share > 0.85 and scores.max() < 5.0,
    )


def order_of_pressures(data: Shear) -> Finding:
    rows = []
    for gas in BOTH:
        xx, yy, zz = (data.against(gas, f"pressure_{k}").value for k in ("xx", "yy", "zz"))
        rows.append(np.array([xx - 1.0, 1.0 - zz, zz - yy]).min(axis=1))
    least = np.min(rows, axis=0)
    text = ", ".join(f"{x:.4f}" for x in least)
    return Finding(f"least P_xx-nT, nT-P_zz, P_zz-P_yy over nT: {text}", np.all(least > 0))


def gases_agree_above(data: Shear) -> Finding:
    texts, good, alpha = [], True, data.restitutions()
    for name in ("reduced_shear_rate", "shear_stress"):
        ihs, ehs = data.both(name)
        off = np.abs(ehs.value / ihs.value - 1.0)
        above, below = off[alpha >= 0.7 - 1e-9].max(), off[0]
        texts.append(f"{name} {percent(above)} for α >= 0.7, {percent(below)} at {alpha[0]}")
        good &= bool(above < 0.03 and above < below)
    return Finding("largest |EHS/IHS - 1|: " + "; ".join(texts), good)


def normal_stresses_differ_below(data: Shear) -> Finding:
    texts, off = [], {}
    for name in ("normal_stress_xy", "normal_stress_zy", "a3"):
        ihs, ehs = data.both(name)
        off[name], score = ehs.value / ihs.value - 1.0, np.abs(ihs.distance(ehs))
        pairs = zip(off[name], score, strict=True)
        texts.append(f"{name}: " + listed(data, (f"{percent(r, 0)} ({s:.0f}σ)" for r, s in pairs)))
    xy = np.abs(off["normal_stress_xy"])
    good = xy[0] > 0.1 and np.all(xy[data.restitutions() > 0.84] < 0.05)
    return Finding("EHS/IHS - 1 of " + "; ".join(texts), good)


def cooling_rate_few_percent(data: Shear) -> Finding:
    values = data.against("ihs", "relative_speed_cubed").value
    return Finding(
        f"ζ/ζ0 - 1 from {percent(values.min() - 1)} to {percent(values.max() - 1)}",
        values.min() > 1.0 and values.max() < 1.15,
    )


def _cooling(data: Shear) -> tuple[Estimate, Estimate]:
    """ζ/ζ0 from pairs, and from the energy lost."""
    names = ("relative_speed_cubed", "relative_speed_cubed_collisional")
    return data.against("ihs", names[0]), data.against("ihs", names[1])


def energy_loss_agrees(data: Shear) -> Finding:
    pairs, lost = _cooling(data)
    score, off = np.abs(lost.distance(pairs)).max(), np.abs(lost.value / pairs.value - 1.0).max()
    text = f"they differ by at most {percent(off, 2)}, {score:.1f} errors of the difference"
    return Finding(text, score < 3.5)


def energy_loss_noisier(data: Shear) -> Finding:
    pairs, lost = _cooling(data)
    ratio = float(np.sqrt(np.mean(lost.error**2) / np.mean(pairs.error**2)))
    return Finding(f"error of the energy loss over that of the pairs: {ratio:.2f}", ratio > 1.2)


def a3_zero(data: Shear) -> Finding:
    a3, alpha = data.against("ihs", "a3"), data.restitutions()
    quasi, strong = (-a3[int(np.argmin(np.abs(alpha - a)))] for a in (0.9, 0.5))
    return Finding(
        f"-a3 = {quasi.value:.4f} ± {quasi.error:.4f} at 0.9, {strong.value:.3f} ± "
        f"{strong.error:.3f} at 0.5",
        abs(quasi.value) < 0.03 * abs(strong.value) and strong.value > 0,
    )


def isotropic_slope_fails(data: Shear) -> Finding:
    found = slopes(data)
    texts = [
        f"{name}: k = {fit.slope} (point by point {fit.least:.3f} to {fit.largest:.3f}), "
        f"χ²/ν = {fit.misfit:.0f}, with 3/16 {fit.misfit_isotropic:.0f}"
        for name, fit in found.items()
    ]
    return Finding("; ".join(texts), found["both"].least > ISOTROPIC_SLOPE)


def white_noise_a2(alpha):
    """a2 of IHS heated by white noise, d = 3 (van Noije and Ernst 1998, the paper's [51])."""
    return 16 * (1 - alpha) * (1 - 2 * alpha**2) / (241 - 177 * alpha + 30 * (1 - alpha) * alpha**2)


def difference_like_white_noise(data: Shear) -> Finding:
    ihs, ehs = data.both("a2")
    (value, error), expected = ihs - ehs, white_noise_a2(data.restitutions())
    rows = zip(value, error, expected, strict=True)
    text = listed(data, (f"{d:.4f} ± {e:.4f} ({w:.4f})" for d, e, w in rows))
    good = np.all(np.abs(value - expected) < 0.005 + 2.0 * error)
    return Finding(f"a2_IHS - a2_EHS (white noise): {text}", good)


def bgk_a2(data: Shear) -> Finding:
    model = bgk_shear_flow.steady_state(data.restitutions()).a2
    ihs = data.against("ihs", "a2").value
    text = listed(data, (percent(off, 0) for off in model / ihs - 1))
    return Finding(f"a2 of BGK over IHS - 1: {text}", np.all(np.abs(model - ihs) < 0.1))


def bgk_a3(data: Shear) -> Finding:
    model = -bgk_shear_flow.steady_state(data.restitutions()).a3
    ihs, ehs = (-found.value for found in data.both("a3"))
    rows = zip(model, ihs, ehs, strict=True)
    text = listed(data, (f"{m:.3f} ({i:.3f}, {e:.3f})" for m, i, e in rows))
    good = np.all(model[1:] > ihs[1:]) and abs(model[0] / ihs[0] - 1.0) < 0.1
    return Finding(f"-a3 of BGK (IHS, EHS): {text}", good)


def measured_drag_temperature(data: Shear) -> Finding:
    excess = over_ihs("temperature", "ehs_measured")(data) - 1.0
    return Finding(f"T/T_IHS - 1 = {percent(excess, 2)}", positive(-excess))


def _closer(data: Shear, *names: str) -> Finding:
    """Is EHS with the measured drag closer to IHS than with the local one? α = 0.5, a τ0 = 4."""
    gain, shown, gases = {}, {}, ("ihs", "ehs", "ehs_measured")
    for name in names:
        ihs, local, measured = (data.steady(gas, 0.5, FAST, name) for gas in gases)
        gain[name] = abs(local - ihs) - abs(measured - ihs)
        shown[name] = f"{local} -> {measured} (IHS {ihs})"
    return all_positive("local -> measured drag", gain, shown)


def measured_drag_closer(data: Shear) -> Finding:
    return _closer(data, "temperature", "shear_stress", "normal_stress_xy")


def measured_drag_not_closer(data: Shear) -> Finding:
    found = [_closer(data, name) for name in ("relative_speed_cubed", "a2")]
    return Finding("; ".join(one.measured for one in found), not any(one.holds for one in found))


def measured_drag_a3(data: Shear) -> Finding:
    gases = ("ihs", "ehs", "ehs_measured")
    ihs, local, measured = (float(data.steady(gas, 0.5, FAST, "a3")) for gas in gases)
    gain = (measured - local) / (ihs - local)
    text = f"{_closer(data, 'a3').measured}: {percent(gain, 0)} of the gap closed"
    return Finding(text, 0 < gain < 0.4)


def viscosity_factor_worse(data: Shear) -> Finding:
    shown, worse, gases = {}, {}, ("ihs", "ehs", "ehs_viscosity")
    for alpha in data.restitutions("ehs_viscosity"):
        ihs, linear, control = (data.steady(g, alpha, FAST, "reduced_viscosity") for g in gases)
        worse[f"α = {alpha}:"] = abs(control - ihs) - abs(linear - ihs)
        shown[f"α = {alpha}:"] = f"{linear} linear, {control} control, {ihs} IHS"
    return all_positive("η*_s", worse, shown)


def bgk_closer_to_ihs(data: Shear) -> Finding:
    texts, closer = [], []
    for label, name in (("η*", "reduced_viscosity"), ("-Ψ1", "first_viscometric")):
        ihs, ehs = (_distance_from_bgk(data, gas, name) for gas in BOTH)
        texts.append(f"{label} {percent(ihs)} IHS, {percent(ehs)} EHS")
        closer.append(ihs < ehs)
    return Finding("mean distance from BGK at equal a*_s: " + "; ".join(texts), all(closer))


def _distance_from_bgk(data: Shear, gas: str, name: str) -> float:
    model = bgk_shear_flow.steady_state(np.linspace(0.3, 0.98, 100))
    rate = model.reduced_shear_rate
    reduced, measured = (data.against(gas, n).value for n in ("reduced_shear_rate", name))
    inside = (reduced > rate.min()) & (reduced < rate.max())
    expected = np.interp(reduced, rate[::-1], getattr(model, name)[::-1])
    return float(np.mean(np.abs(expected / measured - 1.0)[inside]))
