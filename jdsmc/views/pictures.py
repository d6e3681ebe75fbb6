"""Figures, curves with bands, markers with bars, legends beside the data."""

import re
import textwrap
from collections import Counter
from math import ceil

import numpy as np
import xarray as xr

from . import common

MARKERS = "osD^vP"
SPREAD = "bands and bars: two standard errors"


def grid(number: int, columns: int = 0, width: float = 4.2, height: float = 3.1):
    """A figure and `number` panels in rows of `columns`; 1 to 3 of them unless said."""
    from .figure import Picture  # noqa: PLC0415 - slow to import

    columns = columns or (1 if number == 1 else 2 if number <= 4 else 3)
    rows = ceil(number / columns)
    if columns == 1:
        width = 6.4
    figure = Picture(figsize=(width * columns, height * rows + 0.6), layout="constrained")
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    for panel in panels[number:]:
        panel.remove()
    return figure, panels[:number]


def finish(figure, panels, title: str, spread: str = SPREAD):
    """Title and legends: what several panels share below them, the rest above its panel."""
    width = figure.get_figwidth()
    lines = [line for text in (title, spread) for line in _wrapped(text, int(11.5 * width))]
    figure.suptitle(pretty("\n".join(lines)), fontsize=10)
    for panel in panels:
        panel.set_xlabel(pretty(panel.get_xlabel()))
        panel.set_ylabel(pretty(panel.get_ylabel()))
    legends = [dict(zip(*_reversed(panel), strict=True)) for panel in panels]
    uses = Counter(label for legend in legends for label in legend)
    shared = {}
    for panel, legend in zip(panels, legends, strict=True):
        own = {label: handle for label, handle in legend.items() if uses[label] == 1}
        shared |= {label: handle for label, handle in legend.items() if uses[label] > 1}
        if own:
            inches = panel.get_subplotspec().get_position(figure).width * width
            panel.legend(
                *(own.values(), [pretty(label) for label in own]),
                **_style(own, inches),
                loc="lower left",
                bbox_to_anchor=(0.0, 1.0),
            )
    if shared:
        style = _style(shared, width)
        labels = [pretty(label) for label in shared]
        figure.legend(shared.values(), labels, **style, loc="outside lower center")
    return figure


def _wrapped(text: str, width: int) -> list[str]:
    """Lines that end after a comma where they can."""
    kept = re.sub(r"(?<![,;:]) ", "\N{NO-BREAK SPACE}", text)
    lines = textwrap.wrap(kept, width)
    return [line.replace("\N{NO-BREAK SPACE}", " ") for line in lines]


def pretty(text: str) -> str:
    """Subscripts of one or two letters as such; what else there is stays as it is."""
    text = text.replace("$", r"\$")
    text = re.sub(r"([^\W\d_]'?)_([A-Za-z]{1,2}|[+-])(?![A-Za-z_])", r"$\1_{\2}$", text)
    return text.replace("^(+)", "$^{(+)}$")


def _reversed(panel):
    handles, labels = panel.get_legend_handles_labels()
    return labels, handles


def _style(legend: dict, inches: float) -> dict:
    """As many columns as fit."""
    longest = max(len(label) for label in legend)
    columns = max(1, min(len(legend), int(inches / (0.065 * longest + 0.55))))
    return {"fontsize": 8, "frameon": False, "ncols": columns, "borderaxespad": 0.2}


def curve(panel, x, value, error, name: str = "", **style) -> None:
    """A line with a band of two standard errors."""
    (line,) = panel.plot(x, value, **({"lw": 1.2, "label": name or None} | style))
    low, high = value - 2 * error, value + 2 * error
    panel.fill_between(x, low, high, color=line.get_color(), alpha=0.25, lw=0)


def bars(panel, x, value, error, number: int = 0, name: str = "", **style) -> None:
    """Markers with error bars of two standard errors."""
    usual = {"fmt": MARKERS[number % len(MARKERS)], "ms": 4, "mfc": "none", "capsize": 2}
    usual |= {"color": f"C{number % 10}", "label": name or None, "lw": 1}
    panel.errorbar(x, value, 2 * error, **(usual | style))


def against_time(panel, result, name: str, clock: str = "time", log: bool = False) -> None:
    """One observable of a few points against a clock; the steady value of one gas dotted."""
    series, dims = result.series, common.dimensions(result)
    seen = []
    for number, point in enumerate(common.some_points(series, dims)):
        here = series.isel(point)
        x, value, error = (here[key].values for key in (clock, name, f"{name}_error"))
        curve(panel, x, value, error, common.label(series, point), color=f"C{number}")
        seen.append((value, error))
    if not dims and name in result:
        start = float(result.steady[f"steady_from_{clock}"])
        end = float(np.nanmax(series[clock].values))
        value = float(result.steady[name])
        panel.plot([start, end], [value, value], "C3-", lw=1.2, label="steady value")
    panel.set_xlabel(common.with_unit(series, clock))
    panel.set_ylabel(common.with_unit(series, name))
    if log:
        readable_log(panel, np.concatenate([value for value, _ in seen]))
    else:
        limit(panel, *(np.concatenate(column) for column in zip(*seen, strict=True)))


