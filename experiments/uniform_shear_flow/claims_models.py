"""Statements on what the steady states are compared with: heated state, BGK, control gases."""

import numpy as np

from jdsmc.theory import bgk_shear_flow

from ..claims import Claim, Finding, decide, percent
from . import correlation
from .correlation import mean_over_rates
from .data import Measurements, Term, propagate
from .systems import FAST


def difference_like_white_noise(data: Measurements) -> Finding:
    alpha = np.array(data.restitutions())
    ihs, ehs = (mean_over_rates(data, gas, "a2") for gas in ("ihs", "ehs"))
    difference, error = ihs.value - ehs.value, np.hypot(ihs.error, ehs.error)
    expected = correlation.white_noise_a2(alpha)
    text = ", ".join(
        f"{d:.4f} ± {e:.4f} ({w:.4f}) at {a:g}"
        for a, d, e, w in zip(alpha, difference, error, expected, strict=True)
    )
    off = np.abs(difference - expected)
    return Finding(
        f"a2_IHS - a2_EHS (white noise): {text}", bool(np.all(off < 0.005 + 2.0 * error))
    )


def bgk_a3(data: Measurements) -> Finding:
    alpha = np.array(data.restitutions())
    model = -bgk_shear_flow.steady_state(alpha).a3
    ihs, ehs = (-mean_over_rates(data, gas, "a3").value for gas in ("ihs", "ehs"))
    text = ", ".join(
        f"{m:.3f} ({i:.3f}, {e:.3f}) at {a:g}"
        for a, m, i, e in zip(alpha, model, ihs, ehs, strict=True)
    )
    high = np.all(model[1:] > ihs[1:])
    return Finding(
        f"-a3 of BGK (IHS, EHS): {text}", bool(high and abs(model[0] / ihs[0] - 1.0) < 0.1)
    )


def bgk_a2(data: Measurements) -> Finding:
    alpha = np.array(data.restitutions())
    model = bgk_shear_flow.steady_state(alpha).a2
    ihs = mean_over_rates(data, "ihs", "a2").value
    text = ", ".join(
        f"{percent(m / i - 1, 0)} at {a:g}" for a, m, i in zip(alpha, model, ihs, strict=True)
    )
    return Finding(f"a2 of BGK over IHS - 1: {text}", bool(np.all(np.abs(model - ihs) < 0.1)))


def measured_drag_temperature(data: Measurements) -> Finding:
    terms = [Term(gas, 0.5, FAST, "temperature") for gas in ("ehs_measured", "ihs")]
    excess = propagate(lambda x, y: x / y - 1.0, [data.lookup(t) for t in terms])
    return Finding(
        f"T/T_IHS - 1 = ({100 * excess.value:.2f} ± {100 * excess.error:.2f})%",
        decide(*excess, positive=False),
    )


def _closer(data: Measurements, names: tuple[str, ...]) -> tuple[str, list[bool | None]]:
    """Distances to IHS of EHS with the measured and with the local drag, α = 0.5, a τ0 = 4."""
    texts, closer = [], []
    for name in names:
        ihs, local, measured = (
            data.lookup(Term(gas, 0.5, FAST, name)) for gas in ("ihs", "ehs", "ehs_measured")
        )
        gain = propagate(lambda i, b, m: abs(b - i) - abs(m - i), [ihs, local, measured])
        closer.append(decide(*gain))
        texts.append(f"{name} {local} -> {measured} (IHS {ihs})")
    return "; ".join(texts), closer


def measured_drag_closer(data: Measurements) -> Finding:
    text, closer = _closer(data, ("temperature", "shear_stress", "normal_stress_xy"))
    return Finding(text, None if None in closer else all(closer))


def measured_drag_not_closer(data: Measurements) -> Finding:
    text, closer = _closer(data, ("relative_speed_cubed", "a2"))
    return Finding(text, not any(closer))


def measured_drag_a3(data: Measurements) -> Finding:
    text, _ = _closer(data, ("a3",))
    ihs, local, measured = (
        data.steady(gas, 0.5, FAST)["a3"].item() for gas in ("ihs", "ehs", "ehs_measured")
    )
    gain = (measured - local) / (ihs - local)
    return Finding(f"{text}: {percent(gain, 0)} of the gap closed", bool(0 < gain < 0.4))


def viscosity_factor_worse(data: Measurements) -> Finding:
    texts, worse = [], []
    for alpha in data.restitutions("ehs_viscosity"):
        ihs, linear, control = (
            data.lookup(Term(gas, alpha, FAST, "reduced_viscosity"))
            for gas in ("ihs", "ehs", "ehs_viscosity")
        )
        loss = propagate(lambda i, b, c: abs(c - i) - abs(b - i), [ihs, linear, control])
        worse.append(decide(*loss))
        texts.append(f"α = {alpha}: {linear} linear, {control} control, {ihs} IHS")
    return Finding("η*_s: " + "; ".join(texts), None if None in worse else all(worse))


def bgk_closer_to_ihs(data: Measurements) -> Finding:
    texts, closer = [], []
    for name, field in (("η*", "reduced_viscosity"), ("-Ψ1", "first_viscometric")):
        distance = {gas: _distance_from_bgk(data, gas, field) for gas in ("ihs", "ehs")}
        texts.append(f"{name} {percent(distance['ihs'])} IHS, {percent(distance['ehs'])} EHS")
        closer.append(distance["ihs"] < distance["ehs"])
    return Finding("mean distance from BGK at equal a*_s: " + "; ".join(texts), all(closer))


def _distance_from_bgk(data: Measurements, gas: str, field: str) -> float:
    grid = np.linspace(0.3, 0.98, 100)
    model = bgk_shear_flow.steady_state(grid)
    reduced = mean_over_rates(data, gas, "reduced_shear_rate").value
    measured = mean_over_rates(data, gas, field).value
    inside = (reduced > model.reduced_shear_rate.min()) & (reduced < model.reduced_shear_rate.max())
    expected = np.interp(reduced, model.reduced_shear_rate[::-1], getattr(model, field)[::-1])
    return float(np.mean(np.abs(expected / measured - 1.0)[inside]))


CLAIMS = (
    Claim(
        "a2_IHS - a2_EHS is close to a2 of the white-noise state",
        "V C",
        difference_like_white_noise,
    ),
    Claim("BGK captures the increase of a2", "V C, Fig. 16", bgk_a2),
    Claim(
        "-a3 of BGK is too high in general, and by accident that of IHS at α = 0.5",
        "V C, Figs. 16, 18",
        bgk_a3,
    ),
    Claim(
        "EHS with the measured drag is slightly colder than IHS", "V B", measured_drag_temperature
    ),
    Claim("it is closer to IHS in T, P_xy, P_xx-P_yy", "V B, V C", measured_drag_closer),
    Claim("it is not closer in ⟨V12³⟩ and a2", "V C, Fig. 16", measured_drag_not_closer),
    Claim("the improvement of a3 is very small", "V C, Fig. 16", measured_drag_a3),
    Claim("β = (1+α)(2+α)/6 worsens the nonlinear viscosity", "VI", viscosity_factor_worse),
    Claim(
        "BGK is closer to IHS than to EHS in η*_s(a*_s), Ψ1(a*_s)",
        "V C, Fig. 15",
        bgk_closer_to_ihs,
    ),
)
