"""Table and pictures of gases under the heat-flux force, beside the Sonine approximations."""

from functools import partial

import numpy as np

from ..theory import sonine_elastic, transport
from . import common

ORDERS = (1, 2, 3)
ELASTIC_ORDER = 10
"""Sonine polynomials for the elastic values: converged to all digits shown."""
ROWS = {
    "a2": "fourth cumulant a2",
    "a3": "sixth cumulant a3",
    "collision_rate_ratio": "collision rate over local equilibrium",
}


def table(result) -> str:
    """Steady values beside theory: a column for one gas, a row for each of a sweep."""
    return common.table(result, lambda: _single(result), lambda: _columns(result))


def _single(result) -> list[str]:
    steady, alpha = result.to_xarray().to_dataset(), result.attrs["parameter_restitution"]
    field = result.attrs["parameter_field"]
    heading = f"{f'steady value at field ε* = {field:g}':40s} {'jdsmc':>16s} {'first Sonine':>13s}"
    lines = [f"{heading} {'modified':>9s}{'  converged' if alpha == 1 else ''}"]
    if not np.isnan(steady["conductivity_ratio"]):
        lines += _response(steady, alpha)
    for name, label in ROWS.items():
        lines.append(f"{label:40s} {common.estimate(steady, name):>16s}")
    return lines


def _response(steady, alpha: float) -> list[str]:
    """Rows of what is odd in the velocity; theory is that of a weak field."""
    first, modified = _conductivities(alpha)
    elastic = sonine_elastic.conductivity_ratio(ELASTIC_ORDER)
    known = _known(first, modified, elastic, alpha)
    label = "thermal conductivity κ'/κ0"
    lines = [f"{label:40s} {common.estimate(steady, 'conductivity_ratio'):>16s} {known}"]
    scale, exact = transport.elastic_sonine_coefficient(), _elastic_coefficients()
    for name, equation in (("sonine", "3.10"), ("sonine_marginal", "3.12")):
        for k, order in enumerate(ORDERS):
            # a first Sonine approximation is one of the first coefficient only
            both = (first * scale, modified * scale) if order == 1 else (None, None)
            label = f"Sonine coefficient b'{order}, eq. ({equation})"
            known = _known(*both, exact[k], alpha)
            lines.append(f"{label:40s} {common.estimate(steady, name, k):>16s} {known}")
    return lines


def _known(first, modified, elastic, alpha: float) -> str:
    cells = [f"{'' if x is None else f'{x:.4g}':>{w}s}" for x, w in ((first, 13), (modified, 9))]
    return " ".join([*cells, *([f"{elastic:>10.4g}"] if alpha == 1 else [])]).rstrip()


def _columns(result) -> dict:
    fixed = result.attrs["parameter_restitution"]

    def theory(point, which: int) -> str:
        alpha = point["restitution"].values if "restitution" in point.coords else fixed
        return f"{_conductivities(alpha)[which]:.4g}"

    sonine = {f"b'{k}": partial(common.estimate, name="sonine", order=k - 1) for k in ORDERS}
    return {
        "κ'/κ0": partial(common.estimate, name="conductivity_ratio"),
        "first Sonine": partial(theory, which=0),
        "modified": partial(theory, which=1),
        **sonine,
    }


def _conductivities(restitution) -> tuple:
    """κ'/κ0 of the first Sonine approximation, the standard and the modified one."""
    return (
        transport.first_sonine(restitution).modified_conductivity,
        transport.modified_first_sonine(restitution).modified_conductivity,
    )


def _elastic_coefficients() -> np.ndarray:
    return sonine_elastic.sonine_coefficients(ELASTIC_ORDER)[: len(ORDERS)]


def draw(result):
    """κ'/κ0 and b'_k: against time, or for a steady sweep against restitution (or field)."""
    import matplotlib.pyplot as plt  # noqa: PLC0415 - slow to import

    dims = result.series["conductivity_ratio"].dims[:-1]
    figure, panels = plt.subplots(2, 1, figsize=(6.4, 7), sharex=True, layout="constrained")
    if dims and result.is_steady:
        _draw_sweep(panels, result, dims)
    else:
        _draw_series(panels, result, dims)
    panels[0].set_ylabel("thermal conductivity κ'/κ0")
    panels[1].set_ylabel("Sonine coefficients b'k")
    for panel in panels:
        panel.legend(fontsize=8, frameon=False)
    fixed = (("α", "parameter_restitution"), ("ε*", "parameter_field"))
    numbers = [f"{s} = {result.attrs[k]:g}" for s, k in fixed if np.ndim(result.attrs[k]) == 0]
    title = ", ".join(["Gas under the heat-flux force", *numbers])
    size, spread = common.sizes(result.attrs), "bars and bands: two standard errors"
    panels[0].set_title(f"{title}; {size}\n{spread}", fontsize=10)
    return figure


