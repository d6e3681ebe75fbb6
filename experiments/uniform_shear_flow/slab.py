"""Our value of every number that section V A quotes for the inhomogeneous problem."""

import numpy as np

from jdsmc import Estimate

from ..case import estimate
from ..numbers import Span
from .cases import BOTH, STARTS
from .data import CENTRE, HEIGHT, PAPER, TOP, Curve, Shear, profile
from .measured import running_mean, settled

TIMES = (0.13, 0.5, 1.0, 1.5, 2.0)
"""Times of the profiles, t/τ0."""

LIMITS = (0.05, 0.1, 0.03)
"""Distances from uniform shear that count as none: the middle, the loosest, the strictest."""


def collisions(series) -> Curve:
    """s against time."""
    return Curve(series["time"].values, estimate(series, "collisions"))


def time_of(clock: float):
    """The time at which s has a value, and its error from that of s."""

    def of(data: Shear) -> Estimate:
        curve = collisions(data.slab("early" if clock < 5 else "late", "ihs"))
        found = float(np.interp(clock, curve.value, curve.time))
        error = curve.error / np.gradient(curve.value, curve.time)
        return Estimate(found, float(np.interp(found, curve.time, error)))

    return of


def peak(name: str):
    """Where centre minus top of a profile from (3.5) is largest, in s.

    The range is where it is within two errors of that.
    """

    def of(data: Shear) -> Span:
        series = data.slab("early", "ihs")
        centre, top = (profile(series, name).over(layers) for layers in (CENTRE, TOP))
        clock, size = series["clock"].values, np.abs(centre.value - top.value)
        best = int(np.argmax(size))
        near = clock[size > size[best] - 2.0 * np.hypot(centre.error, top.error)[best]]
        places = (clock[best], near[0], near[-1])
        return Span(*map(float, places), label="largest [within two errors]")

    return of


def uniform_from(data: Shear) -> Span:
    """s from which n, T/T̄ and u_x/(aL/2) at the top are within 5% (10%, 3%) of uniform shear.

    Means over half a collision per particle on either side; IHS from (3.5).
    """
    series = data.slab("early", "ihs")
    clock = series["clock"].values
    wanted = {"velocity_x": float(np.mean(HEIGHT[TOP])), "density": 1.0, "temperature": 1.0}
    parts = [profile(series, name).over(TOP).value / one for name, one in wanted.items()]
    distance = np.max([np.abs(running_mean(clock, part) - 1.0) for part in parts], axis=0)
    last = [np.flatnonzero(distance > limit)[-1] for limit in LIMITS]
    places = [float(clock[min(k + 1, len(clock) - 1)]) for k in last]
    return Span(*places, label="within 5% [10% to 3%]")


def ratio_curve(data: Shear) -> tuple[np.ndarray, Estimate]:
    """Times, and s'/s with its error, after the first 0.1 τ0."""
    ihs, ehs = (collisions(data.slab("late", gas)) for gas in BOTH)
    time = ihs.time[(ihs.time > 0.1) & (ihs.time < min(14.0, ehs.time[-1]))]
    return time, ehs.at(time) / ihs.at(time)


def collision_ratio(data: Shear) -> Estimate:
    """s'/s at equal times, averaged over t > 4 τ0 of the run to the steady state."""
    time, ratio = ratio_curve(data)
    value, error = ratio[time > 4.0]
    # accumulated numbers: their errors are almost the same at all times
    return Estimate(float(np.mean(value)), float(np.mean(error)))


def temperature_settling(data: Shear) -> Span:
    """s until the mean temperature is stationary."""
    late, final = data.slab("late", "ihs"), data.slab_steady("ihs", "mean_temperature")
    return settled(late, late["mean_temperature"].values / float(final), "clock")


PAPER.measures |= {
    f"s_{start}_{time:g}": lambda data, start=start, time=time: collisions(
        data.slab("early", "ihs", start)
    ).at(time)
    for start in STARTS
    for time in TIMES
}
PAPER.measures |= {
    f"slab_{name}_{gas}": lambda data, name=name, gas=gas: data.slab_steady(gas, name)
    for name in ("mean_temperature", "shear_stress", "normal_stress_xy")
    for gas in BOTH
}
PAPER.measures |= {f"time_{clock:g}": time_of(clock) for clock in (4.0, 40.0, 50.0)} | {
    "density_top": peak("density"),
    "temperature_top": peak("temperature"),
    "uniform": uniform_from,
    "settling_temperature": temperature_settling,
    "ratio": collision_ratio,
}
