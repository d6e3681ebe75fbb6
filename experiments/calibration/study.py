"""β(α) for every observable and both drags, what one β leaves, and what a second number mends.

Steady shear: one sweep of the inelastic gas and one of the elastic gas with each drag, over
x = d (1-α²)/β (`jdsmc.fit`). Navier-Stokes coefficients come from the theory of both gases.
"""

from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from jdsmc import ElasticHardSpheres, Estimate, InelasticHardSpheres, Result, combine
from jdsmc.fit import calibrate, elastic_sweep
from jdsmc.gases.hard_spheres import RATE_FACTORS
from jdsmc.scenarios import UniformShear
from jdsmc.theory.boltzmann import navier_stokes
from jdsmc.theory.frictional import coefficients

from .. import style
from ..case import Case, Measurements
from ..claims import Finding, every, percent
from ..markdown import grid
from ..paper import Paper

RATE = 4.0
DRAGS = ("local", "measured")
SYMBOLS = {
    "shear_stress": "-P_xy/nT",
    "normal_stress_xy": "(P_xx-P_yy)/nT",
    "reduced_viscosity": "η*",
    "reduced_shear_rate": "a*",
    "relative_speed_cubed": "⟨V12³⟩/⟨V12³⟩0",
    "a2": "a2",
    "normal_stress_zy": "(P_zz-P_yy)/nT",
}
EXACT = {"viscosity": "η", "conductivity": "κ", "modified_conductivity": "κ'"}
JOINT = {
    "shear_stress+reduced_shear_rate": "-P_xy, a*",
    "shear_stress+reduced_shear_rate+normal_stress_xy": "-P_xy, a*, P_xx-P_yy",
    "shear_stress+reduced_shear_rate+normal_stress_xy+relative_speed_cubed": "all and ⟨V12³⟩",
}
BOTH = ("rate_factor", "drag_factor")


class Calibrations(Measurements):
    """`one`, `joint`, `two` by drag: a β for each observable, one β for several, β and d."""

    def __init__(self, size, folder: Path, fresh: bool):
        self.alpha = np.array(size.restitutions)
        models = {d: UniformShear(ElasticHardSpheres(self.alpha, drag=d), RATE) for d in DRAGS}
        scenes = {d: elastic_sweep(model) for d, model in models.items()}
        scenes["inelastic"] = UniformShear(InelasticHardSpheres(self.alpha), RATE)
        super().__init__(size, [Case(n, s, size.options) for n, s in scenes.items()], folder, fresh)

        def fits(target, free) -> dict[str, Result]:
            inelastic = self.results["inelastic"]
            return {
                d: calibrate(inelastic, models[d], target, free=free, sweep=self.results[d])
                for d in DRAGS
            }

        self.one = fits(",".join(SYMBOLS), "rate_factor")
        self.joint = fits(",".join(JOINT), "rate_factor")
        self.two = fits(",".join(JOINT), BOTH)
        self.exact = {name: np.array([_exact(a, name) for a in self.alpha]) for name in EXACT}

    def beta(self, name: str, drag: str = "local") -> Estimate:
        """β(α) that matches one observable of sheared gases."""
        return self.one[drag].at(target=name)["rate_factor"]


def _exact(alpha: float, name: str) -> float:
    """β that matches a Navier-Stokes coefficient: β η depends on x = (1-α²)/β alone."""
    wanted = getattr(navier_stokes(float(alpha)), name)
    return brentq(lambda b: coefficients((1 - alpha**2) / b)[name] / b - wanted, 0.3, 1.5)


PAPER = Paper("calibration", Calibrations)


def _rows(data: Calibrations, columns: list) -> list[list]:
    return [[f"{a:g}", *(column[k] for column in columns)] for k, a in enumerate(data.alpha)]


def _cells(found: Estimate) -> list[str]:
    return [
        str(found[k]) if np.isfinite(found.value[k]) else "none" for k in range(len(found.value))
    ]


def local(data: Calibrations, drag: str = "local") -> list[str]:
    """β of every observable of steady shear."""
    return grid(
        ["α", *SYMBOLS.values()], _rows(data, [_cells(data.beta(n, drag)) for n in SYMBOLS])
    )


def measured(data: Calibrations) -> list[str]:
    """The same with the measured drag."""
    return local(data, "measured")


def newtonian(data: Calibrations) -> list[str]:
    """β of the Navier-Stokes coefficients beside the two of the paper."""
    columns = [*data.exact.values(), *(rule(data.alpha) for rule in RATE_FACTORS.values())]
    shown = [[f"{one:.4f}" for one in column] for column in columns]
    return grid(["α", *EXACT.values(), "(1+α)/2", "(1+α)(2+α)/6"], _rows(data, shown))