def together(panel, result, names, texts, words: str = "") -> None:
    """Several observables of one gas against time, `words` for what they have in common."""
    series = result.series
    for number, (name, text) in enumerate(zip(names, texts, strict=True)):
        time, value, error = (series[key].values for key in ("time", name, f"{name}_error"))
        curve(panel, time, value, error, text, color=f"C{number}", lw=0.9)
    panel.set_xlabel(common.with_unit(series, "time"))
    panel.set_ylabel(common.with_unit(series, names[0], words))


def walls(panel, result, dims, number_name: str, ends) -> None:
    """Crosses at what the walls at 0 and L have: `ends` of a number of the scene at each point."""
    steady = result.steady
    for number, point in enumerate(drawn(steady, dims)):
        here = steady.isel(point)
        value, length = (
            float(common.parameter(result, here, name)) for name in (number_name, "length")
        )
        if steady["z"].attrs.get("units") == "share of the whole":
            length = 1.0
        own = number_name in dims or "length" in dims
        style = {"color": f"C{number}" if own else "k", "ms": 7, "ls": "none", "clip_on": False}
        text = None if number else "walls"
        panel.plot([0.0, length], ends(value), marker="x", label=text, zorder=5, **style)


def profile(panel, data: xr.Dataset, dims, name: str, label: bool = True, **style) -> None:
    """A profile at a few points."""
    (along,) = common.own_dims(data, name, dims)
    x = data[along].values if along in data.coords else np.arange(data.sizes[along])
    seen = []
    for number, point in enumerate(drawn(data, dims)):
        here = data.isel(point)
        value, error = here[name].values, here[f"{name}_error"].values
        text = common.label(data, point) if label else ""
        curve(panel, x, value, error, text, **({"color": f"C{number}"} | style))
        seen.append((value, error))
    panel.set_xlabel(common.with_unit(data, along) if along in data.coords else along)
    panel.set_ylabel(common.with_unit(data, name))
    limit(panel, *(np.concatenate(column) for column in zip(*seen, strict=True)))


def across(data: xr.Dataset, dims) -> str:
    """The swept number that is worth an axis: the one with most values; "" if there is none."""
    numbers = [d for d in dims if data[d].values.dtype.kind == "f" and data[d].ndim == 1]
    numbers = [d for d in numbers if data.sizes[d] > 1]
    return max(numbers, key=lambda d: data.sizes[d], default="")


def drawn(data: xr.Dataset, dims) -> list[dict[str, int]]:
    """Points of a sweep whose profiles and velocities are drawn.

    Where several numbers are swept, those at the first value along the axis of `against_sweep`, in
    the order, hence the colours, of the markers there.
    """
    x = across(data, dims)
    others = [d for d in dims if d != x]
    if not (x and others):
        return common.some_points(data, dims)
    each = list(common.points(data, others))[: common.MOST_CURVES]
    return [{d: (point | {x: 0})[d] for d in dims} for point in each]


def against_sweep(panel, data: xr.Dataset, dims, x: str, name: str, **style) -> None:
    """Steady values against a swept number; the other swept numbers by marker and colour."""
    others = [d for d in dims if d != x]
    style = style if others else {"color": "k"} | style
    for number, point in enumerate(common.points(data, others)):
        here = data.isel(point)
        value, error = here[name].values, here[f"{name}_error"].values
        bars(panel, data[x].values, value, error, number, common.label(data, point), **style)
    panel.set_xlabel(common.with_unit(data, x))
    panel.set_ylabel(common.with_unit(data, name))


def limit(panel, value, error) -> None:
    """Show what is known: values whose error is not far above the usual one."""
    fine = np.isfinite(value) & np.isfinite(error)
    if not np.any(fine):
        return
    value, error = value[fine], error[fine]
    known = error <= 4.0 * np.median(error) + 1e-300
    if np.mean(known) < 0.5 or np.all(known):
        return
    low, high = np.min((value - 2 * error)[known]), np.max((value + 2 * error)[known])
    margin = 0.05 * (high - low)
    if margin > 0:
        panel.set_ylim(low - margin, high + margin)


def readable_log(panel, values) -> None:
    """A logarithmic axis for what is positive and spans a factor of five, with plain numbers."""
    known = values[np.isfinite(values)]
    if not len(known) or np.min(known) <= 0 or np.max(known) < 5 * np.min(known):
        return
    panel.set_yscale("log")
    if np.max(known) < 500 * np.min(known):
        from .figure import plain_numbers  # noqa: PLC0415 - slow to import

        plain_numbers(panel.yaxis)
