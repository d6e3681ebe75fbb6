"""Freely cooling gases: Haff's law and the first Sonine approximation where they hold."""

from collections.abc import Callable

import numpy as np
import xarray as xr

from ..theory import homogeneous_cooling as theory
from . import common, generic, pictures, velocities
from .page import Page

NEEDS = {"temperature", "a2", "a3", "relative_speed_cubed", "collision_rate_ratio"}
DIMENSIONS = {"InelasticHardSpheres": 3, "InelasticHardDisks": 2}
"""Of the gases whose theory is known."""
SWEEP = ("a2", "a3", "relative_speed_cubed", "collision_rate_ratio")


def dimension_of(result) -> int:
    """Of the velocities of a gas with theory, 0 for another."""
    found = {DIMENSIONS.get(one, 0) for one in common.gas_models(result.attrs)}
    return found.pop() if len(found) == 1 else 0


def model(restitution, dimension: int) -> dict:
    """First Sonine approximation, linear in a2; it has no a3."""
    a2 = theory.kurtosis(restitution, dimension)
    if dimension != 3:
        return {"a2": a2}
    cubed = 1 + 3 / 16 * a2
    return {
        "a2": a2,
        "relative_speed_cubed": cubed,
        "relative_speed_cubed_collisional": cubed,
        "collision_rate_ratio": 1 - a2 / 16,
    }


def page(result) -> Page:
    """Steady values beside theory; for a sweep the cumulants."""
    dims, dimension, steady = common.dimensions(result), dimension_of(result), result.steady
    if not result.is_steady or not dimension:
        return generic.page(result)

    def known(here: xr.Dataset, name: str) -> str:
        found = model(common.parameter(result, here, "restitution"), dimension)
        return f"{float(found[name]):.4g}" if name in found else ""

    if not dims:
        cell = {"first Sonine": lambda name, k: known(steady, name) if k is None else ""}
        return generic.page(result, cell)
    columns = {"a2 (theory)": lambda here: known(here, "a2")}
    return generic.page(result, columns=columns | generic.of_observables(steady, SWEEP))


def draw(result):
    """T/T0 against time, a2 against collisions or restitution, and velocities."""
    dims, dimension, series = common.dimensions(result), dimension_of(result), result.series
    with_velocities = velocities.sampled(result) is not None
    x = pictures.across(result.steady, dims) if result.is_steady else ""
    figure, panels = pictures.grid(4 if with_velocities else 2, 2)
    beyond = np.nanmin(series["temperature"].values) < 1e-250
    (_logarithms if beyond else _temperature)(panels[0], result, dimension)
    if x:
        _cumulants(panels[1], result, dims, x, dimension)
    else:
        pictures.against_time(panels[1], result, "a2", "collisions")
        if dimension:
            for point in common.some_points(series, dims):
                here = series.isel(point)
                alpha = common.parameter(result, here, "restitution")
                a2 = theory.kurtosis(alpha, dimension)
                panels[1].axhline(a2, color="k", ls=":", lw=1.2, label="first Sonine")
    if with_velocities:
        found = velocities.kinds(result.distribution, dims)
        for panel, along in zip(panels[2:], found, strict=False):
            velocities.draw(panel, result, along)
    return pictures.finish(figure, panels, common.title(result, "Homogeneous cooling"))


def _temperature(panel, result, dimension: int) -> None:
    """From the second record on: the first is at time zero, which has no logarithm."""

    def law(time, alpha):
        return theory.haff_temperature(time, alpha, dimension=dimension)

    series = result.series.isel(sample=slice(1, None))
    _curves(panel, result, series, "time", "temperature", law if dimension else None)
    panel.set(xscale="log", xlabel="time t (τ0)", ylabel="temperature T/T0")
    if np.nanmin(series["temperature"].values) < 0.5:
        panel.set_yscale("log")


def _logarithms(panel, result, dimension: int) -> None:
    """The same in logarithms, for a gas that has cooled beyond the range of floats."""

    def law(log_time, alpha):
        half = np.log(theory.cooling_rate(alpha, dimension=dimension) / 2)
        return -2 * np.logaddexp(0.0, half + log_time)  # t and 1 + t: the same where it matters

    names = "log_time", "log_temperature"
    _curves(panel, result, result.series, *names, law if dimension else None)
    panel.set(xlabel="ln(1 + t/τ0)", ylabel="ln T/T0")


def _curves(panel, result, series, clock: str, name: str, law: Callable | None) -> None:
    """A band a point of the sweep, with Haff's law (of clock and restitution) if there is one."""
    for number, point in enumerate(common.some_points(series, common.dimensions(result))):
        here = series.isel(point)
        time, value, error = (here[key].values for key in (clock, name, f"{name}_error"))
        style = {"color": f"C{number}", "lw": 3, "alpha": 0.5}
        pictures.curve(panel, time, value, error, common.label(series, point), **style)
        if law is not None:
            haff = law(time, common.parameter(result, here, "restitution"))
            panel.plot(time, haff, "k:", lw=1.2, label=None if number else "Haff's law")


def _cumulants(panel, result, dims, x: str, dimension: int) -> None:
    steady = result.steady
    values = steady[x].values
    fine = np.linspace(values.min(), values.max(), 100)
    others = [d for d in dims if d != x]
    for number, point in enumerate(common.points(steady, others)):
        here, label = steady.isel(point), common.label(steady, point)
        for k, name in enumerate(("a2", "a3")):
            text = f"{name}, {label}" if label else name
            value, error = here[name].values, here[f"{name}_error"].values
            pictures.bars(panel, values, value, error, 2 * number + k, text)
    if dimension and x == "restitution":
        text = "a2, first Sonine"
        panel.plot(fine, theory.kurtosis(fine, dimension), "k:", lw=1.2, label=text)
    panel.set(xlabel=common.with_unit(steady, x), ylabel="steady cumulants")
