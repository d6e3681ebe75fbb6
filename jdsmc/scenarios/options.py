"""The numerical options of a run: everything static, nothing physical but the time step."""

from dataclasses import dataclass

import jax
import jax.numpy as jnp
import numpy as np

from .. import check
from ..collisions.pairs import PairPlan, plan_pairs
from ..types import Whole

PARTICLES = 5_120
"""Default of a scene that has none of its own. Averages are off by about 1/N (a2 by -2/3N, T of a
sheared gas by 2e-4): within errors of a thousandth of the stress, for which a gas of 20000 takes
nearly twice as long, most of it the approach to the steady state."""

TIME_STEP = 0.05
"""Default fraction of τ(T): steady values at the strongest shear of the papers are within 0.3% of
the limit of short steps (experiments/uniform_shear_flow, convergence); 0.1 puts a2 0.5% off."""

STEPS_PER_RECORD = 16
"""Default: a record each 0.8 τ(T), nearly one collision per particle."""

STEPS_PER_CHUNK = 64
"""Steps between two looks at the clock, about."""


@dataclass(frozen=True)
class Options:
    """Sizes and switches that select a compiled program.

    `plan`: how a homogeneous gas is laid out in rows, None in space; `time_step`: largest step as a
    fraction of τ(T), of the scene's own time, or in τ0 (the scene says which); `steps`: steps per
    record; `records`: records per chunk (what is done between two looks at the clock).
    """

    n_particles: int
    plan: PairPlan | None
    time_step: float
    splitting: str
    steps: int
    records: int
    dtype: jnp.dtype

    @property
    def halves(self) -> tuple[float, float]:
        """Shares of a flow before and after the collisions of a step."""
        return (0.5, 0.5) if self.splitting == "strang" else (1.0, 0.0)

    @property
    def rows(self) -> PairPlan:
        """The layout of a homogeneous gas; TypeError in space, where there is none."""
        if self.plan is None:
            raise TypeError("a gas in space is not laid out in rows.")
        return self.plan

    @staticmethod
    def checked(
        n_particles,
        time_step,
        splitting: str,
        dtype,
        steps: Whole,
        samples: int = 1,
        in_space: bool = False,
    ) -> "Options":
        """Check the options of `run` and lay out the particles; raises ValueError or TypeError."""
        n_particles = check.size("n_particles", n_particles, 64)
        steps = check.size("steps_per_record", steps, 1)
        check.scalar("time_step", time_step, 0.0, 1.0)
        check.one_of("splitting", splitting, ("strang", "lie"))
        kind = checked_dtype(dtype)
        plan = None if in_space else plan_pairs(n_particles, float(time_step))
        records = max(1, STEPS_PER_CHUNK // (steps * samples))
        return Options(n_particles, plan, float(time_step), splitting, steps, records, kind)


def checked_dtype(dtype) -> jnp.dtype:
    """float32 or float64, given by name or as a type; the latter needs JAX's x64 mode."""
    try:
        name = dtype if dtype is None else np.dtype(dtype).name
    except (TypeError, ValueError):
        name = dtype
    check.one_of("dtype", name, ("float32", "float64"))
    if name == "float64" and not jax.config.read("jax_enable_x64"):
        raise ValueError(
            'dtype = "float64" needs jax.config.update("jax_enable_x64", True) before the run.'
        )
    return jnp.dtype(name)
