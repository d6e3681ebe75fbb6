"""A sheared slab: approach to uniform shear, steady stresses beside the BGK kinetic model."""

import numpy as np
import xarray as xr

from ..estimate import format_estimate
from . import common, generic, pictures, uniform_shear, velocities
from .page import Block, Page

SWEEP = ("mean_temperature", *uniform_shear.STRESSES, "reduced_viscosity")
UNEVEN = {
    "density": "density n/n̄, from 1",
    "temperature": "temperature T/T̄, from 1",
    "velocity_x": "flow over aL, from y/L - 1/2",
}
PROFILES = {"velocity_x": "u_x/aL", "density": "n/n̄", "temperature": "T/T̄"}
NEEDS = {*SWEEP, *UNEVEN, "collisions"}
INSTANTS = (0.0, 0.1, 0.4, 1.0, 2.0, 4.0)
"""Collisions per particle at which profiles are drawn."""


def page(result) -> Page:
    """Steady values beside the model, and how far the steady profiles are from uniform."""
    steady, dims = result.steady, common.dimensions(result)
    if not result.is_steady:
        return generic.page(result)

    def known(here, name) -> str:
        model = uniform_shear.model_at(result, here)
        name = name.removeprefix("mean_")
        return f"{float(model[name]):.4g}" if name in model else ""

    if dims:
        columns = generic.of_observables(steady, SWEEP)
        if uniform_shear.has_theory(result.attrs):
            columns["η* BGK"] = lambda here: known(here, "reduced_viscosity")
        return generic.page(result, columns=columns)
    theory = {}
    if uniform_shear.model_at(result, steady):
        theory["BGK model"] = lambda name, index: known(steady, name) if index is None else ""
    usual = generic.page(result, theory)
    return Page([*usual.blocks, _uneven(result)], usual.notes)


def _uneven(result) -> Block:
    """The layers that differ most from uniform shear."""
    rows = []
    for name, label in UNEVEN.items():
        value, error = scaled(result, result.steady, name)
        deviation = value - _uniform(result.steady, name)
        worst = int(np.argmax(np.abs(deviation)))
        cell = format_estimate(float(deviation[worst]), float(error[worst]))
        rows.append([label, cell, str(worst + 1)])
    head = ["largest deviation of the steady profiles", "jdsmc", "its layer"]
    return Block(head, rows, (0,))


def scaled(result, here: xr.Dataset, name: str):
    """A profile and its error in the units it is drawn in: n̄, T̄ and aL."""
    value, error = here[name].values, here[f"{name}_error"].values
    whole = 1.0
    if name == "velocity_x":
        rate, length = (common.parameter(result, here, n) for n in ("shear_rate", "length"))
        whole = float(rate * length) or 1.0
    elif name == "temperature":
        whole = float(here["mean_temperature"])
    return value / whole, error / whole


def _uniform(data: xr.Dataset, name: str) -> np.ndarray:
    """What the profile is in uniform shear flow; layers are of equal width."""
    layers = data.sizes["y"]
    share = (np.arange(layers) + 0.5) / layers
    return share - 0.5 if name == "velocity_x" else np.ones(layers)


def draw(result):
    """Profiles (at several times, or of the steady points of a sweep) and global averages."""
    dims = common.dimensions(result)
    kinds = ("velocity", "speed_bin") if velocities.sampled(result) is not None else ()
    figure, panels = pictures.grid(6 + len(kinds), 4 if kinds else 3, 3.7)
    if dims:
        _sweep_profiles(panels[:3], result, dims)
    else:
        _profiles_in_time(panels[:3], result)
    _averages(panels[3:6], result, dims)
    for panel, along in zip(panels[6:], kinds, strict=True):
        velocities.draw(panel, result, along)
    return pictures.finish(figure, panels, common.title(result, "Sheared slab"))


def _profiles_in_time(panels, result) -> None:
    series = result.series
    reached = series["collisions"].values
    nearest = {int(np.argmin(np.abs(reached - s))) for s in INSTANTS if s <= reached[-1]}
    for number, sample in enumerate(sorted(nearest)):
        here = series.isel(sample=sample)
        label = f"s = {float(here['collisions']):.2g}"
        _draw_profiles(panels, result, here, label, f"C{number}")
    if result.is_steady:
        _draw_profiles(panels, result, result.steady, "steady", "k")
    _uniform_lines(panels, series)


def _sweep_profiles(panels, result, dims) -> None:
    """Steady ones; before that, the last."""
    data = result.steady if result.is_steady else result.series.isel(sample=-1)
    for number, point in enumerate(pictures.drawn(data, dims)):
        label = common.label(data, point)
        _draw_profiles(panels, result, data.isel(point), label, f"C{number}")
    _uniform_lines(panels, data)


def _draw_profiles(panels, result, here: xr.Dataset, label: str, color: str) -> None:
    for panel, name in zip(panels, PROFILES, strict=True):
        value, error = scaled(result, here, name)
        pictures.curve(panel, here["y"].values, value, error, label, color=color)


def _uniform_lines(panels, data: xr.Dataset) -> None:
    for panel, (name, label) in zip(panels, PROFILES.items(), strict=True):
        y = data["y"].values
        panel.plot(y, _uniform(data, name), "k:", lw=1.2, label="uniform shear")
        panel.set(xlabel=common.with_unit(data, "y"), ylabel=label)


def _averages(panels, result, dims) -> None:
    series = result.series
    curves = {
        "mean_temperature": panels[0],
        "shear_stress": panels[1],
        "normal_stress_xy": panels[1],
        "collision_ratio": panels[2],
    }
    stresses = {"shear_stress": "-", "normal_stress_xy": "--"}
    for number, point in enumerate(common.some_points(series, dims)):
        here, label = series.isel(point), common.label(series, point)
        for name, panel in curves.items():
            s, value, error = (here[key].values for key in ("collisions", name, f"{name}_error"))
            style = {"color": f"C{number}", "ls": stresses.get(name, "-")}
            text = label if name != "normal_stress_xy" else ""
            pictures.curve(panel, s, value, error, text, **style)
    for name, style in stresses.items():
        panels[1].plot([], [], "k", ls=style, lw=1.2, label=common.symbol(series, name))
    pictures.readable_log(panels[0], series["mean_temperature"].values)
    for panel, label in zip(panels, ("T̄/T0", "reduced stresses", "s/s0"), strict=True):
        panel.set(ylabel=label, xlabel="collisions per particle s")
