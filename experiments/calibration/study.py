"""β(α) for every observable and both drags, what one β leaves, and what a second number mends.

Steady shear: one sweep of the inelastic gas and one of the elastic gas with each drag, over
x = d (1-α²)/β (`jdsmc.fit`). Navier-Stokes coefficients come from the theory of both gases.
"""

from pathlib import Path

import numpy as np

from jdsmc import ElasticHardSpheres, Estimate, InelasticHardSpheres, Result, combine
from jdsmc.fit import calibrate, elastic_sweep
from jdsmc.gases.hard_spheres import RATE_FACTORS
from jdsmc.scenarios import UniformShear
from jdsmc.theory.frictional import rate_factor

from .. import style
from ..case import Case, Measurements
from ..claims import Finding, every, percent
from ..markdown import grid
from ..paper import Paper

RATE = 4.0
DRAGS = ("local", "measured")
TARGETS = (
    *("shear_stress", "normal_stress_xy", "reduced_viscosity", "reduced_shear_rate"),
    *("relative_speed_cubed", "a2", "normal_stress_zy"),
)
SYMBOLS = {one.name: one.symbol for one in UniformShear.reports if one.name in TARGETS}
EXACT = {"viscosity": "η", "conductivity": "κ", "modified_conductivity": "κ'"}
JOINT = {
    "shear_stress+reduced_shear_rate": "-P_xy, a*",
    "shear_stress+reduced_shear_rate+normal_stress_xy": "-P_xy, a*, P_xx-P_yy",
    "shear_stress+reduced_shear_rate+normal_stress_xy+relative_speed_cubed": "all and ⟨V12³⟩",
}
THREE = list(JOINT)[1]
RULES = dict(zip(("(1+α)/2", "(1+α)(2+α)/6"), RATE_FACTORS.values(), strict=True))
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
            runs, given = self.results, {"target": target, "free": free}
            return {
                d: calibrate(runs["inelastic"], models[d], sweep=runs[d], **given) for d in DRAGS
            }

        self.one, self.joint = (fits(",".join(names), "rate_factor") for names in (TARGETS, JOINT))
        self.two = fits(",".join(JOINT), BOTH)
        self.exact = {n: np.array([rate_factor(a, n) for a in size.restitutions]) for n in EXACT}

    def beta(self, name: str, drag: str = "local") -> Estimate:
        """β(α) that matches one observable of sheared gases."""
        return self.one[drag].at(target=name)["rate_factor"]


PAPER = Paper("calibration", Calibrations)


def _table(data: Calibrations, columns: dict) -> list[str]:
    """A row for each α; "none" where nothing matches."""
    rows = ([f"{a:g}", *(x[k] for x in columns.values())] for k, a in enumerate(data.alpha))
    return grid(["α", *columns], ([str(x).replace("nan", "none") for x in row] for row in rows))


def sheared(data: Calibrations) -> list[str]:
    """β of every observable of steady shear, and what has none."""
    lines = []
    for d in DRAGS:
        found = {SYMBOLS[name]: data.beta(name, d) for name in TARGETS}
        lines += [f"With the {d} drag:", "", *_table(data, found), ""]
        lines += [data.one[d].attrs["remarks"], ""]
    return lines


def newtonian(data: Calibrations) -> list[str]:
    """β of the Navier-Stokes coefficients beside the two of the paper."""
    found = {symbol: data.exact[name] for name, symbol in EXACT.items()}
    found |= {label: rule(data.alpha) for label, rule in RULES.items()}
    return _table(data, {label: np.round(values, 4) for label, values in found.items()})


def misfits(data: Calibrations) -> list[str]:
    """What one β leaves in %; β and d that match stresses and shear rate, and what they leave."""
    found = {f"{JOINT[n]}; {d}": data.joint[d].at(target=n)["misfit"] for n in JOINT for d in DRAGS}
    keys = [(d, key) for d in DRAGS for key in (*BOTH, "misfit")]
    two = {f"{key}; {d}": data.two[d].at(target=THREE)[key] for d, key in keys}
    return [*_table(data, found), "", f"β and d for {JOINT[THREE]}:", "", *_table(data, two)]


def linear_in_shear(data: Calibrations) -> Finding:
    """Which of the two rules lies nearer to the β of η*."""
    found = data.beta("reduced_viscosity")
    linear, viscous = (rule(data.alpha) for rule in RULES.values())
    gain = combine(lambda b: np.abs(b - viscous) - np.abs(b - linear), found)
    signs = [None if abs(g) < 2 * e else bool(g > 0) for g, e in zip(*gain, strict=True)]
    nearer = ", ".join(f"{a:g}" for a, one in zip(data.alpha, signs, strict=True) if one)
    return Finding(f"(1+α)/2 is nearer to the β of η* at α = {nearer or 'none'} only", every(signs))


def viscosity_factor(data: Calibrations) -> Finding:
    """Its largest distance from the exact β of η."""
    off = RULES["(1+α)(2+α)/6"](data.alpha) / data.exact["viscosity"] - 1
    worst = np.max(np.abs(off))
    return Finding(f"off by at most {percent(worst)}", worst < 0.02)


def drag_is_enough(data: Calibrations) -> Finding:
    """What one β leaves of three stresses and rates, and what β and d leave."""
    left = {d: data.joint[d].at(target=THREE)["misfit"][0] for d in DRAGS}
    two = data.two["local"].at(target=THREE)
    text = f"at α = {data.alpha[0]:g} one β leaves {left['local']}% with the local and "
    text += f"{left['measured']}% with the measured drag of -P_xy, a*, P_xx-P_yy; with a drag "
    text += f"stronger by d = {two['drag_factor'][0]} it leaves {two['misfit'][0]}%"
    return Finding(text, bool(left["local"].value < 1.0))


@PAPER.figure("rate_factors", 1, 3, 14, 4.6)
def draw(data: Calibrations, axes) -> None:
    """β of everything with both drags, and what is left."""
    alpha, fine = data.alpha, np.linspace(data.alpha[0], data.alpha[-1], 100)
    for panel, drag in zip(axes[0], DRAGS, strict=False):
        for number, name in enumerate(TARGETS[:-1]):
            look = {"color": f"C{number}", "fmt": "osD^vP"[number], "label": SYMBOLS[name]}
            style.points(panel, alpha, data.beta(name, drag), **look)
        for (label, rule), line in zip(RULES.items(), ("k:", "k--"), strict=True):
            panel.plot(fine, rule(fine), line, label=label)
        panel.set(xlabel="α", ylabel="β", title=f"{drag} drag", ylim=(0.45, 1.4))
    for number, (name, symbol) in enumerate(EXACT.items()):
        axes[0][0].plot(alpha, data.exact[name], color=f"C{number + 6}", label=f"{symbol} (exact)")
    for number, name in enumerate(JOINT):
        for drag, fmt in zip(DRAGS, "os", strict=True):
            look = {"color": f"C{number}", "fmt": fmt, "label": f"β: {JOINT[name]}, {drag}"}
            style.points(axes[0][2], alpha, data.joint[drag].at(target=name)["misfit"], **look)
    look = {"color": "k", "fmt": "D", "label": f"β and d: {JOINT[THREE]}, local"}
    style.points(axes[0][2], alpha, data.two["local"].at(target=THREE)["misfit"], **look)
    axes[0][2].set(xlabel="α", ylabel="misfit (%)", ylim=(0, None), title="what is left")
    for panel in axes[0]:
        panel.legend(fontsize=7, frameon=False)
