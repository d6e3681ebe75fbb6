"""Figures 5 to 8 and 10 to 13: evolution toward the steady state."""

import numpy as np
from matplotlib.figure import Figure

from jdsmc.theory import bgk_shear_flow

from ...style import COLOURS, band, figure, legend_of
from ..data import Measurements
from ..measured import HYDRODYNAMIC
from ..systems import FAST, SLOW
from .style import BGK, LINES, gas_legend

CLOCK = "s (IHS), s'/β (EHS): collisions per particle"
GASES = ("ihs", "ehs")


def model(restitution: float, shear_rate: float, last: float):
    """BGK from early times to `last`, densely at first."""
    return bgk_shear_flow.transient(restitution, shear_rate, np.geomspace(last / 1e4, last, 800))


def collisions(data: Measurements) -> Figure:
    """Fig. 5: s(t) and s'(t)/β, BGK dotted."""
    found, axes = figure(1, 2, 10, 4.4)
    for ax, rate, last in zip(axes[0], (FAST, SLOW), (10.0, 200.0), strict=True):
        for colour, alpha in zip(COLOURS, (0.5, 0.7, 0.9), strict=False):
            for gas in GASES:
                series = data.series(gas, alpha, rate)
                early = series["time"].values <= last
                error = series["collisions_error"] * (series["clock"] / series["collisions"])
                error = np.nan_to_num(error.values)[early]
                time, clock = series["time"].values[early], series["clock"].values[early]
                band(ax, time, clock, error, color=colour, linestyle=LINES[gas])
            found_model = model(alpha, rate, last)
            ax.plot(found_model.time, found_model.collisions, **BGK)
        ax.set(
            xlabel="time t / τ0", ylabel="s(t), s'(t)/β", title=f"a τ0 = {rate:g}", xlim=(0, last)
        )
        ax.set_ylim(bottom=0)
    alphas = {f"α = {a}": {"color": c} for c, a in zip(COLOURS, (0.5, 0.7, 0.9), strict=False)}
    axes[0, 0].legend(handles=legend_of(alphas) + gas_legend(bgk=True), fontsize=8)
    return found


def collision_ratio(data: Measurements) -> Figure:
    """Fig. 6: collisions over their local-equilibrium number."""
    found, axes = figure(1, 2, 10, 4.2, sharey=True)
    for ax, alpha in zip(axes[0], (0.9, 0.5), strict=True):
        for colour, rate in zip(COLOURS, (FAST, SLOW), strict=False):
            for gas in GASES:
                series = data.series(gas, alpha, rate).isel(sample=slice(1, None))
                band(
                    ax,
                    series["clock"].values,
                    series["collision_ratio"].values,
                    series["collision_ratio_error"].values,
                    color=colour,
                    linestyle=LINES[gas],
                )
        ax.axhline(1.0, color="0.7", linewidth=0.8)
        ax.set(xlabel=CLOCK, title=f"α = {alpha}", xlim=(0, 60), ylim=(0.93, 1.03))
    axes[0, 0].set_ylabel("s/s0 (IHS), s'/s'0 (EHS)")
    axes[0, 1].legend(handles=_rates() + gas_legend(bgk=False), fontsize=8)
    return found


def _rates():
    entries = {f"a τ0 = {r:g}": {"color": c} for c, r in zip(COLOURS, (FAST, SLOW), strict=False)}
    return legend_of(entries)


def transient_quasielastic(data: Measurements) -> Figure:
    """Fig. 7: temperature and stresses at α = 0.9, BGK dotted."""
    return _transient(data, 0.9)


def transient_dissipative(data: Measurements) -> Figure:
    """Fig. 8: temperature and stresses at α = 0.5, BGK dotted."""
    return _transient(data, 0.5)


def _transient(data: Measurements, alpha: float) -> Figure:
    names = {
        "temperature": "T/T0",
        "shear_stress": "-P_xy/nT",
        "normal_stress_xy": "(P_xx - P_yy)/nT",
    }
    found, axes = _evolution(data, alpha, names)
    for rate, last in ((FAST, 40.0), (SLOW, 800.0)):
        curve = model(alpha, rate, last)
        for ax, name in zip(axes, names, strict=True):
            ax.plot(curve.collisions, getattr(curve, name), **BGK)
    axes[0].set_yscale("log")
    axes[0].legend(handles=_rates() + gas_legend(bgk=True), fontsize=8, ncols=2)
    return found


