"""Tests of the statements of section V B on the evolution toward the steady state."""

import numpy as np

from jdsmc import Estimate
from jdsmc.theory import bgk_shear_flow

from ..case import estimate
from ..claims import Finding, percent
from .cases import BOTH, FAST, SLOW
from .data import Shear
from .measured import HYDRODYNAMIC, running_mean

RATES = (FAST, SLOW)


def heating_or_cooling(data: Shear) -> Finding:
    fast, slow = (data.against("ihs", "temperature", rate).value for rate in RATES)
    return Finding(
        f"T_s/T0 >= {fast.min():.3g} at a τ0 = 4, <= {slow.max():.3g} at 0.1",
        fast.min() > 1 > slow.max(),
    )


def collisions_agree(data: Shear) -> Finding:
    """(s'/β)/s at equal times, after one collision per particle."""
    worst = 0.0
    for rate in RATES:
        ihs, ehs = (data.series(gas, 0.9, rate) for gas in BOTH)
        time, clock = ihs["time"].values, ihs["clock"].values
        compared = (clock > 1.0) & (time < ehs["time"].values[-1])
        other = np.interp(time[compared], ehs["time"], ehs["clock"])
        worst = max(worst, np.abs(other / clock[compared] - 1.0).max())
    return Finding(f"|(s'/β)/s - 1| <= {percent(worst, 2)} for s > 1", worst < 0.02)


def ehs_hotter(data: Shear) -> Finding:
    least, lowest = {}, []
    for alpha in (0.5, 0.7):
        parts = [_temperature_excess(data, alpha, rate) for rate in RATES]
        least[alpha] = min(float(part.value.min()) for part in parts)
        lowest += [float((part.value / part.error).min()) for part in parts]
    text = ", ".join(f"{percent(value)} at α = {alpha}" for alpha, value in least.items())
    return Finding(
        f"least T_EHS/T_IHS - 1 at s > 0.5: {text}; lowest in units of its error: "
        f"{min(lowest):.1f}",
        min(lowest) > -3.0,
    )


def _temperature_excess(data: Shear, restitution: float, shear_rate: float) -> Estimate:
    """T_EHS/T_IHS - 1 at equal times (running means over one collision)."""
    ihs, ehs = (data.series(gas, restitution, shear_rate) for gas in BOTH)
    time, clock = ihs["time"].values, ihs["clock"].values
    logs = [estimate(part, "temperature").map(np.log) for part in (ihs, ehs)]
    other = [np.interp(time, ehs["time"], part) for part in logs[1]]
    compared = (clock > 0.5) & (time < ehs["time"].values[-1])
    excess = running_mean(clock, np.exp(other[0] - logs[0].value)) - 1.0
    error = running_mean(clock, np.hypot(logs[0].error, other[1]))
    return Estimate(excess[compared], error[compared])


def bgk_overestimates_collisions(data: Shear) -> Finding:
    ratios = []
    for gas in BOTH:
        for alpha in (0.5, 0.7, 0.9):
            for rate in RATES:
                series = data.series(gas, alpha, rate)
                model = bgk_shear_flow.transient(alpha, rate, series["time"].values[1:])
                ratios.append(model.collisions[-1] / series["clock"].values[-1] - 1.0)
    text = f"at s = 60 BGK exceeds by {percent(min(ratios))} to {percent(max(ratios))}"
    return Finding(text, min(ratios) > 0)


def fewer_than_local_equilibrium(data: Shear) -> Finding:
    late, worst = [], 0.0
    for gas in BOTH:
        for alpha in (0.5, 0.9):
            for rate in RATES:
                series = data.series(gas, alpha, rate)
                ratio, error = estimate(series, "collision_ratio")
                late.append((ratio - 2.0 * error)[series["clock"].values > 10.0].max())
        fast, slow = (data.against(gas, "collision_rate_ratio", rate) for rate in RATES)
        worst = max(worst, np.abs(fast.distance(slow)).max())
    return Finding(
        f"s/s0 less two errors <= {max(late):.4f} after s = 10; steady rates at both a differ by "
        f"at most {worst:.1f} errors",
        max(late) < 1 and worst < 3.5,
    )


