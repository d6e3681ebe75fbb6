"""Statements of section V C on the velocity distributions, Figs. 17 and 18."""

import numpy as np
import xarray as xr

from jdsmc import Estimate
from jdsmc.theory import bgk_shear_flow

from ..claims import Claim, Finding, decide
from . import tails
from .data import Measurements, propagate
from .systems import FAST

FAR = 2.5
"""Velocities beyond this many v0 count as the tail of a marginal distribution."""


def share(found: xr.Dataset, name: str, low: float, high: float) -> Estimate:
    """Integral of a density over the bins between two velocities."""
    axis = "speed_bin" if name == "speed" else "velocity"
    centres = found[axis].values
    inside = (centres > low) & (centres < high)
    width = centres[1] - centres[0]
    error = np.sqrt(np.sum(found[f"{name}_error"].values[inside] ** 2))
    return Estimate(float(width * np.sum(found[name].values[inside])), float(width * error))


def equilibrium(name: str, c: np.ndarray) -> np.ndarray:
    """Local-equilibrium density: half a Gaussian's weight for a marginal, or F."""
    if name == "speed":
        return 4.0 / np.sqrt(np.pi) * c**2 * np.exp(-(c**2))
    return np.exp(-(c**2)) / (2.0 * np.sqrt(np.pi))


def bgk(name: str, restitution: float, c: np.ndarray) -> np.ndarray:
    """Density of the BGK model."""
    functions = {
        "marginal_x": bgk_shear_flow.marginal_x,
        "marginal_y": bgk_shear_flow.marginal_y,
        "speed": bgk_shear_flow.speed_distribution,
    }
    return functions[name](restitution, c)


def share_of(density, low: float, high: float) -> float:
    """The same integral of a formula."""
    width = 0.02
    centres = np.arange(low + width / 2, high, width)
    return float(width * np.sum(density(centres)))


def symmetric(data: Measurements) -> Finding:
    found = data.symmetry
    return Finding(
        f"χ²/ν = {found['misfit_x']:.2f} for g_x, {found['misfit_y']:.2f} for g_y, over "
        f"{found['bins_x']} and {found['bins_y']} bins",
        bool(max(found["misfit_x"], found["misfit_y"]) < 1.6),
    )


def asymmetric(data: Measurements) -> Finding:
    texts, good = [], True
    for alpha in (0.9, 0.5):
        found = data.mean_distribution("ihs", alpha)
        for name in ("marginal_x", "marginal_y"):
            values, errors = found[name].values, found[f"{name}_error"].values
            half = len(values) // 2
            gap = values[:half][::-1] - values[half:]
            score = gap / np.maximum(np.hypot(errors[:half][::-1], errors[half:]), 1e-300)
            seen = np.abs(score) > 3.0
            good &= bool(np.all(score[seen] > 0))
            texts.append(f"{name} at {alpha}: {np.sum(score[seen] > 0)} of {np.sum(seen)} bins")
    return Finding("g(-|C|) > g(|C|) where they differ by 3 errors: " + ", ".join(texts), good)


def x_broader(data: Measurements) -> Finding:
    ratios = {}
    for alpha in (0.9, 0.5):
        found = data.mean_distribution("ihs", alpha)
        c = found["velocity"].values
        ratios[alpha] = float(
            np.sum(c**2 * found["marginal_x"]) / np.sum(c**2 * found["marginal_y"])
        )
    text = ", ".join(f"{ratio:.3f} at {alpha}" for alpha, ratio in ratios.items())
    return Finding(f"second moment of g_x over g_y: {text}", 1 < ratios[0.9] < ratios[0.5])


def ehs_more_populated(data: Measurements) -> Finding:
    ihs, ehs = (data.mean_distribution(gas, 0.5) for gas in ("ihs", "ehs"))
    texts, good = [], []
    for name, low, high in (
        ("marginal_x", -1.0, 0.0),
        ("marginal_y", -0.3, 0.0),
        ("speed", 0.0, 0.5),
    ):
        excess = propagate(
            lambda x, y: y / x - 1.0, [share(g, name, low, high) for g in (ihs, ehs)]
        )
        texts.append(f"{name} ({100 * excess.value:.2f} ± {100 * excess.error:.2f})%")
        good.append(decide(*excess))
    return Finding("EHS/IHS - 1: " + ", ".join(texts), None if None in good else all(good))