def _evolution(data: Measurements, alpha: float, names: dict[str, str]):
    """Panels under each other: observables against s, both gases and shear rates."""
    found, axes = figure(len(names), 1, 7, 2.9 * len(names), sharex=True)
    axes = axes[:, 0]
    for ax, (name, label) in zip(axes, names.items(), strict=True):
        sign = -1.0 if label.startswith("-a") else 1.0
        for colour, rate in zip(COLOURS, (FAST, SLOW), strict=False):
            for gas in GASES:
                series = data.series(gas, alpha, rate)
                values, error = series[name].values, series[f"{name}_error"].values
                clock, style = series["clock"].values, LINES[gas]
                band(ax, clock, values, error, color=colour, linestyle=style, sign=sign)
        ax.set(ylabel=label, xlim=(0, 50))
    axes[0].set_title(f"α = {alpha}")
    axes[-1].set_xlabel(CLOCK)
    return found, axes


def cumulants_quasielastic(data: Measurements) -> Figure:
    """Fig. 11: relative speeds and cumulants at α = 0.9."""
    return _cumulants(data, 0.9)


def cumulants_dissipative(data: Measurements) -> Figure:
    """Fig. 12: relative speeds and cumulants at α = 0.5."""
    return _cumulants(data, 0.5)


def _cumulants(data: Measurements, alpha: float) -> Figure:
    names = {"relative_speed_cubed": "⟨V12³⟩/⟨V12³⟩0", "a2": "a2", "a3": "-a3"}
    found, axes = _evolution(data, alpha, names)
    axes[0].legend(handles=_rates() + gas_legend(bgk=False), fontsize=8, ncols=2)
    return found


def speed_ratios(data: Measurements) -> Figure:
    """Fig. 13: R_0 to R_3 at α = 0.5, a τ0 = 4."""
    found, axes = figure(2, 2, 9, 6.4, sharex=True)
    for place, ax in enumerate(axes.ravel()):
        for gas, colour in zip(GASES, COLOURS, strict=False):
            series = data.series(gas, 0.5, FAST).isel(speed_class=place)
            values, error = series["speed_ratio"].values, series["speed_ratio_error"].values
            clock = series["clock"].values
            band(ax, clock, values, error, color=colour, linestyle=LINES[gas])
        ax.set(ylabel=f"R_{place}", xlim=(0, 25))
    for ax in axes[1]:
        ax.set_xlabel("s (IHS), s'/β (EHS)")
    entries = {
        "IHS (band: 1 s.e.)": {"color": COLOURS[0]},
        "EHS (band: 1 s.e.)": {"color": COLOURS[1], "linestyle": "--"},
    }
    axes[0, 0].legend(handles=legend_of(entries), fontsize=8)
    found.suptitle("α = 0.5, a τ0 = 4")
    return found


def viscosity(data: Measurements) -> Figure:
    """Fig. 10: reduced viscosity against reduced shear rate, α = 0.5, BGK dotted."""
    found, axes = figure(1, 1, 6.6, 4.8)
    ax = axes[0, 0]
    for gas, colour, marker in zip(GASES, COLOURS, "os", strict=False):
        for rate in (FAST, SLOW):
            series = data.series(gas, 0.5, rate)
            late = series.isel(sample=(series["clock"].values > HYDRODYNAMIC).nonzero()[0])
            x, y = late["reduced_shear_rate"].values, late["reduced_viscosity"].values
            error = late["reduced_viscosity_error"].values
            band(ax, x, y, error, color=colour, linestyle=LINES[gas])
        steady = data.steady(gas, 0.5, FAST)
        ax.errorbar(
            steady["reduced_shear_rate"],
            steady["reduced_viscosity"],
            xerr=steady["reduced_shear_rate_error"],
            yerr=steady["reduced_viscosity_error"],
            **_symbol(marker, colour),
        )
    for rate, last in ((FAST, 20.0), (SLOW, 400.0)):
        curve = model(0.5, rate, last)
        late = curve.collisions > HYDRODYNAMIC
        ax.plot(curve.reduced_shear_rate[late], curve.reduced_viscosity[late], **BGK)
    point = bgk_shear_flow.steady_state(0.5)
    ax.plot(point.reduced_shear_rate, point.reduced_viscosity, **_symbol("D", "black"))
    entries = {
        "IHS (band: 1 s.e.)": {"color": COLOURS[0]},
        "EHS (band: 1 s.e.)": {"color": COLOURS[1], "linestyle": "--"},
        "BGK": BGK,
        "steady state, IHS": _symbol("o", COLOURS[0]),
        "steady state, EHS": _symbol("s", COLOURS[1]),
        "steady state, BGK": _symbol("D", "black"),
    }
    ax.legend(handles=legend_of(entries), fontsize=8)
    ax.set(xlabel="a* = a τ_η", ylabel="η* = η/η0", title="α = 0.5, s > 2")
    return found


def _symbol(marker: str, colour: str) -> dict:
    return {"marker": marker, "color": colour, "markerfacecolor": "white", "linestyle": "none"}
