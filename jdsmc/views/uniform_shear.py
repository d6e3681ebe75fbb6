"""Table and pictures of sheared gases, beside the BGK kinetic model."""

from functools import partial

import numpy as np

from ..results.result import format_estimate
from ..theory import bgk_shear_flow
from . import common

ROWS = {
    "temperature": "temperature T/T0",
    "reduced_shear_rate": "reduced shear rate a*",
    "shear_stress": "shear stress -Pxy/nT",
    "normal_stress_xy": "normal stress (Pxx-Pyy)/nT",
    "normal_stress_zy": "normal stress (Pzz-Pyy)/nT",
    "reduced_viscosity": "reduced viscosity η*",
    "first_viscometric": "viscometric function -Ψ1",
    "second_viscometric": "viscometric function Ψ2",
    "relative_speed_cubed": "relative speed ⟨V12³⟩/⟨V12³⟩0",
    "relative_speed_cubed_collisional": "  the same from the energy lost",
    "a2": "fourth cumulant a2",
    "a3": "sixth cumulant a3",
    "collision_rate_ratio": "collision rate over local equilibrium",
}
SWEEP_COLUMNS = ("temperature", "shear_stress", "normal_stress_xy", "normal_stress_zy", "a2")
NO_THEORY = ("relative_speed_cubed", "relative_speed_cubed_collisional", "collision_rate_ratio")


def table(result) -> str:
    """Steady values: one column for a single gas, one row a point for a sweep."""
    steady = result.to_xarray().to_dataset()
    columns = {name: partial(common.estimate, name=name) for name in SWEEP_COLUMNS}
    return common.table(result, lambda: _single(steady, result.attrs), lambda: columns)


def _single(steady, attrs) -> list[str]:
    model = _model(attrs["parameter_restitution"], attrs["parameter_shear_rate"])
    lines = [f"{'steady value':40s} {'jdsmc':>16s} {'BGK model':>10s}"]
    for name, label in ROWS.items():
        value, error = float(steady[name]), float(steady[f"{name}_error"])
        if not np.isnan(value):
            theory = f"{float(model[name]):.4g}" if name in model else ""
            lines.append(f"{label:40s} {format_estimate(value, error):>16s} {theory:>10s}")
    for index, value in enumerate(steady["speed_ratio"].values):
        error = float(steady["speed_ratio_error"][index])
        label = f"particles with {common.speed_class(index)}, over Maxwell"
        lines.append(f"{label:40s} {format_estimate(float(value), error):>16s}")
    return lines


def _model(restitution, shear_rate) -> dict:
    """Steady values of the BGK model by observable name; empty where it has none."""
    if not (np.all(np.asarray(restitution) < 1) and np.all(np.asarray(shear_rate) > 0)):
        return {}
    state = bgk_shear_flow.steady_state(restitution, shear_rate)
    names = (name for name in ROWS if name not in NO_THEORY)
    return {name: np.asarray(getattr(state, name)) for name in names}


def draw(result):
    """Approach to the steady state of one gas, or steady values against restitution."""
    dims = result.series["temperature"].dims[:-1]
    if "restitution" in dims and result.is_steady:
        return _draw_sweep(result)
    return _draw_series(result)


def _draw_series(result):
    import matplotlib.pyplot as plt  # noqa: PLC0415 - slow to import

    series, attrs = result.series, result.attrs
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(6.4, 6.4), sharex=True, layout="constrained"
    )
    dims = series["temperature"].dims[:-1]
    for index in np.ndindex(*(series.sizes[d] for d in dims)):
        point = dict(zip(dims, index, strict=True))
        label = ", ".join(f"{d} = {common.short(series[d].values[k])}" for d, k in point.items())
        _curve(top, series.isel(point), "temperature", label or "T/T0")
        for name, short in (
            ("shear_stress", "-Pxy/nT"),
            ("normal_stress_xy", "(Pxx-Pyy)/nT"),
            ("normal_stress_zy", "(Pzz-Pyy)/nT"),
        ):
            _curve(bottom, series.isel(point), name, f"{short} {label}".strip())
    if not dims:
        _model_curves(top, bottom, series, attrs)
    positive = series["temperature"].values
    if np.nanmax(positive) > 5 * np.nanmin(positive):
        top.set_yscale("log")
    top.set_ylabel("temperature T/T0")
    bottom.set_ylabel("reduced stress")
    bottom.set_xlabel("collisions per particle s")
    top.set_title(_title(attrs), fontsize=10)
    for panel in (top, bottom):
        panel.legend(fontsize=8, frameon=False)
    return figure


