"""Steady targets of any model: Newton's method with the derivatives of `jdsmc.sensitivity`."""

from typing import Any

import numpy as np

from ..derivatives.sensitivity import sensitivity
from ..errors import unbroken
from ..estimate import Estimate, combine
from ..results.result import Result
from ..scenarios import AbstractScene
from .labelled import Match, nothing
from .numbers import replaced, value_of
from .targets import Target

MOST_STEPS = 10

NEAR = 0.05
"""Relative step after which the next value is the last: what is quadratic in it is below 0.3%."""

SEEDS = 2**64
"""Every run has the seed after that of the run before it."""

LONGEST = 0.3
"""Longest relative step."""


def newton(
    model: AbstractScene, free: tuple[str, ...], fit: Target, wanted: list[Estimate], options: dict
) -> tuple[Match, Result]:
    """The free numbers that match, and the last run of the model.

    The error holds those of both gases, and of the derivatives (error and truncation) times the
    last step. Least squares of relative deviations where there are more observables than numbers.
    """
    numbers = np.array([value_of(model, name) for name in free])
    goal = np.array([float(one.value) for one in wanted])
    scale = np.array(fit.weights) / np.abs(goal)
    last, seed = False, int(options.get("seed", 0))
    for turn in range(MOST_STEPS):
        here = replaced(model, dict(zip(free, numbers, strict=True)))
        found = sensitivity(here, free, **(options | {"seed": (seed + turn) % SEEDS}))
        made: Any = unbroken(found.result)
        if any(name not in made for name in fit.names):
            return nothing(
                free, f"no steady value to fit: {made.attrs['stopped']}".rstrip(".")
            ), made
        values = [made[name] for name in fit.names]
        slopes = np.array([[float(found[n][p].value) for p in free] for n in fit.names])
        doubt = np.array([[float(found[n][p].uncertainty) for p in free] for n in fit.names])
        idle = [name for name, slope in zip(free, slopes.T, strict=True) if not np.any(slope)]
        if idle:
            return nothing(free, f"{fit.label} does not depend on {', '.join(idle)}"), made
        inverse = np.linalg.pinv(slopes * scale[:, None]) * scale
        miss = np.array([float(one.value) for one in values]) - goal
        step = -inverse @ miss
        if last or np.max(np.abs(step / numbers)) < NEAR / 10.0:
            return _ended(free, numbers, values, wanted, scale, slopes, doubt, step), made
        last = bool(np.max(np.abs(step / numbers)) < NEAR)
        numbers = numbers + np.clip(step / numbers, -LONGEST, LONGEST) * numbers
        try:
            replaced(model, dict(zip(free, numbers, strict=True)))
        except ValueError as error:
            return nothing(free, f"no value matches {fit.label}: {error}".rstrip(".")), made
    left = 100.0 * float(np.sqrt(np.mean((miss * scale) ** 2)))
    why = f"no value matches {fit.label}: {MOST_STEPS} steps end at {numbers}, off by {left:.2g}%"
    return nothing(free, why), made


def _ended(free, numbers, values, wanted, scale, slopes, doubt, step) -> Match:
    """The last step, with the errors of both gases and of the derivatives."""
    inverse = np.linalg.pinv(slopes * scale[:, None]) * scale
    count = len(values)

    def parts(*all_values):
        miss = np.array(all_values[:count]) - np.array(all_values[count:])
        left = scale * (miss - slopes @ (inverse @ miss))
        return np.append(numbers - inverse @ miss, 100.0 * np.sqrt(np.mean(left**2)))

    found = combine(parts, *values, *wanted)
    off = np.sqrt((inverse**2) @ (doubt**2 @ step**2))
    both = np.hypot(found.error[:-1], off)
    ends = {name: Estimate(found.value[k], both[k]) for k, name in enumerate(free)}
    exact = count == len(free)
    return Match(ends, Estimate(0.0, 0.0) if exact else found[-1])