def speed_less_distorted(data: Measurements) -> Finding:
    distances = {}
    for alpha in (0.9, 0.5):
        found = data.mean_distribution("ihs", alpha)
        for name in ("marginal_x", "marginal_y", "speed"):
            c = found["speed_bin" if name == "speed" else "velocity"].values
            weight = 1.0 if name == "speed" else 2.0
            off = np.abs(found[name].values - equilibrium(name, c))[np.abs(c) < 2]
            distances[alpha, name] = float(weight * np.sum(off) * (c[1] - c[0]))
    texts = [f"{name} {value:.3f} at {alpha}" for (alpha, name), value in distances.items()]
    good = distances[0.9, "speed"] < 0.7 * min(distances[0.9, f"marginal_{k}"] for k in "xy")
    return Finding("∫|g - g_eq| over |C| < 2, of each norm 1: " + ", ".join(texts), good)


def overpopulated_tails(data: Measurements) -> Finding:
    found = data.mean_distribution("ihs", 0.5)
    texts, good = [], True
    for name, side, expected in (
        ("marginal_x", -1, True),
        ("marginal_x", 1, True),
        ("marginal_y", -1, True),
        ("marginal_y", 1, False),
    ):
        low, high = (FAR, 10.0) if side > 0 else (-10.0, -FAR)
        ratio = share(found, name, low, high).value
        ratio /= share_of(lambda c, n=name: equilibrium(n, c), low, high)
        texts.append(f"{name} {'C > ' if side > 0 else 'C < -'}{FAR}: {ratio:.2f}")
        good &= bool((ratio > 1.0) == expected)
    return Finding("weight over the Maxwellian's, α = 0.5: " + ", ".join(texts), good)


def heavier_ihs_tails(data: Measurements) -> Finding:
    ihs, ehs = (data.mean_distribution(gas, 0.5) for gas in ("ihs", "ehs"))
    texts, good = [], []
    for name, low, high, positive in (
        ("marginal_x", -10.0, -FAR, True),
        ("speed", 3.0, 10.0, True),
        ("marginal_y", -10.0, -FAR, False),
    ):
        excess = propagate(
            lambda x, y: x / y - 1.0, [share(g, name, low, high) for g in (ihs, ehs)]
        )
        texts.append(f"{name} ({100 * excess.value:.1f} ± {100 * excess.error:.1f})%")
        good.append(decide(*excess, positive=positive))
    return Finding(
        "tail weight IHS/EHS - 1: " + ", ".join(texts), None if None in good else all(good)
    )


def _over_bgk(data: Measurements, alpha: float, name: str, low: float, high: float) -> float:
    measured = share(data.mean_distribution("ihs", alpha), name, low, high).value
    return share_of(lambda c: bgk(name, alpha, c), low, high) / measured


def bgk_exaggerates(data: Measurements) -> Finding:
    tail_x = _over_bgk(data, 0.9, "marginal_x", -10.0, -FAR)
    tail = _over_bgk(data, 0.9, "speed", 3.0, 10.0)
    return Finding(
        f"BGK/IHS at 0.9: g_x below -{FAR} {tail_x:.2f}, F above 3 {tail:.2f}",
        bool(tail_x > 1.3 and tail > 1.3),
    )


def bgk_tail_by_accident(data: Measurements) -> Finding:
    tail = _over_bgk(data, 0.5, "speed", 3.0, 10.0)
    right_x = _over_bgk(data, 0.5, "marginal_x", FAR, 10.0)
    left_y = _over_bgk(data, 0.5, "marginal_y", -10.0, -FAR)
    return Finding(
        f"BGK/IHS at 0.5: F above 3 {tail:.2f}, g_x above {FAR} {right_x:.3f}, g_y below -{FAR} "
        f"{left_y:.2f}",
        bool(abs(tail - 1) < 0.15 and right_x < 0.5 and left_y < 0.5),
    )


