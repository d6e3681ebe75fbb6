"""Statements of section V A on the inhomogeneous problem."""

import numpy as np

from ..claims import Claim, Finding, percent
from .data import Measurements
from .slab import CENTRE, HEIGHT, STARTS, TOP, Slabs, reduced
from .slab_measured import TIMES, ratio_curve

PROFILES = {"velocity_x": "u_x/aL", "density": "n/n̄", "temperature": "T/T̄"}


class Both:
    """The inhomogeneous problem, and the homogeneous one to compare it with."""

    def __init__(self, slabs: Slabs, homogeneous: Measurements):
        self.slabs, self.homogeneous = slabs, homogeneous


def collided(data: Both) -> Finding:
    shares = []
    for start in STARTS:
        series = data.slabs.series("early", "ihs", start)
        shares.append(2.0 * float(np.interp(0.13, series["time"], series["collisions"])))
    text = " and ".join(percent(share) for share in shares)
    return Finding(
        f"2s = {text} from (3.5) and (3.6) at t = 0.13 τ0", bool(0.155 < min(shares) < 0.185)
    )


def fewer_collisions(data: Both) -> Finding:
    _, ratio, error = ratio_curve(data.slabs)
    high = ratio + 2.0 * error
    return Finding(
        f"s'/s from {ratio.min():.4f} to {ratio.max():.4f} for t > 0.1 τ0, errors "
        f"{error.min():.4f} to {error.max():.4f}",
        bool(np.mean(high < 1.0) > 0.9),
    )


def ratio_settles(data: Both) -> Finding:
    time, ratio, error = ratio_curve(data.slabs)
    early, late = time < 4.0, time > 4.0
    distance = np.abs(ratio / 0.95 - 1.0)
    texts = [
        f"{percent(distance[part].max())} (error {percent(error[part][np.argmax(distance[part])])})"
        for part in (early, late)
    ]
    beyond = (distance - 2.0 * error)[late].max()
    return Finding(
        f"largest |(s'/s)/0.95 - 1|: {texts[0]} before 4 τ0, {texts[1]} after",
        bool(beyond < 0.01 and distance[late].max() < distance[early].max()),
    )


def first_profiles(data: Both) -> Finding:
    parts = {}
    for name in PROFILES:
        curve = reduced(data.slabs.series("early", "ihs"), name)
        middle, edge = slice(10, 40), slice(49, 50)
        parts[name] = curve.over(middle).at(0.13), curve.over(edge).at(0.13)
    flow, density, heat = (parts[name] for name in PROFILES)
    return Finding(
        f"from (3.5) at 0.13 τ0, middle 30 layers and last layer: u_x/aL {flow[0]}, {flow[1]}; "
        f"n/n̄ {density[0]}, {density[1]}; T/T̄ {heat[0]}, {heat[1]}",
        bool(
            abs(flow[0].value) < 0.01
            and flow[1].value > 0.2
            and heat[1].value > 3.0 * heat[0].value
            and abs(density[1].value - 1.0) < 0.15
        ),
    )


def depopulated(data: Both) -> Finding:
    curve = reduced(data.slabs.series("early", "ihs"), "density").over(TOP)
    least = int(np.argmin(curve.value))
    final = curve.value[-20:].mean()
    return Finding(
        f"n/n̄ of the top layers falls to {curve.value[least]:.3f} ± {curve.error[least]:.3f} at t "
        f"= {curve.time[least]:.2f} τ0, and is {final:.3f} at the end",
        bool(curve.value[least] < 1.0 - 4 * curve.error[least] and abs(final - 1.0) < 0.03),
    )


def same_profiles(data: Both) -> Finding:
    """Root mean square difference of IHS and EHS over layers, less what the errors make."""
    texts, worst = [], 0.0
    for name, label in PROFILES.items():
        excess, noises = [], []
        for start in STARTS:
            for time in TIMES:
                ihs, ehs = (data.slabs.profile(g, start, time, name) for g in ("ihs", "ehs"))
                noise = np.mean(ihs.error**2 + ehs.error**2)
                noises.append(noise)
                excess.append(np.mean((ihs.value - ehs.value) ** 2) - noise)
        rms = float(np.sqrt(max(np.mean(excess), 0.0)))
        texts.append(f"{label} {rms:.4f} ({np.sqrt(np.mean(noises)):.4f})")
        worst = max(worst, rms)
    return Finding(
        f"rms difference beyond the errors (and these), all times, both starts: {', '.join(texts)}",
        worst < 0.03,
    )