def _curve(panel, series, name: str, label: str) -> None:
    s, value, error = (series[n].values for n in ("collisions", name, f"{name}_error"))
    common.curve(panel, s, value, error, label)


def _model_curves(top, bottom, series, attrs) -> None:
    """Dotted lines of the BGK model, as in figures 7 and 8 of the paper."""
    restitution, shear_rate = attrs["parameter_restitution"], attrs["parameter_shear_rate"]
    if shear_rate <= 0:
        return
    model = bgk_shear_flow.transient(restitution, shear_rate, series["time"].values)
    factor = (1.0 + restitution) / 2.0 if attrs["gas_model"] == "ElasticHardSpheres" else 1.0
    s = factor * model.collisions
    top.plot(s, model.temperature, "k:", lw=1, label="BGK model")
    bottom.plot(s, model.shear_stress, "k:", lw=1, label="BGK model")
    bottom.plot(s, model.normal_stress_xy, "k:", lw=1)


def _title(attrs) -> str:
    gas = "inelastic" if attrs["gas_model"] == "InelasticHardSpheres" else "frictional elastic"
    numbers = [
        f"{symbol} = {attrs[key]:g}"
        for symbol, key in (("α", "parameter_restitution"), ("aτ0", "parameter_shear_rate"))
        if np.ndim(attrs.get(key, ())) == 0 and key in attrs
    ]
    return (
        f"Sheared gas of {gas} hard spheres, {', '.join(numbers)}; N = {attrs['n_particles']}, "
        f"{attrs['n_realizations']} realizations\nbands: two standard errors"
    )


PANELS = {
    "reduced_shear_rate": "a*",
    "shear_stress": "-Pxy/nT",
    "normal_stress_xy": "(Pxx-Pyy)/nT",
    "normal_stress_zy": "(Pzz-Pyy)/nT",
    "a2": "a2",
    "a3": "a3",
}


def _draw_sweep(result):
    import matplotlib.pyplot as plt  # noqa: PLC0415 - slow to import

    steady = result.to_xarray().to_dataset()
    figure, panels = plt.subplots(2, 3, figsize=(10, 6.2), sharex=True, layout="constrained")
    others = [d for d in steady["temperature"].dims if d != "restitution"]
    alpha = steady["restitution"].values
    fine = np.linspace(alpha.min(), min(alpha.max(), 0.999), 100)
    model = _model(fine, 1.0)
    for panel, (name, label) in zip(panels.flat, PANELS.items(), strict=True):
        for number, index in enumerate(np.ndindex(*(steady.sizes[d] for d in others))):
            point = dict(zip(others, index, strict=True))
            panel.errorbar(
                alpha,
                steady[name].isel(point).values,
                2 * steady[f"{name}_error"].isel(point).values,
                fmt="osD^v"[number % 5],
                ms=4,
                mfc="none",
                capsize=2,
                label=", ".join(
                    f"{d} {common.short(steady[d].values[k])}" for d, k in point.items()
                )
                or "jdsmc",
            )
        if name in model:
            panel.plot(fine, np.broadcast_to(model[name], fine.shape), "k:", lw=1, label="BGK")
        panel.set_ylabel(label)
    for panel in panels[1]:
        panel.set_xlabel("restitution α")
    panels[0, 0].legend(fontsize=8, frameon=False)
    figure.suptitle("Steady sheared gas (error bars: two standard errors)", fontsize=10)
    return figure
