"""How many layers a slab needs: none much wider than a mean free path of the gas in it."""

import jax
import jax.core
import numpy as np

from .. import check, sweep
from ..gases.base import check_gas
from ..gases.relaxation import mean_free_paths
from ..units import INITIAL_TEMPERATURE

WIDEST = 0.5
"""Widest layer between walls, in mean free paths at the densest place. A layer of Δz conducts
better by (32/225π)(Δz/λ)²: 1.1% there, and 0.1% or less of the heat flux through the whole slab,
most of whose resistance is elsewhere."""

FEWEST = 100
"""Layers that any slab between walls has, to draw its profiles; those of the paper."""

RUNGS = 50 * 2 ** np.arange(50)
"""Numbers of layers to choose from. Few, so that neighbouring points of a sweep need the same: a
point has the layers, and so the numbers, that it has in a run of its own."""

CONDUCTED = 16.0 / (45.0 * np.pi)
"""Share by which collisions across a layer of Δz raise the viscosity, over (Δz/λ)² (Alexander,
Garcia and Alder, Phys. Fluids 10, 1540 (1998))."""

TOO_WIDE = 0.01
"""The same in the mean of all layers before a run remarks on it."""

JUMP = 2.127
"""Temperature jump at a wall over λ dT/dz (hard spheres, Maxwell walls)."""


def thin_layers(gas, cold_temperature, gravity, length, *, jump: bool, times: int = 1) -> int:
    """Layers at most `WIDEST` mean free paths wide, or so many times thinner; as `common_layers`.

    `jump`: whether the gas at a wall is warmer than the wall.
    """
    check_gas(gas)
    slab = [np.ravel(check.physical(number)) for number in (cold_temperature, gravity, length)]
    if any(values.dtype.kind != "f" or not np.all(np.isfinite(values)) for values in slab):
        return FEWEST  # refused with its name when the scene checks its fields
    cold, gravity, length = np.broadcast_arrays(*np.ix_(*slab))
    length, gravity = np.clip(length, 1e-6, 1e3), np.clip(gravity, -1.0, 1.0)
    cold = np.clip(cold, 1e-6, 1.0)
    wanted = length * densest(cold, gravity, length, jump) / WIDEST
    own = own_mean_free_paths(gas, np.clip(slab[0], 1e-6, 1.0))[..., None, None]
    return common_layers(np.maximum(FEWEST, times * own * wanted))


def own_mean_free_paths(gas, temperatures) -> np.ndarray:
    """Mean free paths in one λ0, at T0 or at a temperature (T0) if more: (gases, temperatures)."""
    traced = any(isinstance(leaf, jax.core.Tracer) for leaf in jax.tree.leaves(gas))
    if traced:
        return np.ones((1, len(temperatures)))
    found = [
        [mean_free_paths(one, INITIAL_TEMPERATURE * t) for t in (1.0, *temperatures)]
        for one in sweep.points(gas)[0]
    ]
    return np.maximum(np.array(found)[:, 1:], np.array(found)[:, :1])


def local_mean_free_paths(gas, temperature: np.ndarray) -> np.ndarray:
    """Mean free paths of one gas in one λ0 at temperatures over T0, as a power law between them."""
    ends = np.log(np.clip([np.min(temperature), np.max(temperature)], 1e-6, 1e6))
    ends[1] = max(ends[1], ends[0] + 1e-3)
    paths = [mean_free_paths(gas, INITIAL_TEMPERATURE * np.exp(one)) for one in ends]
    known = np.log(np.maximum(paths, 1e-300))
    return np.exp(np.interp(np.log(np.maximum(temperature, 1e-6)), ends, known))


def remark_on_layers(gas, density: np.ndarray, temperature: np.ndarray, length: float) -> str:
    """A sentence on layers that are too wide for the gas in them; or none.

    Arguments: one gas; profiles of n/n̄ and T/T0, NaN where nothing is known; L in λ0.
    """
    layers = len(density)
    known = (density > 0) & np.isfinite(temperature)
    paths = density * local_mean_free_paths(gas, np.where(known, temperature, 1.0))
    width = length / layers * np.where(known, paths, 0.0)
    excess = float(np.mean(CONDUCTED * width**2))
    if excess <= TOO_WIDE:
        return ""
    return (
        f"Layers up to {np.max(width):.2g} mean free paths wide conduct momentum "
        f"{100 * excess:.2g}% too well; take at least "
        f"{int(np.ceil(layers * np.sqrt(excess / TOO_WIDE)))} layers for {TOO_WIDE:.0%}."
    )


def common_layers(wanted) -> int:
    """The least of `RUNGS` that is enough for each point of a sweep by itself.

    Arguments: layers that each point needs, an array or a number.
    Raises ValueError if points need different ones: then they would not be the points they are in
    runs of their own.
    """
    wanted = np.ravel(wanted)
    if not wanted.size:  # of an empty array, which is refused when the scene checks its fields
        return FEWEST
    rungs = RUNGS[np.searchsorted(RUNGS, wanted)]
    least, most = int(np.min(rungs)), int(np.max(rungs))
    if least < most:
        raise ValueError(
            f"points of this sweep need {least} to {most} layers, but all of a sweep have as many: "
            f"give layers = {most}, which is enough for each, or run them one by one."
        )
    return most


def densest(cold, gravity, length, jump: bool):
    """Largest density n/n̄ of a gas between walls, about.

    Fourier's law (Tahiri et al., eq. 31) with θ = √T at the cold end of the gas has the pressure
    (1 + θ + θ²)/3 and the slope √T dT/dz = 2(1 - θ³)/3L; the jump there is θ² - T_- =
    2.127 (θ²/p) dT/dz. Gravity presses the gas into a scale height T/2|g| at either wall.
    """
    root = np.sqrt(cold)
    for _ in range(20 if jump else 0):
        pressure = (1.0 + root + root**2) / 3.0
        step = JUMP * 2.0 * (1.0 - root**3) / (3.0 * length * pressure)
        root = np.minimum(0.5 * (root + 0.5 * (step + np.sqrt(step**2 + 4.0 * cold))), 1.0)
    conducting = (1.0 + root + root**2) / (3.0 * root**2)
    pressed = 2.0 * np.abs(gravity) * length / np.where(gravity > 0, cold, 1.0)
    return np.maximum(conducting, pressed)