def centre_at_rest(data: Both) -> Finding:
    curve = reduced(data.slabs.series("early", "ihs"), "velocity_x").over(CENTRE)
    score = curve.value[1:] / curve.error[1:]
    return Finding(
        f"|u_x/aL| <= {np.abs(curve.value).max():.3f}, root mean square "
        f"{np.sqrt(np.mean(score**2)):.1f} errors",
        bool(np.abs(curve.value).max() < 0.03),
    )


def top_follows_the_plane(data: Both) -> Finding:
    curve = reduced(data.slabs.series("early", "ihs"), "velocity_x").over(TOP)
    blocks = np.array([part.mean() for part in np.array_split(curve.value, 12)])
    falls = float(np.min(np.diff(blocks)))
    error = float(curve.error.mean() * np.sqrt(2.0 * 12 / len(curve.value)))
    last = blocks[-1] / np.mean(HEIGHT[TOP])
    return Finding(
        f"means over 12 equal parts of the run rise by at least {falls:.4f} ± {error:.4f} (u_x/aL) "
        f"from one to the next; the last is {last:.3f} of uniform shear",
        bool(falls > -4.0 * error),
    )


SHIFT = -1.0 / (4.0 * np.pi)
"""Final u_x/aL at y = 0 from (3.6).

Planes, collisions and drag keep Σ(v_x - a y) if Σ v_y = 0. At the start Σ v_x = 0, and (3.7) puts
the centre of mass at y = L/4π; once it is at 0, the flow has to be a (y - L/4π).
"""


def linear_profile(data: Both) -> Finding:
    texts, good = [], []
    for start, expected in zip(STARTS, (0.0, SHIFT), strict=True):
        curve = reduced(data.slabs.series("early", "ihs", start), "velocity_x")
        late = curve.time > 2.4
        offset = np.mean(curve.value[late] - HEIGHT)
        slope = np.mean(np.polyfit(HEIGHT, curve.value[late].T, 1)[0])
        bend = np.mean(curve.value[late], axis=0) - offset - slope * HEIGHT
        texts.append(
            f"from {STARTS[start]}: slope {slope:.3f} a, largest deviation from a line "
            f"{np.abs(bend).max():.3f} aL, u_x(0) = {offset:.4f} aL ({expected:.4f} by momentum)"
        )
        good.append(abs(offset) < 0.01)
    return Finding("; ".join(texts) + "; t > 2.4 τ0", all(good))


def stationary(data: Both) -> Finding:
    series = data.slabs.series("late", "ihs")
    clock, step = series["clock"].values, np.gradient(series["time"].values)
    texts, good = [], []
    for name, first in (("mean_temperature", 50), ("shear_stress", 40), ("normal_stress_xy", 40)):
        steady = data.slabs.steady("ihs", name)
        means = []
        for low, high in ((first - 20, first - 10), (first, first + 10)):
            inside = (clock > low) & (clock < high)
            means.append(np.average(series[name].values[inside], weights=step[inside]))
        before, after = (mean / steady.value - 1.0 for mean in means)
        texts.append(
            f"{name} {percent(before)} at {first - 20} < s < {first - 10}, {percent(after)} at "
            f"{first} < s < {first + 10} (error of its steady value "
            f"{percent(float(steady.error / steady.value))})"
        )
        good.append(abs(after) < 0.02)
    return Finding(f"from the steady value: {'; '.join(texts)}", all(good))


def proceeds_as_homogeneous(data: Both) -> Finding:
    """Reduced stresses at equal temperature, slab from (3.5) against the homogeneous gas."""
    scores, largest = [], 0.0
    for gas in ("ihs", "ehs"):
        slab = data.slabs.series("late", gas)
        flat = data.homogeneous.series(gas, 0.9, 4.0)
        for name in ("shear_stress", "normal_stress_xy"):
            for low, high in ((35.0, 60.0), (60.0, 90.0), (90.0, 120.0)):
                (a, da), (b, db) = (
                    _mean_between(series, temperature, name, low, high)
                    for series, temperature in ((slab, "mean_temperature"), (flat, "temperature"))
                )
                scores.append((a - b) / np.hypot(da, db))
                largest = max(largest, abs(a / b - 1.0))
    worst = float(np.max(np.abs(scores)))
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
    weights = np.gradient(np.log(rising))[inside]
    weights = np.maximum(weights, 0.0) / np.sum(np.maximum(weights, 0.0))
    error = np.sqrt(np.sum((weights * series[f"{name}_error"].values[inside]) ** 2))
    # records are about 0.1 τ(T) apart and stress lives for one: neighbours say the same
    spacing = np.mean(np.diff(series["collisions"].values[inside]))
    together = max(1.0, 0.6 / spacing)
    return np.sum(weights * series[name].values[inside]), error * np.sqrt(together)


