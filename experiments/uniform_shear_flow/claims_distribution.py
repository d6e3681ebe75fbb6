"""Tests of the statements of section V C on the velocity distributions, Figs. 17 and 18."""

import numpy as np
import xarray as xr

from jdsmc import Estimate
from jdsmc.theory import bgk_shear_flow

from ..case import estimate
from ..claims import Finding, all_positive, percent, positive
from ..numbers import total
from .cases import BOTH, FAST
from .data import Shear
from .measured import tail
from .symmetry import misfit

FAR, FARTHEST = 2.5, 10.0
"""Velocities beyond this many v0 count as the tail of a marginal distribution."""

LEFT, RIGHT, FAST_TAIL = (-FARTHEST, -FAR), (FAR, FARTHEST), (3.0, FARTHEST)


def share(found: xr.Dataset, name: str, low: float, high: float) -> Estimate:
    """Integral of a density over the bins between two velocities in which any particle was seen."""
    centres = found["speed_bin" if name == "speed" else "velocity"].values
    inside = (centres > low) & (centres < high) & np.isfinite(found[f"{name}_error"].values)
    return total(estimate(found, name)[inside]) * (centres[1] - centres[0])


def equilibrium(name: str, c: np.ndarray) -> np.ndarray:
    """Local-equilibrium density: half a Gaussian's weight for a marginal, or F."""
    if name == "speed":
        return 4.0 / np.sqrt(np.pi) * c**2 * np.exp(-(c**2))
    return np.exp(-(c**2)) / (2.0 * np.sqrt(np.pi))


def bgk(name: str, restitution: float, c: np.ndarray) -> np.ndarray:
    """Density of the BGK model."""
    function = {"speed": bgk_shear_flow.speed_distribution}.get(name)
    return (function or getattr(bgk_shear_flow, name))(restitution, c)


def share_of(density, low: float, high: float) -> float:
    """The same integral of a formula."""
    width = 0.02
    return float(width * np.sum(density(np.arange(low + width / 2, high, width))))


def shares(data: Shear, alpha: float, name: str, low: float, high: float) -> list[Estimate]:
    """Those of IHS and EHS, averaged over the shear rates."""
    return [share(data.distribution(gas, alpha), name, low, high) for gas in BOTH]


def symmetric(data: Shear) -> Finding:
    (x, bins_x), (y, bins_y) = (misfit(data.results["symmetry"], axis) for axis in "xy")
    text = f"χ²/ν = {x:.2f} for g_x, {y:.2f} for g_y, over {bins_x} and {bins_y} bins"
    return Finding(text, max(x, y) < 1.6)


def asymmetric(data: Shear) -> Finding:
    texts, good = [], True
    for alpha in (0.9, 0.5):
        for name in ("marginal_x", "marginal_y"):
            value, error = estimate(data.distribution("ihs", alpha), name)
            half = len(value) // 2
            gap = value[:half][::-1] - value[half:]
            score = gap / np.maximum(np.hypot(error[:half][::-1], error[half:]), 1e-300)
            seen = np.abs(score) > 3.0
            good &= bool(np.all(score[seen] > 0))
            texts.append(f"{name} at {alpha}: {np.sum(score[seen] > 0)} of {np.sum(seen)} bins")
    return Finding("g(-|C|) > g(|C|) where they differ by 3 errors: " + ", ".join(texts), good)


def x_broader(data: Shear) -> Finding:
    ratios = {}
    for alpha in (0.9, 0.5):
        found = data.distribution("ihs", alpha)
        x, y = ((found["velocity"] ** 2 * found[f"marginal_{k}"]).sum() for k in "xy")
        ratios[alpha] = float(x / y)
    text = ", ".join(f"{ratio:.3f} at {alpha}" for alpha, ratio in ratios.items())
    return Finding(f"second moment of g_x over g_y: {text}", 1 < ratios[0.9] < ratios[0.5])


def ehs_more_populated(data: Shear) -> Finding:
    parts = ("marginal_x", -1.0, 0.0), ("marginal_y", -0.3, 0.0), ("speed", 0.0, 0.5)
    pairs = {part[0]: shares(data, 0.5, *part) for part in parts}
    return all_positive(
        "EHS/IHS - 1", {name: ehs / ihs - 1.0 for name, (ihs, ehs) in pairs.items()}
    )