def gases_overlap(data: Measurements) -> Finding:
    ihs, ehs = (data.mean_distribution(gas, 0.9) for gas in ("ihs", "ehs"))
    ratios = propagate(lambda x, y: y / x - 1.0, [share(g, "speed", 0.0, 1.0) for g in (ihs, ehs)])
    tail = propagate(lambda x, y: y / x - 1.0, [share(g, "speed", 3.0, 10.0) for g in (ihs, ehs)])
    return Finding(
        f"EHS/IHS - 1 of F at 0.9: C < 1 ({100 * ratios.value:.2f} ± {100 * ratios.error:.2f})%, "
        f"C > 3 ({100 * tail.value:.0f} ± {100 * tail.error:.0f})%",
        bool(abs(ratios.value) < 0.02 and abs(tail.value) < 0.2),
    )


def measured_drag_tails(data: Measurements) -> Finding:
    parts = [data.distribution(gas, 0.5, FAST) for gas in ("ihs", "ehs", "ehs_measured")]
    ihs, local, measured = (share(part, "speed", 3.0, 10.0) for part in parts)
    gap = propagate(lambda i, b, m: (m - b) / (i - b), [ihs, local, measured])
    return Finding(
        f"weight of F above 3: {local} local, {measured} measured drag, {ihs} IHS; "
        f"({100 * gap.value:.0f} ± {100 * gap.error:.0f})% of the gap closed",
        decide(0.5 - gap.value, gap.error),
    )


def exponential_tails(data: Measurements) -> Finding:
    texts, good = [], []
    for gas in ("ihs", "ehs"):
        for alpha in (0.5, 0.9):
            tail = tails.exponent(data, gas, alpha)
            slopes = " and ".join(str(slope) for slope in tail.slopes)
            texts.append(
                f"{gas.upper()} {alpha}: μ = {tail.exponent} on {tail.first:.1f} < C < "
                f"{tail.last:.1f}, slopes {slopes}, χ²/ν {tail.misfit_exponential:.1f} for μ = 1, "
                f"{tail.misfit_gaussian:.1f} for μ = 2"
            )
            if alpha == 0.5:  # at 0.9 the tail is too thin to tell
                nearer = tail.misfit_exponential < tail.misfit_gaussian
                good.append(nearer and abs(tail.exponent.value - 1.0) < 0.5)
    return Finding("; ".join(texts), bool(all(good)))


CLAIMS = (
    Claim("g(C) of one half is g(-C) of the other (3.21)", "V C", symmetric),
    Claim("g_x and g_y are larger at -|C| than at |C|", "V C, Fig. 17", asymmetric),
    Claim("g_x is broader than g_y, more so at α = 0.5", "V C, Fig. 17", x_broader),
    Claim(
        "at α = 0.5 EHS is more populated at -1 < C_x < 0, -0.3 < C_y < 0, C < 0.5",
        "V C, Fig. 17",
        ehs_more_populated,
    ),
    Claim(
        "in the thermal region F is much less distorted than g_x and g_y, especially at 0.9",
        "V C, Fig. 17",
        speed_less_distorted,
    ),
    Claim(
        "both tails of g_x are overpopulated, of g_y only C_y < 0",
        "V C, Fig. 18",
        overpopulated_tails,
    ),
    Claim(
        "at α = 0.5 the tails of g_x and F are larger for IHS, those of g_y for EHS",
        "V C, Fig. 18",
        heavier_ihs_tails,
    ),
    Claim("at α = 0.9 BGK strongly exaggerates the tails", "V C, Fig. 18", bgk_exaggerates),
    Claim(
        "at α = 0.5 BGK's tail of F agrees with IHS; those of g_x at C_x > 0 and g_y at C_y < 0 "
        "are strongly underestimated",
        "V C, Fig. 18",
        bgk_tail_by_accident,
    ),
    Claim("at α = 0.9 IHS and EHS overlap", "V C, Fig. 18; VI", gases_overlap),
    Claim(
        "the measured drag leaves the tails of EHS practically unchanged",
        "V C, VI",
        measured_drag_tails,
    ),
    Claim("tails consistent with ln F ~ -C", "V C, Fig. 18", exponential_tails),
)
