"""Fluctuating modes of cooling disks, beside the linear Boltzmann-Langevin equation of the notes.

For both scenes: DSMC and molecular dynamics. The theory is that of dilute disks.
"""

from functools import lru_cache

import numpy as np
import xarray as xr

from ..scenarios.disk_modes import lags_of
from ..theory import langevin
from . import common, generic, pictures
from .page import Page

NEEDS = {"viscosity_ratio", "noise_viscosity_ratio", "mode_amplitude", "autocorrelation"}
TITLES = {"CoolingDisks": "Cooling disks", "MolecularDynamics": "Molecular dynamics"}
RATIOS = ("viscosity_ratio", "noise_viscosity_ratio", "noise_over_viscosity")
SWEEP = (*RATIOS, "mode_amplitude", "temperature", "a2")
SAME = (*RATIOS, "tail_amplitude", "tail_noise_viscosity_ratio", "tail_noise_over_viscosity")
"""Observables that theory calls by the same names."""

THEORY = "Boltzmann-Langevin"


class Theory:
    """What the theory says of one point; `pace` is √(T~/T0) at the growth rate that was imposed."""

    def __init__(self, alpha: float, share: float, pace: float):
        self.mode, self.pace = langevin.transverse_mode(alpha, share), pace
        state = langevin.cooling_state(alpha)
        self.values = {name: float(getattr(self.mode, name)) for name in SAME} | {
            "mode_amplitude": self.mode.amplitude,
            "mode_decay_rate": pace * self.mode.decay_rate,
            "temperature": pace**2,
            "a2": state.a2,
            "cooling_rate": pace * state.cooling_rate,
        }

    def autocorrelation(self, lag):
        """C(s), s in τ0."""
        return self.mode.autocorrelation(self.pace * lag)


def theory_at(result, here: xr.Dataset) -> Theory | None:
    """Of one point; None where there is none (a system too small for a hydrodynamic mode)."""
    alpha, density, growth = (
        common.parameter(result, here, name) for name in ("restitution", "density", "growth_rate")
    )
    share = float(density) * result.attrs["n_particles"]
    return _theory(float(alpha), share, None if growth is None else float(growth))


@lru_cache(maxsize=64)
def _theory(alpha: float, share: float, growth: float | None) -> Theory | None:
    try:
        own = langevin.cooling_state(alpha).growth_rate
        pace = growth / own if growth and own > 0 else 1.0
        return Theory(alpha, share, pace)
    except ValueError:
        return None


def page(result) -> Page:
    """Steady values beside theory; for a sweep the viscosities and theirs."""
    dims, steady = common.dimensions(result), result.steady
    if not result.is_steady:
        return generic.page(result)

    def known(here: xr.Dataset, name: str) -> str:
        theory = theory_at(result, here)
        return f"{theory.values[name]:.4g}" if theory and name in theory.values else ""

    if not dims:
        cell = {THEORY: lambda name, k: known(steady, name) if k is None else ""}
        return generic.page(result, cell)
    columns = generic.of_observables(steady, SWEEP)
    for name in RATIOS:
        heading = f"{common.symbol(steady, name)} theory"
        columns[heading] = lambda here, name=name: known(here, name)
    return generic.page(result, columns=columns)


def draw(result):
    """T~(s), |ξ|²(s) and C(s); for a sweep the viscosities in place of |ξ|²."""
    dims = common.dimensions(result)
    x = pictures.across(result.steady, dims) if result.is_steady else ""
    figure, panels = pictures.grid(2 + result.is_steady + bool(x), 2 if x else 3)
    pictures.against_time(panels[0], result, "temperature")
    if x:
        _viscosities(panels[1:3], result, dims, x)
    else:
        pictures.against_time(panels[1], result, "mode_power")
    _expected(panels[0], result, dims, "temperature")
    if not dims and not x:
        _expected(panels[1], result, dims, "mode_amplitude")
    if result.is_steady:
        _autocorrelations(panels[-1], result, dims)
    for panel in panels[:1] if x else panels[:2]:
        panel.set_xlabel("scaled time s (τ0)")
    what = TITLES.get(result.attrs.get("scene", ""), "Cooling disks")
    return pictures.finish(figure, panels, common.title(result, what))


def _expected(panel, result, dims, name: str) -> None:
    """A dotted line at the value of the theory of each point that is drawn."""
    seen = set()
    for point in common.some_points(result.series, dims):
        theory = theory_at(result, result.series.isel(point))
        if theory and theory.values[name] not in seen:
            seen.add(theory.values[name])
            panel.axhline(theory.values[name], color="k", ls=":", lw=1.2, label=THEORY)


def _autocorrelations(panel, result, dims) -> None:
    """C(s) with its band, and the line of the theory."""
    steady, attrs = result.steady, result.attrs
    spacing = attrs["time_step"] * attrs["steps_per_record"]
    for number, point in enumerate(pictures.drawn(steady, dims)):
        here = steady.isel(point)
        lag, theory = here["lag"].values, theory_at(result, here)
        if theory:  # points of a sweep share their lags only as shares of the longest
            _, lag = lags_of(theory.mode.decay_rate, spacing)
            fine = np.linspace(0.0, lag[-1], 201)
            text = None if number else THEORY
            panel.plot(fine, theory.autocorrelation(fine), "k:", lw=1.2, label=text)
        value, error = here["autocorrelation"].values, here["autocorrelation_error"].values
        text = common.label(steady, point)
        pictures.curve(panel, lag, value, error, text, color=f"C{number}", zorder=1)
    panel.axhline(0.0, color="k", lw=0.5)
    panel.set(xlabel="lag s (τ0)", ylabel="C(s)/(N T~/m)")


def _viscosities(panels, result, dims, x: str) -> None:
    """η/η0 and η1/η0, and their ratio, against what was swept."""
    steady = result.steady
    values = steady[x].values
    others = [d for d in dims if d != x]
    for number, point in enumerate(common.points(steady, others)):
        here, label = steady.isel(point), common.label(steady, point)
        for k, name in enumerate(RATIOS):
            panel, text = panels[k // 2], common.symbol(steady, name)
            value, error = here[name].values, here[f"{name}_error"].values
            mark = 2 * number + k % 2
            pictures.bars(panel, values, value, error, mark, f"{text}, {label}" if label else text)
            line = _line(result, here, x, values, name)
            panel.plot(*line, "k:", lw=1.2, label=None if number or k else THEORY)
    for panel, label in zip(panels, ("η/η0, η1/η0", "η1/η"), strict=True):
        panel.set(xlabel=common.with_unit(steady, x), ylabel=label)


def _line(result, here: xr.Dataset, x: str, values: np.ndarray, name: str):
    """Theory at the swept values: a second for each."""
    points = [theory_at(result, here.isel({x: k})) for k in range(len(values))]
    return values, np.array([p.values[name] if p else np.nan for p in points])
