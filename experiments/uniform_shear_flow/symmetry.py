"""The symmetry (3.21) of the marginal distributions, which `Result.distribution` has folded in.

`jdsmc` adds the two halves of eq. (5.3); this scene reports them one by one.
"""

from typing import ClassVar

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from jdsmc import Observable, Result
from jdsmc.measure.distributions import BIN_WIDTH, histogram
from jdsmc.scenarios import UniformShear

NOWHERE = 1e6
"""A velocity that no bin holds."""


class Halves(eqx.Module):
    """Fractions of particles in bins of C_x and C_y, the other component being > 0 or < 0."""

    x_plus: Float[Array, " bins"]
    x_minus: Float[Array, " bins"]
    y_plus: Float[Array, " bins"]
    y_minus: Float[Array, " bins"]


class HalvedShear(UniformShear):
    """Uniform shear flow with the halves of its marginal distributions."""

    sampled: ClassVar[tuple[Observable, ...]] = tuple(
        Observable(f"{axis}_{side}", f"C_{axis}, half of the particles", dims=("velocity",))
        for axis in "xy"
        for side in ("plus", "minus")
    )

    def finish_chunk(self, state):
        """Sample both halves and deal the particles into new rows."""
        mixed, _ = super().finish_chunk(state)
        scale = jnp.sqrt(1.5 / jnp.mean(sum(v * v for v in state.velocity)))
        x, y = (scale * v for v in state.velocity[:2])
        parts = [
            histogram(jnp.where(chosen, value, NOWHERE), symmetric=True)
            for value, other in ((x, y), (y, x))
            for chosen in (other > 0, other < 0)
        ]
        return mixed, Halves(*parts)

    def sample_densities(self, sample: dict) -> dict:
        """Densities in units of 1/v0(T)."""
        return {name: values / BIN_WIDTH for name, values in sample.items()}


def misfit(result: Result, axis: str) -> tuple[float, int]:
    """χ²/ν of g^(+)(C) - g^(-)(-C) in the bins |C| < 3 with enough particles, and their number."""
    found, size = result.distribution, int(result.attrs["n_particles"]) * BIN_WIDTH
    names = f"{axis}_plus", f"{axis}_minus"
    plus, minus = (found[name].values.squeeze() for name in names)
    wrong = [found[f"{name}_error"].values.squeeze() for name in names]
    filled = (size * (plus + minus[::-1]) > 1.0) & (np.abs(found["velocity"].values) < 3.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        score = ((plus - minus[::-1]) / np.hypot(wrong[0], wrong[1][::-1]))[filled]
    count = int(result.attrs["n_realizations"])
    expected = (count - 1) / (count - 3)  # mean square of Student's t
    return float(np.mean(score**2) / expected), int(filled.sum())
