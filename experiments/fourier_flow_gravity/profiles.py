"""What the text reads off the profiles: temperature jumps, densities at the walls, p and P_zz."""

from typing import NamedTuple

import numpy as np
import xarray as xr

from jdsmc import Estimate

from ..compare import Span

END = 5
"""Layers (0.5 λ0) from which a profile is continued to the wall, in a straight line."""


class Ends(NamedTuple):
    """A profile in its first (or last) layer, with its error, and continued to the wall."""

    layer: tuple[float, float]
    wall: float


def at_wall(state: xr.Dataset, name: str, cold: bool) -> Ends:
    """A profile at z = 0 (`cold`) or z = L."""
    value, error = state[name].values, state[f"{name}_error"].values
    z = state["z"].values
    near = slice(0, END) if cold else slice(-END, None)
    wall = 0.0 if cold else z[-1] + z[0]
    continued = np.polyval(np.polyfit(z[near], value[near], 1), wall)
    k = 0 if cold else -1
    return Ends((float(value[k]), float(error[k])), float(continued))


def jump(state: xr.Dataset, cold_temperature: float, cold: bool) -> Span:
    """Temperature jump: T(0) - T_- or T_+ - T(L).

    From the layer at the wall to the continuation, each with an error; their mean in the middle.
    """
    (inside, error), wall = at_wall(state, "temperature", cold)
    one, two = (t - cold_temperature if cold else 1.0 - t for t in (inside, wall))
    low, high = min(one, two) - error, max(one, two) + error
    return Span(0.5 * (one + two), low, high, "layer and wall")


def density(state: xr.Dataset, cold: bool) -> Span:
    """Density near a wall: from the layer at it to the mean of the first 0.5 λ0."""
    value = state["density"].values
    near = value[:END] if cold else value[-END:]
    both = value[0 if cold else -1], np.mean(near)
    return Span(float(np.mean(both)), float(min(both)), float(max(both)), "layer and 0.5 λ0")


def pressure_difference(realizations: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """(p - P_zz)/p in each layer, and its error."""
    p, zz = (
        realizations[name].transpose("realization", "z").values
        for name in ("pressure", "pressure_zz")
    )
    each = (p - zz) / np.mean(p, axis=0)
    return np.mean(each, axis=0), np.std(each, axis=0, ddof=1) / np.sqrt(len(each))


def crossing(realizations: xr.Dataset) -> Estimate:
    """z/L where p - P_zz changes its sign: of a cubic in z/L, jackknife over realizations."""
    p, zz = (
        realizations[name].transpose("realization", "z").values
        for name in ("pressure", "pressure_zz")
    )
    difference = p - zz
    z = realizations["z"].values
    share = z / (z[-1] + z[0])
    count, total = len(difference), np.sum(difference, axis=0)
    left_out = [_root(share, (total - one) / (count - 1)) for one in difference]
    error = np.sqrt((count - 1) * np.var(left_out))
    return Estimate(_root(share, total / count), float(error))


def _root(share: np.ndarray, difference: np.ndarray) -> float:
    """The zero of a cubic fitted to a profile that is nearest to where the paper has it."""
    roots = np.roots(np.polyfit(share, difference, 3))
    real = roots.real[(abs(roots.imag) < 1e-9) & (roots.real > 0) & (roots.real < 1)]
    return float(real[np.argmin(abs(real - PAPER_CROSSING))]) if len(real) else float("nan")


PAPER_CROSSING = 0.35
"""Middle of 0.3 to 0.4."""
