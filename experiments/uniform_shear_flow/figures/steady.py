"""Figures 14 to 16: steady states."""

import numpy as np
from matplotlib.figure import Figure

from jdsmc import Estimate
from jdsmc.theory import bgk_shear_flow

from ...style import COLOURS, figure, legend_of
from ..data import Measurements, Term
from ..systems import FAST, SLOW
from .style import BGK

POINTS = {
    ("ihs", FAST): {"marker": "o", "color": COLOURS[0], "label": "IHS, a τ0 = 4"},
    ("ihs", SLOW): {"marker": "^", "color": COLOURS[0], "label": "IHS, a τ0 = 0.1"},
    ("ehs", FAST): {"marker": "s", "color": COLOURS[1], "label": "EHS, a τ0 = 4"},
    ("ehs", SLOW): {"marker": "v", "color": COLOURS[1], "label": "EHS, a τ0 = 0.1"},
}

OPEN = {"markerfacecolor": "none", "linestyle": "none", "markersize": 6, "capsize": 2}
FILLED = {"marker": "D", "color": COLOURS[2], "linestyle": "none", "markersize": 6, "capsize": 2}
MEASURED_LABEL = "EHS, measured drag, a τ0 = 4"


def stresses(data: Measurements) -> Figure:
    """Fig. 14: shear rate, shear stress, normal stress differences against α, BGK dotted."""
    labels = {
        "reduced_shear_rate": "a* = a τ_η",
        "shear_stress": "-P_xy/nT",
        "normal_stress_xy": "(P_xx - P_yy)/nT",
        "normal_stress_zy": "(P_zz - P_yy)/nT",
    }
    found, axes = figure(4, 1, 6.4, 11.5, sharex=True)
    _against_restitution(data, axes[:, 0], labels, set(labels))
    return found


def cumulants(data: Measurements) -> Figure:
    """Fig. 16: relative speeds and cumulants against α; BGK dotted but in the first panel."""
    labels = {"relative_speed_cubed": "⟨V12³⟩/⟨V12³⟩0", "a2": "a2", "a3": "-a3"}
    found, axes = figure(3, 1, 6.4, 9, sharex=True)
    _against_restitution(data, axes[:, 0], labels, {"a2", "a3"})
    return found


def _against_restitution(data: Measurements, axes, labels: dict[str, str], with_model: set) -> None:
    grid = np.linspace(0.48, 0.97, 99)
    model = bgk_shear_flow.steady_state(grid)
    for ax, (name, label) in zip(axes, labels.items(), strict=True):
        sign = -1.0 if label.startswith("-a") else 1.0
        for (gas, rate), look in POINTS.items():
            value, error = data.steady_values(gas, rate, name)
            ax.errorbar(data.restitutions(gas), sign * value, error, **OPEN | look)
        value, error = data.lookup(Term("ehs_measured", 0.5, FAST, name))
        ax.errorbar(0.5, sign * value, error, **FILLED)
        if name in with_model:
            ax.plot(grid, sign * getattr(model, name), **BGK)
        ax.set_ylabel(label)
    axes[0].set_xlim(0.47, 0.98)
    axes[-1].set_xlabel("coefficient of restitution α")
    _legend(axes[0])


def viscometric(data: Measurements) -> Figure:
    """Fig. 15: viscosity and viscometric functions against the steady shear rate, BGK dotted."""
    labels = {
        "reduced_viscosity": "η*",
        "first_viscometric": "-Ψ1",
        "second_viscometric": "Ψ2",
    }
    found, axes = figure(3, 1, 6.4, 9, sharex=True)
    model = bgk_shear_flow.steady_state(np.linspace(0.48, 0.97, 99))
    for ax, (name, label) in zip(axes[:, 0], labels.items(), strict=True):
        for (gas, rate), look in POINTS.items():
            x, y = (data.steady_values(gas, rate, n) for n in ("reduced_shear_rate", name))
            _point(ax, x, y, OPEN | look)
        terms = [Term("ehs_measured", 0.5, FAST, n) for n in ("reduced_shear_rate", name)]
        _point(ax, *(data.lookup(term) for term in terms), FILLED)
        ax.plot(model.reduced_shear_rate, getattr(model, name), **BGK)
        ax.set_ylabel(label)
    axes[-1, 0].set_xlabel("steady reduced shear rate a*_s = a τ_η")
    _legend(axes[0, 0])
    return found


def _point(ax, x: Estimate, y: Estimate, look: dict) -> None:
    ax.errorbar(x.value, y.value, y.error, x.error, **look)


def _legend(ax) -> None:
    keep = ("marker", "color", "markerfacecolor", "linestyle", "markersize")
    entries = {look["label"]: OPEN | look for look in POINTS.values()}
    entries[MEASURED_LABEL] = FILLED
    short = {name: {k: v for k, v in e.items() if k in keep} for name, e in entries.items()}
    ax.legend(handles=legend_of(short | {"BGK": BGK}), fontsize=8, title="error bars: 1 s.e.")
