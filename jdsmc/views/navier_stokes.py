"""The Navier-Stokes coefficients, beside the Sonine approximations of hard spheres."""

import numpy as np

from ..theory import sonine_elastic
from ..theory.transport import first_sonine, modified_first_sonine
from . import common, generic, pictures
from .page import Page

COEFFICIENTS = ("modified_conductivity", "conductivity", "density_coefficient", "viscosity")
NEEDS = {*COEFFICIENTS, "running_conductivity"}
APPROXIMATIONS = {"first Sonine": first_sonine, "modified first": modified_first_sonine}


def has_theory(result) -> bool:
    """True of smooth inelastic hard spheres."""
    return common.gas_models(result.attrs) == {"InelasticHardSpheres"}


def known(restitution, name: str) -> tuple:
    """A coefficient of both first Sonine approximations."""
    return tuple(vars(theory(restitution))[name] for theory in APPROXIMATIONS.values())


def page(result) -> Page:
    """Coefficients beside theory: a column for one gas, a row for each of a sweep."""
    steady, theory = result.steady, has_theory(result)
    if not result.is_steady:
        return generic.page(result)
    if not common.dimensions(result):
        columns = _theory(float(result.attrs["parameter_restitution"])) if theory else {}
        return generic.page(result, columns, heading="transport coefficient")

    def modified(here, name) -> str:
        return f"{float(known(common.parameter(result, here, 'restitution'), name)[1]):.4g}"

    columns = {}
    for name in COEFFICIENTS:
        columns |= generic.of_observables(steady, [name])
        if theory:
            heading = f"{common.symbol(steady, name)} Sonine"
            columns[heading] = lambda here, name=name: modified(here, name)
    return generic.page(result, columns=columns)


def _theory(alpha: float) -> generic.Theory:
    def cell(which):
        def shown(name, index):
            return f"{float(known(alpha, name)[which]):.4g}" if name in COEFFICIENTS else ""

        return shown

    columns = {"first Sonine": cell(0), "modified": cell(1)}
    if alpha == 1:
        columns["converged"] = lambda name, index: (
            f"{sonine_elastic.converged(name):.5g}" if name in COEFFICIENTS else ""
        )
    return columns


def draw(result):
    """Running integrals, where they saturate and how noise grows; for a sweep, coefficients."""
    if not result.is_steady:
        return generic.draw(result)
    steady, dims = result.steady, common.dimensions(result)
    x = pictures.across(steady, dims)
    figure, panels = pictures.grid(8 if x else 4, 4 if x else 2, 3.6 if x else 4.2)
    if x:
        for panel, name in zip(panels, COEFFICIENTS, strict=False):
            pictures.against_sweep(panel, steady, dims, x, name)
            _theory_lines(panel, result, x, name)
    for panel, name in zip(panels[-4:], COEFFICIENTS, strict=True):
        pictures.profile(panel, steady, dims, f"running_{name}")
        panel.set(xlabel="upper end s of the integral (τ0)")
        panel.set_ylabel(common.symbol(steady, name))
        if not dims:
            value, error = (float(steady[key]) for key in (name, f"{name}_error"))
            panel.axhspan(value - 2 * error, value + 2 * error, color="C1", alpha=0.3, lw=0)
            panel.axhline(value, color="C1", lw=1, label="with what is extrapolated")
            if has_theory(result):
                _levels(panel, float(result.attrs["parameter_restitution"]), name)
    return pictures.finish(figure, panels, common.title(result, "Impulse response"))


def _levels(panel, alpha: float, name: str) -> None:
    for value, text, style in zip(known(alpha, name), APPROXIMATIONS, ("-", "--"), strict=True):
        panel.axhline(float(value), color="k", ls=style, lw=1, label=text)


def _theory_lines(panel, result, x: str, name: str) -> None:
    """Lines against restitution; levels where something else is swept at one restitution."""
    alpha = result.attrs.get("parameter_restitution")
    if not has_theory(result) or (x != "restitution" and np.ndim(alpha)):
        return
    if x != "restitution":
        _levels(panel, float(alpha), name)
        return
    values = result.steady[x].values
    fine = np.linspace(values.min(), values.max(), 100)
    for line, text, style in zip(known(fine, name), APPROXIMATIONS, ("-", "--"), strict=True):
        panel.plot(fine, line, f"k{style}", lw=1, label=text)
    if values.max() == 1:
        panel.plot(
            [1.0], [sonine_elastic.converged(name)], "k*", ms=9, mfc="none", label="converged"
        )
