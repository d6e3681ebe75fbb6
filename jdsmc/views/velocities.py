"""Velocity distributions beside the Maxwellian, on a logarithmic axis: the tail is the news."""

import numpy as np
import xarray as xr

from ..measure.distributions import PLACES
from . import common, pictures

VELOCITIES = ("velocity", "speed_bin")
AXES = {"marginal_x": "C_x", "marginal_y": "C_y", "speed": "C"}
AXES |= {f"marginal_z_{place}": "c_z" for place in PLACES}
SYMBOLS = {"marginal_x": "g_x", "marginal_y": "g_y", "speed": "F"}
SYMBOLS |= {f"marginal_z_{place}": f"{words} layer" for place, words in PLACES.items()}


def sampled(result) -> xr.Dataset | None:
    """The distributions, if any were sampled."""
    return result.distribution if "distribution" in result.to_xarray().children else None


def kinds(data: xr.Dataset, dims) -> dict[str, list[str]]:
    """Distributions by the one dimension that they have."""
    found: dict[str, list[str]] = {}
    for name in common.names(data):
        own = common.own_dims(data, name, dims)
        if len(own) == 1:
            found.setdefault(own[0], []).append(name)
    return found


def draw(panel, result, along: str, names: list[str] | None = None) -> None:
    """All of one gas, or the first of a few points of a sweep."""
    data, dims = result.distribution, common.dimensions(result)
    wanted = names or kinds(data, dims)[along]
    chosen = wanted if not dims else wanted[:1]
    x, floors = data[along].values, []
    for number, point in enumerate(pictures.drawn(data, dims)):
        for k, name in enumerate(chosen):
            value, error = (data.isel(point)[key].values for key in (name, f"{name}_error"))
            shown = np.where((value > 0) & (value > error), value, np.nan)
            text = common.label(data, point) if dims else SYMBOLS.get(name, name)
            pictures.curve(panel, x, shown, error, text, color=f"C{number if dims else k}")
            floors.append(shown)
    local = chosen[0].startswith("marginal_z_")
    if local:
        _local_maxwellians(panel, data, chosen, dims)
    elif along in VELOCITIES:
        _maxwellian(panel, data, chosen[0], along)
    _limits(panel, x, np.array(floors))
    axes = dict.fromkeys(AXES.get(name, along) for name in chosen)
    panel.set_xlabel(" or ".join(axes) + (", v_z over the thermal speed there" if local else ""))
    meanings = [common.meaning(data, name) for name in chosen]
    panel.set_ylabel("n f(c_z)/n̄" if local and len(chosen) > 1 else ", ".join(meanings))


def _local_maxwellians(panel, data: xr.Dataset, names: list[str], dims) -> None:
    """Those of the same density, and of the same temperature across the slab."""
    x = data["velocity"].values
    for number, point in enumerate(pictures.drawn(data, dims)):
        for k, name in enumerate(names):
            value = data.isel(point)[name].values
            whole = np.sum(value)
            if not whole > 0:
                continue
            mean = np.sum(value * x) / whole
            density = np.exp(-((x - mean) ** 2) / (2.0 * np.sum(value * (x - mean) ** 2) / whole))
            density *= whole / np.sum(density)
            style = {"color": f"C{number if dims else k}", "ls": "--", "lw": 0.8}
            panel.plot(x, density, **style, label=None if number + k else "Maxwellians, same n, T")


def _maxwellian(panel, data: xr.Dataset, name: str, along: str) -> None:
    """That of the same integral and the same temperature."""
    x = data[along].values
    value = data[name].values.reshape(-1, len(x))[0]
    density = np.exp(-(x**2))
    if along == "speed_bin":  # ⟨C²⟩ = d/2 tells the dimension d
        d = round(2.0 * np.sum(value * x**2) / np.sum(value))
        density = density * x ** (d - 1)
    density *= np.sum(value) / np.sum(density)
    panel.plot(x, density, "k--", lw=1, label="Maxwellian")


def _limits(panel, x, shown) -> None:
    """The range in which something was counted."""
    known = np.any(np.isfinite(shown), axis=0)
    if not np.any(known):
        return
    panel.set_yscale("log")
    panel.set_ylim(0.5 * np.nanmin(shown), 2.0 * np.nanmax(shown))
    panel.set_xlim(np.min(x[known]) - 0.2, np.max(x[known]) + 0.2)
