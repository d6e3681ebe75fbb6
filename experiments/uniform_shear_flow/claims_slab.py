"""Tests of the statements of section V A on the inhomogeneous problem."""

import numpy as np

from jdsmc import Estimate

from ..case import estimate
from ..claims import Finding, percent
from .cases import BOTH, FAST, SLAB_RESTITUTION, STARTS
from .data import CENTRE, HEIGHT, TOP, Shear, profile
from .slab import TIMES, ratio_curve

PROFILES = {"velocity_x": "u_x/aL", "density": "n/n̄", "temperature": "T/T̄"}

SHIFT = -1.0 / (4.0 * np.pi)
"""Final u_x/aL at y = 0 from (3.6).

Planes, collisions and drag keep Σ(v_x - a y) if Σ v_y = 0. At the start Σ v_x = 0, and (3.7) puts
the centre of mass at y = L/4π; once it is at 0, the flow has to be a (y - L/4π).
"""


def flat(data: Shear, gas: str = "ihs"):
    """The series of the homogeneous gas to compare with."""
    return data.series(gas, SLAB_RESTITUTION, FAST)


def collided(data: Shear) -> Finding:
    each = [data.slab("early", "ihs", start) for start in STARTS]
    shares = [2.0 * float(np.interp(0.13, one["time"], one["collisions"])) for one in each]
    text = " and ".join(percent(share) for share in shares)
    text = f"2s = {text} from (3.5) and (3.6) at t = 0.13 τ0"
    return Finding(text, 0.155 < min(shares) < 0.185)


def fewer_collisions(data: Shear) -> Finding:
    _, (ratio, error) = ratio_curve(data)
    return Finding(
        f"s'/s from {ratio.min():.4f} to {ratio.max():.4f} for t > 0.1 τ0, errors "
        f"{error.min():.4f} to {error.max():.4f}",
        np.mean(ratio + 2.0 * error < 1.0) > 0.9,
    )


def ratio_settles(data: Shear) -> Finding:
    time, (ratio, error) = ratio_curve(data)
    distance, late = np.abs(ratio / 0.95 - 1.0), time > 4.0
    texts = [
        f"{percent(distance[part].max())} (error {percent(error[part][np.argmax(distance[part])])})"
        for part in (~late, late)
    ]
    return Finding(
        f"largest |(s'/s)/0.95 - 1|: {texts[0]} before 4 τ0, {texts[1]} after",
        (distance - 2.0 * error)[late].max() < 0.01
        and distance[late].max() < distance[~late].max(),
    )


def first_profiles(data: Shear) -> Finding:
    early, parts = data.slab("early", "ihs"), {}
    for name in PROFILES:
        curve = profile(early, name)
        parts[name] = [curve.over(part).at(0.13) for part in (slice(10, 40), slice(49, 50))]
    flow, density, heat = parts.values()
    return Finding(
        f"from (3.5) at 0.13 τ0, middle 30 layers and last layer: u_x/aL {flow[0]}, {flow[1]}; "
        f"n/n̄ {density[0]}, {density[1]}; T/T̄ {heat[0]}, {heat[1]}",
        abs(flow[0].value) < 0.01
        and flow[1].value > 0.2
        and heat[1].value > 3.0 * heat[0].value
        and abs(density[1].value - 1.0) < 0.15,
    )


def depopulated(data: Shear) -> Finding:
    curve = profile(data.slab("early", "ihs"), "density").over(TOP)
    least, final = int(np.argmin(curve.value)), curve.value[-20:].mean()
    value, error = curve.value[least], curve.error[least]
    return Finding(
        f"n/n̄ of the top layers falls to {value:.3f} ± {error:.3f} at t "
        f"= {curve.time[least]:.2f} τ0, and is {final:.3f} at the end",
        value < 1.0 - 4 * error and abs(final - 1.0) < 0.03,
    )


def same_profiles(data: Shear) -> Finding:
    """Root mean square difference of IHS and EHS over layers, less what the errors make."""
    texts, worst = [], 0.0
    for name, label in PROFILES.items():
        apart = [_apart(data, start, time, name) for start in STARTS for time in TIMES]
        noise = float(np.mean([np.mean(one.error**2) for one in apart]))
        square = float(np.mean([np.mean(one.value**2) for one in apart]))
        rms = max(square - noise, 0.0) ** 0.5
        texts.append(f"{label} {rms:.4f} ({noise**0.5:.4f})")
        worst = max(worst, rms)
    return Finding(
        f"rms difference beyond the errors (and these), all times, both starts: {', '.join(texts)}",
        worst < 0.03,
    )


def _apart(data: Shear, start: str, time: float, name: str) -> Estimate:
    ihs, ehs = (profile(data.slab("early", gas, start), name).at(time) for gas in BOTH)
    return ihs - ehs


def centre_at_rest(data: Shear) -> Finding:
    curve = profile(data.slab("early", "ihs"), "velocity_x").over(CENTRE)
    score, largest = curve.value[1:] / curve.error[1:], np.abs(curve.value).max()
    text = f"|u_x/aL| <= {largest:.3f}, root mean square {np.sqrt(np.mean(score**2)):.1f} errors"
    return Finding(text, largest < 0.03)


def top_follows_the_plane(data: Shear) -> Finding:
    curve = profile(data.slab("early", "ihs"), "velocity_x").over(TOP)
    blocks = np.array([part.mean() for part in np.array_split(curve.value, 12)])
    falls = float(np.min(np.diff(blocks)))
    error = float(curve.error.mean() * np.sqrt(2.0 * 12 / len(curve.value)))
    last = blocks[-1] / np.mean(HEIGHT[TOP])
    return Finding(
        f"means over 12 equal parts of the run rise by at least {falls:.4f} ± {error:.4f} (u_x/aL) "
        f"from one to the next; the last is {last:.3f} of uniform shear",
        falls > -4.0 * error,
    )