def normal_stress_peaks(data: Both) -> Finding:
    text, latest = _peaks(data, "normal_stress_xy")
    return Finding(f"maximum of (P_xx-P_yy)/nT at s = {text}", latest < 1.5)


def shear_stress_peaks(data: Both) -> Finding:
    text, latest = _peaks(data, "shear_stress")
    return Finding(f"maximum of -P_xy/nT at s = {text}", latest < 1.5)


def _peaks(data: Both, name: str) -> tuple[str, float]:
    """Where a quantity is largest and where it is above 95% of that, for every start."""
    series = {
        equation: data.slabs.series("early", "ihs", start) for start, equation in STARTS.items()
    }
    series["(3.12)"] = data.homogeneous.series("ihs", 0.9, 4.0)
    texts, places = [], []
    for equation, one in series.items():
        clock, value = one["clock"].values, one[name].values
        best = int(np.argmax(value))
        near = clock[value > 0.95 * value[best]]
        places.append(float(clock[best]))
        texts.append(f"{places[-1]:.2f} from {equation} (95%: {near[0]:.2f} to {near[-1]:.2f})")
    return ", ".join(texts), max(places)


def memory_fades(data: Both) -> Finding:
    """Spread of the reduced stresses of the three starts at equal s."""
    all_series = [data.slabs.series("late", "ihs", start) for start in STARTS]
    all_series.append(data.homogeneous.series("ihs", 0.9, 4.0))
    spreads, texts = [], []
    for low, high in ((0.5, 1.5), (3.0, 5.0), (8.0, 12.0), (25.0, 35.0)):
        means = []
        for series in all_series:
            inside = (series["clock"].values > low) & (series["clock"].values < high)
            means.append(float(series["normal_stress_xy"].values[inside].mean()))
        spreads.append(max(means) - min(means))
        texts.append(f"{spreads[-1]:.3f} for {low:g} < s < {high:g}")
    return Finding(
        f"largest difference of (P_xx-P_yy)/nT among the three starts: {', '.join(texts)}",
        bool(spreads[0] > spreads[1] > spreads[2] > spreads[3]),
    )


CLAIMS = (
    Claim("by t = 0.13 τ0 about 16-18% of the particles have collided", "V A", collided),
    Claim("s'(t) < s(t)", "V A, Fig. 1", fewer_collisions),
    Claim(
        "s'/s fluctuates around 0.95 until 4 τ0 and stays very close to it after",
        "V A, Fig. 1",
        ratio_settles,
    ),
    Claim(
        "at 0.13 τ0 only the layers at the planes move, and are much hotter; n is unchanged",
        "V A, Fig. 2",
        first_profiles,
    ),
    Claim("the layers at the planes are first depopulated", "V A, Fig. 2", depopulated),
    Claim("profiles of IHS and EHS are practically identical", "V A, Fig. 2", same_profiles),
    Claim("the flow velocity at y = 0 fluctuates around zero", "V A, Fig. 3", centre_at_rest),
    Claim(
        "the flow at the top increases monotonically to that of the plane",
        "V A, Fig. 3",
        top_follows_the_plane,
    ),
    Claim("the flow ends as u_x = a y, whatever the start", "III, V A, Fig. 2", linear_profile),
    Claim("T̄ is stationary from s = 50 on, P̄_ij/n̄T̄ from s = 40 on", "V A, Fig. 4", stationary),
    Claim(
        "after s = 4 the evolution is that of the homogeneous problem",
        "V A, V B",
        proceeds_as_homogeneous,
    ),
    Claim(
        "(P_xx-P_yy)/nT has a sharp maximum in a first stage of about one collision",
        "V B, Fig. 9",
        normal_stress_peaks,
    ),
    Claim("the same of -P_xy/nT", "V B, Fig. 9", shear_stress_peaks),
    Claim(
        "the second stage becomes more and more independent of the initial state",
        "V B, Fig. 9",
        memory_fades,
    ),
)
