"""Sheared gases: beside the BGK kinetic model where that is one of them."""

import numpy as np
import xarray as xr

from ..theory import bgk_shear_flow
from . import common, generic, pictures, velocities
from .page import Page

STRESSES = ("shear_stress", "normal_stress_xy", "normal_stress_zy")
SWEEP = ("temperature", *STRESSES, "reduced_viscosity", "a2")
PANELS = ("reduced_shear_rate", "reduced_viscosity", *STRESSES, "a2", "a3")
MODEL = (*PANELS, "temperature", "first_viscometric", "second_viscometric")
"""What the model has a steady value of."""
NEEDS = {*SWEEP, *PANELS, "collisions"}
STYLES: dict[str, str] = dict(zip(STRESSES, ("-", "--", "-."), strict=True))


def has_theory(attrs: dict) -> bool:
    """True of hard spheres, elastic ones with the rate and the drag that the model stands for."""
    gases = common.gas_models(attrs)
    if not gases <= {"InelasticHardSpheres", "ElasticHardSpheres"}:
        return False
    usual_drag = np.all(np.equal(attrs.get("parameter_drag_factor", 1.0), 1.0))
    usual = bool(usual_drag and attrs.get("option_rate_factor") == "linear")
    return "ElasticHardSpheres" not in gases or usual


def model_at(result, here: xr.Dataset, **instead) -> dict[str, np.ndarray]:
    """Steady values of the model at one point, by name; empty where it has none.

    `instead`: arrays in place of a number of the point.
    """
    if not has_theory(result.attrs):
        return {}
    found = {name: common.parameter(result, here, name) for name in ("restitution", "shear_rate")}
    alpha, rate = np.broadcast_arrays(*(found | instead).values())
    if not (np.all(alpha < 1) and np.all(rate > 0)):
        return {}
    state = vars(bgk_shear_flow.steady_state(alpha, rate))
    return {name: np.asarray(state[name]) for name in MODEL}


def page(result) -> Page:
    """Steady values beside the model; for a sweep the stresses, η* and a2."""
    steady = result.steady

    def known(here, name) -> str:
        model = model_at(result, here)
        return f"{float(model[name]):.4g}" if name in model else ""

    if not common.dimensions(result):
        theory = {}
        if model_at(result, steady):
            theory["BGK model"] = lambda name, index: known(steady, name) if index is None else ""
        return generic.page(result, theory)
    if not result.is_steady:
        return generic.page(result)
    columns = generic.of_observables(steady, SWEEP)
    if has_theory(result.attrs):
        for name in ("shear_stress", "reduced_viscosity"):
            heading = f"{common.symbol(steady, name)} BGK"
            columns[heading] = lambda here, name=name: known(here, name)
    return generic.page(result, columns=columns)


def draw(result):
    """Approach to the steady state, or steady values of a sweep; and velocities."""
    dims = common.dimensions(result)
    x = pictures.across(result.steady, dims) if result.is_steady else ""
    return _draw_sweep(result, x) if x else _draw_series(result)


def _draw_series(result):
    series, dims = result.series, common.dimensions(result)
    with_velocities = velocities.sampled(result) is not None
    figure, panels = pictures.grid(4 if with_velocities else 2, 2)
    for number, point in enumerate(common.some_points(series, dims)):
        here, label = series.isel(point), common.label(series, point)
        for panel, name in [(panels[0], "temperature"), *((panels[1], n) for n in STRESSES)]:
            s, value, error = (here[key].values for key in ("collisions", name, f"{name}_error"))
            style = {"color": f"C{number}", "ls": STYLES.get(name, "-")}
            if not dims and name in STRESSES:
                style = {"color": f"C{STRESSES.index(name)}"}
            text = label if dims else common.symbol(series, name)
            shown = text if name in ("temperature", "shear_stress") or not dims else ""
            pictures.curve(panel, s, value, error, shown, **style)
    if dims:
        for name, style in STYLES.items():
            panels[1].plot([], [], "k", ls=style, lw=1.2, label=common.symbol(series, name))
    else:
        _model_curves(panels, result)
    pictures.readable_log(panels[0], series["temperature"].values)
    for panel, label in zip(panels, ("temperature T/T0", "reduced stresses"), strict=False):
        panel.set(ylabel=label, xlabel="collisions per particle s")
    if with_velocities:
        velocities.draw(panels[2], result, "velocity")
        velocities.draw(panels[3], result, "speed_bin")
        _model_velocities(panels[2:], result, result.distribution)
    return pictures.finish(figure, panels, common.title(result, "Uniform shear flow"))