def linear_profile(data: Shear) -> Finding:
    texts, good = [], []
    for (start, equation), expected in zip(STARTS.items(), (0.0, SHIFT), strict=True):
        curve = profile(data.slab("early", "ihs", start), "velocity_x")
        late = curve.value[curve.time > 2.4]
        offset, slope = np.mean(late - HEIGHT), np.mean(np.polyfit(HEIGHT, late.T, 1)[0])
        bend = np.mean(late, axis=0) - offset - slope * HEIGHT
        texts.append(
            f"from {equation}: slope {slope:.3f} a, largest deviation from a line "
            f"{np.abs(bend).max():.3f} aL, u_x(0) = {offset:.4f} aL ({expected:.4f} by momentum)"
        )
        good.append(abs(offset) < 0.01)
    return Finding("; ".join(texts) + "; t > 2.4 τ0", all(good))


def stationary(data: Shear) -> Finding:
    series, texts, good = data.slab("late", "ihs"), [], []
    clock, step = series["clock"].values, np.gradient(series["time"].values)
    for name, first in (("mean_temperature", 50), ("shear_stress", 40), ("normal_stress_xy", 40)):
        value, error = data.slab_steady("ihs", name)
        windows = (first - 20, first - 10), (first, first + 10)
        inside = [(clock > low) & (clock < high) for low, high in windows]
        off = [np.average(series[name][one], weights=step[one]) / value - 1.0 for one in inside]
        parts = [f"{percent(o)} at {a} < s < {b}" for o, (a, b) in zip(off, windows, strict=True)]
        texts.append(
            f"{name} {', '.join(parts)} (error of its steady value {percent(float(error / value))})"
        )
        good.append(abs(off[1]) < 0.02)
    return Finding(f"from the steady value: {'; '.join(texts)}", all(good))


def proceeds_as_homogeneous(data: Shear) -> Finding:
    """Reduced stresses at equal temperature, slab from (3.5) against the homogeneous gas."""
    worst, largest = 0.0, 0.0
    for gas in BOTH:
        slab = data.slab("late", gas)
        for name in ("shear_stress", "normal_stress_xy"):
            for low, high in ((35.0, 60.0), (60.0, 90.0), (90.0, 120.0)):
                a, da = _mean_between(slab, "mean_temperature", name, low, high)
                b, db = _mean_between(flat(data, gas), "temperature", name, low, high)
                worst = max(worst, abs(a - b) / np.hypot(da, db))
                largest = max(largest, abs(a / b - 1.0))
    return Finding(
        f"-P_xy/nT and (P_xx-P_yy)/nT of both gases where T/T0 is in 35 to 60, 60 to 90, 90 to 120 "
        f"(s from about 4): within {percent(largest)} of the homogeneous gas, {worst:.1f} errors",
        worst < 3.5,
    )


def _mean_between(series, temperature: str, name: str, low: float, high: float):
    """Mean over ln T of a quantity while T rises from low to high; records as independent."""
    rising = series[temperature].values
    last = int(np.argmax(rising > high))
    inside = np.flatnonzero((rising[:last] > low) & (rising[:last] <= high))
    weights = np.maximum(np.gradient(np.log(rising))[inside], 0.0)
    weights = weights / np.sum(weights)
    value, error = estimate(series, name)[inside]
    # records are about 0.1 τ(T) apart and stress lives for one: neighbours say the same
    spacing = np.mean(np.diff(series["collisions"].values[inside]))
    together = np.sqrt(max(1.0, 0.6 / spacing))
    return np.sum(weights * value), np.sqrt(np.sum((weights * error) ** 2)) * together


def _starts(data: Shear, stage: str) -> dict:
    """The series of IHS from the three initial states, by equation."""
    return {eq: data.slab(stage, "ihs", s) for s, eq in STARTS.items()} | {"(3.12)": flat(data)}


def _peaks(data: Shear, name: str, label: str) -> Finding:
    """Where a quantity is largest and where it is above 95% of that, for every start."""
    texts, places = [], []
    for equation, one in _starts(data, "early").items():
        clock, value = one["clock"].values, one[name].values
        best = int(np.argmax(value))
        near = clock[value > 0.95 * value[best]]
        places.append(float(clock[best]))
        texts.append(f"{places[-1]:.2f} from {equation} (95%: {near[0]:.2f} to {near[-1]:.2f})")
    return Finding(f"maximum of {label} at s = {', '.join(texts)}", max(places) < 1.5)


def normal_stress_peaks(data: Shear) -> Finding:
    return _peaks(data, "normal_stress_xy", "(P_xx-P_yy)/nT")


def shear_stress_peaks(data: Shear) -> Finding:
    return _peaks(data, "shear_stress", "-P_xy/nT")


def memory_fades(data: Shear) -> Finding:
    """Spread of the reduced stresses of the three starts at equal s."""
    spreads, texts = [], []
    for low, high in ((0.5, 1.5), (3.0, 5.0), (8.0, 12.0), (25.0, 35.0)):
        means = []
        for series in _starts(data, "late").values():
            inside = (series["clock"].values > low) & (series["clock"].values < high)
            means.append(float(series["normal_stress_xy"].values[inside].mean()))
        spreads.append(max(means) - min(means))
        texts.append(f"{spreads[-1]:.3f} for {low:g} < s < {high:g}")
    return Finding(
        f"largest difference of (P_xx-P_yy)/nT among the three starts: {', '.join(texts)}",
        spreads[0] > spreads[1] > spreads[2] > spreads[3],
    )
