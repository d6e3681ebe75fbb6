"""Table and pictures of freely cooling gases, beside the first Sonine approximation."""

from functools import partial

import numpy as np

from ..theory import homogeneous_cooling as theory
from . import common

ROWS = {
    "a2": "fourth cumulant a2",
    "a3": "sixth cumulant a3",
    "relative_speed_cubed": "relative speed ⟨V12³⟩/⟨V12³⟩0",
    "relative_speed_cubed_collisional": "  the same from the energy lost",
    "collision_rate_ratio": "collision rate over local equilibrium",
}


def table(result) -> str:
    """Steady values beside theory: a column for one gas, a row for each of a sweep."""
    return common.table(result, lambda: _single(result), lambda: _columns(result))


def _single(result) -> list[str]:
    steady = result.to_xarray().to_dataset()
    model = _model(result.attrs["parameter_restitution"])
    lines = [f"{'steady value':40s} {'jdsmc':>16s} {'first Sonine':>13s}"]
    for name, label in ROWS.items():
        if not np.isnan(steady[name]):
            known = f"{model[name]:.4g}" if name in model else ""
            lines.append(f"{label:40s} {common.estimate(steady, name):>16s} {known:>13s}")
    for order in range(steady.sizes["speed_class"]):
        label = f"particles with {common.speed_class(order)}, over Maxwell"
        lines.append(f"{label:40s} {common.estimate(steady, 'speed_ratio', order):>16s}")
    return lines


def _columns(result) -> dict:
    names = ("a2", "a3", "relative_speed_cubed", "collision_rate_ratio")
    columns = {name: partial(common.estimate, name=name) for name in names}
    return {"a2 (theory)": lambda point: f"{theory.kurtosis(point['restitution']):.4g}"} | columns


def _model(restitution) -> dict:
    """First Sonine approximation, linear in a2; it has no a3."""
    a2 = theory.kurtosis(restitution)
    cubed = 1 + 3 / 16 * a2
    return {
        "a2": a2,
        "relative_speed_cubed": cubed,
        "relative_speed_cubed_collisional": cubed,
        "collision_rate_ratio": 1 - a2 / 16,
    }


def draw(result):
    """T/T0 against time with Haff's law, and a2: against collisions, or restitution in a sweep."""
    import matplotlib.pyplot as plt  # noqa: PLC0415 - slow to import

    series, attrs = result.series, result.attrs
    dims = series["temperature"].dims[:-1]
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(6.4, 7), layout="constrained")
    for point in common.some_points(series, dims):
        alpha = float(series["restitution"].values[point["restitution"]] if dims else _alpha(attrs))
        _temperature(top, series.isel(point), alpha, f"α = {alpha:g}")
        if not (dims and result.is_steady):
            _cumulant(bottom, series.isel(point), alpha)
    if dims and result.is_steady:
        _cumulants(bottom, result.to_xarray().to_dataset())
    top.plot([], [], "k:", lw=1, label="Haff's law")
    top.set(xscale="log", yscale="log", xlabel="time t/τ0", ylabel="temperature T/T0")
    for panel in (top, bottom):
        panel.legend(fontsize=8, frameon=False)
    top.set_title(
        f"Freely cooling gas; {common.sizes(attrs)}\nbands: two standard errors", fontsize=10
    )
    return figure


def _alpha(attrs) -> float:
    return attrs["parameter_restitution"]


def _temperature(panel, series, alpha: float, label: str) -> None:
    """From the second record on: the first is at time zero, which has no logarithm."""
    time, value, error = (
        series[name].values[1:] for name in ("time", "temperature", "temperature_error")
    )
    common.curve(panel, time, value, error, label, lw=3, alpha=0.5)
    panel.plot(time, theory.haff_temperature(time, alpha), "k:", lw=1)


def _cumulant(panel, series, alpha: float) -> None:
    s, value, error = (series[name].values for name in ("collisions", "a2", "a2_error"))
    common.curve(panel, s, value, error, f"a2, α = {alpha:g}")
    panel.axhline(theory.kurtosis(alpha), color="k", ls=":", lw=1)
    panel.set(xlabel="collisions per particle s", ylabel="fourth cumulant a2")


def _cumulants(panel, steady) -> None:
    alpha = steady["restitution"].values
    fine = np.linspace(alpha.min(), alpha.max(), 100)
    for number, name in enumerate(("a2", "a3")):
        common.bars(panel, alpha, steady[name].values, steady[f"{name}_error"].values, number, name)
    panel.plot(fine, theory.kurtosis(fine), "k:", lw=1, label="a2, first Sonine")
    panel.set(xlabel="restitution α", ylabel="steady cumulants")