def bgk_temperature(data: Shear) -> Finding:
    model = float(np.asarray(bgk_shear_flow.steady_state(0.5, FAST).temperature))
    ihs, ehs = (model / float(data.steady(g, 0.5, FAST, "temperature")) - 1.0 for g in BOTH)
    return Finding(
        f"T_BGK is {percent(ehs)} from EHS and {percent(ihs)} from IHS",
        abs(ehs) < 0.05 and abs(ehs) < abs(ihs),
    )


def kinetic_maximum(data: Shear) -> Finding:
    places = {}
    for name in ("shear_stress", "normal_stress_xy", "relative_speed_cubed", "a2"):
        both = [data.series("ihs", alpha, FAST) for alpha in (0.5, 0.9)]
        places[name] = max(float(one["clock"][int(np.argmax(one[name].values))]) for one in both)
    text = ", ".join(f"{name} {place:.2f}" for name, place in places.items())
    return Finding(f"largest s at the maximum: {text}", max(places.values()) < 2.0)


def curves_coincide(data: Shear) -> Finding:
    edges = np.linspace(0.2, 1.6, 15)
    ihs, ehs = (_viscosity_curve(data, gas, edges) for gas in BOTH)
    both, centres = np.isfinite(ihs) & np.isfinite(ehs), 0.5 * (edges[1:] + edges[:-1])
    model = _bgk_curve(centres)
    between = np.abs(ehs / ihs - 1.0)
    upper = between[both & (centres > 1.0)].max()
    from_model = np.abs(model / ihs - 1.0)[both & np.isfinite(model)].max()
    return Finding(
        f"EHS within {percent(between[both].max())} of IHS, {percent(upper)} for a* > 1; BGK "
        f"within {percent(from_model)} of IHS; "
        f"{centres[both][0]:.2f} < a* < {centres[both][-1]:.2f}",
        between[both].max() < 0.05,
    )


def _viscosity_curve(data: Shear, gas: str, edges: np.ndarray) -> np.ndarray:
    """η* in bins of a*, α = 0.5, both shear rates, after the kinetic stage (Fig. 10)."""
    parts = [data.series(gas, 0.5, rate) for rate in RATES]
    parts = [part.isel(sample=part["clock"].values > HYDRODYNAMIC) for part in parts]
    names = ("reduced_shear_rate", "reduced_viscosity")
    reduced, viscosity = (np.concatenate([part[name] for part in parts]) for name in names)
    with np.errstate(invalid="ignore"):
        total = np.histogram(reduced, edges, weights=viscosity)[0]
        return total / np.histogram(reduced, edges)[0]


def _bgk_curve(at: np.ndarray) -> np.ndarray:
    curve = np.full(at.shape, np.nan)
    for rate, last in ((FAST, 20.0), (SLOW, 400.0)):
        model = bgk_shear_flow.transient(0.5, rate, np.linspace(last / 2000, last, 2000))
        late = model.collisions > HYDRODYNAMIC
        order = np.argsort(model.reduced_shear_rate[late])
        x, y = (v[late][order] for v in (model.reduced_shear_rate, model.reduced_viscosity))
        curve = np.where((at >= x[0]) & (at <= x[-1]), np.interp(at, x, y), curve)
    return curve


def fluctuations(data: Shear) -> Finding:
    """Root mean square over both shear rates of the standard error of one record, s > 20."""

    def error(gas: str, name: str) -> float:
        parts = [data.series(gas, 0.5, rate) for rate in RATES]
        late = [part[f"{name}_error"].values[part["clock"].values > 20.0] for part in parts]
        return float(np.sqrt(np.mean([np.mean(one**2) for one in late])))

    names = ("relative_speed_cubed", "a2", "a3")
    ratios = {name: error("ihs", name) / error("ehs", name) for name in names}
    text = ", ".join(f"{name} {ratio:.2f}" for name, ratio in ratios.items())
    return Finding(f"α = 0.5, IHS over EHS: {text}", min(ratios.values()) > 1.0)
