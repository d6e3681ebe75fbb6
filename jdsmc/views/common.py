"""What tables and pictures of all scenes share."""

from collections.abc import Callable, Iterator

import numpy as np
import xarray as xr

from ..results.result import format_estimate

MARKERS = "osD^v"
MOST_CURVES = 6
"""Most points of a sweep whose time series are drawn."""


def table(result, single: Callable[[], list[str]], columns: Callable[[], dict]) -> str:
    """Steady values: the lines of `single` for one gas, one row a point for a sweep.

    `columns`, for a sweep, maps a heading to a function that makes the cell of one point.
    """
    steady = result.to_xarray().to_dataset()
    if not result.is_steady:
        return f"No steady values ({result.attrs['stopped']})."
    dims = steady["steady_from_time"].dims
    lines = sweep_rows(steady, dims, columns()) if dims else [*single(), steady_from(steady)]
    ended = result.attrs.get("stopped")
    return "\n".join([*lines, *([f"Ended because {ended}."] if ended else [])])


def speed_class(index: int) -> str:
    """The speeds of a class, as in a table."""
    return ("C < 1", "1 < C < 2", "2 < C < 3", "C > 3")[index]


def steady_from(steady: xr.Dataset) -> str:
    """Where the measurement of one gas began."""
    return (
        f"steady from t = {float(steady['steady_from_time']):.1f} τ0, "
        f"s = {float(steady['steady_from_collisions']):.0f} collisions per particle"
    )


def sweep_rows(steady: xr.Dataset, dims: tuple, columns: dict) -> list[str]:
    """The heading and one row for each point of a sweep."""
    widths = {name: max(18, len(name) + 2) for name in columns}
    headings = [f"{name:>14s}" for name in dims] + [f"{n:>{w}s}" for n, w in widths.items()]
    lines = ["".join(headings)]
    for point in points(steady, dims):
        cells = [_cell(steady[name].values[k]) for name, k in point.items()]
        here = steady.isel(point)
        lines.append("".join(cells + [f"{columns[n](here):>{w}s}" for n, w in widths.items()]))
    return lines


def _cell(value) -> str:
    return f"{value:>14s}" if isinstance(value, str) else f"{value:14.4g}"


def points(data: xr.Dataset, dims) -> Iterator[dict[str, int]]:
    """The indices of every point of a sweep; one empty set of them for a single gas."""
    for index in np.ndindex(*(data.sizes[name] for name in dims)):
        yield dict(zip(dims, index, strict=True))


def some_points(data: xr.Dataset, dims) -> list[dict[str, int]]:
    """At most `MOST_CURVES` of the points, from the first to the last."""
    every = list(points(data, dims))
    chosen = np.linspace(0, len(every) - 1, min(len(every), MOST_CURVES)).round().astype(int)
    return [every[k] for k in chosen]


def estimate(data: xr.Dataset, name: str, order: int | None = None) -> str:
    """An observable of one point with its error, or one of its components."""
    value, error = data[name].values, data[f"{name}_error"].values
    if order is not None:
        value, error = value[order], error[order]
    return format_estimate(float(value), float(error))


def label(data: xr.Dataset, point: dict[str, int]) -> str:
    """What tells a point from the others, for a legend."""
    return ", ".join(
        f"{_symbol(name)} = {short(data[name].values[k])}" for name, k in point.items()
    )


def _symbol(name: str) -> str:
    return {"restitution": "α", "field": "ε*", "gravity": "g"}.get(name, name)


def short(value) -> str:
    """A coordinate, as text."""
    return value if isinstance(value, str) else f"{value:g}"


def curve(panel, x, value, error, name: str = "", **style) -> None:
    """A line with a band of two standard errors."""
    (line,) = panel.plot(x, value, **({"lw": 1.2, "label": name} | style))
    panel.fill_between(
        x, value - 2 * error, value + 2 * error, color=line.get_color(), alpha=0.25, lw=0
    )


def bars(panel, x, value, error, number: int, name: str, **style) -> None:
    """Markers with error bars of two standard errors."""
    usual = {"fmt": MARKERS[number % len(MARKERS)], "ms": 4, "mfc": "none", "capsize": 2}
    panel.errorbar(x, value, 2 * error, **(usual | style), label=name)


def sizes(attrs: dict) -> str:
    """The size of a simulation, for a title."""
    return f"N = {attrs['n_particles']}, {attrs['n_realizations']} realizations"
