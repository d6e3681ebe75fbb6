"""Table and picture of derivatives: one column or panel for each number."""

from collections.abc import Callable

import numpy as np
import xarray as xr

from ..estimate import format_estimate
from . import common
from .page import Block, Page

MOST = 6
"""Observables that a sweep shows."""

LINEAR = 0.1
"""Derivatives below are on a linear scale, above on a logarithmic one: T/T0 has hundreds."""

ERROR, TRUNCATION = "tab:blue", "tab:orange"


def page(found) -> Page:
    """Rows are observables, or points of a sweep; `(..)` is one standard error, ± truncation."""
    data, dims = found.to_xarray(), found.result.dims
    if not len(found):
        stopped = found.result.attrs.get("stopped", "the run was not steady")
        return Page([], [f"No steady derivatives ({stopped})."])
    notes = ["In brackets one standard error of the last digits; ± what the method leaves out."]
    if dims:
        blocks = [_points(data, dims, scalars(found)[:MOST], p) for p in found.parameters]
        more = scalars(found)[MOST:]
        return Page(blocks, [*notes, *([f"More in .to_xarray(): {', '.join(more)}."] * bool(more))])
    rows = []
    for name in found:
        for label, pick in _components(data, name):
            cells = [cell(pick(data.sel(parameter=p)), name) for p in found.parameters]
            rows.append([label, *cells])
    head = ["derivative of", *(f"with respect to {p}" for p in found.parameters)]
    return Page([Block(head, rows, (0,))], notes)


def scalars(found) -> list[str]:
    """Observables with one number a point."""
    data = found.to_xarray()
    return [n for n in found if set(data[n].dims) <= {*found.result.dims, "parameter"}]


def cell(data: xr.Dataset, name: str) -> str:
    """A derivative with error and truncation; one that is exactly zero as 0."""
    value, error, truncation = (float(data[f"{name}{s}"]) for s in ("", "_error", "_truncation"))
    if value == 0.0 and error == 0.0:
        return "0"
    return f"{format_estimate(value, error)} ±{truncation:.1g}"


def _components(data: xr.Dataset, name: str) -> list[tuple[str, Callable]]:
    """Labels of an observable's numbers, and what picks each."""
    own = [dim for dim in data[name].dims if dim != "parameter"]
    if not own:
        return [(name, lambda one: one)]
    dim = own[0]
    places = data[dim].values if dim in data.coords else np.arange(data.sizes[dim])
    return [
        (f"{name}, {dim} {place}", lambda one, k=k: one.isel({dim: k}))
        for k, place in enumerate(places)
    ]


def _points(data: xr.Dataset, dims, names: list[str], parameter: str) -> Block:
    one = data.sel(parameter=parameter)
    rows = []
    for index in np.ndindex(*(data.sizes[d] for d in dims)):
        at = one.isel(dict(zip(dims, index, strict=True)))
        rows.append([*(f"{float(at[d]):g}" for d in dims), *(cell(at, n) for n in names)])
    return Block([*dims, *(f"∂{n}/∂{parameter}" for n in names)], rows)


def draw(found):
    """One gas: points, a panel for each number. A sweep of one number: lines against it."""
    data, dims = found.to_xarray(), found.result.dims
    names = scalars(found)
    if not names:
        raise ValueError("there are no steady derivatives to draw; see .series.")
    if len(dims) == 1:
        return _against(data, dims[0], names[:MOST], found.parameters)
    if dims:
        raise ValueError("a picture shows a sweep of one number; choose a part: result.at(...).")
    from .figure import Picture  # noqa: PLC0415 - slow to import

    figure = Picture(figsize=(1.5 + 3.5 * len(found.parameters), 1.3 + 0.3 * len(names)))
    panels = figure.subplots(1, len(found.parameters), sharey=True, squeeze=False)[0]
    rows = np.arange(len(names))[::-1]
    for panel, parameter in zip(panels, found.parameters, strict=True):
        value, error, truncation = _arrays(data.sel(parameter=parameter), names)
        panel.axvline(0.0, color="0.8", lw=0.8)
        panel.barh(rows, value, color="0.88", height=0.7)
        _bars(panel, value, rows, error, truncation, sideways=True)
        panel.set_xscale("symlog", linthresh=LINEAR)
        panel.set_xlabel(f"∂/∂ {common.named(parameter)}")
    panels[0].set_yticks(rows, [common.symbol(data, name) for name in names])
    panels[0].legend(fontsize="small")
    figure.tight_layout()
    return figure


def _against(data: xr.Dataset, dim: str, names: list[str], parameters):
    """Derivatives against the swept number: a panel for each observable and number."""
    shown = [(n, p) for p in parameters for n in names if np.any(data[n].sel(parameter=p) != 0)]
    shown = shown[: 2 * MOST] or [(names[0], parameters[0])]
    columns = min(3, len(shown))
    lines = -(-len(shown) // columns)
    from .figure import Picture  # noqa: PLC0415 - slow to import

    figure = Picture(figsize=(3.6 * columns, 2.7 * lines))
    panels = figure.subplots(lines, columns, squeeze=False).ravel()
    for panel, (name, parameter) in zip(panels, shown, strict=False):
        x = data[dim].values
        value, error, truncation = (
            part[0] for part in _arrays(data.sel(parameter=parameter), [name])
        )
        panel.plot(x, value, color="0.7", lw=1.0)
        _bars(panel, x, value, error, truncation, sideways=False)
        panel.set_ylabel(f"∂({common.symbol(data, name)})/∂ {common.named(parameter)}")
        panel.set_xlabel(dim.replace("_", " "))
    for panel in panels[len(shown) :]:
        panel.set_visible(False)
    panels[0].legend(fontsize="small")
    figure.tight_layout()
    return figure


def _arrays(data: xr.Dataset, names: list[str]) -> list[np.ndarray]:
    """Values, errors and truncations, one row a name."""
    return [np.stack([data[n + s].values for n in names]) for s in ("", "_error", "_truncation")]


def _bars(panel, x, y, error, truncation, *, sideways: bool) -> None:
    """A thick bar of one standard error, a thin one of error and truncation together."""
    key = "xerr" if sideways else "yerr"
    whole, own = {key: np.hypot(error, truncation)}, {key: error}
    style = {"fmt": "none", "capsize": 3.0}
    panel.errorbar(x, y, **whole, **style, color=TRUNCATION, lw=1.2, label="error and truncation")
    panel.errorbar(x, y, **own, fmt="o", ms=3.0, color=ERROR, lw=2.5, label="one standard error")