def _model_curves(panels, result) -> None:
    """Dotted lines of the model, as in figures 7 and 8 of the paper; steady where it starts so."""
    series, attrs = result.series, result.attrs
    time, rate = series["time"].values, attrs.get("parameter_shear_rate", 0.0)
    if not has_theory(attrs) or rate <= 0 or len(time) < 2:
        return
    alpha = attrs["parameter_restitution"]
    if attrs.get("option_initial_state") == "steady":
        model = bgk_shear_flow.steady_state(alpha, rate)
        style = {"color": "k", "ls": ":", "lw": 1.2}
        panels[0].axhline(float(np.asarray(model.temperature)), label="BGK model", **style)
        panels[1].axhline(float(model.shear_stress), label="BGK model", **style)
        panels[1].axhline(float(model.normal_stress_xy), **style)
        return
    model = bgk_shear_flow.transient(alpha, rate, time)
    elastic = "ElasticHardSpheres" in common.gas_models(attrs)
    s = model.collisions * ((1.0 + alpha) / 2.0 if elastic else 1.0)
    panels[0].plot(s, model.temperature, "k:", lw=1.2, label="BGK model")
    panels[1].plot(s, model.shear_stress, "k:", lw=1.2, label="BGK model")
    panels[1].plot(s, model.normal_stress_xy, "k:", lw=1.2)


def _model_velocities(panels, result, here: xr.Dataset, color="k", text="BGK model") -> None:
    """The model's steady distributions at one point."""
    if not model_at(result, here):
        return
    alpha = float(common.parameter(result, here, "restitution"))
    along_x, speed = panels
    low, high = along_x.get_xlim()
    c = np.linspace(low, high, 201)
    style = {"color": color, "ls": ":", "lw": 1.2, "label": text or None}
    along_x.plot(c, bgk_shear_flow.marginal_x(alpha, c), **style)
    c = np.linspace(0.05, speed.get_xlim()[1], 60)
    speed.plot(c, bgk_shear_flow.speed_distribution(alpha, c), **style)


def _draw_sweep(result, x: str):
    steady, dims = result.steady, common.dimensions(result)
    with_velocities = velocities.sampled(result) is not None
    figure, panels = pictures.grid(len(PANELS) + 2 * with_velocities, 3, 3.8, 2.8)
    values = steady[x].values
    fine = np.linspace(values.min(), values.max(), 100)
    if x == "restitution":
        fine = np.linspace(values.min(), min(values.max(), 0.999), 100)
    others = [d for d in dims if d != x]
    for panel, name in zip(panels, PANELS, strict=False):
        pictures.against_sweep(panel, steady, dims, x, name)
        for number, point in enumerate(common.points(steady, others)):
            model = model_at(result, steady.isel(point), **{x: fine})
            if name in model:
                text = "" if number else "BGK model"
                panel.plot(fine, model[name], "k:", lw=1.2, label=text or None)
    if with_velocities:
        velocities.draw(panels[-2], result, "velocity")
        velocities.draw(panels[-1], result, "speed_bin")
        for number, point in enumerate(pictures.drawn(result.distribution, dims)):
            here, text = result.distribution.isel(point), "" if number else "BGK model"
            _model_velocities(panels[-2:], result, here, f"C{number}", text)
    return pictures.finish(figure, panels, common.title(result, "Uniform shear flow"))
