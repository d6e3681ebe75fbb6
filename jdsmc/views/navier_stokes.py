"""Table and picture of the Navier-Stokes coefficients, beside the Sonine approximations."""

from functools import partial

import numpy as np

from ..theory import sonine_elastic
from ..theory.transport import first_sonine, modified_first_sonine
from . import common

ROWS = {
    "modified_conductivity": "modified conductivity κ'/κ0",
    "conductivity": "conductivity κ/κ0",
    "density_coefficient": "density coefficient nμ/(Tκ0)",
    "viscosity": "viscosity η/η0",
}
ELASTIC_ORDER = 10
"""Sonine polynomials for the elastic values: converged to all digits shown."""


def table(result) -> str:
    """Coefficients beside theory: a column for one gas, a row for each of a sweep."""
    steady = result.to_xarray().to_dataset()
    dims = steady["conductivity"].dims
    lines = common.sweep_rows(steady, dims, _columns(steady, result)) if dims else _single(result)
    return "\n".join([*lines, f"Ended because {result.attrs['stopped']}."])


def _single(result) -> list[str]:
    steady, alpha = result.to_xarray().to_dataset(), result.attrs["parameter_restitution"]
    heading = f"{'transport coefficient':32s} {'jdsmc':>14s} {'first Sonine':>13s} {'modified':>9s}"
    lines = [heading + ("  converged" if alpha == 1 else "")]
    for name, label in ROWS.items():
        known = [getattr(theory(alpha), name) for theory in (first_sonine, modified_first_sonine)]
        cells = f"{known[0]:>13.4g} {known[1]:>9.4g}"
        cells += f" {_elastic(name):>10.5g}" if alpha == 1 else ""
        lines.append(f"{label:32s} {common.estimate(steady, name):>14s} {cells}")
    return [*lines, f"{'fourth cumulant a2':32s} {common.estimate(steady, 'a2'):>14s}"]


def _columns(steady, result) -> dict:
    """Every coefficient and, where restitution is known, its modified first Sonine value."""

    def theory(name, here):
        alpha = here.get("restitution", result.attrs["parameter_restitution"])
        return f"{float(getattr(modified_first_sonine(np.asarray(alpha)), name)):.4g}"

    columns = {}
    for name, label in ROWS.items():
        symbol = label.split()[-1]
        columns[symbol] = partial(common.estimate, name=name)
        columns[f"{symbol} Sonine"] = partial(theory, name)
    return columns


def _elastic(name: str) -> float:
    if name == "density_coefficient":
        return 0.0
    if name == "viscosity":
        return sonine_elastic.viscosity_ratio(ELASTIC_ORDER)
    return sonine_elastic.conductivity_ratio(ELASTIC_ORDER)


def draw(result):
    """Running integrals against reduced time: where they saturate, and how noise grows."""
    import matplotlib.pyplot as plt  # noqa: PLC0415 - slow to import

    series = result.series
    dims = series["conductivity"].dims[:-1]
    figure, panels = plt.subplots(2, 2, figsize=(9, 6), sharex=True, layout="constrained")
    for panel, (name, label) in zip(panels.ravel(), ROWS.items(), strict=True):
        for point in common.some_points(series, dims):
            here = series.isel(point)
            values, error = here[name].values, here[f"{name}_error"].values
            common.curve(panel, series["time"], values, error, common.label(series, point))
        panel.set(ylabel=label, xlabel="upper end of the integral s/τ0")
    if dims:
        panels[0, 0].legend()
    figure.suptitle(f"Impulse response, {common.sizes(result.attrs)}")
    return figure
