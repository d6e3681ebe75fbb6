"""Table and pictures of a sheared slab: approach to uniform shear, steady stresses."""

from functools import partial

import numpy as np

from ..results.result import format_estimate
from ..theory import bgk_shear_flow
from . import common

ROWS = {
    "mean_temperature": "temperature T/T0",
    "reduced_shear_rate": "reduced shear rate a*",
    "shear_stress": "shear stress -Pxy/nT",
    "normal_stress_xy": "normal stress (Pxx-Pyy)/nT",
    "normal_stress_zy": "normal stress (Pzz-Pyy)/nT",
    "reduced_viscosity": "reduced viscosity η*",
}
UNEVEN = {
    "density": "density n/n̄, from 1",
    "temperature": "temperature T/T̄, from 1",
    "velocity_x": "flow over aL, from y/L - 1/2",
}
INSTANTS = (0.0, 0.1, 0.4, 1.0, 2.0, 4.0)
"""Collisions per particle at which profiles are drawn."""


def table(result) -> str:
    """Steady values beside the BGK model, and how far the steady profiles are from uniform."""
    steady, attrs = result.to_xarray().to_dataset(), result.attrs
    columns = {name: partial(common.estimate, name=name) for name in tuple(ROWS)[:5]}
    return common.table(result, lambda: _single(steady, attrs), lambda: columns)


def _single(steady, attrs) -> list[str]:
    restitution, shear_rate = (attrs[f"parameter_{n}"] for n in ("restitution", "shear_rate"))
    model = bgk_shear_flow.steady_state(restitution, shear_rate)
    lines = [f"{'steady value':40s} {'jdsmc':>16s} {'BGK model':>10s}"]
    for name, label in ROWS.items():
        theory = float(getattr(model, name.removeprefix("mean_")))
        lines.append(f"{label:40s} {common.estimate(steady, name):>16s} {theory:>10.4g}")
    lines.append(f"{'largest deviation of the steady profiles':40s} {'':>16s} {'its layer':>10s}")
    for name, label in UNEVEN.items():
        value, error = _scaled(steady, name, shear_rate, attrs["parameter_length"])
        deviation = value - _uniform(steady, name, attrs["parameter_length"])
        worst = int(np.argmax(np.abs(deviation)))
        cell = format_estimate(float(deviation[worst]), float(error[worst]))
        lines.append(f"{'  ' + label:40s} {cell:>16s} {worst + 1:>10d}")
    return lines


def _scaled(data, name: str, shear_rate: float, length: float):
    """A profile and its error in the units it is drawn in: n̄, T̄ and aL."""
    value, error = data[name].values, data[f"{name}_error"].values
    if name == "velocity_x":
        whole = shear_rate * length or 1.0
    else:
        whole = float(data["mean_temperature"]) if name == "temperature" else 1.0
    return value / whole, error / whole


def _uniform(data, name: str, length: float):
    """What the profile is in uniform shear flow, in the same units."""
    return data["y"].values / length - 0.5 if name == "velocity_x" else np.ones(data.sizes["y"])


def draw(result):
    """Profiles at several times beside the global averages; for a sweep the latter only."""
    import matplotlib.pyplot as plt  # noqa: PLC0415 - slow to import

    series = result.series
    dims = series["time"].dims[:-1]
    columns = 1 if dims else 2
    figure, panels = plt.subplots(
        3, columns, figsize=(5.2 * columns, 8.0), sharex="col", squeeze=False, layout="constrained"
    )
    if not dims:
        _draw_profiles(panels[:, 0], series, result.attrs)
    _draw_averages(panels[:, -1], series, dims)
    figure.suptitle(_title(result.attrs), fontsize=10)
    return figure


def _draw_profiles(panels, series, attrs) -> None:
    length, shear_rate = attrs["parameter_length"], attrs["parameter_shear_rate"]
    reached = series["collisions"].values
    wanted = [s for s in INSTANTS if s <= reached[-1]]
    for number, s in enumerate(wanted):
        here = series.isel(sample=int(np.argmin(np.abs(reached - s))))
        label = f"s = {float(here['collisions']):.2g}"
        style = {"color": f"C{number}"}
        for panel, name in zip(panels, ("velocity_x", "density", "temperature"), strict=True):
            value, error = _scaled(here, name, shear_rate, length)
            common.curve(panel, here["y"].values, value, error, label, **style)
    y = series["y"].values
    panels[0].plot(y, y / length - 0.5, "k:", lw=1, label="uniform shear")
    for panel, name in zip(panels, ("u_x / aL", "n / n̄", "T / T̄"), strict=True):
        panel.set_ylabel(name)
    panels[0].legend(fontsize=7, frameon=False, loc="upper left", labelspacing=0.2)
    panels[2].set_xlabel("y / λ0")


def _draw_averages(panels, series, dims) -> None:
    curves = {
        "mean_temperature": (0, ""),
        "shear_stress": (1, "-Pxy/nT"),
        "normal_stress_xy": (1, "(Pxx-Pyy)/nT"),
        "collision_ratio": (2, ""),
    }
    for point in common.some_points(series, dims):
        here, label = series.isel(point), common.label(series, point)
        for name, (row, short) in curves.items():
            value, error = here[name].values, here[f"{name}_error"].values
            text = f"{short} {label}".strip()
            common.curve(panels[row], here["collisions"].values, value, error, text)
    for panel, name in zip(panels, ("T̄ / T0", "reduced stress", "s / s0"), strict=True):
        panel.set_ylabel(name)
    panels[0].set_yscale("log")
    for panel in panels[:2]:
        if panel.get_legend_handles_labels()[1]:
            panel.legend(fontsize=8, frameon=False)
    panels[2].set_xlabel("collisions per particle s")


def _title(attrs) -> str:
    gas = "inelastic" if attrs["gas_model"] == "InelasticHardSpheres" else "frictional elastic"
    fixed = [
        f"{symbol} = {attrs[f'parameter_{name}']:g}"
        for name, symbol in (("restitution", "α"), ("shear_rate", "aτ0"), ("length", "L/λ0"))
        if np.ndim(attrs.get(f"parameter_{name}", ())) == 0 and f"parameter_{name}" in attrs
    ]
    start = attrs["option_initial_state"].replace("_", " ")
    first = ", ".join([f"Sheared slab of {gas} hard spheres", *fixed])
    return f"{first}\nfrom {start}; {common.sizes(attrs)}; bands: two standard errors"
