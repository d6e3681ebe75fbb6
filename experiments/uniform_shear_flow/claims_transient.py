"""Statements of section V B on the evolution toward the steady state."""

import numpy as np

from jdsmc.theory import bgk_shear_flow

from ..claims import Claim, Finding, percent
from .data import Measurements
from .measured import HYDRODYNAMIC, running_mean
from .systems import FAST, SLOW


def heating_or_cooling(data: Measurements) -> Finding:
    fast, slow = (data.steady_values("ihs", rate, "temperature").value for rate in (FAST, SLOW))
    return Finding(
        f"T_s/T0 >= {fast.min():.3g} at a τ0 = 4, <= {slow.max():.3g} at 0.1",
        bool(fast.min() > 1 > slow.max()),
    )


def collisions_agree(data: Measurements) -> Finding:
    worst = max(abs(_collision_ratio(data, 0.9, rate) - 1.0).max() for rate in (FAST, SLOW))
    return Finding(f"|(s'/β)/s - 1| <= {percent(worst, 2)} for s > 1", bool(worst < 0.02))


def _collision_ratio(data: Measurements, restitution: float, shear_rate: float) -> np.ndarray:
    """(s'/β)/s at equal times, after one collision per particle."""
    ihs, ehs = (data.series(gas, restitution, shear_rate) for gas in ("ihs", "ehs"))
    time, clock = ihs["time"].values, ihs["clock"].values
    compared = (clock > 1.0) & (time < ehs["time"].values[-1])
    return np.interp(time[compared], ehs["time"], ehs["clock"]) / clock[compared]


def ehs_hotter(data: Measurements) -> Finding:
    least, significance = {}, []
    for alpha in (0.5, 0.7):
        parts = [_temperature_excess(data, alpha, rate) for rate in (FAST, SLOW)]
        least[alpha] = min(float(excess.min()) for excess, _ in parts)
        significance += [float((excess / error).min()) for excess, error in parts]
    text = ", ".join(f"{percent(value)} at α = {alpha}" for alpha, value in least.items())
    worst = min(significance)
    return Finding(
        f"least T_EHS/T_IHS - 1 at s > 0.5: {text}; lowest in units of its error: {worst:.1f}",
        worst > -3.0,
    )


def _temperature_excess(data: Measurements, restitution: float, shear_rate: float):
    """T_EHS/T_IHS - 1 at equal times (running means over one collision), and its error."""
    ihs, ehs = (data.series(gas, restitution, shear_rate) for gas in ("ihs", "ehs"))
    time, clock = ihs["time"].values, ihs["clock"].values
    other = np.exp(np.interp(time, ehs["time"], np.log(ehs["temperature"])))
    relative = [
        part["temperature_error"].values / part["temperature"].values for part in (ihs, ehs)
    ]
    error = np.hypot(relative[0], np.interp(time, ehs["time"], relative[1]))
    compared = (clock > 0.5) & (time < ehs["time"].values[-1])
    excess = running_mean(clock, other / ihs["temperature"].values) - 1.0
    return excess[compared], running_mean(clock, error)[compared]


def bgk_overestimates_collisions(data: Measurements) -> Finding:
    ratios = []
    for gas in ("ihs", "ehs"):
        for alpha in (0.5, 0.7, 0.9):
            for rate in (FAST, SLOW):
                series = data.series(gas, alpha, rate)
                time = series["time"].values[1:]
                model = bgk_shear_flow.transient(alpha, rate, time).collisions
                ratios.append(model[-1] / series["clock"].values[-1] - 1.0)
    return Finding(
        f"at s = 60 BGK exceeds by {percent(min(ratios))} to {percent(max(ratios))}",
        min(ratios) > 0,
    )


def fewer_than_local_equilibrium(data: Measurements) -> Finding:
    late, steady = [], []
    for gas in ("ihs", "ehs"):
        for alpha in (0.5, 0.9):
            for rate in (FAST, SLOW):
                series = data.series(gas, alpha, rate)
                ratio = series["collision_ratio"].values.copy()
                ratio -= 2.0 * series["collision_ratio_error"].values
                late.append(ratio[series["clock"].values > 10.0].max())
        fast, slow = (data.steady_values(gas, r, "collision_rate_ratio") for r in (FAST, SLOW))
        steady.append((fast.value - slow.value) / np.hypot(fast.error, slow.error))
    worst = float(np.max(np.abs(steady)))
    return Finding(
        f"s/s0 less two errors <= {max(late):.4f} after s = 10; steady rates "
        f"at both a differ by at most {worst:.1f} errors",
        bool(max(late) < 1 and worst < 3.5),
    )


def bgk_temperature(data: Measurements) -> Finding:
    model = bgk_shear_flow.steady_state(0.5, FAST)
    ihs, ehs = (data.steady(gas, 0.5, FAST)["temperature"].item() for gas in ("ihs", "ehs"))
    over_ehs, over_ihs = model.temperature / ehs - 1.0, model.temperature / ihs - 1.0
    return Finding(
        f"T_BGK is {percent(over_ehs)} from EHS and {percent(over_ihs)} from IHS",
        bool(abs(over_ehs) < 0.05 and abs(over_ehs) < abs(over_ihs)),
    )


