"""The numbers that section V A quotes for the inhomogeneous problem, and ours."""

import numpy as np

from jdsmc import Estimate

from ..compare import Quoted, Span
from .measured import running_mean, settled
from .slab import BETA, CENTRE, HEIGHT, STARTS, TOP, Curve, Slabs, Start, reduced

TIMES = (0.13, 0.5, 1.0, 1.5, 2.0)
"""Times of the profiles, t/τ0."""

COLLISIONS: dict[Start, tuple[float, ...]] = {
    "equilibrium": (0.08, 0.4, 1.1, 2.1, 3.4),
    "nonequilibrium": (0.09, 0.5, 1.5, 2.8, 4.6),
}
"""What the paper quotes for s at these times."""

MARKS = ((4.0, 2.2), (40.0, 8.3), (50.0, 9.8))
"""Collisions per particle and times that the paper says belong together, from (3.5)."""


def _quoted_collisions() -> tuple[Quoted, ...]:
    return tuple(
        Quoted(
            f"s_{start}_{time}",
            f"s at t = {time:g} τ0, from {STARTS[start]}",
            value,
            0.005 if value < 0.1 else 0.05,
            "V A",
        )
        for start, values in COLLISIONS.items()
        for time, value in zip(TIMES, values, strict=True)
    )


NUMBERS = (
    *_quoted_collisions(),
    *(Quoted(f"time_{s:g}", f"t/τ0 when s = {s:g}", t, 0.05, "V A, Figs. 3, 4") for s, t in MARKS),
    Quoted("density_top", "s of the largest density difference", 1.0, 0.5, "V A, Fig. 3"),
    Quoted(
        "temperature_top", "s of the largest temperature difference", 0.15, 0.005, "V A, Fig. 3"
    ),
    Quoted("uniform", "s when the profiles are those of uniform shear", 4, 0.5, "V A, Fig. 3"),
    Quoted("settling_temperature", "s until T̄ is stationary", 50, 5, "V A, Fig. 4"),
    *(
        quoted
        for gas in ("ihs", "ehs")
        for quoted in (
            Quoted(f"temperature_{gas}", f"T̄_s/T0, {gas.upper()}", 147, 0.5, "V A, Fig. 4"),
            Quoted(f"shear_{gas}", f"-P̄_xy/n̄T̄, {gas.upper()}", 0.33, 0.005, "V A, Fig. 4"),
            Quoted(f"normal_{gas}", f"(P̄_xx-P̄_yy)/n̄T̄, {gas.upper()}", 0.24, 0.005, "V A, Fig. 4"),
        )
    ),
    Quoted("ratio", "s'/s for t > 4 τ0", 0.95, 0.005, "V A, Fig. 1"),
)


def values(slabs: Slabs) -> dict[str, Estimate | Span]:
    """Our value of every entry of `NUMBERS`, by its key."""
    found: dict[str, Estimate | Span] = {}
    for start in STARTS:
        early = slabs.series("early", "ihs", start)
        for time in TIMES:
            found[f"s_{start}_{time}"] = _collisions(early).at(time)
    late = slabs.series("late", "ihs")
    for s, _ in MARKS:
        source = slabs.series("early", "ihs") if s < 5 else late
        found[f"time_{s:g}"] = time_of(source, s)
    found |= {
        "density_top": peak(difference(slabs, "ihs", "density")),
        "temperature_top": peak(difference(slabs, "ihs", "temperature")),
        "uniform": uniform_from(slabs),
        "ratio": collision_ratio(slabs),
    }
    steady = ("temperature", "mean_temperature"), ("shear", "shear_stress")
    for key, name in (*steady, ("normal", "normal_stress_xy")):
        for gas in BETA:
            found[f"{key}_{gas}"] = slabs.steady(gas, name)
    relative = late["mean_temperature"].values / slabs.steady("ihs", "mean_temperature").value
    return found | {"settling_temperature": settled(late, relative, "clock")}


def _collisions(series) -> Curve:
    """s against time."""
    names = ("time", "collisions", "collisions_error")
    return Curve(*(series[name].values for name in names))


def time_of(series, collisions: float) -> Estimate:
    """The time at which s has a value, and its error from that of s."""
    time, clock = series["time"].values, series["collisions"].values
    found = float(np.interp(collisions, clock, time))
    rate = np.gradient(clock, time)
    error = np.interp(found, time, series["collisions_error"].values / rate)
    return Estimate(found, float(error))


def difference(slabs: Slabs, gas: str, name: str) -> Curve:
    """Centre minus top of a profile from (3.5), against s instead of time."""
    series = slabs.series("early", gas)
    curve = reduced(series, name)
    centre, top = curve.over(CENTRE), curve.over(TOP)
    error = np.hypot(centre.error, top.error)
    return Curve(series["clock"].values, centre.value - top.value, error)


def peak(curve: Curve) -> Span:
    """Where a difference is largest; the range is where it is within two errors of that."""
    size = np.abs(curve.value)
    best = int(np.argmax(size))
    near = curve.time[size > size[best] - 2.0 * curve.error[best]]
    return Span(
        float(curve.time[best]), float(near[0]), float(near[-1]), "largest [within two errors]"
    )


LIMITS = (0.05, 0.1, 0.03)
"""Distances from uniform shear that count as none: the middle, the loosest, the strictest."""


def uniform_from(slabs: Slabs) -> Span:
    """s from which n, T/T̄ and u_x/(aL/2) at the top are within 5% (10%, 3%) of uniform shear.

    Means over half a collision per particle on either side; IHS from (3.5).
    """
    series = slabs.series("early", "ihs")
    clock = series["clock"].values
    flow = reduced(series, "velocity_x").over(TOP).value / float(np.mean(HEIGHT[TOP]))
    parts = [reduced(series, name).over(TOP).value for name in ("density", "temperature")]
    distance = np.max([np.abs(running_mean(clock, part) - 1.0) for part in (flow, *parts)], axis=0)
    places = []
    for limit in LIMITS:
        outside = np.flatnonzero(distance > limit)
        places.append(float(clock[min(outside[-1] + 1, len(clock) - 1)]))
    return Span(*places, label="within 5% [10% to 3%]")


def collision_ratio(slabs: Slabs) -> Estimate:
    """s'/s at equal times, averaged over t > 4 τ0 of the run to the steady state."""
    time, ratio, error = ratio_curve(slabs)
    late = time > 4.0
    # accumulated numbers: their errors are almost the same at all times
    return Estimate(float(np.mean(ratio[late])), float(np.mean(error[late])))


def ratio_curve(slabs: Slabs) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, s'/s and its error, after the first 0.1 τ0."""
    ihs, ehs = (slabs.series("late", gas) for gas in ("ihs", "ehs"))
    time = ihs["time"].values
    time = time[(time > 0.1) & (time < min(14.0, ehs["time"].values[-1]))]
    parts = [_collisions(series) for series in (ihs, ehs)]
    s, other = (np.interp(time, part.time, part.value) for part in parts)
    errors = [np.interp(time, part.time, part.error) for part in parts]
    ratio = other / s
    return time, ratio, ratio * np.hypot(errors[0] / s, errors[1] / other)
