"""Gases under the heat-flux force, beside the Sonine approximations of hard spheres."""

import numpy as np
import xarray as xr

from ..theory import sonine_elastic, transport
from ..units import CONVERGED_ORDER
from . import common, generic, pictures, velocities
from .page import Page

NEEDS = {"modified_conductivity", "sonine", "sonine_marginal"}
ORDERS = (1, 2, 3)
SMOOTHED = 15
"""Windows over which a time series of Sonine coefficients is averaged: so many are shown."""
LABELS = {
    (name, k): f"Sonine coefficient b'{k + 1}, eq. ({equation})"
    for name, equation in (("sonine", "3.10"), ("sonine_marginal", "3.12"))
    for k in range(len(ORDERS))
}


def has_theory(result) -> bool:
    """True of smooth inelastic hard spheres."""
    return common.gas_models(result.attrs) == {"InelasticHardSpheres"}


def conductivities(restitution) -> tuple:
    """κ'/κ0 of the first Sonine approximation, the standard and the modified one."""
    return (
        transport.first_sonine(restitution).modified_conductivity,
        transport.modified_first_sonine(restitution).modified_conductivity,
    )


def page(result) -> Page:
    """Steady values beside theory, which is that of a weak field."""
    steady, dims = result.steady, common.dimensions(result)
    if not result.is_steady:
        return generic.page(result)
    if not dims:
        theory = _theory(float(result.attrs["parameter_restitution"])) if has_theory(result) else {}
        heading = f"steady value at field ε* = {common.short(result.attrs['parameter_field'])}"
        return generic.page(result, theory, labels=LABELS, heading=heading)
    columns = generic.of_observables(steady, ["modified_conductivity"])
    if has_theory(result):
        for which, name in enumerate(("first Sonine", "modified")):
            columns[name] = lambda here, which=which: _theory_at(result, here, which)
    columns |= {f"b'{k}": generic.of_component("sonine", k - 1) for k in ORDERS}
    return generic.page(result, columns=columns)


def _theory_at(result, here: xr.Dataset, which: int) -> str:
    alpha = common.parameter(result, here, "restitution")
    return f"{float(conductivities(alpha)[which]):.4g}"


def _theory(alpha: float) -> generic.Theory:
    """A first Sonine approximation has the first coefficient only; all are known at α = 1."""
    first, modified = conductivities(alpha)
    scale = transport.elastic_sonine_coefficient()

    def cell(value):
        def shown(name, index):
            if name == "modified_conductivity":
                return f"{value:.4g}"
            return f"{value * scale:.4g}" if (name, index) in LABELS and index == 0 else ""

        return shown

    def converged(name, index):
        if name == "modified_conductivity":
            return f"{sonine_elastic.conductivity_ratio(CONVERGED_ORDER):.4g}"
        return f"{_elastic_coefficients()[index]:.4g}" if (name, index) in LABELS else ""

    columns: generic.Theory = {"first Sonine": cell(first), "modified": cell(modified)}
    return columns | ({"converged": converged} if alpha == 1 else {})


def _elastic_coefficients() -> np.ndarray:
    return sonine_elastic.sonine_coefficients(CONVERGED_ORDER)[: len(ORDERS)]


def draw(result):
    """κ'/κ0 and b'_k: against time, or for a steady sweep against restitution (or field)."""
    dims = common.dimensions(result)
    with_velocities = velocities.sampled(result) is not None
    figure, panels = pictures.grid(2 + with_velocities, 3 if with_velocities else 2)
    x = pictures.across(result.steady, dims) if result.is_steady else ""
    spread = pictures.SPREAD
    if x:
        _draw_sweep(panels, result, dims, x)
    else:
        spread = _draw_series(panels, result, dims)
    panels[0].set_ylabel("modified conductivity κ'/κ0")
    panels[1].set_ylabel("Sonine coefficients b'_k")
    if with_velocities:
        velocities.draw(panels[2], result, "velocity")
        panels[2].set(xlabel="c_x", ylabel="density of c_x")
    return pictures.finish(figure, panels, common.title(result, "Heat-flux force"), spread)


