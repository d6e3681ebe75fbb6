"""Table and pictures of heat conduction under gravity."""

from functools import partial

import numpy as np

from ..results.result import format_estimate
from . import common

FLUXES = {
    "mean_heat_flux": "heat flux, mean over the slab",
    "heat_flux_cold_wall": "  from the energy exchanged at the cold wall",
    "heat_flux_hot_wall": "  from the energy exchanged at the hot wall",
}
PANELS = (
    ("temperature", "temperature T/T_+"),
    ("density", "density n/n̄"),
    ("pressure", "pressures / n̄ m v0²"),
    ("heat_flux", "heat flux / n̄ m v0³"),
)
LOCAL = ("temperature", "density", "reduced_gradient", "reduced_gravity", "kappa_star")


def table(result) -> str:
    """Heat fluxes, and the state at the walls and halfway (in mean free paths) between them."""
    columns = {
        "heat flux": partial(common.estimate, name="mean_heat_flux"),
        "T at cold wall": partial(_at, name="temperature", index=0),
        "T at hot wall": partial(_at, name="temperature", index=-1),
        "κ* halfway": partial(_halfway, name="kappa_star"),
        "ε halfway": partial(_halfway, name="reduced_gradient"),
        "g* halfway": partial(_halfway, name="reduced_gravity"),
    }
    return common.table(result, lambda: _single(result.to_xarray().to_dataset()), lambda: columns)


def _single(steady) -> list[str]:
    lines = [f"{'steady value':46s} {'jdsmc':>14s}"]
    lines += [f"{label:46s} {common.estimate(steady, n):>14s}" for n, label in FLUXES.items()]
    lines.append(f"{'':20s} {'first layer':>14s} {'halfway':>14s} {'last layer':>14s}")
    middle = _middle(steady)
    for name in LOCAL:
        cells = [_at(steady, name, index) for index in (0, middle, -1)]
        lines.append(f"{name.replace('_', ' '):20s}" + "".join(f" {cell:>14s}" for cell in cells))
    return lines


def _middle(steady) -> int:
    """The layer halfway in mean free paths."""
    crossed = steady["mean_free_paths"].values
    return int(np.searchsorted(crossed, 0.5 * crossed[-1]))


def _at(steady, name: str, index: int) -> str:
    value, error = steady[name].values[index], steady[f"{name}_error"].values[index]
    return format_estimate(float(value), float(error))


def _halfway(steady, name: str) -> str:
    return _at(steady, name, _middle(steady))


def draw(result):
    """Profiles of every state (at most six), or heat flux against time before it is steady."""
    import matplotlib.pyplot as plt  # noqa: PLC0415 - slow to import

    if not result.is_steady:
        return _draw_series(result, plt)
    steady = result.to_xarray().to_dataset()
    dims = steady["steady_from_time"].dims
    figure, panels = plt.subplots(2, 2, figsize=(8.6, 6.6), sharex=True, layout="constrained")
    for point in common.some_points(steady, dims):
        here, label = steady.isel(point), common.label(steady, point)
        z = here["z"].values
        for panel, (name, _) in zip(panels.flat, PANELS, strict=True):
            common.curve(panel, z, here[name].values, here[f"{name}_error"].values, label)
        color = panels[1, 0].lines[-1].get_color()
        other = here["pressure_zz"].values
        common.curve(panels[1, 0], z, other, here["pressure_zz_error"].values, color=color, ls="--")
    for panel, (_, label) in zip(panels.flat, PANELS, strict=True):
        panel.set_ylabel(label)
    panels[0, 1].set_yscale("log")
    panels[1, 0].plot([], [], "k-", lw=1.2, label="p")
    panels[1, 0].plot([], [], "k--", lw=1.2, label="P_zz")
    panels[1, 0].legend(handles=panels[1, 0].lines[-2:], fontsize=8, frameon=False)
    if dims:
        panels[0, 0].legend(fontsize=8, frameon=False)
    for panel in panels[1]:
        panel.set_xlabel(f"z / {steady['z'].attrs['units']} (cold wall at 0)")
    figure.suptitle(_title(result.attrs), fontsize=10)
    return figure


def _draw_series(result, plt):
    series = result.series
    figure, panel = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    for point in common.some_points(series, series["time"].dims[:-1]):
        here = series.isel(point)
        value, error = here["mean_heat_flux"].values, here["mean_heat_flux_error"].values
        common.curve(panel, here["time"].values, value, error, common.label(series, point))
    panel.set_xlabel("time / τ0")
    panel.set_ylabel("mean heat flux / n̄ m v0³")
    panel.set_title(_title(result.attrs), fontsize=10)
    return figure


def _title(attrs) -> str:
    gas = "Maxwell molecules" if attrs["gas_model"] == "MaxwellMolecules" else "hard spheres"
    fixed = [
        f"{symbol} = {attrs[f'parameter_{name}']:g}"
        for name, symbol in (("cold_temperature", "T_-/T_+"), ("gravity", "g"), ("length", "L/λ0"))
        if np.ndim(attrs[f"parameter_{name}"]) == 0
    ]
    kind = {"maxwell": "Maxwell walls", "bgk": "BGK walls"}[attrs["option_wall"]]
    return ", ".join([f"Fourier flow of {gas}", kind, *fixed]) + f"\n{common.sizes(attrs)}"