def kinetic_maximum(data: Measurements) -> Finding:
    places = {}
    for name in ("shear_stress", "normal_stress_xy", "relative_speed_cubed", "a2"):
        tops = []
        for alpha in (0.5, 0.9):
            series = data.series("ihs", alpha, FAST)
            tops.append(float(series["clock"].values[int(np.argmax(series[name].values))]))
        places[name] = max(tops)
    text = ", ".join(f"{name} {place:.2f}" for name, place in places.items())
    return Finding(f"largest s at the maximum: {text}", max(places.values()) < 2.0)


def curves_coincide(data: Measurements) -> Finding:
    edges = np.linspace(0.2, 1.6, 15)
    ihs, ehs = (_viscosity_curve(data, gas, edges) for gas in ("ihs", "ehs"))
    both = np.isfinite(ihs) & np.isfinite(ehs)
    centres = 0.5 * (edges[1:] + edges[:-1])
    model = _bgk_curve(centres)
    between = np.abs(ehs / ihs - 1.0)[both].max()
    upper = np.abs(ehs / ihs - 1.0)[both & (centres > 1.0)].max()
    from_model = np.abs(model / ihs - 1.0)[both & np.isfinite(model)].max()
    return Finding(
        f"EHS within {percent(between)} of IHS, {percent(upper)} for a* > 1; BGK within "
        f"{percent(from_model)} of IHS; "
        f"{centres[both][0]:.2f} < a* < {centres[both][-1]:.2f}",
        bool(between < 0.05),
    )


def _viscosity_curve(data: Measurements, gas: str, edges: np.ndarray) -> np.ndarray:
    """η* in bins of a*, α = 0.5, both shear rates, after the kinetic stage (Fig. 10)."""
    total, count = np.zeros(len(edges) - 1), np.zeros(len(edges) - 1)
    for rate in (FAST, SLOW):
        series = data.series(gas, 0.5, rate)
        late = series["clock"].values > HYDRODYNAMIC
        reduced = series["reduced_shear_rate"].values[late]
        total += np.histogram(reduced, edges, weights=series["reduced_viscosity"].values[late])[0]
        count += np.histogram(reduced, edges)[0]
    with np.errstate(invalid="ignore"):
        return total / count


def _bgk_curve(at: np.ndarray) -> np.ndarray:
    curve = np.full(at.shape, np.nan)
    for rate, last in ((FAST, 20.0), (SLOW, 400.0)):
        model = bgk_shear_flow.transient(0.5, rate, np.linspace(last / 2000, last, 2000))
        late = model.collisions > HYDRODYNAMIC
        order = np.argsort(model.reduced_shear_rate[late])
        x, y = (
            values[late][order] for values in (model.reduced_shear_rate, model.reduced_viscosity)
        )
        curve = np.where((at >= x[0]) & (at <= x[-1]), np.interp(at, x, y), curve)
    return curve


def fluctuations(data: Measurements) -> Finding:
    ratios = {}
    for name in ("relative_speed_cubed", "a2", "a3"):
        errors = [_late_error(data, gas, name) for gas in ("ihs", "ehs")]
        ratios[name] = errors[0] / errors[1]
    text = ", ".join(f"{name} {ratio:.2f}" for name, ratio in ratios.items())
    return Finding(f"α = 0.5, IHS over EHS: {text}", min(ratios.values()) > 1.0)


def _late_error(data: Measurements, gas: str, name: str) -> float:
    """Root mean square over both shear rates of the standard error of one record, s > 20."""
    squares = []
    for rate in (FAST, SLOW):
        series = data.series(gas, 0.5, rate)
        late = series["clock"].values > 20.0
        squares.append(np.mean(series[f"{name}_error"].values[late] ** 2))
    return float(np.sqrt(np.mean(squares)))


CLAIMS = (
    Claim("a τ0 = 4 heats and 0.1 cools the gas at every α", "V B", heating_or_cooling),
    Claim("s'/β and s agree almost perfectly at α = 0.9", "V B, Fig. 5", collisions_agree),
    Claim("EHS is slightly hotter than IHS at any time", "V B, Figs. 5, 8", ehs_hotter),
    Claim("BGK tends to overestimate s and s'/β", "V B, Fig. 5", bgk_overestimates_collisions),
    Claim(
        "s < s0 after a short time, tending to values independent of a",
        "V B, Fig. 6",
        fewer_than_local_equilibrium,
    ),
    Claim("BGK predicts the EHS temperature well at α = 0.5", "V B, Fig. 8", bgk_temperature),
    Claim(
        "at a τ0 = 4 all quantities peak in the kinetic stage, about one collision long",
        "V B, Figs. 7, 8, 11, 12",
        kinetic_maximum,
    ),
    Claim(
        "η*(a*) of IHS, EHS and BGK practically coincide for 0.2 < a* < 1.6, α = 0.5",
        "V B, Fig. 10",
        curves_coincide,
    ),
    Claim(
        "⟨V12³⟩, a2 and a3 fluctuate much more in IHS than in EHS",
        "V B, Figs. 11, 12",
        fluctuations,
    ),
)