def _draw_series(panels, result, dims) -> str:
    """Approach to the steady state: κ' as it is, the noisy b'_k averaged over records."""
    series, (top, bottom) = result.series, panels[:2]
    pictures.against_time(top, result, "modified_conductivity")
    if has_theory(result) and not dims:
        first, modified = conductivities(float(result.attrs["parameter_restitution"]))
        top.axhline(first, color="k", ls="-", lw=1, label="first Sonine")
        top.axhline(modified, color="k", ls="-.", lw=1, label="modified first Sonine")
    length = max(1, series.sizes["sample"] // SMOOTHED)
    for number, point in enumerate(common.some_points(series, dims)):
        here, label = series.isel(point), common.label(series, point)
        time = smoothed(here["time"].values, length)
        for k, order in enumerate(ORDERS):
            value = smoothed(here["sonine"].values[:, k], length)
            style = ("-", "--", "-.")[k] if dims else "-"
            text = f"b'{order}" if not dims else label if k == 0 else ""
            color = f"C{number if dims else k}"
            bottom.plot(time, value, lw=1.2, color=color, ls=style, label=text or None)
    if dims:
        for k, order in enumerate(ORDERS):
            bottom.plot([], [], "k", ls=("-", "--", "-.")[k], lw=1.2, label=f"b'{order}")
    elif result.is_steady:
        for k in range(len(ORDERS)):
            value, error = (result.steady[f"sonine{s}"].values[k] for s in ("", "_error"))
            bottom.axhspan(value - 2 * error, value + 2 * error, color=f"C{k}", alpha=0.25, lw=0)
    bottom.set_xlabel("time t (τ0) of the gas held at T0")
    top.set_xlabel("time t (τ0) of the gas held at T0")
    lines = f"lines of b'_k: averages over {length} records" if length > 1 else "b'_k: every record"
    return f"{pictures.SPREAD}; {lines}, bands of the steady values"


def smoothed(values: np.ndarray, length: int) -> np.ndarray:
    """Averages over consecutive windows; what is left over at the end is dropped."""
    windows = len(values) // length
    return values[: windows * length].reshape(windows, length).mean(axis=1)


def _draw_sweep(panels, result, dims, x: str) -> None:
    """Steady values against restitution, or against the field where that alone is swept."""
    steady, (top, bottom) = result.steady, panels[:2]
    pictures.against_sweep(top, steady, dims, x, "modified_conductivity")
    others = [name for name in dims if name != x]
    for number, point in enumerate(common.points(steady, others)):
        here, label = steady.isel(point), common.label(steady, point)
        for k, order in enumerate(ORDERS):
            value, error = (here[f"sonine{s}"].isel(sonine_order=k).values for s in ("", "_error"))
            text = f"b'{order}, {label}" if label else f"b'{order}"
            marker = {"fmt": pictures.MARKERS[number % len(pictures.MARKERS)]}
            pictures.bars(bottom, steady[x].values, value, error, k, text, **marker)
    bottom.set_ylim(*_limits(steady["sonine"].values, steady["sonine_error"].values))
    bottom.set_xlabel(common.with_unit(steady, x))
    if has_theory(result):
        _theory_lines(top, bottom, result, steady, x)


def _limits(value, error) -> tuple[float, float]:
    """A range that holds what is known to better than 1, and zero and the elastic values."""
    fine = error < 0.5
    known, spread = np.where(fine, value, 0.0), np.where(fine, 2 * error, 0.0)
    return min(-1.0, np.min(known - spread) - 0.1), max(2.3, np.max(known + spread) + 0.1)


def _theory_lines(top, bottom, result, steady: xr.Dataset, x: str) -> None:
    """Lines of the first Sonine approximations; stars where the elastic values are known."""
    values = steady[x].values
    fine = np.linspace(values.min(), values.max(), 100)
    if x == "restitution":
        alphas = [fine]
    else:  # theory is that of a weak field, at every restitution
        fine = np.array([0.0, values.max()])
        each = np.ravel(common.parameter(result, steady, "restitution"))
        alphas = [np.full(2, alpha) for alpha in each]
    scale = transport.elastic_sonine_coefficient()
    for number, alpha in enumerate(alphas):
        for known, style, name in zip(
            conductivities(alpha), ("-", "--"), ("first Sonine", "modified first"), strict=True
        ):
            text = None if number else name
            top.plot(fine, known, f"k{style}", lw=1, label=text)
            bottom.plot(fine, scale * known, f"k{style}", lw=1, label=text)
        if alpha[-1] == 1:
            ratio = sonine_elastic.conductivity_ratio(CONVERGED_ORDER)
            end = fine[-1:] if x == "restitution" else fine[:1]
            top.plot(end, [ratio], "k*", ms=9, mfc="none", label=f"converged: {ratio:.6f}")
            stars = np.repeat(end, len(ORDERS)), _elastic_coefficients()
            bottom.plot(*stars, "k*", ms=9, mfc="none", label="converged")
