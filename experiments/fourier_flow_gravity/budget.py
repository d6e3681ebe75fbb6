"""Error budget: what the window of the slope, the time step, the layers and N do to κ*.

At the paper's reference example with g = 0 and -0.016: κ* at g = 0, Δκ* at -0.016, and z0.
"""

from typing import NamedTuple

import numpy as np
from jdsmc.conduction import WINDOW
from jdsmc.gravity_effect import linear_response, means, rule

from jdsmc import Estimate, Result
from jdsmc.stats import jackknife

from .data import Measurements
from .systems import EXAMPLE, STUDY_GRAVITY, Combination

WINDOWS = (0.6, 1.0, 2.0, 4.0)

QUANTITIES = {"κ*(g = 0)": ("kappa_star", 0.0), "Δκ*(g = -0.016)": ("kappa_star_change", -0.016)}
"""Label: name of `gravity_effect`, and g."""


class Entry(NamedTuple):
    """Values of `QUANTITIES` and the heat flux, and their changes from the default."""

    label: str
    values: dict[str, Estimate]
    changes: dict[str, Estimate] | None


def windows(data: Measurements) -> list[Entry]:
    """Same data, other windows: changes have smaller errors than values."""
    result = data.sweep(EXAMPLE)
    entries = []
    for window in WINDOWS:
        here, default = rule(result, window), rule(result, WINDOW)

        def both(averages, here=here, default=default):
            one, other = _pick(result, here(averages)), _pick(result, default(averages))
            return {**one, **{f"change {n}": one[n] - other[n] for n in one}}

        value, error = jackknife(means(result), both, axis=1)
        found = {n: Estimate(float(value[n]), float(error[n])) for n in value}
        changes = {n: found[f"change {n}"] for n in QUANTITIES}
        values = {n: found[n] for n in QUANTITIES}
        entries.append(
            Entry(f"window {window:g} λ0", values, None if window == WINDOW else changes)
        )
    return entries


def response_by_window(data: Measurements, combination: Combination) -> list[Estimate]:
    """B of a sweep with every window."""
    return [linear_response(data.sweep(combination), window)["B"] for window in WINDOWS]


def variants(data: Measurements) -> list[Entry]:
    """Other simulations, independent of the default one."""
    entries, start = [], None
    for label, result in data.variants.items():
        local = rule(result)
        value, error = jackknife(means(result), lambda a, r=result, f=local: _pick(r, f(a)), axis=1)
        values = {n: Estimate(float(value[n]), float(error[n])) for n in value}
        values |= {f"q(g = {g:g})": _flux(result, g) for g in STUDY_GRAVITY}
        start = start or values
        changes = None if values is start else {n: _change(values[n], start[n]) for n in values}
        entries.append(Entry(label, values, changes))
    return entries


def _change(one: Estimate, other: Estimate) -> Estimate:
    return Estimate(one.value - other.value, float(np.hypot(one.error, other.error)))


def _pick(result: Result, found: dict) -> dict:
    return {label: found[name][_place(result, g)] for label, (name, g) in QUANTITIES.items()}


def _flux(result: Result, gravity: float) -> Estimate:
    value, error = (np.asarray(part)[_place(result, gravity)] for part in result["mean_heat_flux"])
    return Estimate(float(value), float(error))


def _place(result: Result, gravity: float) -> int:
    """Which of the states has this g."""
    values = result.to_xarray().to_dataset()["gravity"].values
    return int(np.argmin(np.abs(values - gravity)))
