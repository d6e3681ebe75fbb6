"""How results are shown to people: tables and pictures.

`generic` shows any scene from what its observables say of themselves. The other modules, one a
scene, add what is its own: theory beside the values, panels that belong together.
"""

from . import (
    calibration,
    cooling_disks,
    couette_flow,
    fourier_flow,
    generic,
    heat_flux_force,
    homogeneous_cooling,
    navier_stokes,
    sensitivity,
    sheared_slab,
    uniform_shear,
)
from .page import Page, as_html, as_text

_SCENES = {
    "Calibration": calibration,
    "CoolingDisks": cooling_disks,
    "CouetteFlow": couette_flow,
    "FourierFlow": fourier_flow,
    "HeatFluxForce": heat_flux_force,
    "HomogeneousCooling": homogeneous_cooling,
    "MolecularDynamics": cooling_disks,
    "NavierStokes": navier_stokes,
    "ShearedSlab": sheared_slab,
    "UniformShear": uniform_shear,
}


def _view(result):
    """What shows a scene: `generic` unless a module is there that finds all that it needs."""
    view = _SCENES.get(result.attrs.get("scene", ""), generic)
    there = {*map(str, result.series.data_vars), *map(str, result.steady.data_vars)}
    return view if view.NEEDS.issubset(there) else generic


def _page(result) -> Page:
    """What the view says, and what the scene remarks on the run."""
    page, remarks = _view(result).page(result), str(result.attrs.get("remarks", ""))
    return Page(page.blocks, [*([remarks] if remarks else []), *page.notes])


def table(result) -> str:
    """Steady values with errors and units, beside theory where there is one."""
    return as_text(_page(result))


def html(result) -> str:
    """The same as HTML, for a notebook."""
    return as_html(_page(result))


def draw(result):
    """The matplotlib figure of a result; it belongs to no window and needs no closing.

    A sweep over one value is drawn as that point.
    """
    root = result.to_xarray()
    single = {name: root[name].values[0] for name in result.dims if root.sizes[name] == 1}
    return _view(result).draw(result.at(**single) if single else result)


def sensitivity_table(found) -> str:
    """Derivatives with error and truncation."""
    return as_text(sensitivity.page(found))


def sensitivity_html(found) -> str:
    """The same as HTML, for a notebook."""
    return as_html(sensitivity.page(found))


def draw_sensitivity(found):
    """The matplotlib figure of derivatives."""
    return sensitivity.draw(found)