def speed_less_distorted(data: Shear) -> Finding:
    distances = {}
    for alpha in (0.9, 0.5):
        found = data.distribution("ihs", alpha)
        for name in ("marginal_x", "marginal_y", "speed"):
            c = found["speed_bin" if name == "speed" else "velocity"].values
            weight = 1.0 if name == "speed" else 2.0
            off = np.abs(found[name].values - equilibrium(name, c))[np.abs(c) < 2]
            distances[alpha, name] = float(weight * np.sum(off) * (c[1] - c[0]))
    texts = [f"{name} {value:.3f} at {alpha}" for (alpha, name), value in distances.items()]
    good = distances[0.9, "speed"] < 0.7 * min(distances[0.9, f"marginal_{k}"] for k in "xy")
    return Finding("∫|g - g_eq| over |C| < 2, of each norm 1: " + ", ".join(texts), good)


def overpopulated_tails(data: Shear) -> Finding:
    found, texts, good = data.distribution("ihs", 0.5), [], True
    sides = ("marginal_x", LEFT), ("marginal_x", RIGHT), ("marginal_y", LEFT), ("marginal_y", RIGHT)
    for name, side in sides:
        ratio = float(share(found, name, *side))
        ratio /= share_of(lambda c, name=name: equilibrium(name, c), *side)
        texts.append(f"{name} {'C > ' if side == RIGHT else 'C < -'}{FAR}: {ratio:.2f}")
        good &= (ratio > 1.0) == (name == "marginal_x" or side == LEFT)
    return Finding("weight over the Maxwellian's, α = 0.5: " + ", ".join(texts), good)


def heavier_ihs_tails(data: Shear) -> Finding:
    excess = {}
    parts = ("marginal_x", LEFT, 1), ("speed", FAST_TAIL, 1), ("marginal_y", LEFT, -1)
    for name, side, sign in parts:
        ihs, ehs = shares(data, 0.5, name, *side)
        excess[name if sign > 0 else f"minus that of {name}"] = sign * (ihs / ehs - 1.0)
    return all_positive("tail weight IHS/EHS - 1", excess)


def _over_bgk(data: Shear, alpha: float, name: str, side: tuple[float, float]) -> float:
    measured = float(share(data.distribution("ihs", alpha), name, *side))
    return share_of(lambda c: bgk(name, alpha, c), *side) / measured


def bgk_exaggerates(data: Shear) -> Finding:
    tail_x = _over_bgk(data, 0.9, "marginal_x", LEFT)
    fast = _over_bgk(data, 0.9, "speed", FAST_TAIL)
    text = f"BGK/IHS at 0.9: g_x below -{FAR} {tail_x:.2f}, F above 3 {fast:.2f}"
    return Finding(text, tail_x > 1.3 and fast > 1.3)


def bgk_tail_by_accident(data: Shear) -> Finding:
    parts = ("speed", FAST_TAIL), ("marginal_x", RIGHT), ("marginal_y", LEFT)
    fast, right_x, left_y = (_over_bgk(data, 0.5, *part) for part in parts)
    return Finding(
        f"BGK/IHS at 0.5: F above 3 {fast:.2f}, g_x above {FAR} {right_x:.3f}, g_y below -{FAR} "
        f"{left_y:.2f}",
        abs(fast - 1) < 0.15 and right_x < 0.5 and left_y < 0.5,
    )


def gases_overlap(data: Shear) -> Finding:
    pairs = [shares(data, 0.9, "speed", *side) for side in ((0.0, 1.0), FAST_TAIL)]
    slow, fast = (ehs / ihs - 1.0 for ihs, ehs in pairs)
    return Finding(
        f"EHS/IHS - 1 of F at 0.9: C < 1 {percent(slow, 2)}, C > 3 {percent(fast, 0)}",
        abs(slow.value) < 0.02 and abs(fast.value) < 0.2,
    )


def measured_drag_tails(data: Shear) -> Finding:
    parts = [data.distribution(gas, 0.5, FAST) for gas in ("ihs", "ehs", "ehs_measured")]
    ihs, local, measured = (share(part, "speed", *FAST_TAIL) for part in parts)
    gap = (measured - local) / (ihs - local)
    return Finding(
        f"weight of F above 3: {local} local, {measured} measured drag, {ihs} IHS; "
        f"{percent(gap, 0)} of the gap closed",
        positive(0.5 - gap),
    )


def exponential_tails(data: Shear) -> Finding:
    texts, good = [], []
    for gas in BOTH:
        for alpha in (0.5, 0.9):
            found = tail(data, gas, alpha)
            one, two = found.misfits
            texts.append(
                f"{gas.upper()} {alpha}: μ = {found.exponent} on {found.first:.1f} < C < "
                f"{found.last:.1f}, slopes {' and '.join(map(str, found.slopes))}, χ²/ν {one:.1f} "
                f"for μ = 1, {two:.1f} for μ = 2"
            )
            if alpha == 0.5:  # at 0.9 the tail is too thin to tell
                good.append(one < two and abs(found.exponent.value - 1.0) < 0.5)
    return Finding("; ".join(texts), all(good))
