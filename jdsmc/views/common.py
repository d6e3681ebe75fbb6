"""What tables and pictures ask of a result: its points, and words for what is in it."""

import re
from collections.abc import Iterator

import numpy as np
import xarray as xr

from ..estimate import format_estimate

SYMBOLS = {
    "restitution": "α",
    "shear_rate": "a",
    "field": "ε*",
    "gravity": "g",
    "length": "L",
    "cold_temperature": "T_-/T_+",
    "rate_factor": "β",
    "drag_factor": "d",
    "kick": "ε",
    "wall_velocity": "U",
    "accommodation": "χ",
    "force": "f",
    "noise": "ξ²",
}
"""Of the numbers of jdsmc's own scenes and gases; others are called by their names."""

UNITS = {
    "shear_rate": "1/τ0",
    "gravity": "v0²/λ0",
    "length": "λ0",
    "kick": "1/v0",
    "wall_velocity": "v0",
    "force": "v0²/λ0",
    "noise": "v0²/τ0",
}
"""Of the same numbers."""

GASES = {
    "InelasticHardSpheres": "inelastic hard spheres",
    "ElasticHardSpheres": "elastic hard spheres with drag",
    "InelasticHardDisks": "inelastic hard disks",
    "MaxwellMolecules": "Maxwell molecules",
}

MOST_CURVES = 6
"""Most points of a sweep that are drawn as curves."""

FEW = 8
"""So many values along a dimension are listed; more are a profile."""

HIDDEN = ("lag",)
"""Dimensions too long and too noisy for a table."""


def dimensions(result) -> tuple[str, ...]:
    """What was swept; the gas first where several were joined."""
    joined = ("gas",) if "gas" in result.series.dims else ()
    return (*joined, *(name for name in result.dims if name != "gas"))


def points(data: xr.Dataset, dims) -> Iterator[dict[str, int]]:
    """The indices of every point of a sweep; one empty set of them for a single gas."""
    for index in np.ndindex(*(data.sizes[name] for name in dims)):
        yield dict(zip(dims, index, strict=True))


def some_points(data: xr.Dataset, dims) -> list[dict[str, int]]:
    """At most `MOST_CURVES` of the points, from the first to the last."""
    every = list(points(data, dims))
    chosen = np.linspace(0, len(every) - 1, min(len(every), MOST_CURVES)).round().astype(int)
    return [every[k] for k in chosen]


def names(data: xr.Dataset) -> list[str]:
    """What has a value and an error, and is not NaN everywhere."""
    found = [str(name) for name in data.data_vars if f"{name}_error" in data.data_vars]
    return [name for name in found if not np.all(np.isnan(data[name].values))]


def own_dims(data: xr.Dataset, name: str, dims) -> tuple[str, ...]:
    """Dimensions of an observable beyond the sweep and the samples of a series."""
    return tuple(str(d) for d in data[name].dims if d not in dims and d != "sample")


def scalars(data: xr.Dataset, dims) -> list[str]:
    """Observables without dimensions of their own."""
    return [name for name in names(data) if not own_dims(data, name, dims)]


def meaning(data: xr.Dataset, name: str) -> str:
    """What a variable is, in words."""
    return str(data[name].attrs.get("long_name", name.replace("_", " ")))


def symbol(data: xr.Dataset, name: str) -> str:
    """What stands for a variable on an axis or a column; its name if it has no symbol."""
    return str(data[name].attrs.get("symbol", SYMBOLS.get(name, name.replace("_", " "))))


def unit(data: xr.Dataset, name: str) -> str:
    """Of a variable; empty for a pure number."""
    found = str(data[name].attrs.get("units", "1"))
    return "" if found == "1" else found


def with_unit(data: xr.Dataset, name: str, words: str = "") -> str:
    """Symbol (or other words) and unit, for an axis or a column."""
    words, found = words or symbol(data, name), unit(data, name)
    return f"{words} ({found})" if found else words


def estimate(data: xr.Dataset, name: str, index: int | tuple = ()) -> str:
    """A value of one point with its error; a dash for NaN."""
    value, error = (float(data[key].values[index]) for key in (name, f"{name}_error"))
    return "–" if np.isnan(value) else format_estimate(value, error)


def short(value) -> str:
    """A coordinate or a number, as text."""
    if isinstance(value, str):
        return value
    if np.ndim(value):
        return f"({', '.join(short(one) for one in value)})"
    return f"{value:.4g}"


def label(data: xr.Dataset, point: dict[str, int]) -> str:
    """What tells a point from the others, for a legend."""
    words = []
    for name, k in point.items():
        value = short(data[name].values[k])
        named = value if name == "gas" else f"{symbol(data, name)} = {value}"
        words.append(_with(named, unit(data, name)))
    return ", ".join(words)


def _with(number: str, unit: str) -> str:
    """A number and its unit: 0.3/τ0, not 0.3 1/τ0."""
    return number + unit[1:] if unit.startswith("1/") else f"{number} {unit}".strip()


def parameter(result, here: xr.Dataset, name: str):
    """A number of the scene at one point, or None if it has no such number."""
    if name in here.coords:
        return here[name].values[()]
    return result.attrs.get(f"parameter_{name}")


def gas_models(attrs: dict) -> set[str]:
    """Classes of the gases of a result, joined or not."""
    joined = {str(attrs[key]) for key in attrs if key.startswith("gas_model_")}
    return joined or {str(attrs.get("gas_model", ""))}


def title(result, what: str = "") -> str:
    """Scene and gas, numbers and names that are not swept, the size of the simulation."""
    attrs = result.attrs
    what = what or words_of(attrs.get("scene", "result"))
    gases = [GASES.get(one, words_of(one)) for one in sorted(gas_models(attrs))]
    facts = [f"{what}: {' and '.join(gases)}"]
    for key, value in attrs.items():
        name = key.removeprefix("parameter_")
        if name != key and np.ndim(value) == 0:
            facts.append(_with(f"{named(name)} = {short(value)}", UNITS.get(name, "")))
        name = key.removeprefix("option_")
        if name != key and isinstance(value, str) and value != "None":
            facts.append(f"{name.replace('_', ' ')} {value.replace('_', ' ')}")
    facts.append(f"N = {attrs.get('n_particles')}")
    return ", ".join([*facts, f"{attrs.get('n_realizations')} realizations"])


def named(name: str) -> str:
    """The symbol of a number of a scene or gas, or its name in words."""
    return SYMBOLS.get(name, name.replace("_", " "))


def words_of(name: str) -> str:
    """A class as words: HomogeneousCooling is a homogeneous cooling."""
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", str(name))
    return words[:1] + words[1:].lower()


SPEED_CLASSES = ("C < 1", "1 < C < 2", "2 < C < 3", "C > 3")


def place(data: xr.Dataset, dim: str, index: int) -> str:
    """One value along a dimension of an observable, in words."""
    if dim == "speed_class":
        return SPEED_CLASSES[index]
    if dim not in data.coords:
        return f"{dim.replace('_', ' ')} {index + 1}"
    value = short(data[dim].values[index])
    return f"{dim.replace('_', ' ')} = {value} {unit(data, dim)}".strip()