def misfits(data: Calibrations) -> list[str]:
    """What one β leaves in %, for both drags; what β and d together leave, and both."""
    columns, header = [], ["α"]
    for name, symbol in JOINT.items():
        for drag in DRAGS:
            header.append(f"β: {symbol} ({drag})")
            columns.append(_cells(data.joint[drag].at(target=name)["misfit"]))
    for drag in DRAGS:
        name = list(JOINT)[1]
        for key, symbol in (("rate_factor", "β"), ("drag_factor", "d"), ("misfit", "left")):
            header.append(f"β, d: {symbol} ({drag})")
            columns.append(_cells(data.two[drag].at(target=name)[key]))
    return grid(header, _rows(data, columns))


def without_match(data: Calibrations) -> list[str]:
    """The remarks of the fits: what no β can match."""
    return [f"- {d} drag, {line}." for d in DRAGS for line in _lines(data.one[d].attrs["remarks"])]


def _lines(remarks: str) -> list[str]:
    return [one.strip().rstrip(".") for one in remarks.split("restitution ")[1:]]


def linear_in_shear(data: Calibrations) -> Finding:
    """Which of the two rules lies nearer to the β of η*."""
    found, (linear, viscous) = (
        data.beta("reduced_viscosity"),
        (r(data.alpha) for r in RATE_FACTORS.values()),
    )
    gain = combine(lambda b: np.abs(b - viscous) - np.abs(b - linear), found)
    signs = [None if abs(g) < 2 * e else bool(g > 0) for g, e in zip(*gain, strict=True)]
    nearer = ", ".join(f"{a:g}" for a, one in zip(data.alpha, signs, strict=True) if one)
    return Finding(f"(1+α)/2 is nearer to the β of η* at α = {nearer or 'none'} only", every(signs))


def viscosity_factor(data: Calibrations) -> Finding:
    """Its largest distance from the exact β of η."""
    off = RATE_FACTORS["viscosity"](data.alpha) / data.exact["viscosity"] - 1
    worst = off[np.argmax(np.abs(off))]
    return Finding(f"off by at most {percent(worst)}", abs(worst) < 0.02)


def drag_is_enough(data: Calibrations) -> Finding:
    """What one β leaves of three stresses and rates, and what β and d leave."""
    name = list(JOINT)[1]
    left = {d: data.joint[d].at(target=name)["misfit"][0] for d in DRAGS}
    two = data.two["local"].at(target=name)
    text = f"at α = {data.alpha[0]:g} one β leaves {left['local']}% with the local and "
    text += f"{left['measured']}% with the measured drag of -P_xy, a*, P_xx-P_yy; with a drag "
    text += f"stronger by d = {two['drag_factor'][0]} it leaves {two['misfit'][0]}%"
    return Finding(text, bool(left["local"].value < 1.0))


@PAPER.figure("rate_factors", 1, 3, 14, 4.6)
def draw(data: Calibrations, axes) -> None:
    """β of everything with both drags, and what is left."""
    alpha, fine = data.alpha, np.linspace(data.alpha[0], data.alpha[-1], 100)
    for panel, drag in zip(axes[0], DRAGS, strict=False):
        for number, (name, symbol) in enumerate(list(SYMBOLS.items())[:-1]):
            look = {"color": f"C{number}", "fmt": "osD^vP"[number], "label": symbol}
            style.points(panel, alpha, data.beta(name, drag), **look)
        for rule, line in zip(RATE_FACTORS.values(), ("k:", "k--"), strict=True):
            panel.plot(fine, rule(fine), line, label={"k:": "(1+α)/2"}.get(line, "(1+α)(2+α)/6"))
        panel.set(xlabel="α", ylabel="β", title=f"{drag} drag", ylim=(0.5, 1.3))
    for number, (name, symbol) in enumerate(EXACT.items()):
        axes[0][0].plot(alpha, data.exact[name], color=f"C{number + 6}", label=f"{symbol} (exact)")
    for number, name in enumerate(JOINT):
        for drag, fmt in zip(DRAGS, "os", strict=True):
            look = {"color": f"C{number}", "fmt": fmt, "label": f"β: {JOINT[name]}, {drag}"}
            style.points(axes[0][2], alpha, data.joint[drag].at(target=name)["misfit"], **look)
    name = list(JOINT)[1]
    look = {"color": "k", "fmt": "D", "label": f"β and d: {JOINT[name]}, local"}
    style.points(axes[0][2], alpha, data.two["local"].at(target=name)["misfit"], **look)
    axes[0][2].set(xlabel="α", ylabel="misfit (%)", ylim=(0, None), title="what is left")
    for panel in axes[0]:
        panel.legend(fontsize=7, frameon=False)