def _draw_series(panels, result, dims) -> None:
    """Approach to the steady state; steady values, if there are, as dotted lines."""
    series, top, bottom = result.series, panels[0], panels[1]
    for point in common.some_points(series, dims):
        here = series.isel(point)
        time, label = here["time"].values, common.label(series, point)
        value, error = (here[f"conductivity_ratio{s}"].values for s in ("", "_error"))
        common.curve(top, time, value, error, label or "κ'(t)/κ0")
        for k, order in enumerate(ORDERS):
            for name, style in (("sonine", "-"), ("sonine_marginal", "--")):
                value, error = (here[f"{name}{s}"].values[:, k] for s in ("", "_error"))
                text = f"b'{order} {label}" if style == "-" else ""
                common.curve(bottom, time, value, error, text, ls=style, color=f"C{k}")
    bottom.plot([], [], "k--", lw=1.2, label="eq. (3.12)")
    bottom.set_xlabel("time t/τ0 (of the gas held at T0)")
    bottom.set_ylim(*_limits(series["sonine"].values, series["sonine_error"].values))
    if result.is_steady and not dims:
        top.axhline(result["conductivity_ratio"].value, color="k", ls=":", lw=1, label="steady")
        for value in np.asarray(result["sonine"].value):
            bottom.axhline(value, color="k", ls=":", lw=1)


def _draw_sweep(panels, result, dims) -> None:
    """Steady values against restitution, or against the field where that alone is swept."""
    steady, (top, bottom) = result.to_xarray().to_dataset(), panels
    across = "restitution" if "restitution" in dims else dims[0]
    others = [name for name in dims if name != across]
    x = steady[across].values
    for number, point in enumerate(common.points(steady, others)):
        here, label = steady.isel(point), common.label(steady, point)
        value, error = (here[f"conductivity_ratio{s}"].values for s in ("", "_error"))
        common.bars(top, x, value, error, number, label or "jdsmc")
        for k, order in enumerate(ORDERS):
            value, error = (here[f"sonine{s}"].isel(sonine_order=k).values for s in ("", "_error"))
            text = f"b'{order} {label}".strip()
            common.bars(bottom, x, value, error, number if others else k, text, color=f"C{k}")
    bottom.set_ylim(*_limits(steady["sonine"].values, steady["sonine_error"].values))
    if across == "restitution":
        _theory_lines(top, bottom, np.linspace(x.min(), x.max(), 100))
        bottom.set_xlabel("restitution α")
    else:  # theory is that of a weak field
        alpha = np.full(2, result.attrs["parameter_restitution"])
        _theory_lines(top, bottom, alpha, np.array([x.max(), 0.0]))
        bottom.set_xlabel("field ε*")


def _limits(value, error) -> tuple[float, float]:
    """A range that holds what is known to better than 1, and zero and the elastic values."""
    known = np.where(error < 0.5, value, 0.0)
    spread = np.where(error < 0.5, 2 * error, 0.0)
    return min(-1.0, np.min(known - spread) - 0.1), max(2.3, np.max(known + spread) + 0.1)


def _theory_lines(top, bottom, alpha, x=None) -> None:
    """Lines of the first Sonine approximations; stars where the elastic values are known."""
    first, modified = _conductivities(alpha)
    scale = transport.elastic_sonine_coefficient()
    x = alpha if x is None else x
    for values, style, name in ((first, "-", "first Sonine"), (modified, "--", "modified first")):
        top.plot(x, values, f"k{style}", lw=1, label=name)
        bottom.plot(x, scale * values, f"k{style}", lw=1)
    if alpha[-1] == 1:
        ratio = sonine_elastic.conductivity_ratio(ELASTIC_ORDER)
        known = np.array([[ratio], *_elastic_coefficients()[:, None]])
        end = x[-1:]
        top.plot(end, known[0], "k*", ms=9, mfc="none", label=f"converged: {ratio:.6f}")
        bottom.plot(np.repeat(end, len(ORDERS)), known[1:, 0], "k*", ms=9, mfc="none")
