"""What the text reads off the profiles; Maxwell molecules against eq. (6); the error budget.

κ* = 1 + (46/5) ε g* + (24/5 + 503.7 ε²) g*² is derived for Maxwell molecules and exact to second
order in g: exactly 1 at g = 0 in the bulk for any ε. The slab adds what its walls do, and orders
beyond the second.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr

from jdsmc import Estimate, Result
from jdsmc.measure import conduction
from jdsmc.results.gravity_effect import linear_response, means, points
from jdsmc.stats import jackknife

from ..case import estimate, steady
from ..numbers import Span, over_parts
from .cases import EXAMPLE, STUDY_GRAVITY
from .data import Fourier, share

END = 5
"""Layers (0.5 λ0) from which a profile is continued to the wall, in a straight line."""

PAPER_CROSSING = 0.35
"""Middle of the 0.3 to 0.4 where the paper has p and P_zz cross."""


def layer(state: xr.Dataset, name: str, cold: bool) -> Estimate:
    """A profile in its first (`cold`) or last layer."""
    return estimate(state, name)[0 if cold else -1]


def jump(state: xr.Dataset, cold_temperature: float, cold: bool) -> Span:
    """Temperature jump: T(0) - T_- or T_+ - T(L).

    From the layer at the wall to the continuation, each with an error; their mean in the middle.
    """
    z, near = state["z"].values, slice(0, END) if cold else slice(-END, None)
    line = np.polyfit(z[near], state["temperature"].values[near], 1)
    wall = np.polyval(line, 0.0 if cold else z[-1] + z[0])
    inside, error = layer(state, "temperature", cold)
    one, two = (float(t - cold_temperature if cold else 1.0 - t) for t in (inside, wall))
    low, high = min(one, two) - float(error), max(one, two) + float(error)
    return Span(0.5 * (one + two), low, high, "layer and wall")


def density(state: xr.Dataset, cold: bool) -> Span:
    """Density near a wall: from the layer at it to the mean of the first 0.5 λ0."""
    value = state["density"].values
    both = value[0 if cold else -1], np.mean(value[:END] if cold else value[-END:])
    return Span(float(np.mean(both)), float(min(both)), float(max(both)), "layer and 0.5 λ0")


def pressure_difference(realizations: xr.Dataset) -> Estimate:
    """(p - P_zz)/p in each layer."""
    p, zz = (realizations[name].values for name in ("pressure", "pressure_zz"))
    return over_parts((p - zz) / np.mean(p, axis=0))


def crossing(realizations: xr.Dataset) -> Estimate:
    """z/L where p - P_zz changes its sign: of a cubic in z/L, jackknife over realizations."""
    difference = (realizations["pressure"] - realizations["pressure_zz"]).values
    place = share(realizations)

    def root(profile) -> float:
        roots = np.roots(np.polyfit(place, profile, 3))
        real = roots.real[(abs(roots.imag) < 1e-9) & (roots.real > 0) & (roots.real < 1)]
        return float(real[np.argmin(abs(real - PAPER_CROSSING))]) if len(real) else np.nan

    return over_parts(difference, root)


FIRST_ORDER = 46.0 / 5.0
MAXWELL_WINDOW = 0.3
"""Share of the slab: T² is nearly linear, so that a wide window costs no bias that is seen
(table.md), and the error of the slope falls faster than 1/window."""
MAXWELL_WINDOWS = (0.1, 0.2, 0.3)


def second_order(gradient):
    """Coefficient of g*² in eq. (6)."""
    return 24.0 / 5.0 + 503.7 * gradient**2


def prediction(gradient, strength):
    """κ* of eq. (6)."""
    return 1.0 + FIRST_ORDER * gradient * strength + second_order(gradient) * strength**2


def slab(result: Result) -> float:
    """L/λ0."""
    return float(result.attrs["parameter_length"])


def molecular_profile(result: Result) -> tuple[np.ndarray, Estimate]:
    """𝒩/L and κ* with errors of every layer, at g = 0, of Maxwell molecules."""
    free = int(np.flatnonzero(result.steady["gravity"].values == 0.0)[0])
    length = slab(result)

    def local(one: dict) -> dict:
        profile = conduction.profiles(one)
        return conduction.reduced(profile, 0.0, length, 1.0, MAXWELL_WINDOW * length)

    averages = {name: value[free] for name, value in means(result).items()}
    value, error, _ = jackknife(averages, local, axis=0)
    return value["mean_free_paths"] / length, Estimate(value["kappa_star"], error["kappa_star"])


WINDOWS = (0.6, 1.0, 2.0, 4.0)
"""λ0 in which the slope of T^(3/2) is fitted; 1 by default."""


class Entry(NamedTuple):
    """Values by name, and their changes from the default (none for the default itself)."""

    label: str
    values: dict[str, Estimate]
    changes: dict[str, Estimate]


def _at_example(result: Result, window: float = conduction.WINDOW) -> dict[str, Estimate]:
    """κ* at g = 0, and Δκ* at g = -0.016."""
    found, gravity = points(result, window), list(result.steady["gravity"].values)
    low, free = (gravity.index(g) for g in STUDY_GRAVITY)
    return {
        "κ*(g = 0)": found["kappa_star"][free],
        "Δκ*(g = -0.016)": found["kappa_star_change"][low],
    }


def _entries(values: dict[str, dict[str, Estimate]], default: str) -> list[Entry]:
    start = values[default]
    return [
        Entry(k, v, {n: v[n] - start[n] for n in v} if k != default else {})
        for k, v in values.items()
    ]


def windows(data: Fourier) -> list[Entry]:
    """Same data, other windows: changes have smaller errors than values."""
    found = {f"window {w:g} λ0": _at_example(data.sweep(EXAMPLE), w) for w in WINDOWS}
    return _entries(found, f"window {conduction.WINDOW:g} λ0")


def variants(data: Fourier) -> list[Entry]:
    """Other simulations, independent of the default one; with the heat flux."""
    found = {
        label: _at_example(result)
        | {f"q(g = {g:g})": steady(result, "mean_heat_flux", gravity=g) for g in STUDY_GRAVITY}
        for label, result in data.variants.items()
    }
    return _entries(found, "default")


def response_by_window(result: Result) -> list[Estimate]:
    """B of a sweep with every window."""
    return [linear_response(result, window)["B"] for window in WINDOWS]
